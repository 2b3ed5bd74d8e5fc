#!/usr/bin/env python3
"""Time and memory against the energy error on the thick sphere, Mortise beside other programs.
Not a test: it writes run_time.csv, its part of run_time.md and run_time.png in doc/measurements.

  pip install ngsolve numpy matplotlib; apt-get install python3-getfem++ calculix-ccx
  tests/benchmarks/run_time.py build/mortise --peers DIRECTORY

Mortise over degree, mesh, shape of the cells, tied and conforming; the peers by their scripts
(ngsolve_sphere.py, getfem_sphere.py, calculix_sphere.py in DIRECTORY), those that are not installed
left out. Every round runs all of them once in random order, on one core and on two; reported are
medians of the runs that other processes left the cores to (of all runs where there are none)."""
import argparse
import csv
import json
import os
import random
import resource
import shutil
import subprocess
import tempfile
import time

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plot
import numpy

from page import TOP, write_part
from processor import on_ranks, openblas

STAGES = ("spaces", "interface_search", "interface_clipping", "coupling", "bulk", "solver_setup", "solve")
COUPLING = STAGES[1:4]
MEDIANS = ("seconds", "process", "memory_mib")
KEYS = ("program", "scene", "cells", "degree", "mesh", "cores")
# Subdivisions inner : outer by degree, also inner : outer; those of 1 : 2 cells across nest, as the peers' smallest do
TIED = {2: ("4,2:6,3", "7,4:8,4", "14,7:21,10"), 3: ("1,1:2,1", "2,2:1,1", "2,2:3,1"),
        4: ("1,1:2,1", "1,2:2,1", "2,2:3,1", "9,5:10,5", "11,6:13,6"), 5: ("2,1:3,1", "2,2:3,1"),
        6: ("1,1:2,1", "1,2:2,1", "2,2:3,1"), 7: ("2,2:3,1",), 8: ("1,2:2,1", "2,2:3,1"),
        "4:3": ("1,1:2,1",), "6:4": ("1,1:2,1",), "6:5": ("1,1:2,1",), "8:7": ("1,1:2,1",)}
TIED_TETRAHEDRA = {2: ("4,2:6,3",), 3: ("2,2:3,1",), 4: ("2,2:3,1",), 5: ("1,2:2,1",), 6: ("1,2:2,1",)}
CONFORMING = {2: ("4,4", "8,8", "19,19"), 3: ("1,3",), 4: ("1,3", "2,3", "9,10"), 5: ("2,3",), 6: ("2,3",), 7: ("2,3",), 8: ("2,3",)}
CONFORMING_TETRAHEDRA = {4: ("2,3",)}
CORES = {1: "one core", 2: "two cores"}
BOTH = ("hexahedra", "tetrahedra")
HUGE = "24,12:28,14"
SHOWN = [("hexahedra", p, mesh) for p, mesh in ((4, "1,2:2,1"), (8, "2,2:3,1"), (2, "7,4:8,4"), (2, "14,7:21,10"), (4, "9,5:10,5"), (4, "11,6:13,6"),
         (4, HUGE))] + [("tetrahedra", 4, "2,2:3,1"), ("tetrahedra", 2, "4,2:6,3")]
PEERS = {"NGSolve": [f"--mode {line}" for line in (
    "nitsche --elem hex --order 2 --n 4 --intorder 6", "nitsche --elem hex --order 3 --n 1 --intorder 20",
    "nitsche --elem hex --order 4 --n 1 --intorder 20", "nitsche --elem hex --order 4 --n 1 --nr 2 --intorder 10 --primary outer",
    "nitsche --elem hex --order 4 --n 1 --nr 2 --nr2 2 --intorder 10 --primary outer",
    "nitsche --elem hex --order 5 --n 1 --nr 2 --nr2 2 --intorder 12 --primary outer",
    "nitsche --elem tet --order 5 --h 0.6 --intorder 20", "conf --elem hex --order 2 --n 8", "conf --elem hex --order 4 --n 1",
    "conf --elem hex --order 5 --n 1", "conf --elem hex --order 5 --n 1 --nr 2", "conf --elem tet --order 5 --h 0.6")],
    "GetFEM": [f"--mode lm --elem {elem} --order 2 --n {n} --solver mumps" for elem, n in (("hex", 2), ("tet", 4), ("tet", 6))],
    "CalculiX": [f"--method tie --elem C3D20 --m {m}" for m in (1, 2)]}
PYTHON = {"NGSolve": "python3", "GetFEM": "/usr/bin/python3", "CalculiX": "python3"}  # GetFEM is the distribution's package
# energy error, goal in seconds, best tie of the peers when the goals were set
TARGETS = ((1e-2, 0.02, "0.19"), (1e-3, 0.05, "0.53"), (3e-4, 0.10, "1.49"), (1e-4, 0.15, "-"), (1e-6, 1., "-"))
# name, degree, mesh, goal in seconds and GiB, peers when the goals were set
SIZES = (("40,000 tied dofs, p = 2", 2, "7,4:8,4", 0.3, None, "4.4 s (conforming)"),
         ("1 million tied dofs, p = 4", 4, "11,6:13,6", 5., 2., "319 s, 20 GB (0.3 million, conforming)"),
         ("10 million tied dofs, p = 4", 4, HUGE, 60., 16., "-"))
# Far from 1:1 at the interface; the inner body is the slave
RATIOS = {2: ("20,10:2,1", "2,1:20,10", "30,15:4,2"), 4: ("10,5:2,1", "2,1:10,5", "10,5:1,1")}
PER_DOF = ((2, "14,7:21,10", "19,19"), (4, "9,5:10,5", "9,10"))


def jobs_of_mortise(mortise, scene, cells, meshes, cores=(1, 2)):
    bodies = ("shell",) if scene == "conforming" else ("inner", "outer")
    file = os.path.join(TOP, "prm", "thick_sphere" + ("_conforming" if scene == "conforming" else "") + ".prm")
    for degree, names in meshes.items():
        for mesh in names:
            settings = ["Output/Fields=", "Solver/Tolerance=1e-8"]
            for body, p, subdivisions in zip(bodies, str(degree).split(":") * 2, mesh.split(":")):
                settings += [f"Body {body}/Degree={p}", f"Body {body}/Mesh/Cells={cells}", f"Body {body}/Mesh/Subdivisions={subdivisions}"]
            command = [mortise, file] + [word for s in settings for word in ("--set", s)]
            for n in cores:
                yield {"program": "Mortise", "scene": scene, "cells": cells, "degree": degree, "mesh": mesh, "cores": n,
                       "command": (on_ranks(n) if n > 1 else []) + command}


def jobs_of_peer(program, lines, directory):
    for line in lines:
        words = line.split()
        value = dict(zip(words[::2], words[1::2]))
        job = {"program": program, "scene": "conforming" if value.get("--mode") == "conf" else "tied",
               "cells": {"tet": "tetrahedra"}.get(value["--elem"], "hexahedra"), "degree": int(value.get("--order", 2)),
               "mesh": " ".join(f"{k.strip('-')} {v}" for k, v in value.items() if k not in ("--mode", "--method", "--elem", "--order", "--solver"))}
        for n in (1,) if program == "CalculiX" else (1, 2):
            extra = {"NGSolve": ["--threads", str(n), "--out", ""], "GetFEM": ["--out", ""], "CalculiX": []}[program]
            yield {**job, "cores": n, "command": [PYTHON[program], os.path.join(directory, program.lower() + "_sphere.py"), *words, *extra]}


def installed(program):
    if program == "CalculiX":
        return shutil.which("ccx")
    return subprocess.run([PYTHON[program], "-c", "import " + program.lower()], capture_output=True).returncode == 0


def busy_and_own():
    """Core seconds that all cores have worked, and those of the processes started here."""
    with open("/proc/stat") as file:
        ticks = [int(word) for word in file.readline().split()[1:9]]
    own = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (sum(ticks) - ticks[3] - ticks[4]) / os.sysconf("SC_CLK_TCK"), own.ru_utime + own.ru_stime


def wait_for_cores(n, seconds):
    """Until n cores are idle for a moment, or the time is over."""
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        start, before = time.perf_counter(), busy_and_own()[0]
        time.sleep(0.2)
        if busy_and_own()[0] - before < (os.cpu_count() - n + 0.2) * (time.perf_counter() - start):
            return


def numbers_of_peer(output):
    found = json.loads(output.strip().splitlines()[-1])
    either = lambda *names: next(found[name] for name in names if name in found)
    return {"dofs": either("ndof", "dofs"), "energy": either("EN", "relEn"), "l2": either("L2", "relL2"),
            "seconds": found["wall"] - found.get("T", {}).get("mesh", [0])[0], "memory_mib": either("memMB", "rss_MB")}


def numbers_of_mortise(file_name):
    with open(file_name) as file:
        summary = json.load(file)
    step, stages = summary["steps"][-1], {s: summary["timings_s"].get(s, 0) for s in STAGES}
    return {"dofs": step["dofs"]["total"], "energy": step["errors"]["energy"], "l2": step["errors"]["displacement_l2"],
            "seconds": sum(stages.values()), "memory_mib": summary["memory_mib"]["peak_sum_over_ranks"],
            "iterations": step["solver"]["iterations"], **stages}


def measure(job, patience, work):
    """Numbers of one run, or None if it failed."""
    mortise = job["program"] == "Mortise"
    environment = dict(os.environ, OMP_NUM_THREADS="1", **openblas(), LAMEP="1e-4",
                       OPENBLAS_NUM_THREADS=str(job["cores"] if job["program"] == "GetFEM" else 1))
    wait_for_cores(job["cores"], patience)
    start, (busy, own) = time.perf_counter(), busy_and_own()
    result = subprocess.run(job["command"] + (["--output", work] if mortise else []), cwd=work, env=environment, capture_output=True, text=True)
    process, (busy_after, own_after) = time.perf_counter() - start, busy_and_own()
    others = (busy_after - busy - own_after + own) / process
    try:
        result.check_returncode()
        numbers = numbers_of_mortise(os.path.join(work, "summary.json")) if mortise else numbers_of_peer(result.stdout)
    except (subprocess.CalledProcessError, ValueError, StopIteration) as error:
        print("failed:", *job["command"], error, result.stderr[-300:], flush=True)
        return None
    return {**numbers, "process": process, "undisturbed": others < os.cpu_count() - job["cores"] + 0.2}


def measured_rows(jobs, repeats, options, work):
    """Medians over undisturbed runs, over all runs where there are none. Jobs are repeated until
    each has had enough undisturbed runs, or the time is over and each has run."""
    end, runs, due = time.time() + 60 * options.minutes, {id(job): [] for job in jobs}, list(jobs)
    for repeat in range(3 * repeats if repeats > 1 else 1):
        random.Random(repeat).shuffle(due)
        for job in due:
            if not repeat or time.time() < end:  # every job runs once
                runs[id(job)].append(measure(job, options.patience, work))
        due = [job for job in due if None not in runs[id(job)] and sum(r["undisturbed"] for r in runs[id(job)]) < repeats]
        print(f"round {repeat + 1}: {len(due)} jobs want more runs", flush=True)
        if time.time() > end:
            break
    for job in jobs:
        found = [r for r in runs[id(job)] if r]
        counted = [r for r in found if r["undisturbed"]] or found
        if found:
            median = lambda key: float(f"{numpy.median([r[key] for r in counted]):.5g}")
            yield {**{k: job[k] for k in KEYS}, **found[0], **{k: median(k) for k in (*MEDIANS, *STAGES) if k in found[0]},
                   "runs": len(found), "undisturbed": sum(r["undisturbed"] for r in found), "least": min(r["seconds"] for r in found)}


def write_csv(rows, path):
    columns = [*KEYS, "dofs", "energy", "l2", *MEDIANS, "least", "runs", "undisturbed", "iterations", *STAGES]
    with open(path, "w") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows({k: f"{v:.5g}" if isinstance(v, float) else v for k, v in row.items()}
                        for row in sorted(rows, key=lambda r: [r["program"] != "Mortise"] + [str(r[k]) for k in KEYS[:4]] + [r["dofs"], r["mesh"], r["cores"]]))


def read_csv(path):
    convert = lambda key, text: text if key in (*KEYS[:3], "mesh") or ":" in text else float(text) if "." in text or "e" in text else int(text)
    with open(path) as file:
        return [{k: convert(k, v) for k, v in row.items() if v != ""} for row in csv.DictReader(file)]


def pick(rows, **wanted):
    return [r for r in rows if all(r[k] in v if isinstance(v, tuple) else r[k] == v for k, v in wanted.items())]


def fastest(rows, target, **wanted):
    """What first reaches an energy error."""
    return min((r for r in pick(rows, **wanted) if r["energy"] <= target), key=lambda r: r["seconds"], default=None)


def seconds_of(row):
    return f"{row['seconds']:.3g} [{row['least']:.3g}]" + ("" if row["undisturbed"] else " *")


def text_of(row):
    if not row:
        return "-"
    return f"{seconds_of(row)}, {'' if row['program'] == 'Mortise' else row['program'] + ' '}{row['cells'][:3]} p{row['degree']} {row['mesh']}"


def front(rows, key):
    """Rows that no other one beats in both the error and the key, by falling error."""
    best = []
    for row in sorted(rows, key=lambda r: (r[key], r["energy"])):
        if not best or row["energy"] < best[-1]["energy"]:
            best.append(row)
    return best


def draw(rows, path):
    figure, axes = plot.subplots(1, 3, figsize=(17, 5.4), gridspec_kw={"width_ratios": [1, 1, 1.1]})
    kinds = (("Mortise", "tied", "hexahedra", "C0", "o-"), ("Mortise", "tied", "tetrahedra", "C2", "^-"), ("Mortise", "conforming", BOTH, "C7", "s--"),
             ("NGSolve", "tied", BOTH, "C3", "o-"), ("NGSolve", "conforming", BOTH, "C1", "s--"), ("GetFEM", "tied", BOTH, "C4", "o-"),
             ("CalculiX", "tied", BOTH, "C5", "o-"))
    for axis, key, title in ((axes[0], "seconds", "solve [s]"), (axes[1], "memory_mib", "memory of all processes [MiB]")):
        for program, scene, cells, color, style in kinds:
            part = pick(rows, program=program, scene=scene, cells=cells, cores=1 if program == "CalculiX" else 2)
            if not part:
                continue
            label = f"{program}, {scene}" + (", " + cells if cells != BOTH else "") + (", one core" if program == "CalculiX" else "")
            best = front(part, key)
            axis.loglog([r["energy"] for r in best], [r[key] for r in best], style, color=color, ms=5, label=label)
            axis.loglog([r["energy"] for r in part], [r[key] for r in part], style[0], color=color, ms=3, alpha=0.5)
        axis.invert_xaxis()
        axis.set_xlabel("relative energy error")
        axis.set_title(title + ", two cores", fontsize=11)
        axis.grid(True, which="major", alpha=0.4)
    axes[0].loglog([t[0] for t in TARGETS], [t[1] for t in TARGETS], "k*", ms=9, label="goals")
    axes[1].legend(*axes[0].get_legend_handles_labels(), fontsize=8, loc="lower right")
    shown = sorted((r for r in pick(rows, program="Mortise", scene="tied", cores=2) if (r["cells"], r["degree"], r["mesh"]) in SHOWN), key=lambda r: r["dofs"])
    left = numpy.zeros(len(shown))
    for stage, color in zip(STAGES, plot.cm.tab10.colors):
        share = numpy.array([r[stage] / r["seconds"] for r in shown])
        axes[2].barh(range(len(shown)), share, left=left, color=color, label=stage.replace("_", " "))
        left += share
    axes[2].set_yticks(range(len(shown)), [f"{r['cells'][:3]} p{r['degree']}, {r['dofs']:,} dofs\n{r['seconds']:.3g} s" for r in shown], fontsize=8)
    axes[2].set_xlim(0, 1)
    axes[2].set_title("share of the stages, tied, two cores", fontsize=11)
    axes[2].legend(fontsize=8, ncol=4, loc="upper center", bbox_to_anchor=(0.4, -0.06))
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def table(head, lines):
    return "\n".join("| " + " | ".join(line) + " |" for line in (head, ["---"] * len(head), *lines)) + "\n"


def introduction(rows, page):
    with open("/proc/cpuinfo") as file:
        processor = next(line.split(":")[1].strip() for line in file if line.startswith("model name"))
    runs, disturbed = [r["runs"] for r in rows if r["mesh"] != HUGE], sum(not r["undisturbed"] for r in rows)
    return f"""## {"Without" if page.endswith("avx2") else "With"} AVX-512

`tests/benchmarks/run_time.py build/mortise --peers DIRECTORY --huge{"" if page == "run_time" else " --page " + page}` writes this section,
[all rows]({page}.csv) and the picture. {processor}, {os.cpu_count()} cores, {min(runs)} to {max(runs)} runs of a row; {disturbed} of {len(rows)} rows have a *.

![Time, memory and stages]({page}.png)
"""


def errors_reached(rows, missed):
    tied, conforming = pick(rows, scene="tied"), pick(rows, scene="conforming")
    peers = tuple(PEERS)
    lines, twins = [], []
    for target, goal, before in TARGETS:
        ours = fastest(tied, target, program="Mortise")
        if not ours or ours["seconds"] > goal:
            missed.append(f"energy error {target:.0e}: {text_of(ours)}{', ' + CORES[ours['cores']] if ours else ''}; goal {goal:g} s")
        lines.append((f"{target:.0e}", f"{goal:g}", *(text_of(fastest(tied, target, program="Mortise", cores=n)) for n in (2, 1)),
                      *(text_of(fastest(tied, target, program=peers, cores=n)) for n in (2, 1)), before))
        twins.append((f"{target:.0e}", *(text_of(fastest(conforming, target, program=p, cores=n)) for p in ("Mortise", "NGSolve") for n in (2, 1))))
    return ("### An error\n\nSeconds of solve of the fastest row, tied:\n\n" +
            table(("energy error", "goal, two cores", "Mortise, two cores", "one core", "best peer, two cores", "one core", "peer when goals were set"), lines) +
            "\nConforming:\n\n" + table(("energy error", "Mortise, two cores", "one core", "NGSolve, two cores", "one core"), twins))


def sizes_reached(rows, missed):
    lines = []
    for name, degree, mesh, goal, memory, before in SIZES:
        found = pick(rows, program="Mortise", cells="hexahedra", degree=degree, mesh=mesh)
        for r in pick(found, cores=2):
            name += f" ({r['dofs']:,}, {mesh}, energy error {r['energy']:.1e})"
            if r["seconds"] > goal or memory and r["memory_mib"] > 1024 * memory:
                missed.append(f"{name}: {seconds_of(r)}, {r['memory_mib'] / 1024:.2g} GiB instead of {goal:g} s" + (f", {memory:g} GiB" if memory else ""))
        text = [" ".join(f"{seconds_of(r)}, {r['memory_mib'] / 1024:.2g} GiB, process {r['process']:.3g}"
                         for r in pick(found, cores=n)) or "not run" for n in (2, 1)]
        lines.append((name, f"{goal:g} s" + (f", {memory:g} GiB" if memory else ""), *text, before))
    return "### A size\n\nSeconds of solve, peak memory of all ranks, seconds of the process:\n\n" + table(("", "goal, two cores", "two cores", "one core", "peer when goals were set"), lines)


def per_dof(rows, missed):
    lines = []
    for degree, *meshes in PER_DOF:
        for n in (2, 1):
            pair = [r for mesh in meshes for r in pick(rows, program="Mortise", cells="hexahedra", degree=degree, mesh=mesh, cores=n)]
            if len(pair) < 2:
                continue
            each = [1e6 * r["seconds"] / r["dofs"] for r in pair]
            ratio, share = each[0] / each[1], sum(pair[0][s] for s in COUPLING) / pair[0]["seconds"]
            if ratio > 1.15:
                missed.append(f"tied to conforming per dof, p = {degree}, {CORES[n]}: {ratio:.2f} instead of 1.15")
            if share > 0.1:
                missed.append(f"share of the coupling, p = {degree}, {CORES[n]}: {share:.0%} instead of 10 %")
            lines.append((str(degree), CORES[n], *(f"{r['dofs']:,} ({r['mesh']}), {e:.2f}{'' if r['undisturbed'] else ' *'}, {r['iterations']} iterations" for r, e in zip(pair, each)),
                          f"{ratio:.2f}", f"{share:.1%}"))
    return ("### Tied beside conforming, about 500,000 dofs\n\nMicroseconds of solve per dof. Goals: ratio 1.15, coupling "
            "(search, clipping, its matrices) 10 % of solve.\n\n" +
            table(("p", "cores", "tied: dofs, us per dof", "conforming", "ratio", "coupling"), lines))


def ratios(rows):
    lines = []
    for degree, meshes in RATIOS.items():
        for mesh in meshes:
            for r in pick(rows, program="Mortise", cells="hexahedra", degree=degree, mesh=mesh, cores=1):
                lines.append((str(degree), mesh, f"{r['dofs']:,}", seconds_of(r), f"{1e6 * r['seconds'] / r['dofs']:.2f}",
                              f"{r['memory_mib']:.0f}", str(r["iterations"]), f"{sum(r[s] for s in COUPLING):.2g}",
                              *(f"{r[s]:.2g}" for s in ("solver_setup", "solve"))))
    return ("### Ratios of sizes far from 1\n\nOne core; the inner body is the slave. Seconds of solve, of its coupling, solver setup and "
            "solution.\n\n" +
            table(("p", "subdivisions", "dofs", "seconds", "us per dof", "MiB", "iterations", "coupling", "solver setup", "solution"), lines))


def report(rows, page):
    missed = []
    parts = [introduction(rows, page), errors_reached(rows, missed), sizes_reached(rows, missed), per_dof(rows, missed), ratios(rows)]
    return "\n".join(parts) + "\n### Goals missed\n\n" + ("\n".join("- " + m for m in missed) or "None.") + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mortise", nargs="?", help="the program")
    parser.add_argument("--peers", help="directory of the peers' scripts")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--minutes", type=float, default=60, help="after which no run is repeated any more")
    parser.add_argument("--patience", type=float, default=10, help="seconds to wait for idle cores before a run")
    parser.add_argument("--huge", action="store_true", help="10 million dofs, once on two cores (16 GiB)")
    parser.add_argument("--page", default="run_time", help="what the part of doc/measurements/run_time.md, its rows and its picture are called")
    parser.add_argument("--report", action="store_true", help="page and picture again from the rows")
    options = parser.parse_args()
    path = os.path.join(TOP, "doc", "measurements", options.page + ".csv")
    if options.report:
        rows = read_csv(path)
    else:
        mortise = os.path.abspath(options.mortise)
        cases = [
            ("tied", "hexahedra", TIED), ("tied", "hexahedra", RATIOS, (1,)), ("tied", "tetrahedra", TIED_TETRAHEDRA),
            ("conforming", "hexahedra", CONFORMING), ("conforming", "tetrahedra", CONFORMING_TETRAHEDRA)]
        with tempfile.TemporaryDirectory() as work:
            jobs = [job for case in cases for job in jobs_of_mortise(mortise, *case)]
            if options.peers:
                scripts = shutil.copytree(options.peers, os.path.join(work, "peers"))
                os.mkdir(os.path.join(scripts, "runs"))  # where calculix_sphere.py writes
                for program, lines in PEERS.items():
                    if installed(program):
                        jobs += jobs_of_peer(program, lines, scripts)
            rows = list(measured_rows(jobs, options.repeats, options, work))
            if options.huge:
                rows += measured_rows(list(jobs_of_mortise(mortise, "tied", "hexahedra", {4: (HUGE,)}, (2,))), 1, options, work)
        write_csv(rows, path)
    draw(rows, os.path.join(TOP, "doc", "measurements", options.page + ".png"))
    write_part("run_time.md", options.page, report(rows, options.page))


if __name__ == "__main__":
    main()
