#!/usr/bin/env python3
"""What a scene skips, and Mortise without an interface beside a plain program of deal.II.
Not a test: it writes doc/measurements/skipping.md.

  ninja -C build mortise benchmark_plain
  tests/benchmarks/plain.py build/mortise build/benchmark_plain

Runs every scene of prm/ once, then prm/thick_sphere_conforming.prm over degrees, sizes and ranks in
turn with plain_elasticity.cc, which solves the same scene in the same space, without a matrix and
with one. Reported are medians of the rounds in which other processes left the cores to the program
(of all rounds where there are none)."""
import argparse
import glob
import json
import os
import statistics
import subprocess
import tempfile
import time

from processor import on_ranks, openblas
from scaling import busy, is_quiet, wait_for_quiet
from scaling_report import machine, table

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
STAGES = ("mesh", "spaces", "interface_search", "interface_clipping", "coupling", "bulk", "solver_setup", "solve",
          "postprocess", "output")
PARTS = ("start", "mesh", "spaces", "setup", "solve", "postprocess")
SIZES = ("15,000", "100,000", "500,000")
MESHES = {2: ("6,5", "12,9", "19,19"), 3: ("4,3", "8,6", "14,10"), 4: ("3,2", "6,4", "9,10"), 6: ("2,2", "4,3", "7,5")}
ASSEMBLED = {2: 2, 3: 1, 4: 1, 6: 0}  # so many sizes are affordable with a matrix
GOAL = 1.05
ERRORS = ("energy", "l2")
COMPARED = {"process": "s of the process", "stages": "s of stages", "memory": "MiB", "own memory": "MiB above start"}


def timed(command, ranks=1):
    """Output of the program, and seconds of the process, of all its cores, and whether it had the cores to itself."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", **openblas()}
    before, start = busy(), time.perf_counter()
    output = subprocess.run((on_ranks(ranks) if ranks > 1 else []) + command, check=True, capture_output=True, text=True, env=environment).stdout
    seconds, after = time.perf_counter() - start, busy()
    cpu = after[1] - before[1]
    return output, {"process": seconds, "cpu": cpu, "quiet": is_quiet((after[0] - before[0] - cpu) / seconds, ranks)}


def memory_at_start(program):
    """MiB of a process that has loaded its libraries and does nothing."""
    null = [(os.POSIX_SPAWN_OPEN, fd, os.devnull, os.O_WRONLY, 0) for fd in (1, 2)]
    _, _, usage = os.wait4(os.posix_spawn(program, [program, "--version"], os.environ, file_actions=null), 0)
    return usage.ru_maxrss / 1024


def run_mortise(mortise, scene, settings=(), ranks=1):
    """Summary and what timed() has."""
    with tempfile.TemporaryDirectory() as work:
        command = [mortise, os.path.join(TOP, "prm", scene + ".prm"), "--output", work]
        for setting in settings:
            command += ["--set", setting]
        _, measured = timed(command, ranks)
        with open(os.path.join(work, "summary.json")) as file:
            return json.load(file), measured


def numbers(times, measured, **more):
    parts = {"mesh": times["mesh"], "spaces": times["spaces"], "solve": times["solve"], "postprocess": times["postprocess"],
             "setup": times.get("setup", 0) + times.get("bulk", 0) + times.get("solver_setup", 0)}
    stages = sum(parts.values())
    return {**parts, **measured, **more, "start": measured["process"] - stages, "stages": stages}


def of_mortise(mortise, p, mesh, ranks):
    settings = [f"Body shell/Degree={p}", f"Body shell/Mesh/Subdivisions={mesh}", "Solver/Tolerance=1e-8", "Output/Fields=",
                "Output/Points=", "Output/Resultants="]
    summary, measured = run_mortise(mortise, "thick_sphere_conforming", settings, ranks)
    step = summary["steps"][-1]
    return numbers(summary["timings_s"], measured, dofs=step["dofs"]["total"], energy=step["errors"]["energy"],
                   l2=step["errors"]["displacement_l2"], iterations=step["solver"]["iterations"],
                   memory=summary["memory_mib"]["peak_sum_over_ranks"])


def of_plain(plain, variant, p, mesh, ranks):
    output, measured = timed([plain, variant, str(p), *mesh.split(",")], ranks)
    found = json.loads(output)
    return numbers(found["timings_s"], measured, dofs=found["dofs"], energy=found["energy"],
                   l2=found["displacement_l2"], iterations=found["iterations"], memory=found["peak_sum_over_ranks"])


def median(runs):
    counted = [r for r in runs if r["quiet"]] or runs
    return {**{key: statistics.median(r[key] for r in counted) for key in (*PARTS, *COMPARED, "cpu", "iterations", *ERRORS)},
            "dofs": runs[0]["dofs"], "runs": len(runs), "quiet": sum(r["quiet"] for r in runs)}


def measure(options, p, size, ranks):
    """The programs in turn until each has had its runs or the time is over; the program with a matrix once."""
    mesh, start = MESHES[p][size], time.time()
    runs = {"mortise": [], "matrix_free": [], "assembled": []}
    for n in range(options.rounds):
        if n and time.time() - start > options.seconds:
            break
        wait_for_quiet(ranks, options.patience)
        runs["mortise"].append(of_mortise(options.mortise, p, mesh, ranks))
        runs["matrix_free"].append(of_plain(options.plain, "matrix_free", p, mesh, ranks))
    if size < ASSEMBLED[p]:
        runs["assembled"].append(of_plain(options.plain, "assembled", p, mesh, ranks))
    for name, of_name in runs.items():
        for run in of_name:
            run["own memory"] = run["memory"] - ranks * options.at_start[name == "mortise"]
    found = {name: median(of_name) for name, of_name in runs.items() if of_name}
    print(p, mesh, ranks, {name: round(r["process"], 2) for name, r in found.items()}, flush=True)
    return {"p": p, "mesh": mesh, "ranks": ranks, **found}


def others(case):
    return [case[name] for name in ("matrix_free", "assembled") if name in case]


def ratio(case, key):
    """Mortise over the better one of the plain programs."""
    return case["mortise"][key] / min(r[key] for r in others(case))


def difference(case):
    """Largest relative difference of the errors against the exact solution."""
    return max(abs(r[key] / case["mortise"][key] - 1) for r in others(case) for key in ERRORS)


def scene_rows(mortise):
    for path in sorted(glob.glob(os.path.join(TOP, "prm", "*.prm"))):
        scene = os.path.splitext(os.path.basename(path))[0]
        summary = run_mortise(mortise, scene)[0]
        step, times = summary["steps"][-1], summary["timings_s"]
        ran = [f"{times[s]:.3f}" if s in times else "-" for s in STAGES]
        yield [scene, f"{step['dofs']['total']:,}", *ran, "yes" if "errors" in step else "-"]


def texts(case, key, form):
    return [form.format(case[name][key]) if name in case else "-" for name in ("mortise", "matrix_free", "assembled")]


def name_of(case):
    return [str(case["p"]), f"{case['mortise']['dofs']:,} ({case['mesh']})", str(case["ranks"])]


def mark(case):
    return "" if all(case[name]["quiet"] for name in ("mortise", "matrix_free")) else " *"


def comparison(cases):
    rows = [[*name_of(c), *texts(c, "process", "{:.2f}"), f"{ratio(c, 'process'):.2f}{mark(c)}", f"{ratio(c, 'stages'):.2f}", f"{ratio(c, 'cpu'):.2f}",
             *texts(c, "memory", "{:.0f}"), f"{ratio(c, 'memory'):.2f}", f"{ratio(c, 'own memory'):.2f}",
             " / ".join(texts(c, "iterations", "{:.0f}")), f"{difference(c):.0e}"] for c in cases]
    return table(("p", "dofs", "ranks", "seconds: Mortise", "no matrix", "matrix", "ratio", "stages alone", "CPU",
                  "MiB: Mortise", "no matrix", "matrix", "ratio", "above start", "iterations", "errors differ by"), rows)


def stage_table(cases):
    rows = [[*name_of(c), *(f"{c['mortise'][s]:.3f} / {c['matrix_free'][s]:.3f}" for s in PARTS)] for c in cases]
    return table(("p", "dofs", "ranks", *PARTS), rows)


def missed(cases):
    """Where Mortise takes more than allowed: the whole, and stages by more than 5 ms; errors that differ by more than
    what the solvers' tolerance explains."""
    for c in cases:
        where = f"p = {c['p']}, {c['mortise']['dofs']:,} dofs, {c['ranks']} rank{'s' if c['ranks'] > 1 else ''}"
        for key, unit in COMPARED.items():
            if ratio(c, key) > GOAL:
                yield (f"- {where}: {c['mortise'][key]:.3g} {unit}, {ratio(c, key):.2f} times the plain program's" +
                       ("" if "memory" in key else mark(c)))
        for part in PARTS[1:]:
            ours, theirs = c["mortise"][part], c["matrix_free"][part]
            if ours > GOAL * theirs and ours > theirs + 5e-3:
                yield f"- {where}, {part}: {ours:.3f} s instead of {theirs:.3f} s{mark(c)}"
        if any(abs(r[key] - c["mortise"][key]) > 1e-4 * c["mortise"][key] + 1e-10 for r in others(c) for key in ERRORS):
            yield f"- {where}: errors differ by {difference(c):.0e}"


def report(scenes, cases, at_start=()):
    yield f"""# Stages that a scene skips, and a plain program beside it

Regenerate: `ninja -C build mortise benchmark_plain && tests/benchmarks/plain.py build/mortise build/benchmark_plain`
(`--ranks 1` for one rank alone, `--scenes` for the first table alone). Machine: {machine()}.

## Stages of the scenes

Seconds of each stage of `timings_s` in `summary.json`, every scene as it is in `prm/`, one rank, one run; "-": the
stage did not run and is absent there. Errors: there is an exact solution to compare with, as part of postprocess.
"""
    yield from table(("scene", "dofs", *(s.replace("_", " ") for s in STAGES), "errors"), scenes)
    if not cases:
        return
    yield f"""## No interface: beside a plain program

`prm/thick_sphere_conforming.prm` without fields, points and resultants, beside
[`plain_elasticity.cc`](../../tests/benchmarks/plain_elasticity.cc), which knows only deal.II, in the same space on the same
mesh: conjugate gradients to a relative residual of 1e-8, either without a matrix (multigrid in the degree, Chebyshev
smoothers, single precision, algebraic multigrid at degree 1; `MatrixFree` has one lane in Debian's deal.II) or with a
matrix and algebraic multigrid (where that is affordable, one run). Seconds of the whole process, peak memory of all
ranks, shared libraries included (`VmHWM`), iterations Mortise / no matrix / matrix, and the largest relative difference
between the programs' errors against Lame's solution (at an error of 3e-9, degree 6 and the finest mesh, the solvers'
tolerance shows). Ratio: Mortise over the better plain program; goal: at most {GOAL}. Stages alone: the same without start
and end of the process; CPU: of the time of all cores, which others disturb less; above start: without the
{at_start[1]:.0f} MiB ({at_start[0]:.0f} MiB of the plain program) that each rank has when it has loaded its libraries.
The programs take turns; medians of up to {max(c['mortise']['runs'] for c in cases)} runs. *: no run that other processes left the cores to.
"""
    yield from comparison(cases)
    yield """Seconds of the stages, Mortise / without a matrix. Start: all of the process but the stages, most of it loading of
shared libraries. Setup: `bulk` and `solver_setup`; postprocess: errors in L2 and energy.
"""
    yield from stage_table(cases)
    yield "## Goals missed\n\n" + ("\n".join(missed(cases)) or "None.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mortise", type=os.path.abspath)
    parser.add_argument("plain", type=os.path.abspath, nargs="?", help="the program benchmark_plain")
    parser.add_argument("--ranks", default="1,2")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=18, help="after which no further round of a case begins")
    parser.add_argument("--patience", type=int, default=0, help="seconds to wait for idle cores before a round")
    parser.add_argument("--scenes", action="store_true", help="the table of stages alone, printed")
    options = parser.parse_args()
    scenes = list(scene_rows(options.mortise))
    if options.scenes:
        print("\n".join(report(scenes, [])))
        return
    options.at_start = memory_at_start(options.plain), memory_at_start(options.mortise)
    cases = [measure(options, p, size, int(ranks)) for ranks in options.ranks.split(",")
             for size in range(len(SIZES)) for p in MESHES]
    with open(os.path.join(TOP, "doc", "measurements", "skipping.md"), "w") as file:
        file.write("\n".join(report(scenes, cases, options.at_start)) + "\n")


if __name__ == "__main__":
    main()
