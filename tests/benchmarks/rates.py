#!/usr/bin/env python3
"""Errors of the thick scenes over degree and mesh, tied and conforming: rates.py [--quick] MORTISE

Writes doc/rates.csv and doc/rates.md beside it (and doc/rates.png if matplotlib is there). Tied: the
inner layer has n cells per patch edge (or around), the outer one 3/2 n; conforming: n everywhere,
so its cells have the size of the tied scene's coarser side."""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def run(mortise, scene, settings):
    with tempfile.TemporaryDirectory() as work:
        command = [mortise, os.path.join(TOP, "prm", scene + ".prm"), "--output", work, "--set", "Output/Fields="]
        for setting in settings:
            command += ["--set", setting]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return json.load(open(os.path.join(work, "summary.json")))


def settings(scene, n, p):
    tail = ["Solver/Tolerance=1e-11"]
    if scene == "thick_sphere":
        inner, outer, whole = f"{n}, {max(1, n // 2)}", f"{3 * n // 2}, {max(1, n // 2)}", f"{n}, {2 * max(1, n // 2)}"
    else:
        inner, outer = f"{n}, {max(1, n // 2)}, 1", f"{3 * n // 2}, {max(1, n // 2)}, 2"
        whole = f"{n}, {2 * max(1, n // 2)}, 1"
    tied = [f"Body {b}/Degree={p}" for b in ("inner", "outer")]
    tied += [f"Body inner/Mesh/Subdivisions={inner}", f"Body outer/Mesh/Subdivisions={outer}"]
    return tied + tail, [f"Body shell/Degree={p}", f"Body shell/Mesh/Subdivisions={whole}"] + tail


def main():
    quick = "--quick" in sys.argv
    mortise = os.path.abspath([a for a in sys.argv[1:] if not a.startswith("-")][0])
    meshes = {1: (4, 8, 16), 2: (2, 4, 8), 3: (2, 4, 8), 4: (2, 4), 5: (2, 4), 6: (2, 4)}
    if quick:
        meshes = {p: ns[:2] for p, ns in meshes.items() if p <= 4}
    rows = []
    for scene in ("thick_sphere", "thick_cylinder"):
        for p, ns in meshes.items():
            before = None
            for n in ns:
                tied, whole = settings(scene, n, p)
                a = run(mortise, scene, tied)
                b = run(mortise, scene + "_conforming", whole)
                step = a["steps"][-1]
                errors, twin = step["errors"], b["steps"][-1]["errors"]
                row = {"scene": scene, "degree": p, "n": n, "dofs": step["dofs"]["total"],
                       "l2": errors["displacement_l2"], "energy": errors["energy"],
                       "multiplier": errors["multiplier_l2"], "energy_over_conforming": errors["energy"] / twin["energy"],
                       "iterations": step["solver"]["iterations"], "method": step["solver"]["method"],
                       "seconds": a["timings_s"]["total"]}
                for key in ("l2", "energy", "multiplier"):
                    row[key + "_rate"] = math.log2(before[key] / row[key]) if before else None
                before = row
                rows.append(row)
                print(scene, p, n, *(f"{row[k]:.3g}" for k in ("l2", "energy", "multiplier", "energy_over_conforming")), flush=True)
    write(rows)


def write(rows):
    with open(os.path.join(TOP, "doc", "rates.csv"), "w") as file:
        table = csv.DictWriter(file, rows[0].keys())
        table.writeheader()
        table.writerows(rows)
    with open(os.path.join(TOP, "doc", "rates.md"), "w") as file:
        file.write("# Errors and rates of the tied thick scenes\n\nRegenerate: `tests/benchmarks/rates.py build/mortise` "
                   "(writes this page and `rates.csv`).\n`n`: cells per patch edge (around) of the inner layer, 3/2 n of the outer; "
                   "rates against the row above; last but one column:\nenergy error over that of the conforming mesh with n cells.\n\n"
                   "| scene | p | n | dofs | L2 | rate | energy | rate | multiplier | rate | / conforming | iterations |\n"
                   "|---|---|---|---|---|---|---|---|---|---|---|---|\n")
        for r in rows:
            rate = lambda key: "" if r[key + "_rate"] is None else f"{r[key + '_rate']:.2f}"
            file.write(f"| {r['scene']} | {r['degree']} | {r['n']} | {r['dofs']} | {r['l2']:.2e} | {rate('l2')} | {r['energy']:.2e} | "
                       f"{rate('energy')} | {r['multiplier']:.2e} | {rate('multiplier')} | {r['energy_over_conforming']:.3f} | "
                       f"{r['iterations']} ({r['method']}) |\n")
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plot
    except ImportError:
        return
    for degree in sorted({r["degree"] for r in rows}):
        part = [r for r in rows if r["degree"] == degree and r["scene"] == "thick_sphere"]
        plot.loglog([r["dofs"] for r in part], [r["energy"] for r in part], "o-", label=f"p = {degree}")
    plot.xlabel("degrees of freedom")
    plot.ylabel("relative energy error")
    plot.title("Thick sphere, tied at mid radius, 2 : 3 cells")
    plot.legend()
    plot.grid(True, which="both", alpha=0.3)
    plot.savefig(os.path.join(TOP, "doc", "rates.png"), dpi=110)


if __name__ == "__main__":
    main()
