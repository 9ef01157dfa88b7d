# SPDX-License-Identifier: LGPL-2.1-or-later
"""The law and the results as Python has them. Arguments: folder of the cases."""
import json
import os
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("SKIPPED: numpy is missing (Debian: python3-numpy)")
    sys.exit(77)
import slipstep

cases = Path(sys.argv[1])
for name in ("velocity_step", "anisotropic_path"):
    case = cases / name / f"{name}.prm"
    with tempfile.TemporaryDirectory() as folder:
        history = slipstep.read(slipstep.run(case, output=folder, command="point"))
        assert slipstep.read(folder, "summary.json")["command"] == "point"
    law = slipstep.Law(case)
    point = law.point()
    motion = np.diff(np.vstack([history["displacement_mm"], history["displacement_y_mm"]]), prepend=0.)
    times = np.diff(history["time_s"], prepend=0.)
    tractions = np.array([point.step(motion[:, i], history["pressure_MPa"][i], times[i])
                          for i in range(len(times))])
    expected = history["pressure_MPa"] * history["friction"]
    difference = np.max(np.abs(tractions[:, 0] - expected))
    print(name, "largest difference", difference, "MPa, mu", point["mu"])
    assert len(times) > 20 and difference < 1e-10

# Derivatives have the shapes that they are said to have, and their meaning.
end, traction, d_slip, d_pressure = law.step(law.initial_state(), [1e-6, 0.], 5., 1e-3)
assert d_slip.shape == (2, 2) and d_pressure.shape == (2,)
stiffer, _, _, _ = law.step(law.initial_state(), [1.01e-6, 0.], 5., 1e-3)
assert np.isclose((stiffer[0] - end[0]) / 1e-8, d_slip[0, 0], rtol=1e-3)

# A sweep is a dictionary of its members; --set arrives.
sweep = cases / "slide_hold_slide" / "slide_hold_slide.prm"
with tempfile.TemporaryDirectory() as folder:
    slipstep.run(sweep, output=folder, command="point",
                 set={"Loading/Programme": "press 1 MPa in 1 s; slide for 0.1 mm"})
    members = slipstep.read(folder)
    assert len(members) == 3, members.keys()
    for columns in members.values():
        assert abs(columns["displacement_mm"][-1] - 0.1) < 1e-12

# What is wrong is said.
for wrong in (lambda: slipstep.Law("nowhere.prm"),
              lambda: slipstep.Law(case, set={"Friction/Efects": "x"}),
              lambda: law.step([1., 2.], 0., 1., 1.),
              lambda: law.step(law.initial_state(), 0., 1., 0.),
              lambda: slipstep.read("nowhere")):
    try:
        wrong()
    except slipstep.Error as error:
        print("refused:", str(error).splitlines()[0])
    else:
        sys.exit("not refused")

# The notebook runs, and says what the case says.
notebook = cases.parent / "doc" / "guide" / "flat_surface_test.ipynb"
os.chdir(notebook.parent)
try:
    import matplotlib
    matplotlib.use("Agg")
    can_plot = True
except ImportError:
    print("without the picture: matplotlib is missing (Debian: python3-matplotlib)")
    can_plot = False
names = {}
for cell in json.loads(notebook.read_text())["cells"]:
    source = "".join(cell["source"])
    if cell["cell_type"] == "code" and (can_plot or "matplotlib" not in source):
        exec(source, names)
for speed, kinetic in ((1., 0.0980), (10., 0.1074), (50., 0.1138), (200., 0.1191)):
    assert abs(names["slides"][speed][1][-1] - kinetic) < 1e-4
assert names["difference"] < 1e-10
assert max(names["without_rate"]) - min(names["without_rate"]) < 1e-6
if can_plot:
    assert len(names["axes"].lines) == 4
