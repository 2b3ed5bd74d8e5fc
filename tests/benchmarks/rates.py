#!/usr/bin/env python3
"""Errors over degree and mesh: rates.py [--quick] [--tetrahedra] MORTISE

Thick sphere and cylinder, tied (inner layer n cells per patch edge or around, outer one n times the ratio
3/2 or 5/4) beside conforming twins (n cells everywhere, the size of the tied scene's coarser side),
the manufactured solution with a clamped interface rim, and the errors 1e-4 and 1e-6 on meshes that
do not nest; in hexahedra, and in tetrahedra and both (slave on master). With --tetrahedra only the latter
are run, and the other rows of the last run kept. Writes doc/measurements/rates.csv, doc/measurements/rates.md and, with matplotlib, doc/measurements/rates.png."""
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


def layers(scene, n, ratio):
    """Subdivisions of the inner and the outer layer and of the conforming twin."""
    m, outer = max(1, n // 2), n * ratio[1] // ratio[0]
    if scene == "thick_sphere":
        return f"{n}, {m}", f"{outer}, {m}", f"{n}, {2 * m}"
    return f"{n}, {m}, 1", f"{outer}, {m}, 2", f"{n}, {2 * m}, 1"


def tied_settings(names, p, subdivisions):
    return [f"Body {b}/Degree={p}" for b in names] + [
        f"Body {b}/Mesh/Subdivisions={s}" for b, s in zip(names, subdivisions)]


def cells_settings(names, cells):
    return [f"Body {b}/Mesh/Cells={c}" for b, c in zip(names, cells)]


def row_of(scene, cells, ratio, p, n, result, twin=None):
    step = result["steps"][-1]
    errors = step["errors"]
    return {"scene": scene, "cells": " on ".join(c[:3] for c in cells), "ratio": f"{ratio[0]}:{ratio[1]}", "degree": p, "n": n, "dofs": step["dofs"]["total"],
            "l2": errors["displacement_l2"], "energy": errors["energy"], "multiplier": errors["multiplier_l2"],
            "energy_over_conforming": errors["energy"] / twin["steps"][-1]["errors"]["energy"] if twin else None,
            "iterations": step["solver"]["iterations"], "method": step["solver"]["method"],
            "seconds": result["timings_s"]["total"]}


def add_rates(row, before):
    for key in ("l2", "energy", "multiplier"):
        row[key + "_rate"] = math.log(before[key] / row[key]) / math.log(row["n"] / before["n"]) if before else None
    return row


def thick_rows(mortise, scene, ratio, meshes, cells=("hexahedra", "hexahedra")):
    for p, ns in meshes.items():
        before = None
        for n in ns:
            inner, outer, whole = layers(scene, n, ratio)
            tied = run(mortise, scene, tied_settings(("inner", "outer"), p, (inner, outer)) +
                       cells_settings(("inner", "outer"), cells) + [TOLERANCE])
            twin = run(mortise, scene + "_conforming", tied_settings(("shell",), p, (whole,)) +
                       cells_settings(("shell",), cells[:1]) + [TOLERANCE])
            before = add_rates(row_of(scene, cells, ratio, p, n, tied, twin), before)
            yield before


def manufactured_rows(mortise, meshes, cells=("hexahedra", "hexahedra")):
    for p, ns in meshes.items():
        before = None
        for n in ns:
            m = max(1, n // 2)
            sizes = (f"{n}, {n}, {m}", f"{3 * n // 2}, {3 * n // 2}, {m}")
            result = run(mortise, "manufactured", tied_settings(("lower", "upper"), p, sizes) +
                         cells_settings(("lower", "upper"), cells) + [TOLERANCE])
            before = add_rates(row_of("manufactured", cells, (2, 3), p, n, result), before)
            yield before


def target_rows(mortise):
    """Small meshes of high degree that reach 1e-4 and 1e-6."""
    for scene, p, inner, outer in (("thick_cylinder", 5, "2, 1, 1", "3, 1, 1"), ("thick_cylinder", 7, "2, 1, 1", "3, 1, 1"),
                                   ("thick_sphere", 6, "2, 1", "3, 1"), ("thick_sphere", 8, "2, 1", "3, 1")):
        result = run(mortise, scene, tied_settings(("inner", "outer"), p, (inner, outer)) + [TOLERANCE])
        yield add_rates(row_of(scene, ("hexahedra", "hexahedra"), (2, 3), p, 2, result), None)


TOLERANCE = "Solver/Tolerance=1e-11"
SPHERE = {1: (4, 8, 16), 2: (2, 4, 8), 3: (2, 4, 8), 4: (2, 4), 5: (2, 4), 6: (2, 4)}
CYLINDER = {1: (8, 16, 32), 2: (4, 8, 16), 3: (4, 8, 16), 4: (4, 8, 16), 5: (2, 4, 8), 6: (2, 4, 8)}
TETRAHEDRA = {"thick_sphere": {1: (4, 8, 16), 2: (2, 4, 8), 3: (2, 4), 4: (2, 4)},
              "thick_cylinder": {1: (8, 16), 2: (4, 8), 3: (4, 8), 4: (2, 4, 8), 5: (2, 4, 8), 6: (2, 4)}}
PAIRS = (("tetrahedra", "tetrahedra"), ("tetrahedra", "hexahedra"), ("hexahedra", "tetrahedra"))
MANUFACTURED = {1: (4, 8, 16), 2: (4, 8), 3: (2, 4, 8), 4: (2, 4), 5: (2, 4), 6: (2, 4)}


def earlier_rows():
    """Rows without tetrahedra of the last run."""
    def number(text):
        try:
            return None if text == "" else int(text) if text.isdigit() else float(text)
        except ValueError:
            return text
    with open(os.path.join(TOP, "doc", "measurements", "rates.csv")) as file:
        rows = [{"scene": row["scene"], "cells": row.get("cells", "hex on hex"), **{k: number(v) for k, v in row.items() if k not in ("scene", "cells")}}
                for row in csv.DictReader(file)]
    return [row for row in rows if row["cells"] == "hex on hex"]


def main():
    quick = "--quick" in sys.argv
    mortise = os.path.abspath([a for a in sys.argv[1:] if not a.startswith("-")][0])
    cut = (lambda meshes: {p: ns[:2] for p, ns in meshes.items() if p <= 4}) if quick else (lambda meshes: meshes)
    four_five = {p: (4, 8) for p in range(1, 5)}
    parts = [thick_rows(mortise, "thick_sphere", (2, 3), cut(SPHERE)),
             thick_rows(mortise, "thick_cylinder", (2, 3), cut(CYLINDER)),
             thick_rows(mortise, "thick_sphere", (4, 5), cut({1: (4, 8), 2: (4, 8), 3: (4,), 4: (4,)})),
             thick_rows(mortise, "thick_cylinder", (4, 5), cut({**four_five, 5: (4, 8), 6: (4, 8)})),
             manufactured_rows(mortise, cut(MANUFACTURED)), target_rows(mortise)]
    kept = earlier_rows() if "--tetrahedra" in sys.argv else []
    if kept:
        parts = []
    for pair in PAIRS:
        parts += [thick_rows(mortise, scene, (2, 3), cut(meshes), pair) for scene, meshes in TETRAHEDRA.items()]
        parts.append(manufactured_rows(mortise, cut({1: (4, 8, 16), 2: (4, 8), 3: (2, 4, 8), 4: (2, 4)}), pair))
    rows = kept
    for part in parts:
        for row in part:
            rows.append(row)
            print(row["scene"], row["cells"], row["ratio"], row["degree"], row["n"], row["dofs"],
                  *("-" if row[k] is None else f"{row[k]:.3g}" for k in
                    ("l2", "l2_rate", "energy", "energy_rate", "multiplier", "multiplier_rate", "energy_over_conforming")),
                  row["method"], row["iterations"], f"{row['seconds']:.1f} s", flush=True)
    write(rows)


def write(rows):
    with open(os.path.join(TOP, "doc", "measurements", "rates.csv"), "w") as file:
        table = csv.DictWriter(file, rows[0].keys())
        table.writeheader()
        table.writerows(rows)
    with open(os.path.join(TOP, "doc", "measurements", "rates.md"), "w") as file:
        file.write("# Errors and rates\n\nRegenerate: `tests/benchmarks/rates.py build/mortise` "
                   "(writes this page, `rates.csv` and `rates.png`).\n`n`: cells per patch edge (around, per side) of the inner or "
                   "lower body, `ratio` its number to the other body's; rates\nagainst the row above; `/ conforming`: energy error "
                   "over that of the conforming mesh with n cells.\n\n"
                   "| scene | cells | ratio | p | n | dofs | L2 | rate | energy | rate | multiplier | rate | / conforming | iterations |\n"
                   "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n")
        for r in rows:
            rate = lambda key: "" if r[key + "_rate"] is None else f"{r[key + '_rate']:.2f}"
            ratio = "" if r["energy_over_conforming"] is None else f"{r['energy_over_conforming']:.3f}"
            file.write(f"| {r['scene']} | {r['cells']} | {r['ratio']} | {r['degree']} | {r['n']} | {r['dofs']} | {r['l2']:.2e} | {rate('l2')} | "
                       f"{r['energy']:.2e} | {rate('energy')} | {r['multiplier']:.2e} | {rate('multiplier')} | {ratio} | "
                       f"{r['iterations']} ({r['method']}) |\n")
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plot
    except ImportError:
        return
    for degree in sorted({r["degree"] for r in rows if r["degree"] <= 6}):
        part = [r for r in rows if r["degree"] == degree and r["scene"] == "thick_sphere" and r["cells"] == "hex on hex" and r["ratio"] == "2:3" and r["energy_over_conforming"]]
        plot.loglog([r["dofs"] for r in part], [r["energy"] for r in part], "o-", label=f"p = {degree}")
    plot.xlabel("degrees of freedom")
    plot.ylabel("relative energy error")
    plot.title("Thick sphere, tied at mid radius, 2 : 3 cells")
    plot.legend()
    plot.grid(True, which="both", alpha=0.3)
    plot.savefig(os.path.join(TOP, "doc", "measurements", "rates.png"), dpi=110)


if __name__ == "__main__":
    main()
