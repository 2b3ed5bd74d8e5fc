#!/usr/bin/env python3
"""Iterations of the iterative solvers on the tied thick sphere to 1e-10: iterations.py MORTISE

Over degree and mesh, over ranks, and over contrast and ratio of sizes. Writes doc/iterations.md."""
import json
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MESHES = {1: ("4,2:6,3", "8,4:12,6", "16,8:24,12"), 2: ("2,1:3,2", "4,2:6,3", "8,4:12,6"),
          3: ("2,1:3,2", "4,2:6,3", "8,4:12,6"), 4: ("1,1:2,1", "2,1:3,2", "4,2:6,3"),
          5: ("1,1:2,1", "2,1:3,2", "4,2:6,3"), 6: ("1,1:2,1", "2,1:3,1", "3,1:4,2")}
METHODS = ("saddle point", "condensed")


def iterations(mortise, p, meshes, method, ranks=1, moduli=(10, 10), slave="inner"):
    inner, outer = meshes.split(":")
    settings = [f"Body inner/Degree={p}", f"Body outer/Degree={p}", f"Body inner/Mesh/Subdivisions={inner}",
                f"Body outer/Mesh/Subdivisions={outer}", f"Solver/Method={method}", "Output/Fields=",
                f"Body inner/Material/Young modulus={moduli[0]}", f"Body outer/Material/Young modulus={moduli[1]}"]
    if slave == "outer":
        settings += ["Interface glue/Slave=outer: inside", "Interface glue/Master=inner: outside"]
    with tempfile.TemporaryDirectory() as work:
        command = [mortise, os.path.join(TOP, "prm", "thick_sphere.prm"), "--output", work]
        for setting in settings:
            command += ["--set", setting]
        if ranks > 1:
            root = ["--allow-run-as-root"] if os.getuid() == 0 else []
            command = ["mpirun", "-q", "-n", str(ranks), "--oversubscribe", "--bind-to", "none",
                       "--mca", "mpi_yield_when_idle", "1"] + root + command
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return json.load(open(os.path.join(work, "summary.json")))["steps"][-1]["solver"]["iterations"]


def both(mortise, *arguments, **options):
    return " / ".join(str(iterations(mortise, *arguments[:2], method, *arguments[2:], **options)) for method in METHODS)


def report(mortise):
    yield ("# Iterations to a relative residual of 1e-10\n\nRegenerate: `tests/benchmarks/iterations.py build/mortise`. Scene "
           "`prm/thick_sphere.prm`; each entry:\nsubdivisions inner : outer, iterations of `saddle point` / `condensed`.\n\n"
           "| p | | | |\n|---|---|---|---|")
    for p, meshes in MESHES.items():
        yield f"| {p} | " + " | ".join(f"{m} {both(mortise, p, m)}" for m in meshes) + " |"
    yield "\nOver ranks, same entries:\n\n| p, mesh | 1 | 2 | 3 | 5 |\n|---|---|---|---|---|"
    for p, mesh in ((1, "8,4:12,6"), (2, "4,2:6,3"), (4, "2,1:3,2")):
        yield f"| {p}, {mesh} | " + " | ".join(both(mortise, p, mesh, ranks=n) for n in (1, 2, 3, 5)) + " |"
    yield ("\nOver Young's moduli (inner : outer) and side of the slave, p = 2, 4,2:6,3:\n\n"
           "| slave | 1e6 : 1 | 1e3 : 1 | 1 : 1e3 | 1 : 1e6 |\n|---|---|---|---|---|")
    for slave in ("inner", "outer"):
        yield f"| {slave} | " + " | ".join(both(mortise, 2, "4,2:6,3", moduli=e, slave=slave)
                                           for e in ((1e6, 1), (1e3, 1), (1, 1e3), (1, 1e6))) + " |"
    yield "\nOver the ratio of sizes, p = 1 and 2:\n\n| slave | p = 1, 2,2:20,4 | p = 2, 1,1:10,2 |\n|---|---|---|"
    for slave in ("inner", "outer"):
        yield f"| {slave} | {both(mortise, 1, '2,2:20,4', slave=slave)} | {both(mortise, 2, '1,1:10,2', slave=slave)} |"


def main():
    with open(os.path.join(TOP, "doc", "iterations.md"), "w") as file:
        for line in report(os.path.abspath(sys.argv[1])):
            print(line, flush=True)
            file.write(line + "\n")


if __name__ == "__main__":
    main()
