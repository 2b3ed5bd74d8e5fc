#!/usr/bin/env python3
"""A corner singularity on an interface by h, p and hp: hp.py [--quick] MORTISE

Runs prm/fichera.prm, whose displacement behaves as r^0.6 at a corner of the interface, with all cells halved
(h, degree 2), with rising degree on one mesh (p), and with cells halved once more at the corner for each
degree (hp), also with the upper body in tetrahedra that shrink towards the corner (hp, tet). Writes doc/measurements/hp.csv, doc/measurements/hp.md and, with matplotlib, doc/measurements/hp.png."""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


# Mesh size of meshes/fichera_tet.geo by degree: the edges at the corner have its sixth power.
SIZES = {1: 0.9, 2: 0.8, 3: 0.7, 4: 0.6, 5: 0.52}


def run(mortise, kind, p, refinements, near, size=None):
    settings = ["Output/Fields=", "Solver/Tolerance=1e-11", f"Body lower/Mesh/Refinements={refinements}",
                f"Body upper/Mesh/Refinements={refinements + 1}"]
    for body in ("lower", "upper"):
        settings += [f"Body {body}/Degree={p}",
                     f"Body {body}/Mesh/Refine near=" + (f"0, 0, 0, 1e-9, {near}" if near and (body == "lower" or not size) else "")]
    if size:
        settings += ["Body upper/Mesh/File=meshes/fichera_tet.geo", f"Body upper/Mesh/Mesh size={size}",
                     "Body upper/Mesh/Refinements=0"]
    with tempfile.TemporaryDirectory() as work:
        command = [mortise, os.path.join(TOP, "prm", "fichera.prm"), "--output", work]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, cwd=TOP)
        result = json.load(open(os.path.join(work, "summary.json")))
    step = result["steps"][-1]
    row = {"kind": kind, "degree": p, "halvings": near or refinements, "dofs": step["dofs"]["total"],
           "l2": step["errors"]["displacement_l2"], "energy": step["errors"]["energy"],
           "multiplier": step["errors"]["multiplier_l2"], "iterations": step["solver"]["iterations"],
           "method": step["solver"]["method"], "seconds": result["timings_s"]["total"]}
    print(*(f"{v:.3g}" if isinstance(v, float) else v for v in row.values()), flush=True)
    return row


def main():
    quick = "--quick" in sys.argv
    mortise = os.path.abspath([a for a in sys.argv[1:] if not a.startswith("-")][0])
    top = 4 if quick else 6
    rows = [run(mortise, "h", 2, refinements, 0) for refinements in range(2 if quick else 3)]
    rows += [run(mortise, "p", p, 0, 0) for p in range(1, top + 1)]
    rows += [run(mortise, "hp", p, 0, p) for p in range(1, top + 1)]
    rows += [run(mortise, "hp, tet", p, 0, p, size) for p, size in SIZES.items() if p <= top]
    write(rows)


def exponent(rows, power):
    """b of the least-squares line log(energy) = a - b dofs^power."""
    x = [r["dofs"] ** power for r in rows]
    y = [math.log(r["energy"]) for r in rows]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return -sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def write(rows):
    with open(os.path.join(TOP, "doc", "measurements", "hp.csv"), "w") as file:
        table = csv.DictWriter(file, rows[0].keys())
        table.writeheader()
        table.writerows(rows)
    b = exponent([r for r in rows if r["kind"] == "hp"], 0.25)
    b_tet = exponent([r for r in rows if r["kind"] == "hp, tet"], 0.25)
    with open(os.path.join(TOP, "doc", "measurements", "hp.md"), "w") as file:
        file.write("# hp refinement at a corner of the interface\n\nRegenerate: `tests/benchmarks/hp.py build/mortise` (writes this page, `hp.csv` "
                   "and `hp.png`).\n\n![Energy error over degrees of freedom](hp.png)\n\n"
                   "`prm/fichera.prm`: Fichera's corner, two bodies tied along an L whose re-entrant vertex is the corner, displacement "
                   "r^0.6,\nmeshes 2 : 3, so that neither side's faces match; hanging nodes on both sides of the interface. With cells "
                   "halved once more\nat the corner for each degree the energy error falls as "
                   f"exp(-{b:.2f} N^(1/4)), with the upper body in tetrahedra that shrink towards the corner (`meshes/fichera_tet.geo`)\nas "
                   f"exp(-{b_tet:.2f} N^(1/4)); all cells halved, or the degree alone raised,\nit falls algebraically.\n\n"
                   "| | p | halvings | dofs | L2 | energy | multiplier | iterations |\n|---|---|---|---|---|---|---|---|\n")
        for r in rows:
            file.write(f"| {r['kind']} | {r['degree']} | {r['halvings']} | {r['dofs']} | {r['l2']:.1e} | {r['energy']:.1e} | "
                       f"{r['multiplier']:.1e} | {r['iterations']} ({r['method']}) |\n")
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plot
    except ImportError:
        return
    figure, axes = plot.subplots(1, 2, figsize=(11, 4.3), sharey=True)
    for kind, label in (("h", "all cells halved, p = 2"), ("p", "degree 1 to 6, one mesh"), ("hp", "degree and halvings at the corner"), ("hp, tet", "the same, upper body in tetrahedra")):
        part = [r for r in rows if r["kind"] == kind]
        axes[0].loglog([r["dofs"] for r in part], [r["energy"] for r in part], "o-", label=label)
        axes[1].semilogy([r["dofs"] ** 0.25 for r in part], [r["energy"] for r in part], "o-", label=label)
    axes[0].set_xlabel("degrees of freedom N")
    axes[1].set_xlabel("N^(1/4)")
    axes[0].set_ylabel("relative energy error")
    axes[0].legend()
    for axis in axes:
        axis.grid(True, which="both", alpha=0.3)
    figure.tight_layout()
    figure.savefig(os.path.join(TOP, "doc", "measurements", "hp.png"), dpi=90)


if __name__ == "__main__":
    main()
