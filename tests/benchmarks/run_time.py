#!/usr/bin/env python3
"""Time and memory against the energy error on the thick sphere, Mortise beside other programs.
Not a test: it writes doc/run_time.csv, doc/run_time.md and doc/pictures/run_time.png.

  pip install ngsolve numpy matplotlib; apt-get install python3-getfem++ calculix-ccx gmsh
  tests/benchmarks/run_time.py build/mortise --peers DIRECTORY

Mortise over degree, mesh, shape of the cells, tied and conforming; the peers by their scripts
(ngsolve_sphere.py, getfem_sphere.py, calculix_sphere.py in DIRECTORY), those that are not installed
left out. Every round runs all of them once in random order, on one core and on two; reported are
medians of the runs that other processes left the cores to (all runs where there are none). "solve" is all of Mortise's stages but mesh, postprocess and output, and the peers' own
wall time without mesh and errors; "process" is the whole process."""
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

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
STAGES = ("spaces", "interface_search", "interface_clipping", "coupling", "bulk", "solver_setup", "solve")
COUPLING = STAGES[1:4]
KEYS = ("program", "scene", "cells", "degree", "mesh", "cores")
# Subdivisions inner : outer by degree; those of 1 : 2 cells across nest, as the peers' smallest do
TIED = {1: ("4,2:6,3", "8,4:12,6", "16,8:24,12"), 2: ("2,1:3,2", "4,2:6,3", "7,4:8,4", "14,7:21,10"),
        3: ("1,1:2,1", "2,2:1,1", "2,2:3,1", "4,2:6,3"),
        4: ("1,1:2,1", "1,2:2,1", "2,2:1,1", "2,2:3,1", "4,2:6,3", "9,5:10,5", "11,6:13,6"),
        5: ("1,1:2,1", "2,1:3,1", "2,2:3,1", "3,2:2,1"), 6: ("1,1:2,1", "1,2:2,1", "2,2:3,1"),
        7: ("2,1:3,1", "2,2:3,1"), 8: ("1,2:2,1", "2,1:3,1", "2,2:3,1")}
TIED_TETRAHEDRA = {1: ("8,4:12,6",), 2: ("2,1:3,2", "4,2:6,3"), 3: ("2,1:3,1", "2,2:3,1"), 4: ("1,1:2,1", "2,2:3,1"),
                   5: ("1,2:2,1",), 6: ("1,2:2,1",)}
CONFORMING = {1: ("8,8",), 2: ("4,4", "8,8", "19,19"), 3: ("1,3", "4,4"), 4: ("1,3", "2,3", "4,4", "9,10"), 5: ("1,3", "2,3"),
              6: ("2,3",), 7: ("2,3",), 8: ("2,3",)}
CONFORMING_TETRAHEDRA = {2: ("4,4",), 3: ("2,3",), 4: ("2,3",), 6: ("1,3",)}
HUGE = "24,12:28,14"
QUICK = {3: ("1,1:2,1",), 4: ("1,1:2,1",)}
PEERS = {"NGSolve": ("ngsolve_sphere.py", (
    "--mode nitsche --elem hex --order 2 --n 4 --intorder 6", "--mode nitsche --elem hex --order 3 --n 1 --intorder 20",
    "--mode nitsche --elem hex --order 4 --n 1 --intorder 20",
    "--mode nitsche --elem hex --order 4 --n 1 --nr 2 --intorder 10 --primary outer",
    "--mode nitsche --elem hex --order 5 --n 1 --nr 2 --nr2 2 --intorder 12 --primary outer",
    "--mode nitsche --elem tet --order 5 --h 0.6 --intorder 20",
    "--mode conf --elem hex --order 2 --n 4", "--mode conf --elem hex --order 2 --n 8", "--mode conf --elem hex --order 4 --n 1",
    "--mode conf --elem hex --order 5 --n 1", "--mode conf --elem hex --order 5 --n 1 --nr 2",
    "--mode conf --elem tet --order 5 --h 0.6")),
    "GetFEM": ("getfem_sphere.py", (
        "--mode lm --elem hex --order 2 --n 2 --solver mumps", "--mode lm --elem hex --order 2 --n 4 --solver mumps",
        "--mode lm --elem tet --order 2 --n 4 --solver mumps", "--mode lm --elem tet --order 2 --n 6 --solver mumps")),
    "CalculiX": ("calculix_sphere.py", ("--method tie --elem C3D20 --m 1", "--method tie --elem C3D20 --m 2"))}
# energy error, goal in seconds, best tie of the peers when the goals were set
TARGETS = ((1e-2, 0.02, "0.19"), (1e-3, 0.05, "0.53"), (3e-4, 0.10, "1.49"), (1e-4, 0.15, "-"), (1e-6, 1., "-"))
# name, degree, mesh, goal in seconds and GiB, peers when the goals were set
SIZES = (("40,000 tied dofs, p = 2", 2, "7,4:8,4", 0.3, None, "4.4 s (conforming)"),
         ("1 million tied dofs, p = 4", 4, "11,6:13,6", 5., 2., "319 s, 20 GB (0.3 million, conforming)"),
         ("10 million tied dofs, p = 4", 4, HUGE, 60., 16., "-"))
PER_DOF = ((2, "14,7:21,10", "19,19"), (4, "9,5:10,5", "9,10"))


def jobs_of_mortise(mortise, scene, cells, meshes, cores=(1, 2)):
    bodies = ("shell",) if scene == "conforming" else ("inner", "outer")
    file = os.path.join(TOP, "prm", "thick_sphere" + ("_conforming" if scene == "conforming" else "") + ".prm")
    for degree, names in meshes.items():
        for mesh in names:
            settings = ["Output/Fields=", "Solver/Tolerance=1e-8"]
            for body, subdivisions in zip(bodies, mesh.split(":")):
                settings += [f"Body {body}/Degree={degree}", f"Body {body}/Mesh/Cells={cells}", f"Body {body}/Mesh/Subdivisions={subdivisions}"]
            command = [mortise, file] + [word for s in settings for word in ("--set", s)]
            for n in cores:
                root = ["--allow-run-as-root"] if os.getuid() == 0 else []
                parallel = ["mpirun", "-q", *root, "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "-n", str(n)]
                yield {"program": "Mortise", "scene": scene, "cells": cells, "degree": degree, "mesh": mesh, "cores": n,
                       "command": (parallel if n > 1 else []) + command}


def jobs_of_peer(program, script, lines, directory):
    python = "/usr/bin/python3" if program == "GetFEM" else "python3"  # the distribution's package
    for line in lines:
        words = line.split()
        value = dict(zip(words[::2], words[1::2]))
        scene = "conforming" if value.get("--mode", value.get("--method")) == "conf" else "tied"
        job = {"program": program, "scene": scene,
               "cells": "tetrahedra" if value["--elem"] in ("tet", "C3D10") else "hexahedra",
               "degree": int(value.get("--order", 2)),
               "mesh": " ".join(f"{k.strip('-')} {v}" for k, v in value.items() if k not in ("--mode", "--method", "--elem", "--order", "--solver"))}
        for n in (1,) if program == "CalculiX" else (1, 2):
            extra = {"NGSolve": ["--threads", str(n), "--out", ""], "GetFEM": ["--out", ""], "CalculiX": []}[program]
            yield {**job, "cores": n, "command": [python, os.path.join(directory, script), *words, *extra]}


def installed(program):
    if program == "CalculiX":
        return shutil.which("ccx") and shutil.which("gmsh")
    python, module = {"NGSolve": ("python3", "ngsolve"), "GetFEM": ("/usr/bin/python3", "getfem")}[program]
    return subprocess.run([python, "-c", "import " + module], capture_output=True).returncode == 0


def busy_and_own():
    """Core seconds that all cores have worked, and those of the processes started here."""
    with open("/proc/stat") as file:
        ticks = [int(word) for word in file.readline().split()[1:9]]
    own = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (sum(ticks) - ticks[3] - ticks[4]) / os.sysconf("SC_CLK_TCK"), own.ru_utime + own.ru_stime


def wait_for_cores(n, seconds=3):
    """Until n cores are idle for a moment, or the time is over."""
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        start, before = time.perf_counter(), busy_and_own()[0]
        time.sleep(0.2)
        if busy_and_own()[0] - before < (os.cpu_count() - n + 0.2) * (time.perf_counter() - start):
            return


def measure(job, work):
    """Numbers of one run, or None if it failed."""
    mortise = job["program"] == "Mortise"
    environment = dict(os.environ, OMP_NUM_THREADS="1", LAMEP="1e-4",
                       OPENBLAS_NUM_THREADS=str(job["cores"] if job["program"] == "GetFEM" else 1))
    if mortise:
        environment["OPENBLAS_CORETYPE"] = "SkylakeX"
    wait_for_cores(job["cores"])
    start, (busy, own) = time.perf_counter(), busy_and_own()
    result = subprocess.run(job["command"] + (["--output", work] if mortise else []), cwd=work, env=environment, capture_output=True, text=True)
    process, (busy_after, own_after) = time.perf_counter() - start, busy_and_own()
    others = (busy_after - busy - own_after + own) / process
    undisturbed = {"undisturbed": others < os.cpu_count() - job["cores"] + 0.2}
    try:
        assert result.returncode == 0
        if not mortise:
            found = json.loads(result.stdout.strip().splitlines()[-1])
            return {**undisturbed, "dofs": found.get("ndof", found.get("dofs")), "energy": found["EN"] if "EN" in found else found["relEn"],
                    "l2": found["L2"] if "L2" in found else found["relL2"], "seconds": found["wall"] - found.get("T", {}).get("mesh", [0])[0],
                    "process": process, "memory_mib": found.get("memMB", found.get("rss_MB"))}
        with open(os.path.join(work, "summary.json")) as file:
            summary = json.load(file)
    except (AssertionError, ValueError, KeyError, IndexError):
        print("failed:", *job["command"][1:], result.stderr[-300:], flush=True)
        return None
    step, stages = summary["steps"][-1], {s: summary["timings_s"][s] for s in STAGES if s in summary["timings_s"]}
    return {**undisturbed, "dofs": step["dofs"]["total"], "energy": step["errors"]["energy"], "l2": step["errors"]["displacement_l2"],
            "seconds": sum(stages.values()), "process": process, "memory_mib": summary["memory_mib"]["peak_sum_over_ranks"],
            "iterations": step["solver"]["iterations"], **stages}


def measured_rows(jobs, repeats, minutes, work):
    """Medians over undisturbed runs, over all runs where there are none. Jobs are repeated until
    each has had enough undisturbed runs, or the time is over and each has run."""
    end, runs, due = time.time() + 60 * minutes, {id(job): [] for job in jobs}, list(jobs)
    for repeat in range(3 * repeats):
        random.Random(repeat).shuffle(due)
        for job in due:
            if not repeat or time.time() < end:
                runs[id(job)].append(measure(job, work))
        due = [job for job in due if None not in runs[id(job)] and sum(r["undisturbed"] for r in runs[id(job)]) < repeats]
        print(f"round {repeat + 1} done, {len(due)} jobs left", flush=True)
    for job in jobs:
        found = [r for r in runs[id(job)] if r]
        counted = [r for r in found if r["undisturbed"]] or found
        if found:
            medians = {k: float(f"{numpy.median([r[k] for r in counted]):.5g}") for k in found[0] if k not in ("undisturbed", "dofs", "iterations")}
            yield {**{k: job[k] for k in KEYS}, **found[0], **medians, "runs": len(found), "undisturbed": sum(r["undisturbed"] for r in found),
                   "least": float(f"{min(r['seconds'] for r in found):.5g}")}


def write_csv(rows, path):
    columns = [*KEYS, "dofs", "energy", "l2", "seconds", "least", "process", "memory_mib", "runs", "undisturbed", "iterations", *STAGES]
    with open(path, "w") as file:
        table = csv.DictWriter(file, columns, restval="")
        table.writeheader()
        table.writerows(sorted(rows, key=lambda r: [r["program"] != "Mortise"] + [r[k] for k in KEYS[:4]] + [r["dofs"], r["mesh"], r["cores"]]))


def read_csv(path):
    text = (*KEYS[:3], "mesh")
    with open(path) as file:
        return [{k: v if k in text else float(v) if "." in v or "e" in v else int(v) for k, v in row.items() if v != ""}
                for row in csv.DictReader(file)]


def pick(rows, **wanted):
    return [r for r in rows if all(r.get(k) == v for k, v in wanted.items())]


def name_of(row):
    if row["program"] != "Mortise":
        return f"{row['program']} {row['cells'][:3]} p{row['degree']} {row['mesh']}"
    return f"{row['cells'][:3]} p{row['degree']} {row['mesh']}"


def fastest(rows, target, **wanted):
    """What first reaches an energy error, as text."""
    found = [r for r in pick(rows, **wanted) if r["energy"] <= target]
    if not found:
        return "-"
    best = min(found, key=lambda r: r["seconds"])
    return f"{best['seconds']:.3g} ({name_of(best)})"


def front(rows, key):
    """Rows that no other one beats in both the error and the key, by falling error."""
    best = []
    for row in sorted(rows, key=lambda r: (r[key], r["energy"])):
        if not best or row["energy"] < best[-1]["energy"]:
            best.append(row)
    return best


def draw(rows, path):
    figure, axes = plot.subplots(1, 3, figsize=(17, 5.2), gridspec_kw={"width_ratios": [1, 1, 1.15]})
    kinds = (("Mortise, tied, hexahedra", "C0", "o-", {"program": "Mortise", "scene": "tied", "cells": "hexahedra"}),
             ("Mortise, tied, tetrahedra", "C2", "^-", {"program": "Mortise", "scene": "tied", "cells": "tetrahedra"}),
             ("Mortise, conforming", "C7", "s--", {"program": "Mortise", "scene": "conforming"}),
             ("NGSolve, tied", "C3", "o-", {"program": "NGSolve", "scene": "tied"}),
             ("NGSolve, conforming", "C1", "s--", {"program": "NGSolve", "scene": "conforming"}),
             ("GetFEM, tied", "C4", "o-", {"program": "GetFEM"}), ("CalculiX, tied", "C5", "o-", {"program": "CalculiX"}))
    for axis, key, title in ((axes[0], "seconds", "solve [s]"), (axes[1], "memory_mib", "memory [MiB], all processes")):
        for label, color, style, wanted in kinds:
            part = pick(rows, cores=1 if wanted["program"] == "CalculiX" else 2, **wanted)
            if part:
                best = front(part, key)
                axis.loglog([r["energy"] for r in best], [r[key] for r in best], style, color=color, ms=5, label=label)
                axis.loglog([r["energy"] for r in part], [r[key] for r in part], style[0], color=color, ms=3, alpha=0.5)
        axis.invert_xaxis()
        axis.set_xlabel("relative energy error")
        axis.set_title(title + ", two cores", fontsize=11)
        axis.grid(True, which="major", alpha=0.4)
    axes[0].loglog([t[0] for t in TARGETS], [t[1] for t in TARGETS], "k*", ms=9, label="goals")
    axes[0].legend(fontsize=8)
    shown = [r for cells, degree, mesh in (("hexahedra", 4, "1,2:2,1"), ("hexahedra", 8, "2,2:3,1"), ("tetrahedra", 4, "2,2:3,1"),
             ("tetrahedra", 2, "4,2:6,3"), ("hexahedra", 2, "7,4:8,4"), ("hexahedra", 2, "14,7:21,10"), ("hexahedra", 4, "9,5:10,5"),
             ("hexahedra", 4, "11,6:13,6"), ("hexahedra", 4, HUGE))
             for r in pick(rows, program="Mortise", scene="tied", cells=cells, degree=degree, mesh=mesh, cores=2)]
    left = numpy.zeros(len(shown))
    for stage, color in zip(STAGES, plot.cm.tab10.colors):
        share = numpy.array([r.get(stage, 0) / r["seconds"] for r in shown])
        axes[2].barh(range(len(shown)), share, left=left, color=color, label=stage.replace("_", " "))
        left += share
    axes[2].set_yticks(range(len(shown)), [f"{r['cells'][:3]} p{r['degree']}, {r['dofs']:,} dofs\n{r['seconds']:.3g} s" for r in shown], fontsize=8)
    axes[2].invert_yaxis()
    axes[2].set_xlim(0, 1)
    axes[2].set_title("share of the stages, tied, two cores", fontsize=11)
    axes[2].legend(fontsize=8, ncol=4, loc="upper center", bbox_to_anchor=(0.4, -0.06))
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def table(head, lines):
    yield "| " + " | ".join(head) + " |"
    yield "|" + "---|" * len(head)
    for line in lines:
        yield "| " + " | ".join(line) + " |"
    yield ""


def machine():
    with open("/proc/cpuinfo") as file:
        return next(line.split(":")[1].strip() for line in file if line.startswith("model name")) + f", {os.cpu_count()} cores"


def report(rows):
    """Lines of doc/run_time.md."""
    tied, missed = {"program": "Mortise", "scene": "tied"}, []
    yield ("# Time and memory against the error\n\nRegenerate: `tests/benchmarks/run_time.py build/mortise --peers DIRECTORY "
           "--huge` (writes this page, [all rows](run_time.csv) and the\npicture; without `--peers` Mortise alone).\n\n"
           "![Time, memory and stages](pictures/run_time.png)\n\n"
           "`prm/thick_sphere.prm` and its conforming twin to a residual of 1e-8, cells of degree p, subdivisions inner : outer "
           "(those of\n1 : 2 cells across nest, as do the peers' n = 1). \"Solve\" is all stages but mesh, postprocess and output; "
           "of the peers the\nwall time without mesh and errors; \"process\" is the whole process, start-up included. Medians of "
           f"{numpy.median([r['undisturbed'] for r in rows]):.0f} runs (the huge one:\n1) that other processes left the cores to, in "
           f"random order, all programs in turn: {machine()}.\nLines of the picture join what nothing else beats; small marks are the other rows.\n")
    yield "## An error, tied\n\nSeconds of solve of the fastest row.\n"
    lines = []
    for target, goal, before in TARGETS:
        ours = fastest(rows, target, **tied, cores=2)
        reached = ours != "-" and float(ours.split()[0]) <= goal
        if not reached:
            missed.append(f"energy error {target:.0e} ({ours.split()[0]} s of {goal:g} s)")
        peers = [r for r in rows if r["program"] != "Mortise" and r["scene"] == "tied"]
        lines.append((f"{target:.0e}", f"{goal:g}", ours, fastest(rows, target, **tied, cores=1), fastest(peers, target, cores=2),
                      fastest(peers, target, cores=1), before))
    yield from table(("energy error", "goal, two cores", "Mortise, two cores", "one core", "best peer, two cores", "one core", "peer when goals were set"), lines)
    yield "The same on conforming meshes:\n"
    yield from table(("energy error", "Mortise, two cores", "one core", "NGSolve, two cores", "one core"),
                     [(f"{t[0]:.0e}", *(fastest(rows, t[0], program=program, scene="conforming", cores=n)
                                        for program in ("Mortise", "NGSolve") for n in (2, 1))) for t in TARGETS])
    yield "## A size\n"
    lines = []
    for name, degree, mesh, goal, memory, before in SIZES:
        found = {n: pick(rows, **tied, cells="hexahedra", degree=degree, mesh=mesh, cores=n) for n in (1, 2)}
        text = [f"{r['seconds']:.3g} s, {r['memory_mib'] / 1024:.2g} GiB, process {r['process']:.3g} s" if r else "not run"
                for r in (next(iter(found[n]), None) for n in (2, 1))]
        for r in found[2]:
            if r["seconds"] > goal:
                missed.append(f"{name} ({r['seconds']:.3g} s of {goal:g} s)")
            if memory and r["memory_mib"] / 1024 > memory:
                missed.append(f"{name} ({r['memory_mib'] / 1024:.2g} GiB of {memory:g} GiB)")
        dofs = f" ({found[2][0]['dofs']:,}, {mesh}, energy error {found[2][0]['energy']:.1e})" if found[2] else ""
        lines.append((name + dofs, f"{goal:g} s" + (f", {memory:g} GiB" if memory else ""), *text, before))
    yield from table(("", "goal, two cores", "two cores", "one core", "peer when goals were set"), lines)
    yield "## Tied beside conforming, about 500,000 dofs\n\nMicroseconds of solve per dof; goals: ratio at most 1.15, coupling (search, clipping, assembly) at most 10 %.\n"
    lines = []
    for degree, mesh, twin_mesh in PER_DOF:
        for n in (2, 1):
            a, b = (pick(rows, program="Mortise", scene=s, cells="hexahedra", degree=degree, mesh=m, cores=n) for s, m in (("tied", mesh), ("conforming", twin_mesh)))
            if a and b:
                each = [1e6 * r["seconds"] / r["dofs"] for r in (a[0], b[0])]
                share = sum(a[0][s] for s in COUPLING) / a[0]["seconds"]
                if each[0] > 1.15 * each[1]:
                    missed.append(f"tied to conforming, p = {degree}, cores {n} ({each[0] / each[1]:.2f} of 1.15)")
                if share > 0.1:
                    missed.append(f"share of the coupling, p = {degree}, cores {n} ({share:.0%} of 10 %)")
                lines.append((str(degree), str(n), *(f"{r['dofs']:,} ({r['mesh']}), {e:.2f}, {r['iterations']} iterations" for r, e in zip((a[0], b[0]), each)),
                              f"{each[0] / each[1]:.2f}", f"{share:.1%}"))
    yield from table(("p", "cores", "tied: dofs, us per dof", "conforming", "ratio", "coupling"), lines)
    yield "## Goals missed\n\n" + ("\n".join("- " + m for m in missed) or "None.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mortise", help="the program")
    parser.add_argument("--peers", help="directory of the peers' scripts")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--minutes", type=float, default=60, help="after which no run is repeated any more")
    parser.add_argument("--huge", action="store_true", help="10 million dofs, once on two cores (16 GiB)")
    parser.add_argument("--quick", action="store_true", help="two small meshes only")
    parser.add_argument("--report", action="store_true", help="page and picture again from doc/run_time.csv")
    options = parser.parse_args()
    path = os.path.join(TOP, "doc", "run_time.csv")
    if options.report:
        rows = read_csv(path)
    else:
        mortise = os.path.abspath(options.mortise)
        cases = [("tied", "hexahedra", QUICK)] if options.quick else [
            ("tied", "hexahedra", TIED), ("tied", "tetrahedra", TIED_TETRAHEDRA),
            ("conforming", "hexahedra", CONFORMING), ("conforming", "tetrahedra", CONFORMING_TETRAHEDRA)]
        with tempfile.TemporaryDirectory() as work:
            jobs = [job for case in cases for job in jobs_of_mortise(mortise, *case)]
            if options.peers:
                scripts = shutil.copytree(options.peers, os.path.join(work, "peers"))
                os.mkdir(os.path.join(scripts, "runs"))  # where calculix_sphere.py writes
                for program, (script, lines) in PEERS.items():
                    if installed(program):
                        jobs += jobs_of_peer(program, script, lines[:1] if options.quick else lines, scripts)
            rows = list(measured_rows(jobs, options.repeats, options.minutes, work))
            if options.huge:
                rows += measured_rows(list(jobs_of_mortise(mortise, "tied", "hexahedra", {4: (HUGE,)}, (2,))), 1, 0, work)
        write_csv(rows, path)
    draw(rows, os.path.join(TOP, "doc", "pictures", "run_time.png"))
    with open(os.path.join(TOP, "doc", "run_time.md"), "w") as file:
        file.write("\n".join(report(rows)) + "\n")


if __name__ == "__main__":
    main()
