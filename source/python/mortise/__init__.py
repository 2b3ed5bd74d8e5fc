"""Mortise from Python: scenes, runs, results and reports.

    import mortise
    scene = mortise.Scene.read("prm/thick_sphere.prm")
    scene.bodies["inner"].degree = 3
    results = mortise.run(scene, output="results/mine")
    print(results.last.errors.energy, results.quantity("at r 1"))
"""

from .bodies import Body, Boundary, Material, Mesh
from .errors import (InputError, Interrupted, MortiseError, NotConverged, OutOfMemory, ProgramDefect,
                     ProgramNotFound)
from .program import Outcome, find_program, run, sweep
from .results import FieldFile, Record, Results
from .scene import Adaptivity, ExactSolution, Interface, Output, Scene, Solver, Steps
from .tables import Table
from .vtu import Grid, read_vtu

__version__ = "0.1.0"
__all__ = [
    "Adaptivity", "Body", "Boundary", "ExactSolution", "FieldFile", "Grid", "InputError", "Interface",
    "Interrupted", "Material", "Mesh", "MortiseError", "NotConverged", "Outcome", "OutOfMemory", "Output",
    "ProgramDefect", "ProgramNotFound", "Record", "Results", "Scene", "Solver", "Steps", "Table",
    "find_program", "read_vtu", "run", "sweep",
]
