#!/usr/bin/env python3
"""Mortise on prm/o_ring.prm, squeezed and measured as in o_ring.py. Prints a JSON line.

    mortise_o_ring.py --mortise build/mortise --p 2 [--h 0.3] [--plate 4,4] [--set SECTION/NAME=VALUE]

Tetrahedra of gmsh of the size h; the plate has the degree 1. cpu_solve is the whole process without `mortise --version`, gmsh included."""
import os
import subprocess
import tempfile

import fit
import o_ring
import spheres
from mortise_fit import run

o = fit.arguments(mortise="build/mortise", h=0.3, plate="4,4", set=[])
scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "prm", "o_ring.prm")
settings = ["Body ring/Degree=%d" % o.p, "Body plate/Degree=1", "Body plate/Mesh/Subdivisions=%s, 1" % o.plate, "Output/Fields=", "Body ring/Mesh/Mesh size=%g" % o.h, "Body plate/Boundary zmax/Displacement=-, -, -%g * t" % o_ring.SQUEEZE]
result = dict(code="Mortise", order=o.p, h=o.h, cells="plate " + o.plate, method=", ".join(o.set))
with tempfile.TemporaryDirectory() as directory:
    usage, wall, summary, failure = run(o.mortise, [scene] + [v for s in settings + o.set for v in ("--set", s)], directory)
empty = os.wait4(subprocess.Popen([o.mortise, "--version"], stdout=subprocess.DEVNULL).pid, 0)[2]
result.update(fit.child_times(usage, wall, empty.ru_utime + empty.ru_stime))
if failure:
    result["failure"] = failure
if summary:
    steps = summary["steps"]
    result.update(unknowns=steps[-1]["dofs"]["total"], newton=sum(s["solver"]["newton_iterations"] for s in steps), **o_ring.measures([s["quantities"]["press"][2] for s in steps if min(abs(s["time"] - t) for t in o_ring.TIMES) < 1e-9]))
spheres.report(**result)
