#!/usr/bin/env python3
"""Iterations of the iterative solvers to 1e-8: iterations.py MORTISE [TABLE ...]

Over degree and mesh, ranks, contrast of moduli, ratio of sizes, Poisson's ratio, refinement, and
tetrahedra. Writes doc/measurements/iterations.md. TABLE: words of the titles of those to measure; the others are
kept as the page has them."""
import argparse
import json
import os
import subprocess
import tempfile

from processor import on_ranks

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MESHES = {1: ("4,2:6,3", "8,4:12,6", "16,8:24,12"), 2: ("4,2:6,3", "8,4:12,6", "16,8:24,12"),
          3: ("2,1:3,2", "4,2:6,3", "8,4:12,6"), 4: ("2,1:3,2", "4,2:6,3", "8,4:12,6"),
          5: ("2,1:3,2", "4,2:6,3", "6,3:9,5"), 6: ("1,1:2,1", "2,1:3,2", "4,2:6,3"),
          7: ("1,1:2,1", "2,1:3,2", "4,2:6,3"), 8: ("1,1:2,1", "2,1:3,2", "3,2:4,3")}
SIMPLEX_MESHES = {2: ("2,1:3,2", "4,2:6,3", "8,4:12,6"), 3: ("2,1:3,2", "4,2:6,3", "6,3:9,5"), 4: ("1,1:2,1", "2,1:3,2", "4,2:6,3"),
                  5: ("1,1:2,1", "2,1:3,2", "4,2:5,3"), 6: ("1,1:2,1", "2,1:3,2", "3,2:4,3"), 7: ("1,1:1,1", "1,1:2,1", "2,1:3,2"),
                  8: ("1,1:1,1", "1,1:2,1", "2,1:3,2")}
METHODS = ("saddle point", "condensed")
PAGE = os.path.join(TOP, "doc", "measurements", "iterations.md")
kept = {}  # rows by title


def run(mortise, scene, settings, ranks=1):
    with tempfile.TemporaryDirectory() as work:
        command = [mortise, os.path.join(TOP, "prm", scene + ".prm"), "--output", work]
        for setting in ["Solver/Tolerance=1e-8", "Output/Fields=", *settings]:
            command += ["--set", setting]
        if ranks > 1:
            command = on_ranks(ranks) + command
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, cwd=TOP)
        return json.load(open(os.path.join(work, "summary.json")))["steps"][-1]["solver"]["iterations"]


def sphere(p, meshes, moduli=(10, 10), slave="inner", nu=0.3, form="displacement"):
    settings = [f"Body {body}/Formulation={form}" for body in ("inner", "outer")]
    for body, mesh, modulus in zip(("inner", "outer"), meshes.split(":"), moduli):
        settings += [f"Body {body}/Degree={p}", f"Body {body}/Mesh/Subdivisions={mesh}",
                     f"Body {body}/Material/Young modulus={modulus}", f"Body {body}/Material/Poisson ratio={nu}"]
    if slave == "outer":
        settings += ["Interface glue/Slave=outer: inside", "Interface glue/Master=inner: outside"]
    return settings


def both(mortise, settings, scene="thick_sphere", ranks=1):
    return " / ".join(str(run(mortise, scene, [*settings, f"Solver/Method={method}"], ranks)) for method in METHODS)


def table(title, columns, rows):
    if title in kept:
        yield f"\n{title}\n\n{kept[title]}"
        return
    yield f"\n{title}\n\n| " + " | ".join(map(str, columns)) + " |\n|" + "---|" * len(columns)
    for row in rows:
        yield "| " + " | ".join(str(entry) for entry in row) + " |"


def report(mortise):
    count = lambda *arguments, **options: both(mortise, sphere(*arguments, **options))
    yield ("# Iterations to a relative residual of 1e-8\n\nRegenerate: `tests/benchmarks/iterations.py build/mortise`. Each "
           "entry: iterations of `saddle point` /\n`condensed`. Scene `prm/thick_sphere.prm`, subdivisions inner : outer, "
           "unless something else is said.\nMultigrid in the degree and, at vertices, on coarser meshes.")
    yield from table("Over degree and mesh:", ("p", "", "", ""),
                     ((p, *(f"{mesh} {count(p, mesh)}" for mesh in meshes)) for p, meshes in MESHES.items()))
    yield from table("Over ranks:", ("p, mesh", "1", "2", "3", "5"),
                     ((f"{p}, {mesh}", *(both(mortise, sphere(p, mesh), ranks=n) for n in (1, 2, 3, 5)))
                      for p, mesh in ((1, "8,4:12,6"), (2, "8,4:12,6"), (4, "4,2:6,3"), (7, "1,1:2,1"))))
    contrasts = ((1e6, 1), (1e3, 1), (1, 1e3), (1, 1e6))
    yield from table("Over Young's moduli (inner : outer) and side of the slave, 4,2:6,3:",
                     ("p, slave", "1e6 : 1", "1e3 : 1", "1 : 1e3", "1 : 1e6"),
                     ((f"{p}, {slave}", *(count(p, "4,2:6,3", moduli=e, slave=slave) for e in contrasts))
                      for p in (2, 4, 6) for slave in ("inner", "outer")))
    ratios = ((1, "2,2:20,4"), (2, "1,1:10,2"), (4, "1,1:10,2"), (4, "6,2:1,1"), (2, "20,10:2,1"), (4, "10,5:2,1"))
    yield from table("Over the ratio of sizes:", ("slave", *(f"p = {p}, {mesh}" for p, mesh in ratios)),
                     ((slave, *(count(p, mesh, slave=slave) for p, mesh in ratios)) for slave in ("inner", "outer")))
    poisson = (0., 0.3, 0.4, 0.45, 0.49)
    mixed = lambda p, mesh, nu: run(mortise, "thick_sphere", [*sphere(p, mesh, nu=nu, form="mixed"), "Solver/Method=saddle point"], 1)
    yield from table("Over Poisson's ratio, in displacement form and, as `auto` has it from 0.49 on, in mixed form (more in\n"
                     "[incompressible.md](incompressible.md)):",
                     ("p, mesh", *poisson, *(f"{nu}, mixed" for nu in (0.3, 0.49, 0.5))),
                     ((f"{p}, {mesh}", *(count(p, mesh, nu=nu) for nu in poisson), *(mixed(p, mesh, nu) for nu in (0.3, 0.49, 0.5)))
                      for p, mesh in ((2, "8,4:12,6"), (4, "4,2:6,3"), (6, "2,1:3,2"))))
    near = {"none": ("", ""), "slave": ("0, 0, 1.5, 0.6, 1", ""), "master": ("", "1.5, 0, 0, 0.5, 1"),
            "both": ("0, 0, 1.5, 0.6, 1", "1.5, 0, 0, 0.5, 1"), "both, twice": ("0, 0, 1.5, 0.3, 2",) * 2}
    local = lambda balls: [f"Body {body}/Mesh/Refine near={ball}" for body, ball in zip(("inner", "outer"), balls)]
    yield from table("Over the sides of the interface that have hanging nodes, 2,2:3,2:", ("p", *near),
                     ((p, *(both(mortise, sphere(p, "2,2:3,2") + local(balls)) for balls in near.values()))
                      for p in (2, 3, 4, 5, 6)))
    refined = lambda n: [f"Body {body}/Mesh/Refinements={n}" for body in ("inner", "outer")]
    yield from table("Over `Refinements` of 2,1:3,1 (above, meshes are not refined, and lattices of the generator are coarsened), the last\n"
                     "with hanging nodes on both sides:", ("p", "1", "2", "3", "4", "2, hanging"),
                     ((p, *(both(mortise, sphere(p, "2,1:3,1") + refined(n)) if n <= most else "" for n in (1, 2, 3, 4)),
                       both(mortise, sphere(p, "2,1:3,1") + refined(2) + local(near["both, twice"])))
                      for p, most in ((1, 4), (2, 4), (3, 3), (4, 2), (6, 1))))
    regions = lambda degrees: [f"Body {body}/Degree by region={degrees}" for body in ("inner", "outer")]
    yield from table("Degrees mixed within both bodies (a third of the octant each), over ranks, 4,2:6,3; the last with hanging nodes on\n"
                     "both sides:", ("degrees", "1", "2", "3"),
                     ((name, *(both(mortise, sphere(2, mesh) + regions(degrees) + local(near[balls]), ranks=n) for n in (1, 2, 3)))
                      for name, degrees, mesh, balls in (("2, 4, 3", "0: 2; 1: 4; 2: 3", "4,2:6,3", "none"),
                                                         ("6, 4, 3", "0: 6; 1: 4; 2: 3", "4,2:6,3", "none"),
                                                         ("8, 2, 1", "0: 8; 1: 2; 2: 1", "4,2:6,3", "none"),
                                                         ("2, 4, 3, hanging nodes", "0: 2; 1: 4; 2: 3", "2,2:3,2", "both"))))
    tetrahedra = [f"Body {body}/Mesh/Cells=tetrahedra" for body in ("inner", "outer")]
    scenes = [("prm/flange.prm", "flange", []), ("prm/thick_sphere_gmsh.prm", "thick_sphere_gmsh", [])]
    for p, mesh, moduli in ((2, "4,2:6,3", (10, 10)), (2, "4,2:6,3", (1e6, 1)), (2, "4,2:6,3", (1, 1e6)), (3, "4,2:3,2", (10, 10)),
                            (4, "2,1:3,2", (10, 10))):
        scenes.append((f"tetrahedra, p = {p}, {mesh}, moduli {moduli[0]:g} : {moduli[1]:g}", "thick_sphere",
                       sphere(p, mesh, moduli) + tetrahedra))
    yield from table("Tetrahedra:", ("p", "", "", ""),
                     ((p, *(f"{mesh} {both(mortise, sphere(p, mesh) + tetrahedra)}" for mesh in meshes))
                      for p, meshes in SIMPLEX_MESHES.items()))
    yield from table("Scenes with tetrahedra, over ranks:", ("scene", "1", "2", "3"),
                     ((name, *(both(mortise, settings, scene, n) for n in (1, 2, 3))) for name, scene, settings in scenes))


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("mortise", help="the program")
    parser.add_argument("tables", nargs="*", metavar="table", help="words of the titles of those to measure, all unless said")
    arguments = parser.parse_args()
    if arguments.tables:
        blocks = open(PAGE).read().strip().split("\n\n")[2:]  # behind the head
        kept.update((title, rows) for title, rows in zip(blocks[::2], blocks[1::2])
                    if not any(word in title for word in arguments.tables))
    lines = []
    for line in report(os.path.abspath(arguments.mortise)):
        print(line, flush=True)
        lines.append(line)
    with open(PAGE, "w") as page:
        print(*lines, sep="\n", file=page)


if __name__ == "__main__":
    main()
