#!/usr/bin/env python3
"""Iterations of the iterative solvers on the tied thick sphere to 1e-10: iterations.py MORTISE [DEGREE]...

Prints the rows of doc/iterations.md."""
import json
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MESHES = {1: ("2,1:3,2", "4,2:6,3", "8,4:12,6"), 2: ("2,1:3,2", "4,2:6,3", "8,4:12,6"),
          3: ("1,1:2,1", "2,1:3,2", "4,2:6,3"), 4: ("1,1:2,1", "2,1:3,2", "3,1:4,2")}
COARSE = ("1,1:2,1", "2,1:3,1", "3,1:4,2")


def iterations(mortise, p, meshes, method):
    inner, outer = meshes.split(":")
    with tempfile.TemporaryDirectory() as work:
        command = [mortise, os.path.join(TOP, "prm", "thick_sphere.prm"), "--output", work]
        for setting in (f"Body inner/Degree={p}", f"Body outer/Degree={p}", f"Body inner/Mesh/Subdivisions={inner}",
                        f"Body outer/Mesh/Subdivisions={outer}", f"Solver/Method={method}", "Output/Fields="):
            command += ["--set", setting]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return json.load(open(os.path.join(work, "summary.json")))["steps"][-1]["solver"]["iterations"]


def main():
    degrees = [int(a) for a in sys.argv[2:]] or range(1, 7)
    for p in degrees:
        entries = [f"{m} {iterations(sys.argv[1], p, m, 'saddle point')} / {iterations(sys.argv[1], p, m, 'condensed')}"
                   for m in MESHES.get(p, COARSE)]
        print(f"| {p} | " + " | ".join(entries) + " |", flush=True)


if __name__ == "__main__":
    main()
