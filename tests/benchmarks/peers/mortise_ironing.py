#!/usr/bin/env python3
"""Mortise on prm/ironing.prm, measured as in ironing.py. Prints a JSON line.

    mortise_ironing.py --mortise build/mortise --p 1 [--scale 1] [--set SECTION/NAME=VALUE]"""
import os
import tempfile

import fit
import ironing
import spheres
from mortise_fit import run

o = fit.arguments(mortise="build/mortise", scale=1, set=[])
scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "prm", "ironing.prm")
settings = ["Body block/Degree=%d" % o.p, "Body die/Degree=%d" % o.p, "Output/Fields=", "Body block/Mesh/Subdivisions=%d, 1, %d" % (32 * o.scale, 6 * o.scale), "Body die/Mesh/Subdivisions=%d, %d, 1" % (12 * o.scale, 2 * o.scale)]
result = dict(code="Mortise", order=o.p, scale=o.scale, method=", ".join(o.set))
with tempfile.TemporaryDirectory() as directory:
    usage, wall, summary, failure = run(o.mortise, [scene] + [v for s in settings + o.set for v in ("--set", s)], directory)
result.update(fit.child_times(usage, wall))
if failure:
    result["failure"] = failure
if summary:
    steps = summary["steps"]
    result.update(unknowns=steps[-1]["dofs"]["total"], steps_taken=len(steps), newton=sum(s["solver"]["newton_iterations"] for s in steps), **ironing.measures([s["time"] for s in steps], [s["quantities"]["die"][::2] for s in steps]))
spheres.report(**result)
