# SPDX-License-Identifier: LGPL-2.1-or-later
"""slipstep from Python: its friction law, its runs and its results.

    import slipstep
    law = slipstep.Law("case.prm")            # or the law.prm of "slipstep export"
    point = law.point()
    for _ in range(100):
        traction = point.step(slip=1e-4, pressure=5.8, time_step=0.01)
    folder = slipstep.run("case.prm", set={"Loading/Speed": "5 mm/min"}, command="point")
    data = slipstep.read(folder)              # columns of history.csv by name

Units are mm, s, N, MPa. Needs numpy. The program is found in PATH or as environment
variable SLIPSTEP, the library as SLIPSTEP_LIBRARY, beside this file, or where libraries
are.
"""

import ctypes
import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np


class Error(Exception):
    """What slipstep itself says is wrong."""


def _library():
    here = Path(__file__).resolve().parent
    name = "libslipstep_friction.so"
    places = [os.environ.get("SLIPSTEP_LIBRARY", "")]
    places += [str(folder / name) for folder in (here, *here.parents[:3])]
    places += [str(path) for folder in here.parents[:3] for path in folder.glob(f"lib*/**/{name}")]
    found = next((place for place in places if place and os.path.exists(place)), name)
    library = ctypes.CDLL(found)
    pointer, real, text = ctypes.c_void_p, ctypes.c_double, ctypes.c_char_p
    numbers = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
    library.slipstep_law_read.restype = pointer
    library.slipstep_law_read.argtypes = [text, text, ctypes.c_size_t]
    library.slipstep_law_free.argtypes = [pointer]
    library.slipstep_state_size.argtypes = [pointer]
    library.slipstep_state_name.restype = text
    library.slipstep_state_name.argtypes = [pointer, ctypes.c_int]
    library.slipstep_initial_state.argtypes = [pointer, numbers]
    for name in ("tangential", "normal"):
        function = getattr(library, f"slipstep_{name}_stiffness")
        function.restype = real
        function.argtypes = [pointer]
    library.slipstep_step.argtypes = [pointer, numbers, numbers, real, real, numbers, numbers,
                                      numbers, numbers, text, ctypes.c_size_t]
    return library


def _program():
    program = os.environ.get("SLIPSTEP") or shutil.which("slipstep")
    if not program:
        raise Error("the program slipstep is not in PATH; name it by the environment variable "
                    "SLIPSTEP")
    return program


def _call(*arguments):
    done = subprocess.run([_program(), *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise Error(done.stderr.strip())
    return done


def _options(set, variant):
    options = [f"--set={path}={value}" for path, value in (set or {}).items()]
    return options + ([f"--variant={variant}"] if variant else [])


class Law:
    """The friction law of a case. One law serves any number of points."""

    def __init__(self, case, set=None, variant=None):
        """Read a law.prm that "slipstep export" wrote, or the law of a whole case."""
        self._library = _library()
        with tempfile.TemporaryDirectory() as folder:
            if Path(case).name != "law.prm" or set or variant:
                _call("export", case, "--output", folder, *_options(set, variant))
                case = next(Path(folder).rglob("law.prm"))
            message = ctypes.create_string_buffer(1000)
            self._law = self._library.slipstep_law_read(os.fsencode(case), message, 1000)
        if not self._law:
            raise Error(message.value.decode())
        size = self._library.slipstep_state_size(self._law)
        self.names = [self._library.slipstep_state_name(self._law, i).decode()
                      for i in range(size)]
        self.tangential_stiffness = self._library.slipstep_tangential_stiffness(self._law)
        self.normal_stiffness = self._library.slipstep_normal_stiffness(self._law)

    def __del__(self):
        if getattr(self, "_law", None):
            self._library.slipstep_law_free(self._law)

    def initial_state(self):
        """State of a point that has not been loaded: numbers named by `names`."""
        state = np.empty(len(self.names))
        self._library.slipstep_initial_state(self._law, state)
        return state

    def step(self, state, slip, pressure, time_step):
        """A step in which slip and pressure change evenly.

        state: numbers before it; slip: increment [mm], a number or two; pressure at its end
        [MPa]; time_step [s]. Returns the state at the end, the traction (2) [MPa], its
        derivatives by slip (2, 2) [MPa/mm] and by pressure (2).
        """
        start = np.array(state, dtype=float)
        if start.shape != (len(self.names),):
            raise Error(f"a state of this law has {len(self.names)} numbers")
        increment = np.zeros(2)
        increment[:np.size(slip)] = slip
        end, traction = np.empty(len(self.names)), np.empty(2)
        d_slip, d_pressure = np.empty((2, 2)), np.empty(2)
        message = ctypes.create_string_buffer(1000)
        if self._library.slipstep_step(self._law, start, increment, pressure, time_step, end,
                                       traction, d_slip, d_pressure, message, 1000):
            raise Error(message.value.decode())
        return end, traction, d_slip, d_pressure

    def point(self):
        """A contact point that remembers its state."""
        return Point(self)


class Point:
    """A contact point: step() goes on from where the last one ended."""

    def __init__(self, law):
        self.law = law
        self.state = law.initial_state()

    def step(self, slip, pressure, time_step):
        """Returns the traction (2) [MPa]."""
        self.state, traction, _, _ = self.law.step(self.state, slip, pressure, time_step)
        return traction

    def __getitem__(self, name):
        """A number of the state by its name, such as "mu"."""
        return self.state[self.law.names.index(name)]


def run(case, set=None, variant=None, output=None, command="run"):
    """Run a case (command "point": on one contact point). Returns the folder of the results;
    without `output` a new one that stays."""
    output = Path(output or tempfile.mkdtemp(prefix="slipstep_"))
    _call(command, case, "--quiet", "--output", output, *_options(set, variant))
    return output


def read(folder, file="history.csv"):
    """Columns by name, as arrays, of a table in a folder of results; of a sweep, such a
    dictionary per member. "summary.json" is read as it is."""
    folder = Path(folder)
    if not (folder / file).exists():
        members = {path.parent.name: path.parent for path in sorted(folder.glob(f"*/{file}"))}
        if not members:
            raise Error(f"{folder} has no {file}")
        return {name: read(path, file) for name, path in members.items()}
    if file.endswith(".json"):
        return json.loads((folder / file).read_text())
    with open(folder / file) as lines:
        rows = [line for line in lines if not line.startswith("#")]
    names = rows[0].strip().split(",")
    values = np.genfromtxt(rows[1:], delimiter=",", ndmin=2)
    return {name: values[:, i] for i, name in enumerate(names)}


def plot(folder, x="displacement_mm", y="friction", axes=None):
    """One column over another, a curve per member of a sweep; needs matplotlib."""
    import matplotlib.pyplot as plt
    axes = axes or plt.subplots()[1]
    data = read(folder)
    for name, columns in ({"": data} if x in data else data).items():
        axes.plot(columns[x], columns[y], label=name or None)
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if x not in data:
        axes.legend()
    return axes
