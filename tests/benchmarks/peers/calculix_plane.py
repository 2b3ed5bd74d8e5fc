#!/usr/bin/env python3
"""CalculiX on the perforated plate and the necking bar of tests/field (perforated_plate_yields.prm, bar_necks.prm), in its elements for plane strain and axisymmetry. One thread, SPOOLES.

    apt-get install calculix-ccx; pip install numpy
    calculix_plane.py [--problem plate|bar] [--cells 8] [--longest 0.05]

plate: CPE8R, two blocks of cells x cells. *PLASTIC is meant for finite strain, so that E and the hardening modulus are 1000 times as large and displacements 1000 times as small. bar: CAX8R, half as many
cells along the radius, 1.25 times as many along the half bar. --longest: of an increment, over a fourth (plate) or a seventh (bar) of the loads. Prints displacements of points and the force after each of these parts."""
import argparse
import math
import os
import subprocess
import tempfile

import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("--problem", choices=("plate", "bar"), default="plate")
parser.add_argument("--cells", type=int, default=8)
parser.add_argument("--longest", type=float, default=0.05)
o = parser.parse_args()
STIFFER = 1000.


def block(na, nb, place):
    """Nodes of na x nb cells of eight nodes: place(s, t) for s, t in [0, 1]; the cells."""
    ids, points = {}, []
    for j in range(2 * nb + 1):
        for i in range(2 * na + 1):
            if i % 2 == 0 or j % 2 == 0:
                ids[i, j] = len(points)
                points.append(place(i / (2 * na), j / (2 * nb)))
    around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    return points, [[ids[2 * i + a, 2 * j + b] for a, b in around] for j in range(nb) for i in range(na)]


def from_the_hole(corner):
    def place(s, t):
        angle = (corner + t) * math.pi / 4
        outer = (10, 18 * t) if corner == 0 else (10 * (1 - t), 18)
        g = s * (0.6 + 0.4 * s)
        return tuple((1 - g) * c + g * q for c, q in zip((5 * math.cos(angle), 5 * math.sin(angle)), outer))
    return place


def in_the_bar(s, t):
    z = 26.667 * (0.35 * t + 0.65 * t**3)
    return s * 6.413 * (0.982 + 0.018 * z / 26.667), z


if o.problem == "plate":
    element, thickness, geometry, scale, whole = "CPE8R", "1.", "", STIFFER, 1.
    blocks = [block(o.cells, o.cells, from_the_hole(k)) for k in (0, 1)]
    elastic, hardening = (70 * STIFFER, 0.2), [(0.243, 0), (0.243 + 2.25 * STIFFER, 1)]
    ends, seen = [0.05, 0.1, 0.15, 0.2], [(5, 0), (0, 5), (10, 0)]
else:
    element, thickness, geometry, scale, whole = "CAX8R", "", ",NLGEOM", 1., 180.
    blocks = [block(o.cells // 2, 5 * o.cells // 4, in_the_bar)]
    strains = np.concatenate([np.linspace(0, 0.3, 301), np.linspace(0.3, 4, 371)[1:]])
    elastic, hardening = (206.9, 0.29), [(0.45 + 0.265 * (1 - math.exp(-16.93 * a)) + 0.12924 * a, a) for a in strains]
    ends, seen = [1, 2, 3, 4, 5, 6, 7], [(6.413 * 0.982, 0)]
number, nodes, cells = {}, [], []
for points, corners in blocks:
    here = []
    for p in points:
        key = (round(p[0], 8), round(p[1], 8))
        if key not in number:
            number[key] = len(nodes)
            nodes.append(p)
        here.append(number[key])
    cells += [[here[k] for k in c] for c in corners]
nodes = np.array(nodes)
seen = [int(np.argmin(np.abs(nodes - p).sum(1))) for p in seen]
sets = {"BOTTOM": np.flatnonzero(nodes[:, 1] < 1e-7), "AXIS": np.flatnonzero(nodes[:, 0] < 1e-7), "TOP": np.flatnonzero(nodes[:, 1] > nodes[:, 1].max() - 1e-7), "SEEN": seen}
folder = tempfile.mkdtemp()
with open(folder + "/job.inp", "w", encoding="utf-8") as f:
    f.write("*NODE,NSET=NALL\n")
    f.writelines("%d,%.15g,%.15g,0\n" % (k + 1, *p) for k, p in enumerate(nodes))
    f.write("*ELEMENT,TYPE=%s,ELSET=EALL\n" % element)
    f.writelines("%d,%s\n" % (e + 1, ",".join(str(k + 1) for k in c)) for e, c in enumerate(cells))
    f.write("*MATERIAL,NAME=M\n*ELASTIC\n%g,%g\n*PLASTIC\n" % elastic)
    f.writelines("%.12g,%.12g\n" % row for row in hardening)
    f.write("*SOLID SECTION,ELSET=EALL,MATERIAL=M\n%s\n" % thickness if thickness else "*SOLID SECTION,ELSET=EALL,MATERIAL=M\n")
    for name, members in sets.items():
        f.write("*NSET,NSET=%s\n" % name + "".join("%d\n" % (k + 1) for k in members))
    f.write("*BOUNDARY\nBOTTOM,2,2\nAXIS,1,1\n")
    for u in ends:
        f.write("*STEP,INC=10000%s\n*STATIC,SOLVER=SPOOLES\n%g,1.,1e-6,%g\n*CONTROLS,PARAMETERS=FIELD\n1e-6,1e-6\n" % (geometry, o.longest, o.longest))
        f.write("*BOUNDARY\nTOP,2,2,%.15g\n*NODE PRINT,NSET=SEEN,FREQUENCY=100000\nU\n*NODE PRINT,NSET=TOP,TOTALS=ONLY,FREQUENCY=100000\nRF\n*END STEP\n" % (u / scale))
with open(folder + "/job.log", "w", encoding="utf-8") as log:
    subprocess.run(["ccx", "-i", "job"], cwd=folder, stdout=log, stderr=log, env=dict(os.environ, OMP_NUM_THREADS="1"), check=True)
ends = iter(ends)
with open(folder + "/job.dat", encoding="utf-8") as f:
    for line in f:
        row = line.split()
        if line.startswith(" displacements"):
            print("at %g:" % next(ends))
        elif len(row) == 4 and row[0].isdigit():
            print("  (%g, %g) moves by (%.6f, %.6f)" % (*nodes[int(row[0]) - 1], float(row[1]) * scale, float(row[2]) * scale))
        elif len(row) == 3 and "force" not in line:
            print("  force %.6f" % (float(row[1]) * whole))
