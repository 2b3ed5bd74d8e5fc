#!/usr/bin/env python3
"""Scaling over ranks of MPI: scaling.py MORTISE (all), scaling.py --report (pages from the last numbers)

Strong and weak scaling on 1 and 2 ranks, and what decides beyond: messages, bytes, collectives, work and
memory per rank and stage, counted by tests/benchmarks/mpi_counts.c on 1 to 64 ranks that share the cores, and
a model made of them. Writes doc/measurements/scaling.csv (all numbers), doc/measurements/scaling.md and doc/measurements/scaling.png.
--only STUDY runs one study (strong, weak, counts) and keeps the other rows."""
import argparse
import csv
import json
import os
import resource
import subprocess
import tempfile
import time

import numpy as np

from processor import on_ranks, openblas
from scaling_report import report

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CSV = os.path.join(TOP, "doc", "measurements", "scaling.csv")
# name: degree, subdivisions of inner and outer, refinements
SCENES = {"p4": (4, "11,6", "13,6", 0), "p2": (2, "16,8", "18,9", 0), "p4 half": (4, "9,4", "10,5", 0),
          "p4 small": (4, "2,1", "3,2", 1), "p4 large": (4, "2,1", "3,2", 2),
          "p2 small": (2, "3,1", "4,2", 2), "p2 large": (2, "2,1", "3,2", 3)}
BY_PARTS = ("p2 small", "p2 large")  # as scenes that are too large for the counts are solved
STUDIES = {"strong": (("p4", (1, 2)), ("p2", (1, 2))), "weak": (("p4 half", (1,)), ("p4", (2,))),
           "counts": (("p4 small", (1, 2, 4, 8, 16, 32, 64)), ("p2 small", (1, 2, 4, 8, 16, 32, 64)),
                      ("p4 large", (1, 4, 16, 64)), ("p2 large", (1, 4, 16, 64)))}
REPEATS = {"strong": 5, "weak": 5, "counts": 1}
SLACK, PATIENCE = 0.1, 8  # cores that others may take from a run that is timed; runs until the best of them have to do
COLUMNS = ("sent", "received", "bytes_sent", "bytes_received", "partners", "collectives", "collective_bytes", "cpu",
           "wall", "wall_mpi", "peak_kib")


def compile_counter(directory):
    library = os.path.join(directory, "mpi_counts.so")
    subprocess.run(["mpicc", "-O2", "-shared", "-fPIC", "-o", library,
                    os.path.join(TOP, "tests", "benchmarks", "mpi_counts.c")], check=True)
    return library


def busy():
    """Seconds that all processes spent on the cores so far, and those of this one's children."""
    with open("/proc/stat") as file:
        ticks = [int(t) for t in file.readline().split()[1:9]]
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (sum(ticks) - ticks[3] - ticks[4]) / os.sysconf("SC_CLK_TCK"), children.ru_utime + children.ru_stime


def is_quiet(others, ranks):
    """Do others on so many cores leave a core for each rank?"""
    return others <= max(os.cpu_count() - ranks, 0) + SLACK


def wait_for_quiet(ranks, limit=60):
    """Until it has been quiet for two seconds, or for so many seconds."""
    for _ in range(limit // 2):
        before = busy()[0]
        time.sleep(2)
        if is_quiet((busy()[0] - before) / 2, ranks):
            return


def run(mortise, library, scene, ranks):
    """Summary of the program; per stage the columns of all ranks (a row each); cores that others took."""
    degree, inner, outer, refinements = SCENES[scene]
    settings = ["Output/Fields=", "Solver/Tolerance=1e-8"]
    if scene in BY_PARTS:
        settings.append("Solver/Multipliers on all ranks=0")
    for body, subdivisions in (("inner", inner), ("outer", outer)):
        settings += [f"Body {body}/Degree={degree}", f"Body {body}/Mesh/Subdivisions={subdivisions}",
                     f"Body {body}/Mesh/Refinements={refinements}"]
    with tempfile.TemporaryDirectory() as work:
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
                       **openblas(), "MPI_COUNTS": work}
        command = [*on_ranks(ranks), "env", f"LD_PRELOAD={library}", mortise,
                   os.path.join(TOP, "prm", "thick_sphere.prm"), "--output", work]
        for setting in settings:
            command += ["--set", setting]
        before, start = busy(), time.monotonic()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=environment)
        after, stages = busy(), {}
        others = (after[0] - before[0] - after[1] + before[1]) / (time.monotonic() - start)
        for rank in range(ranks):
            with open(os.path.join(work, f"{rank}.csv")) as file:
                for row in csv.DictReader(file):
                    stages.setdefault(row["stage"], []).append([float(row[c]) for c in COLUMNS])
        with open(os.path.join(work, "summary.json")) as file:
            return json.load(file), {name: np.array(values) for name, values in stages.items()}, others


def rows_of(study, scene, ranks, summary, stages, others):
    """One row per stage: the largest over the ranks and the mean."""
    step = summary["steps"][-1]
    cells = [i for i in summary.get("integration_cells_per_rank", {}).values()]
    whole = {"study": study, "scene": scene, "dofs": step["dofs"]["total"],
             "multipliers": step["dofs"]["multiplier"], "ranks": ranks, "iterations": step["solver"]["iterations"],
             "cells_over_mean": max([i["largest"] / i["mean"] for i in cells], default=1.),
             "others": round(others, 3)}
    for name, values in stages.items():
        column = dict(zip(COLUMNS, values.T))
        both = {"messages": np.maximum(column["sent"], column["received"]),
                "bytes": np.maximum(column["bytes_sent"], column["bytes_received"]),
                "partners": column["partners"], "collective_bytes": column["collective_bytes"],
                "work": column["cpu"], "peak_mib": column["peak_kib"] / 1024}
        row = {**whole, "stage": name, "seconds": column["wall"].max(), "collectives": column["collectives"].max()}
        for key, of_ranks in both.items():
            row[key], row[key + "_mean"] = of_ranks.max(), of_ranks.mean()
        row["busiest"] = int(both["messages"].argmax())
        yield row


def median(rows):
    return {key: value if isinstance(value, str) else float(f"{np.median([r[key] for r in rows]):.6g}")
            for key, value in rows[0].items()}


def measure(mortise, library, study):
    """Medians over the repetitions, which go through all cases in turn until each has enough quiet runs; of a
    case that never has, the least disturbed ones. After each run: the rows so far."""
    cases = {(scene, ranks): [] for scene, all_ranks in STUDIES[study] for ranks in all_ranks}
    enough = lambda ranks, runs: len(runs) >= PATIENCE or sum(is_quiet(others, ranks) for others, _ in runs) >= REPEATS[study]
    if study == "counts":
        enough = lambda ranks, runs: len(runs) >= REPEATS[study]
    while not all(enough(ranks, runs) for (_, ranks), runs in cases.items()):
        for (scene, ranks), runs in cases.items():
            if enough(ranks, runs):
                continue
            if study != "counts":
                wait_for_quiet(ranks)
            summary, stages, others = run(mortise, library, scene, ranks)
            runs.append((others, list(rows_of(study, scene, ranks, summary, stages, others))))
            print(study, scene, ranks, f"{others:.2f}", f"{sum(s[:, COLUMNS.index('wall')].max() for s in stages.values()):.2f}", flush=True)
            kept = [[rows for _, rows in sorted(runs, key=lambda r: r[0])[:REPEATS[study]]] for runs in cases.values() if runs]
            yield [median(of_stage) for runs_of_case in kept for of_stage in zip(*runs_of_case)]


def read():
    def number(text):
        try:
            return float(text)
        except ValueError:
            return text
    if not os.path.exists(CSV):
        return []
    with open(CSV) as file:
        return [{k: number(v) for k, v in row.items()} for row in csv.DictReader(file)]


def write(rows):
    with open(CSV, "w") as file:
        table = csv.DictWriter(file, {key: None for row in rows for key in row})
        table.writeheader()
        table.writerows({k: v if isinstance(v, str) else f"{v:.6g}" for k, v in row.items()} for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mortise", nargs="?", help="the program; not needed for --report")
    parser.add_argument("--report", action="store_true", help="only pages from doc/measurements/scaling.csv")
    parser.add_argument("--only", choices=STUDIES, help="run one study, keep the others")
    arguments = parser.parse_args()
    if not arguments.report:
        with tempfile.TemporaryDirectory() as directory:
            library = compile_counter(directory)
            for study in [arguments.only] if arguments.only else STUDIES:
                others = [row for row in read() if row["study"] != study]
                for rows in measure(os.path.abspath(arguments.mortise), library, study):
                    write(others + rows)
    report(read())


if __name__ == "__main__":
    main()
