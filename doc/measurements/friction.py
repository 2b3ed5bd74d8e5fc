#!/usr/bin/env python3
"""Picture of partial slip after Cattaneo and Mindlin: friction.py DIRECTORY [PICTURE.png], or friction.py --table

DIRECTORY holds a run of tests/benchmarks/peers/mortise_cattaneo.py with --n 96 --degree 1 --tangential 3 --back 4. Left and middle: shear traction on y = 0 and nodes that stick, beside the
formulas with the P and Q of the run, when the shear grows and when it is reversed. Right: seconds against the error of the shear traction of Mortise, Kratos and CalculiX on the line contact of tests/benchmarks/peers/cattaneo.py, from
friction_peers.jsonl. --table prints the table of these runs. Needs matplotlib and pyvista (PyPI)."""
import json
import math
import os
import sys

import matplotlib
import numpy as np
import pyvista

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
FRICTION, RADIUS, THICKNESS, E_STAR = 0.3, 100., 0.02, 200 / 2 / (1 - 0.3**2)  # of cattaneo.py
GROWING, REVERSED = (3, 4, 5), (6, 7, 9)  # steps
COLOURS = ("tab:blue", "tab:orange", "tab:green")


def root(x, a, c):
    return c / a * np.sqrt(np.maximum(0, 1 - (x / c)**2))


def formula(x, a, load, largest=None):
    """Shear traction over mu p0 and half-width of the stick zone; with `largest` after the load, Q / (mu P), fell from there."""
    if largest is None:
        c = a * math.sqrt(1 - load)
        return root(x, a, a) - root(x, a, c), c
    c, b = a * math.sqrt(1 - largest), a * math.sqrt(1 - (largest - load) / 2)
    return -root(x, a, a) + 2 * root(x, a, b) - root(x, a, c), b


def on_line(directory, step):
    mesh = pyvista.read(os.path.join(directory, "touch_%04d.vtu" % step))
    at = np.where((abs(mesh.points[:, 1]) < 1e-9) & (abs(mesh.points[:, 0]) < 0.14))[0]
    x, order = mesh.points[at, 0], np.argsort(mesh.points[at, 0], kind="stable")
    return x[order], mesh["traction"][at, 0][order], mesh["status"][at][order]


def zones(axes, directory, steps, largest_at, title):
    with open(os.path.join(directory, "summary.json"), encoding="utf-8") as f:
        forces = [[abs(s["quantities"]["top"][2]) / THICKNESS, s["quantities"]["top"][0] / THICKNESS] for s in json.load(f)["steps"]]
    loads = [q / FRICTION / p for p, q in forces]
    for k, step in enumerate(steps):
        P = forces[step - 1][0]
        a = math.sqrt(4 * P * RADIUS / math.pi / E_STAR)
        peak = 2 * P / math.pi / a
        x = np.linspace(-1.3 * a, 1.3 * a, 1001)
        at, shear, status = on_line(directory, step)
        exact, c = formula(x, a, loads[step - 1], largest_at and loads[largest_at - 1])
        axes.plot(x / a, exact, "-", color=COLOURS[k], lw=1)
        axes.plot(at / a, shear / (FRICTION * peak), ".", color=COLOURS[k], ms=4, label=r"$Q = %.2f\,\mu P$" % loads[step - 1])
        level = -1.12 - 0.1 * k
        stick, slip = at[status > 1.5], at[(status > 0.5) & (status <= 1.5)]
        axes.plot([-c / a, c / a], [level, level], "-", color=COLOURS[k], lw=7, alpha=0.25, solid_capstyle="butt")
        axes.plot(stick / a, np.full(len(stick), level), "o", color=COLOURS[k], ms=1.8)
        axes.plot(slip / a, np.full(len(slip), level), "x", color=COLOURS[k], ms=3.5, mew=0.8)
    axes.plot(x / a, root(x, a, a), "k--", lw=0.7)
    axes.plot(x / a, -root(x, a, a), "k--", lw=0.7, label=r"$\pm\mu p$")
    axes.text(-1.25, -1.58, "dots: nodes that stick, crosses: nodes that slip, bars: c", fontsize=8)
    axes.set(title=title, xlabel="x / a", ylabel=r"shear traction / ($\mu p_0$)", xlim=(-1.3, 1.3), ylim=(-1.65, 1.75))
    axes.legend(loc="upper center", ncol=2, fontsize=8, frameon=False)


def runs_on(scene):
    """Of each program, degree and mesh the quickest run that converged, as (name, runs)."""
    with open(os.path.join(HERE, "friction_peers.jsonl"), encoding="utf-8") as f:
        runs = [json.loads(line) for line in f]
    kinds = [("Mortise, p = %d" % p, lambda r, p=p: r["code"].startswith("mortise") and r["order"] == p) for p in (1, 2, 3)]
    kinds += [("Kratos, p = 1", lambda r: r["code"].startswith("kratos") and r["method"].startswith("ALM")), ("CalculiX, p = 1, mortar", lambda r: r["code"].startswith("calculix") and r["method"] == "mortar")]
    for name, belongs in kinds:
        best = {}
        for r in runs:
            if r["scene"] == scene and r["converged"] and belongs(r) and r["cpu"] < best.get(r["n"], {"cpu": math.inf})["cpu"]:
                best[r["n"]] = r
        yield name, [best[n] for n in sorted(best)]


def table():
    print("| Scene, program | cells | unknowns | CPU [s] | error of shear | of pressure | c/a by moments (formula) | linear solves by step |\n|---|---|---|---|---|---|---|---|")
    for scene, name, r in [(scene, name, r) for scene in ("line", "point") for name, runs in runs_on(scene) for r in runs]:
        print("| %s, %s | %d | %d | %.1f | %.4f | %.4f | %.4f (%.4f) | %s |" % (scene, name, r["n"], r["unknowns"], r["cpu"], r["error_shear"], r["error_pressure"], r["c_over_a_moment"], r["c_over_a"],
                                                                                          "; ".join(", ".join(map(str, part)) for part in r["iterations"])))


def time_against_error(axes):
    for (name, runs), style in zip(runs_on("line"), ("o-", "s-", "^-", "v--", "x--")):
        axes.loglog([r["cpu"] for r in runs], [r["error_shear"] for r in runs], style, ms=5, lw=1, label=name)
    axes.set(title="time against error", xlabel="seconds of one core", ylabel="error of the shear traction in L2")
    axes.set_ylim(top=0.6)
    axes.grid(True, which="both", lw=0.3)
    axes.legend(loc="upper right", fontsize=8, frameon=False)


def main(directory, picture):
    figure, axes = plt.subplots(1, 3, figsize=(14, 4.6))
    zones(axes[0], directory, GROWING, None, "shear grows")
    zones(axes[1], directory, REVERSED, GROWING[-1], "and is reversed")
    time_against_error(axes[2])
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if sys.argv[1] == "--table":
    table()
else:
    main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else os.path.join(HERE, "friction.png"))
