#!/usr/bin/env python3
"""The two examples of Ullah, Kaczmarczyk and Pearce, tied and conforming: curved_pairs.py [--quick] MORTISE

Each pair of bodies that meet in a curved surface is computed with meshes that do not match, n against
3n/2 cells across, and as one body with one conforming mesh, in tetrahedra and in hexahedra. Compared is
u_z along a vertical line and along a line on the interface, seen from both bodies. Writes
doc/measurements/curved_pairs.csv, doc/measurements/curved_pairs.md and, with matplotlib and pyvista, doc/measurements/curved_pairs.png."""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

LENGTH = {"curved_pair_1": 1., "curved_pair_2": 2.}
TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SURFACE = {"curved_pair_1": lambda s, t: 0.2 * math.cos(math.pi * s / 2) * math.cos(math.pi * t / 2),
           "curved_pair_2": lambda s, t: 0.15 * (s * s - t * t + s / 2) / 1.5}


def height(scene, x, y):
    return 0.5 + SURFACE[scene](2 * x / LENGTH[scene] - 1, 2 * y - 1)


def lines(scene):
    """Points (body of the tied scene, x, y, z) of the lines. Curved cells follow the surface up to
    their degree, so points beside it are 0.03 away."""
    x, y = 0.3 * LENGTH[scene], 0.6
    middle = height(scene, x, y)
    vertical = [("lower", x, y, k / 10 * (middle - 0.03)) for k in range(11)]
    vertical += [("upper", x, y, 1 - (9 - k) / 9 * (0.97 - middle)) for k in range(10)]
    beside = [[(body, k / 20 * LENGTH[scene], 0.4, height(scene, k / 20 * LENGTH[scene], 0.4) + away) for k in range(21)]
              for body, away in (("lower", -0.03), ("upper", 0.03))]
    return [vertical] + beside


def settings(scene, cells, p, n, conforming):
    points = []
    for l, line in enumerate(lines(scene)):
        for i, (body, x, y, z) in enumerate(line):
            points.append(f"{l} {i}: {'block' if conforming else body}: {x!r}, {y}, {z!r}")
    result = ["Output/Points=" + "; ".join(points), "Output/Resultants=", "Solver/Tolerance=1e-11"]
    sizes = {"block": f"{n}, {n}, {n // 2}, {n // 2}"} if conforming else {
        "lower": f"{n}, {n}, {n // 2}", "upper": f"{3 * n // 2}, {3 * n // 2}, {n // 2}"}
    for body, size in sizes.items():
        result += [f"Body {body}/Degree={p}", f"Body {body}/Mesh/Cells={cells}", f"Body {body}/Mesh/Subdivisions={size}"]
    return result


def run(mortise, scene, cells, p, n, conforming, work=None):
    with tempfile.TemporaryDirectory() as own:
        name = scene + ("_conforming" if conforming else "")
        command = [mortise, os.path.join(TOP, "prm", name + ".prm"), "--output", work or own]
        for setting in settings(scene, cells, p, n, conforming) + ([] if work else ["Output/Fields="]):
            command += ["--set", setting]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        step = json.load(open(os.path.join(work or own, "summary.json")))["steps"][-1]
        return step["dofs"]["total"], {name: value[2] for name, value in step["quantities"].items()}


def compare(tied, whole):
    """Largest difference of u_z along each line over the largest u_z."""
    largest = max(abs(u) for u in whole.values())
    difference = [0., 0., 0.]
    for name, u in tied.items():
        line = int(name.split()[0])
        difference[line] = max(difference[line], abs(u - whole[name]))
    return [d / largest for d in difference]


def rows(mortise, quick):
    for scene in SURFACE:
        for cells in ("tetrahedra", "hexahedra"):
            for p, ns in {2: (4, 8, 16), 3: (4, 8)}.items():
                before = coarser = None
                for n in ns[:2] if quick else ns:
                    dofs, tied = run(mortise, scene, cells, p, n, False)
                    _, whole = run(mortise, scene, cells, p, n, True)
                    values = compare(tied, whole)
                    if before:  # what the conforming solution itself changed
                        before["refined"] = max(compare(coarser, whole))
                        print("refined conforming mesh:", f"{before['refined']:.3g}")
                        yield before
                    coarser = whole
                    row = {"scene": scene, "cells": cells, "degree": p, "n": n, "dofs": dofs}
                    for key, value in zip(("line", "below", "above"), values):
                        row[key] = value
                        row[key + "_rate"] = math.log(before[key] / value) / math.log(n / before["n"]) if before else None
                    print(*(f"{v:.3g}" if isinstance(v, float) else v for v in row.values()), flush=True)
                    before = row
                yield {**before, "refined": None}


def picture(mortise):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plot
    import numpy
    import pyvista
    figure, axes = plot.subplots(2, 3, figsize=(15, 9.4))
    lines_of, meshes_of = {}, {}
    for scene in SURFACE:
        for conforming in (False, True):
            with tempfile.TemporaryDirectory() as work:
                _, lines_of[scene, conforming] = run(mortise, scene, "tetrahedra", 2, 6, conforming, work)
                names = ["block"] if conforming else ["lower", "upper"]
                meshes_of[scene, conforming] = [pyvista.read(os.path.join(work, name + ".vtu")) for name in names]
    u_z = numpy.concatenate([mesh["displacement"][:, 2] for meshes in meshes_of.values() for mesh in meshes])
    for row, scene in enumerate(SURFACE):
        for column, conforming in enumerate((False, True)):
            plotter = pyvista.Plotter(off_screen=True, window_size=(800, 700))
            plotter.set_background("white")
            for mesh in meshes_of[scene, conforming]:
                mesh["u_z"] = mesh["displacement"][:, 2]
                plotter.add_mesh(mesh.extract_surface(algorithm="dataset_surface"), scalars="u_z", cmap="viridis", n_colors=14,
                                 clim=(u_z.min(), u_z.max()), ambient=0.5, diffuse=0.5, show_edges=True, edge_opacity=0.25,
                                 scalar_bar_args={"title": "u_z", "color": "black", "position_y": 0.01})
            middle = LENGTH[scene] / 2
            plotter.camera_position = [(middle + 2.1, -1.7, 1.8), (middle, 0.5, 0.5), (0, 0, 1)]
            plotter.reset_camera()
            plotter.camera.zoom(0.9)
            axes[row, column].imshow(plotter.screenshot(None, return_img=True))
            axes[row, column].set_axis_off()
            axes[row, column].set_title(f"{scene}, " + ("conforming" if column else "non-conforming, tied"))
        at = [i / 20 for i in range(21)]
        for line, label in enumerate(("vertical line", "below the interface", "above it")):
            for conforming, style in ((True, "-"), (False, "o")):
                axes[row, 2].plot(at, [lines_of[scene, conforming][f"{line} {i}"] for i in range(21)], f"C{line}{style}", fillstyle="none",
                                  label=("conforming, " if conforming else "tied, ") + label)
        axes[row, 2].set_ylabel("u_z")
        axes[row, 2].legend(fontsize=7, loc="lower left")
        axes[row, 2].grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(os.path.join(TOP, "doc", "measurements", "curved_pairs.png"), dpi=80)


def write(table):
    with open(os.path.join(TOP, "doc", "measurements", "curved_pairs.csv"), "w") as file:
        writer = csv.DictWriter(file, table[0].keys())
        writer.writeheader()
        writer.writerows(table)
    with open(os.path.join(TOP, "doc", "measurements", "curved_pairs.md"), "w") as file:
        file.write("# The two examples of Ullah, Kaczmarczyk and Pearce\n\nRegenerate: `tests/benchmarks/curved_pairs.py build/mortise` (writes this page, "
                   "`curved_pairs.csv` and `curved_pairs.png`).\n\n![u_z of both pairs, tied and conforming](curved_pairs.png)\n\n"
                   "`prm/curved_pair_1.prm` and `curved_pair_2.prm` (our dimensions, E = 10 and nu = 0.5 as in the paper), n against 3n/2 cells across, beside one\n"
                   "conforming mesh of n cells. Largest difference of u_z between both along a vertical line (x = 0.3 of the length, y = 0.6) and\n"
                   "along the lines y = 0.4, 0.03 below and above the interface, over the largest u_z; rates against the row above.\n"
                   "`refined`: the largest difference along the same lines between the conforming solutions on this and on the\n"
                   "next mesh, which is the error of the discretisation; the differences between tied and conforming follow it.\n\n"
                   "| scene | cells | p | n | dofs | vertical line | rate | below | rate | above | rate | refined |\n"
                   "|---|---|---|---|---|---|---|---|---|---|---|---|\n")
        for r in table:
            rate = lambda key: "" if r[key + "_rate"] is None else f"{r[key + '_rate']:.2f}"
            file.write(f"| {r['scene']} | {r['cells']} | {r['degree']} | {r['n']} | {r['dofs']} | {r['line']:.1e} | {rate('line')} | "
                       f"{r['below']:.1e} | {rate('below')} | {r['above']:.1e} | {rate('above')} | "
                       + ("" if r["refined"] is None else f"{r['refined']:.1e}") + " |\n")


def main():
    mortise = os.path.abspath([a for a in sys.argv[1:] if not a.startswith("-")][0])
    write(list(rows(mortise, "--quick" in sys.argv)))
    try:
        picture(mortise)
    except ImportError as error:
        print("no picture:", error)


if __name__ == "__main__":
    main()
