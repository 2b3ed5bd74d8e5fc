"""Proves that the classes of parameters are what the program says of them, and that scenes survive reading and writing:
parameters.py MORTISE SOURCE_DIRECTORY"""

import pathlib
import subprocess
import sys

import mortise
from verdict import end, raised, verdict

program, source = sys.argv[1], pathlib.Path(sys.argv[2])


def generated():
    reference = subprocess.run([program, "--parameters=json"], capture_output=True, text=True, check=True).stdout
    check = [sys.executable, "-B", str(source / "source/python/generate.py"), "--check"]
    done = subprocess.run(check, input=reference, capture_output=True, text=True)
    verdict(done.returncode == 0, "bodies.py and scene.py are made from mortise --parameters=json", done.stderr)
    changed = reference.replace('"Max iterations"', '"Most iterations"')
    verdict(subprocess.run(check, input=changed, capture_output=True, text=True).returncode == 1,
            "another parameter of the program would be noticed")


def scenes():
    files = sorted(source.glob("prm/*.prm")) + sorted(source.glob("tests/field/*.prm"))
    differ = []
    for file in files:
        try:
            scene = mortise.Scene.read(file)
        except mortise.InputError as error:
            differ.append(f"{file.name} ({error})")
            continue
        if mortise.Scene.read(scene.write("again.prm")) != scene:
            differ.append(file.name)
    verdict(not differ and len(files) > 100, "all scenes of prm and tests/field are the same when they are written and read again",
            f"{len(files)} scenes, {differ}")
    # what the program reads in both, apart from what is at its default
    file = source / "prm/flange_steps.prm"
    scene = mortise.Scene.read(file)
    scene.write("again.prm")
    for name, changed in (("an included file", file), ("the scene that was written", "again.prm")):
        done = subprocess.run([program, "--validate", "--set", "Body upper/Mesh/Distort=nonsense", str(changed)],
                              capture_output=True, text=True)
        verdict(done.returncode == 2 and "Distort" in done.stderr, f"the program understands {name}", done.stderr)
    verdict(scene.steps.step == (0.2,) and scene.bodies["upper"].boundaries["end"].traction[2].startswith("10 * max"),
            "an included file, and what follows it, is read", scene.steps)


def values():
    scene = mortise.Scene.read(source / "prm/thick_sphere.prm")
    inner = scene.bodies["inner"]
    verdict(inner.mesh.extent == (1.0, 1.5) and inner.material.young_modulus == 10.0 and inner.degree == 2
            and inner.boundaries["xmin"].displacement == (0.0, "-", "-") and scene.output.fields[0] == "displacement",
            "numbers, lists, expressions and selections", inner)
    inner.boundaries["inside"].traction = ("t", 0, "sin(pi * x)")
    inner.mesh.subdivisions = [4, 2]
    scene.solver.print_iterations = True
    text = scene.text()
    verdict("set Traction = t; 0; sin(pi * x)" in text and "set Subdivisions = 4, 2" in text
            and "set Print iterations = true" in text and "Tolerance" not in text,
            "are written as a parameter file has them, without what is at its default", text)
    error = raised(AttributeError, lambda: setattr(inner, "degre", 3))
    verdict("did you mean 'degree'" in str(error), "a name that is none is an error, with the nearest one", error)
    error = raised(TypeError, lambda: mortise.Body(degre=3))
    raised(ValueError, lambda: mortise.Scene(title="a # b").text())
    pathlib.Path("wrong.prm").write_text("set Bodies = a\nsubsection Body a\n  set Degre = 1\nend\n")
    error = raised(mortise.InputError, lambda: mortise.Scene.read("wrong.prm"))
    verdict('"Degre" (line 3 of wrong.prm) (did you mean "Degree"?)' in str(error), "an unknown name in a file, with its line", error)
    error = raised(mortise.InputError, lambda: mortise.Scene.read("missing.prm"))
    verdict("missing.prm" in str(error), "a file that is missing", error)
    doc = (pathlib.Path(mortise.__file__).parent / "bodies.py").read_text()
    verdict("degree: int" in doc and "Polynomial degree of the displacement." in doc, "editors see types and meanings")


generated()
scenes()
values()
end()
