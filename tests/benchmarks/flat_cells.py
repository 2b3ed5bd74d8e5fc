#!/usr/bin/env python3
"""Iterations and times on flat cells: flat_cells.py MORTISE

Two layers of height h on a unit square, prm/patch.prm, whose meshes match or do not, in hexahedra and in
tetrahedra; films on a block. Writes doc/measurements/flat_cells.md."""
import json
import os
import statistics
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HEIGHTS = (1, 0.1, 0.01, 0.001)
DEGREES = (1, 2, 3, 4, 6)
CELLS = ("hexahedra", "tetrahedra")
MESHES = {"8 x 8 on 8 x 8": ("8, 8, 3", "8, 8, 3"), "6 x 6 on 8 x 8": ("6, 6, 3", "8, 8, 3"),
          "8 x 8 on 6 x 6": ("8, 8, 3", "6, 6, 3")}
FLATNESS = (3, 6, 12, 24, 30, 100, 300)
DISPLACEMENT = "0.1*x + 0.03*y - 0.01*z; 0.01*x + 0.05*y + 0.04*z; 0.02*x + 0.06*y - 0.15*z"
INCOMPRESSIBLE = ("Body lower/Material/Poisson ratio=0.5", "Body upper/Material/Poisson ratio=0.5",
                  "Exact solution/Pressure=1")


def solve(mortise, cells, degree, heights, meshes, *more):
    """Iterations, as text; seconds to set up and to solve."""
    lower, upper = heights
    settings = {"Body lower/Mesh/Extent": f"0, 0, 0, 1, 1, {lower}", "Solver/Tolerance": "1e-8",
                "Exact solution/Displacement": DISPLACEMENT,
                "Body upper/Mesh/Extent": f"0, 0, {lower}, 1, 1, {lower + upper}", "Output/Fields": ""}
    for body, mesh in zip(("lower", "upper"), meshes):
        settings.update({f"Body {body}/Mesh/Cells": cells, f"Body {body}/Degree": degree,
                         f"Body {body}/Mesh/Subdivisions": mesh})
    with tempfile.TemporaryDirectory() as work:
        command = [mortise, "--output", work, os.path.join(TOP, "prm", "patch.prm")]
        for setting in [f"{name}={value}" for name, value in settings.items()] + list(more):
            command += ["--set", setting]
        code = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
        summary = json.load(open(os.path.join(work, "summary.json")))
        n = summary["steps"][-1]["solver"]["iterations"]
        times = summary["timings_s"]
        return str(n) if code == 0 else f"> {n}", times["bulk"] + times["solver_setup"], times["solve"], summary["steps"][-1]["dofs"]["total"]


def layers(mortise):
    for cells in CELLS:
        for name, meshes in MESHES.items():
            for degree in DEGREES:
                found = [solve(mortise, cells, degree, (h, h), meshes)[0] for h in HEIGHTS]
                yield f"| {cells} | {name} | {degree} | " + " | ".join(found) + " |"


def incompressible(mortise):
    for cells in CELLS:
        for degree in (2, 3, 4):
            found = [solve(mortise, cells, degree, (h, h), MESHES["6 x 6 on 8 x 8"], *INCOMPRESSIBLE)[0]
                     for h in HEIGHTS]
            yield f"| {cells} | {degree} | " + " | ".join(found) + " |"


def films(mortise):
    swap = ("Interface glue/Slave=upper: zmin", "Interface glue/Master=lower: zmax")
    for cells in CELLS:
        for degree in DEGREES:
            found = [solve(mortise, cells, degree, (1, 1e-3), ("6, 6, 6", "8, 8, 3"), *more)[0] for more in ((), swap)]
            yield f"| {cells} | {degree} | " + " | ".join(found) + " |"


def times(mortise):
    for degree, meshes in ((2, ("12, 12, 3", "16, 16, 3")), (4, ("6, 6, 3", "8, 8, 3"))):
        for flatness in FLATNESS:
            h = 3 / (flatness * int(meshes[1].split(",")[0]))
            runs = [solve(mortise, "hexahedra", degree, (h, h), meshes) for _ in range(3)]
            setup, solution = (statistics.median(run[i] for run in runs) for i in (1, 2))
            yield f"| {degree} | {runs[0][3]} | {flatness} | {runs[0][0]} | {setup:.2f} | {solution:.2f} |"


def largest(rows):
    """Number of iterations in times()."""
    return max(int(row.split("|")[4]) for row in rows)


def main():
    mortise = os.path.abspath(sys.argv[1])
    tables = []
    for rows in (layers, incompressible, films, times):
        tables.append([])
        for row in rows(mortise):
            tables[-1].append(row)
            print(row, flush=True)
    text = f"""# Flat cells

Regenerate: `tests/benchmarks/flat_cells.py build/mortise` (writes this page).

Iterations of conjugate gradients to 1e-8 on `prm/patch.prm` with a displacement that is linear, two layers of height h, three cells each, slave on
master, on a unit square.

| cells | meshes | p | {" | ".join(f"h = {h}" for h in HEIGHTS)} |
|---|---|---|{"---|" * len(HEIGHTS)}
""" + "\n".join(tables[0]) + f"""

Goal: at most 15 down to 0.001. It is missed by tetrahedra of degree 6, by films on tetrahedra from degree 3 on (below) and by cells between 5 and 25
times as wide as high, for which the last table shows why: up to {largest(tables[3])}.

Of GMRES with Poisson's ratio 0.5, mixed form, 6 x 6 on 8 x 8:

| cells | p | {" | ".join(f"h = {h}" for h in HEIGHTS)} |
|---|---|{"---|" * len(HEIGHTS)}
""" + "\n".join(tables[1]) + """

A film of height 0.001, 8 x 8 x 3 cells, on a unit cube of 6 x 6 x 6, either side the slave:

| cells | p | slave below | slave above |
|---|---|---|---|
""" + "\n".join(tables[2]) + """

## What costs iterations, and what helps

A smoother that acts on points, on lines or on blocks of cells sees how a thin body bends with a condition of (width of a cell / thickness)^2
from degree 3 on (Korn), and lower degrees on the same cells bend too stiffly. So the next level must have all that is linear across the
*body*, at the full degree along its plane: `ThicknessCoarsening`. The nodes of a body whose cells are much shorter along one direction lie on lines across
it; the ends of each line stay (and nodes between where a line has more than 12 steps), the others are linear between them. That
matrix, P^T K P, is made of products of the kernels with its functions and is factorised; everything is in double precision, since a body of width 1 and
height 0.001 bends 1e12 times as easily as it stretches. On tetrahedra nodes within those faces that have the short edge, and inside, lie on no such line: they follow from the
others as what a polynomial of the triangle that is left without the short edge, or times what is linear along that edge, has there (`NodesAcross`).
The next level of bodies that are not flat is degree one, but for the cells beside flat ones, all of whose nodes stay: with nothing but the nodes that flat
ones pull along films took 19, 32, 42 and 76 iterations at degrees 2, 3, 4, 6, since what is pulled could not go on into the body; with
values that fall linearly through these cells 10 to 24.

That level sees the constraint by what multipliers see, f sum_i k_i b_i(u)^2 / |b_i|^2 with the rows b_i of B and the largest stiffness k_i of their
nodes, since these may be what follows (`ConstraintPenalty`), not by int [[u]]^2: two meshes of a thin body that bends differ by its curvature times the square of their cells; multipliers do not see that, but
the integral charges the fourth power of the cells' size for it where bending costs the third power of the height. f = 300;
iterations are the same from 100 to 1000.

It pays from where the cells of a body are 25 times as wide as high (other bodies are treated like it from 6 on then): below that factorising takes longer than the iterations that it saves. 12 x 12 x 3 on 16 x 16 x 3 cells at degree 2, 6 x 6 x 3 on
8 x 8 x 3 at degree 4; flatness is that of the upper body, the lower one's is 4/3 of it; seconds on one core to set up (bulk included) and to solve:

| p | unknowns | width / height of a cell | iterations | set up | solve |
|---|---|---|---|---|---|
""" + "\n".join(tables[3]) + """

Goal: at most twice the seconds of cubes (the first row of each degree is near that). It is missed: a factorisation costs 3 to 5 solves. It stands for all load steps.
"""
    open(os.path.join(TOP, "doc", "measurements", "flat_cells.md"), "w").write(text)


if __name__ == "__main__":
    main()
