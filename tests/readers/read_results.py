# SPDX-License-Identifier: LGPL-2.1-or-later
# The files of a run, read by programs that are not ours: ParaView's library,
# meshio, pandas, jq. What is not installed is skipped, with a word.
#   read_results.py <slipstep> [mpirun ...]
import glob, importlib, json, os, shutil, subprocess, sys, tempfile
import xml.etree.ElementTree as xml

here = os.path.dirname(os.path.abspath(__file__))
missing = []
n_read = 0


def library(name, package):
    try:
        return importlib.import_module(name)
    except ImportError:
        missing.append(f"{name} (Debian: {package})")


def require(condition, *what):
    global n_read
    n_read += 1
    if not condition:
        sys.exit("wrong: " + " ".join(str(part) for part in what))


def near(value, expected, tolerance, *what):
    require(abs(value - expected) <= tolerance * abs(expected),
            *what, value, "instead of", expected)


vtk = library("vtk", "python3-vtk9")
meshio = library("meshio", "python3-meshio")
pandas = library("pandas", "python3-pandas")
jq = shutil.which("jq")
if not jq:
    missing.append("jq (Debian: jq)")


# Integrals over the cells of what is known at points.
def check_vtk(file, history, area):
    from vtk.util.numpy_support import vtk_to_numpy
    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    grid = reader.GetOutput()
    require(grid.GetNumberOfCells() > 0, file, "has no cells")
    names = {grid.GetPointData().GetArrayName(i)
             for i in range(grid.GetPointData().GetNumberOfArrays())}
    require("squared_error_Nmm" in names, file, "does not tell the error")
    if "fields_" in file:
        require({"displacement_mm", "stress_MPa"} <= names, file, names)
        return
    require({"r", "r_s", "mu", "slips", "pressure_MPa"} <= names, file, names)
    integrate = vtk.vtkIntegrateAttributes()
    integrate.SetInputData(grid)
    integrate.Update()
    found = integrate.GetOutput()
    extent = found.GetCellData().GetArray(0).GetValue(0)
    near(extent, area, 1e-6, file, "area")
    for name, column in ("pressure_MPa", "normal_load_N"), \
                        ("traction_x_MPa", "tangential_load_N"):
        total = found.GetPointData().GetArray(name).GetValue(0)
        near(total, history[column], 1e-5, file, name)
    mu = vtk_to_numpy(grid.GetPointData().GetArray("mu"))
    require(history["mu_min"] - 1e-6 <= mu.min() and
            mu.max() <= history["mu_max"] + 1e-6, file, "mu", mu.min(), mu.max())


def check_meshio(file, kind):
    mesh = meshio.read(file)
    require(len(mesh.points) > 0 and [c.type for c in mesh.cells] == [kind],
            file, mesh)
    for name, values in mesh.point_data.items():
        require(len(values) == len(mesh.points), file, name)


def check_collection(file, folder, n_times):
    entries = xml.parse(file).getroot().findall("./Collection/DataSet")
    require(len(entries) == n_times, file, len(entries))
    for entry in entries:
        require(os.path.exists(os.path.join(folder, entry.get("file"))), file)


# The picture that ParaView makes of it; where it cannot draw, a word.
def check_state(script):
    with open(script) as text:
        compile(text.read(), script, "exec")
    draw = shutil.which("pvbatch")
    if not draw:
        missing.append("pvbatch (Debian: paraview)")
        return
    screen = shutil.which("xvfb-run")
    picture = script + ".png"
    result = subprocess.run(([screen, "-a"] if screen else []) +
                            [draw, script, picture],
                            capture_output=True, text=True)
    require("Traceback" not in result.stderr, result.stderr[-2000:])
    if os.path.exists(picture):
        require(os.path.getsize(picture) > 10000, picture, "is empty")
    else:
        missing.append("a screen on which pvbatch can draw")


def check(case, launcher, folder, area, kinds):
    subprocess.run(launcher + [sys.argv[1], "run", os.path.join(here, case),
                               "--quiet", "--output", folder],
                   check=True, stderr=subprocess.DEVNULL)
    tables = glob.glob(folder + "/*.csv")
    require(len(tables) >= 2, "no tables in", folder)
    with open(folder + "/history.csv") as lines:
        names = next(lines).strip().split(",")
        history = dict(zip(names, map(float, list(lines)[-1].split(","))))
    if pandas:
        for file in tables:
            table = pandas.read_csv(file)
            require(len(table) > 0 and all(kind != object for kind in table.dtypes),
                    file, table.dtypes)
        last = pandas.read_csv(folder + "/history.csv").iloc[-1]
        require(list(last.index) == names, "history.csv", last)
        for name in names:  # its numbers are off by a last digit
            near(last[name], history[name], 1e-12, "history.csv", name)
    if jq:
        final = subprocess.run([jq, ".friction.final", folder + "/summary.json"],
                               check=True, capture_output=True).stdout
        near(float(final), history["friction"], 1e-12, "jq .friction.final")
    check_state(folder + "/paraview_state.py")
    with open(folder + "/summary.json") as file:
        probes = json.load(file)["probes"]
    require(list(probes) == [n for n in names if n.startswith("probe_")], probes)
    for name, kind in kinds.items():
        check_collection(f"{folder}/{name}.pvd", folder, 2)
        require(glob.glob(f"{folder}/{name}_0001.*vtu"), "no fields in", folder)
        if vtk:
            check_vtk(f"{folder}/{name}_0001.pvtu", history, area)
        if meshio:
            for file in glob.glob(f"{folder}/{name}_*.vtu"):
                check_meshio(file, kind)


with tempfile.TemporaryDirectory() as scratch:
    three_d = {"fields": "hexahedron", "contact": "quad"}
    check("block.prm", [], scratch + "/block", 100., three_d)
    check("strip.prm", [], scratch + "/strip", 10.,
          {"fields": "quad", "contact": "line"})
    if len(sys.argv) > 2:
        check("block.prm", sys.argv[2:], scratch + "/ranks", 100., three_d)

print(n_read, "checks")
if missing:
    print("skipped: not installed are", ", ".join(missing))
    if not (vtk or meshio or pandas or jq):
        sys.exit(77)
