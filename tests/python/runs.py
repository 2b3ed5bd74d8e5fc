"""Proves that scenes run from Python, with results as the summary and the files of fields have them, and that errors of the
program are exceptions: runs.py MORTISE SOURCE_DIRECTORY"""

import os
import pathlib
import sys

from verdict import end, need, raised, verdict

numpy = need("numpy")
import mortise  # noqa: E402

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
os.environ["MORTISE"] = program


def sphere():
    scene = mortise.Scene.read(source / "prm/thick_sphere.prm")
    lines = []
    results = mortise.run(scene, output="sphere", settings={"Body outer/Degree": 3}, log=lines.append)
    last = results.last
    verdict(results.status == "done" and results.warnings == [] and last.errors.energy < 0.03, "a scene with an exact solution", last)
    verdict(results.summary.parameters["Body outer/Degree"] == "3" and results.body("outer").degree_max == 3, "with a setting")
    verdict(any("condensed" in line for line in lines) and "condensed" in results.log, "its log, as it comes and kept")
    u = results.quantity("at r 1")
    verdict(abs(u[0] - 0.08) < 1e-4, "the displacement at a point", u)
    for body, step in (("inner", -1), ("outer", 0)):
        grid = results.fields(body, step)
        largest = float(numpy.linalg.norm(grid["displacement"], axis=1).max())
        peak = results.body(body).displacement_max
        verdict(abs(largest - peak.value) < 1e-6 * peak.value, f"fields of {body} have the largest displacement of the summary", largest)
        nearest = numpy.linalg.norm(grid.points - numpy.array(peak["at"]), axis=1).min()
        verdict(nearest < 1e-9 and len(grid.types) == results.body(body).cells and grid.offsets[-1] == len(grid.points),
                "at its place, in as many cells", nearest)
    radius = numpy.linalg.norm(results.fields("glue").points, axis=1)
    verdict(abs(radius - 1.5).max() < 1e-12 and "traction" in results.fields("glue").point_data, "fields of the interface")
    error = raised(KeyError, lambda: results.fields("glu"))
    verdict("inner, outer, glue" in str(error), "fields that are not there", error)


def steps():
    def block(low, high, **boundaries):
        return mortise.Body(degree=2, mesh=mortise.Mesh(extent=(0, 0, low, 1, 1, high), subdivisions=(2, 2, 2)),
                            material=mortise.Material(young_modulus=100, poisson_ratio=0), boundaries=boundaries)

    scene = mortise.Scene(
        title="A bar that is pulled",
        bodies={"lower": block(0, 1, zmin=mortise.Boundary(displacement=(0, 0, 0))),
                "upper": block(1, 2, zmax=mortise.Boundary(traction=(0, 0, "t^2")))},
        interfaces={"tie": mortise.Interface(slave="lower: zmax", master="upper: zmin")},
        steps=mortise.Steps(end_time=2, step=[0.5, 1, 2]),
        output=mortise.Output(points="end: upper: 1, 1, 2", resultants="support: lower: zmin", fields=["displacement", "stress"]))
    results = mortise.run(scene, ranks=2, output="bar")
    tables = results.tables
    time = tables["steps"]["time"]
    verdict(list(time) == [0.5, 1.0, 2.0], "a scene made in Python runs its steps, on two ranks", time)
    end_of_bar = tables["quantities"].where(name="end")["z"]
    verdict(abs(end_of_bar - 2 * time**2 / 100).max() < 1e-9, "the table of quantities: u = 2 sigma / E", end_of_bar)
    verdict(abs(tables["quantities"].where(name="support")["z"] + time**2).max() < 1e-8, "and the reaction, minus the load")
    verdict(abs(tables["interfaces"]["force_z"]).max() > 3.9 and len(tables["bodies"]) == 6, "tables of interfaces and bodies")
    verdict([f.time for f in results.field_files("upper")] == [0.5, 1.0, 2.0], "files of fields with their times")
    verdict(abs(results.fields("upper", 1)["stress"][:, 8] - 1).max() < 1e-5, "the stress of a step, of the pieces of both ranks")
    grid = results.fields("upper")
    height = grid.points[grid.connectivity[grid.offsets - 1]][:, 2]
    verdict(grid.offsets[-1] == len(grid.points) and len(grid.types) == 8 and list(height) == [1.25] * 4 + [1.75] * 4, "and their cells, whose last nodes are in the middle", height)
    outcomes = mortise.sweep(scene, {"Body lower/Material/Young modulus": [100, 50], "Steps/Step": ["1", "nonsense"]},
                             jobs=2, output="sweep")
    values = [o.results.quantity("end")[2] if o.results else type(o.error).__name__ for o in outcomes]
    verdict(values[1] == values[3] == "InputError" and abs(values[0] - 0.08) < 1e-9 and abs(values[2] - 0.12) < 1e-9,
            "a sweep, in which some runs fail", values)


def errors():
    scene = mortise.Scene.read(source / "prm/patch.prm")
    error = raised(mortise.InputError, lambda: mortise.run(scene, output="wrong", settings={"Body lower/Degree": 9}))
    verdict(error and error.exit_code == 2 and str(error).startswith("error: Body lower/Degree") and "8" in str(error)
            and error.results is None, "wrong input, with the program's own text", error)
    verdict(not pathlib.Path("wrong").exists(), "which leaves no directory")
    sphere = source / "prm/thick_sphere.prm"
    error = raised(mortise.NotConverged, lambda: mortise.run(sphere, output="stopped", settings={"Solver/Max iterations": 2}))
    verdict(error and error.exit_code == 3 and error.results.status == "not converged", "no convergence, with what was reached", error)
    error = raised(mortise.Interrupted, lambda: mortise.run(source / "prm/flange.prm", output="late", timeout=0.5))
    verdict(error and error.exit_code == 143, "a time that is up", error and error.exit_code)
    error = raised(mortise.ProgramNotFound, lambda: mortise.run(sphere, program="no/such/program"))
    verdict("no/such/program" in str(error), "a program that is not there", error)


sphere()
steps()
errors()
end()
