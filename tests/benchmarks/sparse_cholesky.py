#!/usr/bin/env python3
"""The program's own sparse Cholesky factorisation beside CHOLMOD and MUMPS on the matrices that it factorises.
Not a test: it writes doc/measurements/sparse_cholesky.md.

  apt-get install libsuitesparse-dev
  ninja -C build benchmark_sparse_cholesky && tests/benchmarks/sparse_cholesky.py build/benchmark_sparse_cholesky [RUNS]"""
import json
import os
import statistics
import subprocess
import sys

from processor import openblas

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(TOP, "doc", "measurements", "sparse_cholesky.md")
SOLVES = 130  # of a run with 20 iterations or so
GOAL = 1.5


def sphere(degree, slave, master, cells="hexahedra"):
    return dict(source="sphere", degree=degree, slave=slave, master=master, cells=cells)


def box(degree, slave, master, cells="hexahedra", held="", **more):
    return dict(source="box", degree=degree, slave=slave, master=master, cells=cells, held=held, **more)


MULTIPLIERS = [
    sphere(1, 16, 20), sphere(1, 32, 40), sphere(2, 8, 10), sphere(2, 16, 20), sphere(2, 32, 40), sphere(4, 4, 5),
    sphere(4, 8, 10), sphere(4, 12, 15), sphere(6, 3, 4), sphere(6, 6, 7), box(1, 24, 30, held="xmin"),
    box(2, 12, 15, held="xmin,ymin"), box(2, 24, 30, held="xmin"), box(4, 8, 10, held="xmin,xmax,ymin,ymax"),
    box(6, 6, 7, held="xmin"), box(1, 24, 30, "tetrahedra", "xmin"), box(2, 12, 15, "tetrahedra", "xmin"),
    box(2, 24, 30, "tetrahedra"), box(4, 8, 10, "tetrahedra", "xmin,ymin"), box(6, 4, 5, "tetrahedra", "xmin")]
VERTICES = [dict(case, matrix="vertices") for case in (
    box(1, 6, 7, held="xmin", layers=3), box(1, 10, 11, held="xmin", layers=6), box(1, 14, 15, held="xmin", layers=9),
    box(1, 10, 11, "tetrahedra", "xmin", layers=6), box(1, 14, 15, "tetrahedra", "xmin", layers=9), sphere(1, 12, 15))]


def measure(program, case, runs):
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", **openblas())
    words = [f"{key}={value}" for key, value in case.items()]
    result = subprocess.run([program, *words, f"runs={runs}"], env=environment, check=True, capture_output=True, text=True)
    print(" ".join(words), result.stdout.strip(), flush=True)
    return json.loads(result.stdout)


def total(of):
    return of["factor"] + SOLVES * of["solve"]


def cholmod(result):
    """With the better of the two orders."""
    return min((result["cholmod_metis"], result["cholmod_amd"]), key=total)


def describe(case):
    held = case.get("held", "")
    return (f"{case['source']}, {case['cells']}, p = {case['degree']}, {case['slave']} : {case['master']}"
            + (f", clamped {held.replace(',', ' ')}" if held else ""))


def row(case, result):
    single, double, other, mumps = result["own_float"], result["own_double"], cholmod(result), result["mumps"]

    def cell(of):
        return f"{1e3 * of['factor']:.3g} / {1e6 * of['solve']:.3g} / {of['memory']:.3g}"
    return (f"| {describe(case)} | {result['rows']} | {100 * result['alike']:.0f} % | "
            f"{cell(single)} | {cell(double)} | {cell(other)} | {cell(mumps)} | "
            f"{total(other) / total(single):.2f} | {total(other) / total(double):.2f} | {total(mumps) / total(single):.2f} |")


HEAD = ("| scene | rows | alike | own, single: ms / us / MiB | own, double | CHOLMOD | MUMPS | CHOLMOD : single | "
        "CHOLMOD : double | MUMPS : single |\n|---|---|---|---|---|---|---|---|---|---|")


def sentence(results):
    ratios = [total(cholmod(r)) / total(r["own_float"]) for r in results]
    solves = [cholmod(r)["solve"] / r["own_float"]["solve"] for r in results]
    factors = [cholmod(r)["factor"] / r["own_float"]["factor"] for r in results]
    below = sum(ratio < GOAL for ratio in ratios)
    return (f"CHOLMOD takes {min(ratios):.2f} to {max(ratios):.2f} times as long in total, median {statistics.median(ratios):.2f} "
            f"(a factorisation {min(factors):.2f} to {max(factors):.2f}, a solve {min(solves):.2f} to {max(solves):.2f}); "
            f"below {GOAL} in {below} of {len(ratios)}.")


def page(multipliers, vertices, runs):
    return f"""# The program's own sparse Cholesky factorisation

Regenerate: `apt-get install libsuitesparse-dev`, `ninja -C build benchmark_sparse_cholesky && tests/benchmarks/sparse_cholesky.py
build/benchmark_sparse_cholesky` (writes this page).

`SparseCholesky` beside CHOLMOD (supernodal, the better of METIS and AMD; it has double precision only) and MUMPS (as the program
calls it, positive definite) on the matrices that the program factorises. One rank, one thread, seconds on the processor (what
else runs does not count), medians of {runs} factorisations with 20 solves each, in turn. "ms / us / MiB": analysis and factorisation,
one solve, memory that is kept. Ratios are those of what a run pays in total, a factorisation and {SOLVES} solves. "Alike": nodes at
which the three components have the same rows; where all are alike, CHOLMOD factorises one component and solves for three right
hand sides at once.

The program takes single precision (computed in double for C, in single for vertices) wherever that is accurate enough
(`CholeskyInverse`), which is nearly everywhere.

## C = B T B^T of the multipliers

{HEAD}
{chr(10).join(row(case, result) for case, result in multipliers)}

{sentence([result for _, result in multipliers])}

## K + J on vertices

{HEAD}
{chr(10).join(row(case, result) for case, result in vertices)}

{sentence([result for _, result in vertices])}

## How much of it is on every rank

While it is factorised, the whole matrix is on every rank that takes part. This ends

- for C at `Solver/Multipliers on all ranks` (30000 rows): above, each rank factorises what its own multipliers and their
  neighbours have among each other, and corrects (`SchwarzInverse`); only where this fails (a stiff slave that is finer than its
  master) is C gathered again, up to 100000 rows; beyond it is MUMPS', distributed;
- for vertices at 1500 rows, or where it takes 3e5 multiplications per row, if no coarser mesh is known: above, multigrid.
"""


def main():
    program, runs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 9
    tables = [[(case, measure(program, case, runs)) for case in cases] for cases in (MULTIPLIERS, VERTICES)]
    with open(PAGE, "w") as file:
        file.write(page(*tables, runs))


if __name__ == "__main__":
    main()
