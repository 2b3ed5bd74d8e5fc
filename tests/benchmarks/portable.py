#!/usr/bin/env python3
"""portable.py [ROUNDS] PROGRAM...: seconds of the processor that scenes take with programs that are compiled for
different processors, run in turn; medians, and the ratio to the first program. Prints the table of
doc/measurements/portable.md."""
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

rounds, programs = (int(sys.argv[1]), sys.argv[2:]) if sys.argv[1].isdigit() else (5, sys.argv[1:])
prm = Path(__file__).resolve().parents[2] / "prm"


def scene(name, bodies=(), **settings):
    command = [str(prm / name)]
    for body in bodies:
        for key, value in settings.items():
            command += ["--set", f"Body {body}/{key.replace('_', '/')}={value}"]
    return command


scenes = {
    "thick sphere, degree 4": scene("thick_sphere.prm", ["inner", "outer"], Degree=4, Mesh_Refinements=1),
    "contact (`hertz_half_spaces`)": scene("hertz_half_spaces.prm"),
    "tetrahedra and hexahedra, degree 3 (`flange`)": scene("flange.prm", ["bolt 1", "bolt 2", "lower", "upper", "gasket"], Degree=3),
    "finite strain, contact (`o_ring`)": scene("o_ring.prm"),
}
environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")


def seconds(program, command, directory):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, *command, "--output", directory, "--set", "Output/Fields="], env=environment, check=True, stdout=subprocess.DEVNULL)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


print("| scene |" + "".join(f" {Path(p).name} |" for p in programs))
print("|---|" + "---|" * len(programs))
with tempfile.TemporaryDirectory() as directory:
    for name, command in scenes.items():
        times = {p: [] for p in programs}
        for _ in range(rounds):
            for p in programs:
                times[p].append(seconds(p, command, directory))
        medians = [statistics.median(times[p]) for p in programs]
        print(f"| {name} |" + "".join(f" {t:.2f} s, {t / medians[0]:.2f} |" for t in medians), flush=True)
