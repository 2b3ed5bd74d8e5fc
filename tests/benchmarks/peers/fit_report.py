#!/usr/bin/env python3
"""All runs of the press fit at finite strain (fit.py), of an O-ring (o_ring.py) and of ironing (ironing.py). Not a test: it writes its parts of doc/measurements/deformed_contact_peers.md.

    pip install numpy scipy ngsolve KratosMultiphysics KratosStructuralMechanicsApplication KratosConstitutiveLawsApplication KratosContactStructuralMechanicsApplication KratosLinearSolversApplication
    apt-get install calculix-ccx python3-getfem++ python3-scipy
    tests/benchmarks/peers/fit_report.py build/mortise [--scenes fit,turns,o_ring,ironing] [--codes Mortise,NGSolve,...] [--rows ROWS.jsonl] [--getfem /usr/bin/python3]

Runs go one after the other, those of `turns` three times in turn. Seconds of the processor, of one thread. --rows keeps the JSON lines, of which the last ones of a run count; with --scenes ""
the page is written again from that file. --getfem: the Python that has GetFEM."""
import argparse
import json
import os
import shlex
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from page import write_part  # noqa: E402
from processor import openblas  # noqa: E402

CODES = ("Mortise", "NGSolve", "GetFEM", "CalculiX", "Kratos")
LOOSE, QUAD, NEAR = " --set Solver/Tolerance=1e-4", "--elements C3D20R", " --set 'Interface fit/Search distance=length 0.2'"
RUNS = {
    "fit": {
        "Mortise": [f"--p 1 --n {n}" for n in ("2", "4", "8", "8 --layers 4,4", "16 --layers 8,8", "16 --layers 8,8" + NEAR)]
        + [f"--p 2 --n {n}" for n in ("1", "2", "4", "2 --layers 2,2", "2 --layers 2,2" + LOOSE, "2 --layers 2,2 --sliding small", "4 --layers 2,2")]
        + [f"--p 3 --n {n}" for n in ("1", "1 --layers 2,2", "2", "3")] + [f"--p 4 --n {n}" for n in ("1", "1" + LOOSE, "1 --sliding small", "2")] + ["--p 5 --n 1"],
        "NGSolve": [f"--p {p} --h {h} --rule {r}" for p, h, r in ((2, 1, 4), (2, 1, 5), (2, 0.8, 4), (3, 1, 5), (3, 0.6, 5), (4, 1, 4), (4, 1, 5), (4, 0.8, 8))]
        + ["--p 4 --h 1 --rule 8 --tolerance 1e-7", "--p 2 --h 1 --rule 5 --penalty 1e4 --tolerance 1e-7"] + [f"--p {p} --h {h} --rule 20 --penalty 1e4 --tolerance 1e-5" for p, h in ((4, 0.5), (5, 0.8))],
        "GetFEM": [f"--elements tet --p 2 --n {n}" for n in ("1", "2", "2 --rule 5", "2 --layers 2,2", "3 --layers 2,2", "3 --layers 2,2 --rule 8", "4 --layers 2,2")]
        + ["--elements tet --p 3 --n 1 --rule 8", "--elements tet --p 3 --n 2", "--elements tet --p 3 --n 2 --rule 16", "--elements tet --p 4 --n 1 --rule 24"]
        + ["--p 1 --n 4", "--p 2 --n 2", "--p 2 --n 2 --rule 14", "--p 2 --n 2 --layers 2,2 --rule 12", "--p 2 --n 3 --layers 2,2 --rule 10", "--p 3 --n 1", "--p 3 --n 2"],
        "CalculiX": [f"{QUAD} --n {n}" for n in ("1", "2", "2 --penalty 1e2", "3 --layers 2,2", "4 --layers 2,2", "4 --layers 2,2 --slave outer", "6 --layers 2,2", "3 --method MORTAR --hard", "4 --layers 2,2 --method PGLINMORTAR --hard")]
        + ["--elements C3D20 --n 3 --layers 2,2", "--elements C3D8 --n 4", "--elements C3D8I --n 6 --layers 2,2"],
        "Kratos": [f"--n {n}" for n in ("4 --layers 2,2", "6 --layers 3,3", "6 --layers 3,3 --simplified", "7 --layers 3,3 --guess --slave outer", "8 --layers 2,2", "8 --layers 4,4", "8 --layers 4,4 --type PenaltyContactFrictionless",
                                        "12 --layers 3,3 --simplified", "12 --layers 3,3 --guess --slave outer")]},
    "o_ring": {
        "Mortise": [f"--p {p} --h {h}" for p, h in ((2, 0.7), (2, 0.5), (3, 0.7))] + [f"--p {p} --h {h} --plate 8,6" for p, h in ((2, 0.3), (2, 0.2), (3, 0.5), (3, 0.3), (4, 0.5))],
        "NGSolve": [f"--p {p} --h {h}" for p, h in ((2, 0.7), (2, 0.5), (2, 0.4), (2, 0.3), (3, 1), (3, 0.7), (3, 0.5), (4, 1), (4, 0.7))]
        + ["--p 2 --h 0.4 --rule 3", "--p 2 --h 0.5 --penalty 1e2", "--p 3 --h 0.7 --penalty 1e4 --rule 8", "--p 4 --h 1 --rule 8 --finer 2", "--p 3 --h 0.5 --penalty 1e4 --rule 8 --finer 2"],
        "GetFEM": [f"--elements tet --n 2 --augment {a}" for a in ("10", "100", "1000")] + [f"--elements tet --n {n} --along 8 --augment 10" for n in (2, 3)] + ["--p 3 --elements tet --augment 10", "--n 2 --along 8 --augment 10"],
        "CalculiX": [f"--n {n} --along {a} --plate {p}" for n, a, p in ((1, 4, "6,4"), (2, 4, "8,4"), (2, 8, "8,6"), (3, 8, "12,6"))] + ["--n 2 --along 8 --plate 8,6 --kappa 1e2", "--n 3 --along 8 --plate 12,6 --kappa 1e2", "--elements C3D8 --n 2 --along 6 --plate 6,6"],
        "Kratos": [f"--finer {f}" for f in (1, 4, 10)] + ["--finer 4 --type PenaltyContactFrictionless"]},
    "ironing": {
        "Mortise": ["--p 1", "--p 1 --scale 2", "--p 2", "--p 2 --set 'Steps/Largest step=0.0125'", "--p 3"],
        "CalculiX": ["--elements C3D8"] + [f"--elements C3D8 {s}" for s in ("--increment 0.0125", "--increment 0.00625", "--increment 0.00625 --stick 10", "--increment 0.0125 --scale 2")] + ["--elements C3D8I --increment 0.0125", QUAD],
        "GetFEM": [f"--p 1 --augment {a}" for a in ("10", "100", "1000", "1000 --finer 2", "1000 --finer 4", "1e4 --finer 2")] + ["--p 2 --augment 10", "--p 2 --augment 1000 --finer 2"]}}
TURNS = {"1e-2": [("Mortise", "--p 2 --n 1"), ("NGSolve", "--p 2 --h 0.8 --rule 4"), ("GetFEM", "--elements tet --p 2 --n 2 --rule 5"), ("CalculiX", QUAD + " --n 2"), ("Kratos", "--n 7 --layers 3,3 --guess --slave outer")],
         "1e-3": [("Mortise", "--p 2 --n 2 --layers 2,2"), ("Mortise", "--p 4 --n 1"), ("Mortise", "--p 4 --n 1" + LOOSE), ("NGSolve", "--p 4 --h 1 --rule 5"), ("GetFEM", "--elements tet --p 2 --n 3 --layers 2,2 --rule 8"), ("CalculiX", QUAD + " --n 4 --layers 2,2 --slave outer")],
         "1e-4": [("Mortise", "--p 4 --n 1"), ("NGSolve", "--p 5 --h 0.8 --rule 20 --penalty 1e4 --tolerance 1e-5")]}


def all_runs():
    """Scene, target, code, options, how often."""
    for scene, codes in RUNS.items():
        yield from ((scene, "", code, options) for code, runs in codes.items() for options in runs)
    for _ in range(3):
        yield from (("turns", target, code, options) for target, runs in TURNS.items() for code, options in runs)


def measure(scene, code, options, o):
    """The JSON line of a run."""
    script = os.path.join(HERE, code.lower() + "_%s.py" % ("fit" if scene == "turns" else scene))
    command = [o.getfem if code == "GetFEM" else sys.executable, "-W", "ignore", script] + ["--mortise", os.path.abspath(o.mortise)] * (code == "Mortise") + shlex.split(options)
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", DEAL_II_NUM_THREADS="1", **openblas())
    lines = [line for line in subprocess.run(command, env=environment, capture_output=True, text=True, timeout=900).stdout.splitlines() if line.startswith("{")]
    return json.loads(lines[-1]) if lines else dict(code=code, failure="no result")


def label(r):
    size = "h %g" % r["h"] if "h" in r else "n %d" % r["n"] if "n" in r else "scale %d" % r["scale"]
    size += ", layers " + r["layers"] if "layers" in r else ", " + r["cells"] if "cells" in r else ""
    return ", ".join(q for q in ("p%d" % r["order"], r.get("element"), size, r["method"], r.get("set")) if q)


def number(r, key, form="%.1e"):
    return form % r[key] if key in r else ""


def failure(r):
    return " ".join(r.get("failure", "").replace("|", "/").split())[:75]


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|---" * len(head) + "|"] + ["| " + " | ".join(str(v) for v in row) + " |" for row in rows])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mortise")
    parser.add_argument("--scenes", default="fit,turns,o_ring,ironing")
    parser.add_argument("--codes", default=",".join(CODES))
    parser.add_argument("--rows", default=os.devnull)
    parser.add_argument("--getfem", default="/usr/bin/python3")
    o = parser.parse_args()
    measured = []
    if os.path.isfile(o.rows):
        with open(o.rows, encoding="utf-8") as file:
            measured = [json.loads(line) for line in file]
    with open(o.rows, "a", encoding="utf-8") as file:
        for scene, target, code, options in all_runs():
            if scene in o.scenes.split(",") and code in o.codes.split(","):
                measured.append(dict(scene=scene, target=target, options=options, **measure(scene, code, options, o)))
                print(json.dumps(measured[-1]), file=file, flush=True)
    groups = {run: [] for run in all_runs()}
    for r in measured:
        groups.get((r["scene"], r["target"], r["code"], r["options"]), []).append(r)
    groups = {run: same[-(3 if run[0] == "turns" else 1):] for run, same in groups.items() if same}
    runs = [(scene, same[-1]) for (scene, *_), same in groups.items()]
    errors = ("error", "error_pressure", "error_pressure_max")
    write_part("deformed_contact_peers.md", "turns", table(
        ["error below", "program", "run", "seconds", "whole process", "error", "mean pressure", "pressures at points"],
        [[target, code, label(same[-1])] + ["%.3f" % statistics.median(r[k] for r in same) for k in ("cpu_solve", "cpu")] + [number(same[-1], k) for k in errors] for (scene, target, code, _), same in groups.items() if scene == "turns"]))
    write_part("deformed_contact_peers.md", "o-ring", table(
        ["program", "run", "unknowns", "seconds", "whole process", "MB", "Newton", "forces at 6, 12, 18, 24, 30 %", "error", "failure"],
        [[r["code"], label(r), r.get("unknowns", "")] + ["%.1f" % r[k] for k in ("cpu_solve", "cpu")] + [r["memory_MB"], r.get("newton", ""), ", ".join("%.3f" % f for f in r.get("forces", [])), number(r, "error"), failure(r)] for scene, r in runs if scene == "o_ring"]))
    write_part("deformed_contact_peers.md", "ironing", table(
        ["program", "run", "unknowns", "seconds", "steps", "Newton", "ends at t", "across at 1", "along, across at 1.5", "at 2", "ratio", "off by", "ripple", "failure"],
        [[r["code"], label(r), r["unknowns"], "%.1f" % r["cpu"], r["steps_taken"], r["newton"], number(r, "end", "%.4g")] + [", ".join("%.5f" % f for f in r.get("forces", {}).get(t, [])[t == "1":]) for t in ("1", "1.5", "2")]
         + [number(r, k, "%.4f") for k in ("ratio", "ratio_off", "ripple")] + [failure(r)] for scene, r in runs if scene == "ironing"]))
    write_part("deformed_contact_peers.md", "runs", table(
        ["program", "run", "unknowns", "seconds", "whole process", "MB", "Newton", "error", "mean pressure", "pressures at points", "failure"],
        [[r["code"], label(r), r.get("unknowns", ""), "%.3f" % r["cpu_solve"], "%.3f" % r["cpu"], r["memory_MB"], r.get("newton", "")] + [number(r, k) for k in errors] + [failure(r)] for scene, r in runs if scene == "fit"]))


main()
