#!/usr/bin/env python3
"""Time against error of all codes on the two scenes of spheres.py. Not a test: it writes its part of doc/measurements/nonlinear_peers.md.

    pip install ngsolve felupe sfepy KratosMultiphysics KratosStructuralMechanicsApplication KratosConstitutiveLawsApplication KratosLinearSolversApplication; apt-get install calculix-ccx
    tests/benchmarks/peers/spheres_report.py build/mortise [--repeat 3] [--codes Mortise,NGSolve,...] [--rows ROWS.jsonl]

Every round runs all runs once, in turn, and those of less than a second nine times; a run that took more than 20 s of the processor is not repeated. Medians of the seconds of the processor, of one thread. --rows keeps the JSON
lines; without a round (--repeat 0) the page is written again from that file."""
import argparse
import importlib.metadata
import json
import math
import os
import re
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from page import write_part  # noqa: E402
from processor import openblas  # noqa: E402

RESOLUTION = 0.005  # seconds, below which a time without start-up is noise
SHORT, REPEATS = 1., 9  # seconds of the processor below which a run is repeated
TARGETS = (1e-2, 1e-4, 1e-6)
CODES = ("Mortise", "NGSolve", "CalculiX", "FElupe", "Kratos", "SfePy")


def rows(options, degrees):
    """Runs of the given orders, each with meshes `n,m` or `n,m,steps`."""
    for order, meshes in degrees.items():
        for mesh in meshes.split():
            n, m, *steps = mesh.split(",")
            yield f"{options} {order} --n {n} --m {m}" + (f" --steps {steps[0]}" if steps else "")


RUNS = {
    "Mortise": [*rows("--problem balloon --degree", {2: "1,1 1,2 2,2 2,4 4,4", 3: "1,1 2,2 4,4", 4: "1,1 2,2 2,4 2,4,3 4,4 4,4,2", 5: "1,1 2,2 2,2,3 2,4", 6: "1,1 1,2,2 2,2 2,2,3 2,4"}),
                *rows("--problem balloon --tied --degree", {2: "1,2 2,4 4,8", 4: "1,2 2,4 4,8", 6: "1,2,2 2,4 2,4,3"}),
                *rows("--problem hill --degree", {2: "1,2 2,2 2,4 4,4", 3: "1,2 1,4 2,4 4,4", 4: "1,2 1,4 2,4 4,4 1,3", 5: "1,2 1,4 2,4", 6: "1,2 1,4 2,4 1,3"})],
    "NGSolve": [*rows("--problem balloon --order", {2: "1,2 2,2 4,4", 3: "1,1 1,2 2,2 2,4", 4: "1,1 1,2 2,2", 5: "1,1 1,2 2,2", 6: "1,1 2,2"}),
                "--problem balloon --elements tet --order 3 --h 0.7", "--problem balloon --elements tet --order 3 --h 0.5",
                *rows("--problem hill --order", {2: "1,2 2,2 4,4", 3: "1,2 1,4 1,8", 4: "1,2 1,4 1,8 1,3", 5: "1,2 1,4", 6: "1,2 1,4"}), "--problem hill --elements tet --order 3 --h 0.5"],
    "CalculiX": [f"--problem balloon --kappa {k} --n {n} --m {n}" for k in ("1e3", "1e4") for n in (2, 3, 4)] + [f"--problem hill --elements {e} --n {n} --m {n}" for e in ("C3D20R", "C3D20") for n in (2, 4, 6)],
    "FElupe": [*rows("--problem balloon --dual cells --order", {2: "1,2,2 2,2,2 4,4,2"}), *rows("--problem balloon --order", {2: "1,2,2 2,2,2", 3: "1,2,8 2,2,8"}),
               *rows("--problem hill --order", {2: "1,2 2,2 4,4", 3: "1,2 1,4", 4: "1,2 1,4", 5: "1,4"})],
    "Kratos": [f"--problem balloon --element TotalLagrangianElement3D27N --law HyperElastic3DLaw --kappa 100 --steps {s} --n {n} --m 2" for n, s in ((1, 20), (2, 20))]
              + ["--problem balloon --element TotalLagrangianQ1P0MixedElement3D8N --steps 40 --n 2 --m 2"]
              + [f"--problem hill --element SmallDisplacementElement3D{e}N --n {n} --m {n}" for e in (20, 27) for n in (2, 4, 6)],
    "SfePy": [f"--order 2 --steps 24 --n {n} --m 2" for n in (1, 2)]}


def measure(code, options, mortise):
    """The JSON line of a run."""
    command = [sys.executable, "-W", "ignore", os.path.join(HERE, code.lower() + "_spheres.py")] + [mortise] * (code == "Mortise") + options.split()
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", DEAL_II_NUM_THREADS="1", **openblas())
    try:
        output = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=900).stdout
    except subprocess.TimeoutExpired:
        output = ""
    lines = [line for line in output.splitlines() if line.startswith("{")]
    result = json.loads(lines[-1]) if lines else dict(code=code, failure="no result")
    return dict(result, options=options)


def medians(measured):
    """One row for each run, with the medians of its times."""
    by_run = {}
    for row in measured:
        by_run.setdefault((row["code"], row["options"]), []).append(row)
    result = []
    for same in by_run.values():
        row = dict(same[0], runs=len(same))
        for key in ("cpu", "cpu_solve", "wall_solve"):
            if key in row:
                row[key] = statistics.median(r[key] for r in same if key in r)
        if "cpu" in row:
            row["cpu_solve"] = max(RESOLUTION, row["cpu_solve"])
        result.append(row)
    return result


def time_at(family, target, key):
    """Seconds to reach the error, by interpolation of logarithms from the last run that misses it to one that reaches it; the cheapest run that reaches it where that is quicker or none misses."""
    times = [r[key] for r in family if r["error"] <= target]
    for a in family:
        for b in family:
            if a["error"] > target >= b["error"] and a[key] < b[key]:
                share = math.log(a["error"] / target) / math.log(a["error"] / b["error"])
                between = [r for r in family if r is not a and r is not b and target < r["error"] < a["error"] and r[key] <= b[key]]
                if not between:
                    times.append(math.exp(math.log(a[key]) + share * math.log(b[key] / a[key])))
    return min(times) if times else None


def best(all_rows, problem, code, tied, target, key):
    """Text of the least time over the families of a code."""
    families = {}
    for r in all_rows:
        if r["code"] == code and r.get("problem") == problem and "error" in r and ("tied" in r["element"]) == tied:
            families.setdefault((r["element"], r["order"], r.get("kappa") if problem == "balloon" else None), []).append(r)
    found = [(time_at(f, target, key), name) for name, f in families.items()]
    found = min(((t, name) for t, name in found if t is not None), default=None, key=lambda x: x[0])
    return f"{found[0]:.3g} ({'p' + str(found[1][1]) if code in ('Mortise', 'NGSolve', 'FElupe') else found[1][0].replace('Element3D', '')})" if found else "-"


def tables(all_rows, version):
    with open("/proc/cpuinfo") as file:
        processor = re.search(r"model name\s*: (.*)", file.read()).group(1)
    lines = [f"{processor}, one thread. {version}.", ""]
    for problem, title in (("balloon", "Balloon"), ("hill", "Hill")):
        lines += [f"## {title}: seconds to an error", "", "| code | " + " | ".join(f"{t:.0e} whole process | without start-up" for t in TARGETS) + " |", "|---" * (1 + 2 * len(TARGETS)) + "|"]
        for code in CODES:
            for tied in (False, True) if code == "Mortise" and problem == "balloon" else (False,):
                if any(r["code"] == code and r.get("problem") == problem for r in all_rows):
                    cells = [best(all_rows, problem, code, tied, t, key) for t in TARGETS for key in ("cpu", "cpu_solve")]
                    lines.append(f"| {code}{', two tied bodies' * tied} | " + " | ".join(cells) + " |")
        lines += [""]
    lines += ["## All runs", "", "cpu: whole process; solve: without start-up and imports, at least 0.005, which is the noise; wall of the same, on cores with other work. steps: those asked for (and\nthose taken, where a code cut them); newton: iterations of all steps.", "",
              "| code | scene | elements | p | n, m | steps | unknowns | cpu, s | solve, s | wall, s | MB | newton | error | error of the pressure |", "|---" * 14 + "|"]
    for r in all_rows:
        element = r.get("element", r["options"]).replace("TotalLagrangianElement", "TL ").replace("SmallDisplacementElement", "").replace("TotalLagrangianQ1P0MixedElement", "TL Q1P0 ")
        element += f", kappa {r['kappa']:g}" if "kappa" in r and r["problem"] == "balloon" else ""
        size = f"h {r['h']:g}" if "tet" in element else f"{r.get('n')}, {r.get('m')}"
        steps = f"{r.get('steps', 1)}" + (f" ({r['solves']})" if r.get("solves", r.get("steps", 1)) != r.get("steps", 1) else "")
        numbers = [str(r["unknowns"]), f"{r['cpu']:.3f}", f"{r['cpu_solve']:.3f}", f"{r['wall_solve']:.2f}", str(r["memory_MB"]), str(r["newton"]), f"{r['error']:.2e}",
                   f"{r['error_pressure']:.1e}" if "error_pressure" in r else ""] if "error" in r else ["failed: " + r.get("failure", "")[:60].replace("\n", " ").replace("|", ",")] + [""] * 7
        lines.append(f"| {r['code']} | {r.get('problem', '')} | {element} | {r.get('order', '')} | {size} | {steps} | " + " | ".join(numbers) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mortise")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--codes", default=",".join(CODES))
    parser.add_argument("--rows", default=os.devnull)
    o = parser.parse_args()
    measured, slow = [], set()
    if os.path.isfile(o.rows):
        with open(o.rows, encoding="utf-8") as file:
            measured = [json.loads(line) for line in file]
    with open(o.rows, "a", encoding="utf-8") as file:
        for _ in range(o.repeat):
            for code in o.codes.split(","):
                for options in RUNS[code]:
                    for _ in range(REPEATS):
                        if (code, options) in slow:
                            break
                        row = measure(code, options, os.path.abspath(o.mortise))
                        measured.append(row)
                        print(json.dumps(row), file=file, flush=True)
                        if row.get("cpu", 99) > 20:
                            slow.add((code, options))
                        if row.get("cpu", 99) > SHORT:
                            break
    measured = [r for r in measured if r["options"] in RUNS[r["code"]]]
    all_rows = sorted(medians(measured), key=lambda r: (CODES.index(r["code"]), r.get("problem", ""), r.get("element", ""), r.get("order", 0), r.get("unknowns", 0), r.get("steps", 1)))
    versions = [f"{name} {importlib.metadata.version(name)}" for name in ("ngsolve", "felupe", "KratosMultiphysics", "sfepy")]
    ccx = re.search(r"[Vv]ersion (\S+)", subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout)
    text = tables(all_rows, ", ".join(versions + [f"CalculiX {ccx.group(1)}" if ccx else "CalculiX"]) + f"; medians of {min(r['runs'] for r in all_rows)} to {max(r['runs'] for r in all_rows)} runs")
    print(text)
    write_part("nonlinear_peers.md", "spheres", text)


main()
