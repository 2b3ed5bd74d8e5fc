#!/usr/bin/env python3
"""CalculiX on partial slip of Cattaneo and Mindlin (scene, meshes and figures: cattaneo.py). Prints a JSON line per run.

    apt-get install calculix-ccx; pip install numpy scipy
    calculix_cattaneo.py --scene line|point --n 48 [--elements C3D8|C3D20|C3D20R] [--method s2s|n2s|mortar|linmortar|pgmortar]
                         [--normal 2] [--tangential 4] [--stiffness 1e6] [--stick 1e6] [--residual 1e-5] [--longest SECONDS] [--keep]

s2s and n2s: penalty, face to face and node to face; mortar and its kin: dual multipliers, softened by the same stiffness of contact (--stiffness) and of stick (--stick),
both per area. (PRESSURE-OVERCLOSURE=HARD falls back to a stiffness of 1e4.) mortar refuses constraints on nodes of the slave, which are held in y by springs
of 1e7. Each load phase is one *STEP with a first increment of 1 / normal (1 / tangential), which CalculiX may cut but not enlarge. One thread (OMP_NUM_THREADS=1), SPOOLES.

Figures come from the forces at the nodes, of the printed displacements; `printed` has those of the contact stresses that CalculiX prints for nodes (with mortar it prints zeros
for half of the nodes, so they are left out). seconds: wall time of the process ccx, its reading and writing included; cpu: the processor's. iterations: of each increment that
converged, by *STEP; iterations_in_all: with those of increments given up; cut: how often the increment was made smaller."""
import argparse
import json
import os
import re
import shutil
import subprocess
import tempfile
import threading
import time

import numpy as np

import cattaneo

SPRING = 1e7
INTEGRATION = {"C3D8": 2, "C3D20": 3, "C3D20R": 2}

parser = argparse.ArgumentParser()
parser.add_argument("--scene", choices=("line", "point"), default="line")
parser.add_argument("--n", type=int, default=24)
parser.add_argument("--elements", choices=("C3D8", "C3D20", "C3D20R"), default="C3D8")
parser.add_argument("--method", default="s2s")
parser.add_argument("--normal", type=int, default=2)
parser.add_argument("--tangential", type=int, default=4)
parser.add_argument("--stiffness", type=float, default=1e6)
parser.add_argument("--stick", type=float, default=1e6)
parser.add_argument("--residual", type=float, default=None, help="allowed residual over the mean force; CalculiX's own is 0.005")
parser.add_argument("--longest", type=float, default=500)
parser.add_argument("--keep", action="store_true")
o = parser.parse_args()

order = 2 if o.elements.startswith("C3D20") else 1
points, cells, n_lower, cells_lower, below, above = cattaneo.scene_mesh(o.scene, o.n, order)
mortar = "mortar" in o.method
slave_nodes = np.where((abs(points[:, 2]) < 1e-9) & (np.arange(len(points)) < n_lower))[0]
on_y = abs(points[:, 1]) < 1e-9
if o.scene == "line":
    on_y = np.ones(len(points), bool) if order == 1 else on_y | (abs(points[:, 1] - cattaneo.THICKNESS) < 1e-9)
slave = np.isin(np.arange(len(points)), slave_nodes)
bottom = abs(points[:, 2] + cattaneo.EXTENT) < 1e-9
top = abs(points[:, 2] - cattaneo.EXTENT) < 1e-9
d, s = cattaneo.SHIFT[o.scene]

folder = tempfile.mkdtemp()
with open(folder + "/job.inp", "w", encoding="utf-8") as f:

    def node_set(name, nodes):
        f.write("*NSET,NSET=%s\n" % name)
        f.writelines("%d,\n" % (k + 1) for k in nodes)

    f.write("*NODE,NSET=NALL\n")
    f.writelines("%d,%.15g,%.15g,%.15g\n" % (k + 1, *p) for k, p in enumerate(points))
    f.write("*ELEMENT,TYPE=%s,ELSET=EALL\n" % o.elements)
    for e, c in enumerate(cells):
        row = [str(e + 1)] + [str(k + 1) for k in c]
        f.write(",".join(row) + "\n" if len(row) <= 16 else ",".join(row[:16]) + ",\n" + ",".join(row[16:]) + "\n")
    node_set("BOTTOM", np.where(bottom)[0])
    node_set("TOP", np.where(top)[0])
    node_set("SIDES", np.where(on_y & ~bottom & ~top & ~(slave & mortar))[0])
    node_set("NEAR", np.unique(cells[below]))
    f.write("*SURFACE,NAME=SLOW\n")
    f.writelines("%d,S2\n" % (e + 1) for e in below)
    f.write("*SURFACE,NAME=SUP\n")
    f.writelines("%d,S1\n" % (e + 1) for e in above)
    f.write("*MATERIAL,NAME=M\n*ELASTIC\n%g,%g\n*SOLID SECTION,ELSET=EALL,MATERIAL=M\n" % (cattaneo.YOUNG, cattaneo.POISSON))
    if mortar:
        held = np.where(on_y & slave)[0]
        f.write("*NODE,NSET=NAUX\n")
        for k, i in enumerate(held):
            x = points[i] - (0, 0.1, 0)
            f.write("%d,%.15g,%.15g,%.15g\n" % (len(points) + k + 1, *x))
        f.write("*ELEMENT,TYPE=SPRINGA,ELSET=ESP\n")
        f.writelines("%d,%d,%d\n" % (len(cells) + k + 1, i + 1, len(points) + k + 1) for k, i in enumerate(held))
        f.write("*SPRING,ELSET=ESP\n\n%.1f\n*BOUNDARY\nNAUX,1,3\n" % SPRING)
    f.write("*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n%g\n" % o.stiffness)
    f.write("*FRICTION\n%g,%g\n" % (cattaneo.FRICTION, o.stick))
    kind = dict(s2s="SURFACE TO SURFACE", n2s="NODE TO SURFACE").get(o.method, o.method.upper())
    f.write("*CONTACT PAIR,INTERACTION=SI,TYPE=%s\nSLOW,SUP\n" % kind)
    f.write("*BOUNDARY\nBOTTOM,1,3\nSIDES,2,2\nTOP,1,2\n")
    for first, x, z in ((o.normal, 0., -d), (o.tangential, s, -d)):
        f.write("*STEP,INC=1000\n*STATIC,SOLVER=SPOOLES\n%.12g,1.,1e-6,%.12g\n*BOUNDARY\nTOP,1,1,%.12g\nTOP,3,3,%.12g\n" % (1 / first, 1 / first, x, z))
        if o.residual:
            f.write("*CONTROLS,PARAMETERS=FIELD\n%g,%g\n" % (o.residual, 2 * o.residual))
        f.write("*NODE PRINT,NSET=NEAR,FREQUENCY=1000\nU\n*NODE PRINT,NSET=TOP,TOTALS=ONLY,FREQUENCY=1000\nRF\n*CONTACT FILE,FREQUENCY=1000\nCDIS,CSTR\n*END STEP\n")

os.environ["OMP_NUM_THREADS"] = "1"
start = time.perf_counter()
with open(folder + "/job.log", "w", encoding="utf-8") as log_file:
    process = subprocess.Popen(["ccx", "-i", "job"], cwd=folder, stdout=log_file, stderr=subprocess.STDOUT)
    killer = threading.Timer(o.longest, process.kill)
    killer.start()
    _, status, usage = os.wait4(process.pid, 0)
    killer.cancel()
seconds = time.perf_counter() - start
with open(folder + "/job.log", encoding="utf-8", errors="replace") as f:
    log = f.read()
result = dict(code="calculix 2.20", scene=o.scene, n=o.n, order=order, elements=o.elements, method=o.method, stiffness=o.stiffness,
              stick_stiffness=o.stick, residual=o.residual, steps=[o.normal, o.tangential], unknowns=3 * len(points), seconds=round(seconds, 2), cpu=round(usage.ru_utime + usage.ru_stime, 2), memory_MB=round(usage.ru_maxrss / 1024))
try:
    increments = []
    with open(folder + "/job.sta", encoding="utf-8") as f:
        for line in f:
            w = line.split()
            if w and w[0].isdigit():
                increments.append((int(w[0]), w[2], int(w[3])))
    result["iterations"] = [[i for step, _, i in increments if step == k] for k in (1, 2)]
    result["cut"] = log.count("the increment size is decreased")
    with open(folder + "/job.cvg", encoding="utf-8") as f:
        result["iterations_in_all"] = sum(line.split()[:1] != [] and line.split()[0].isdigit() for line in f)
    result["messages"] = sorted(set(re.findall(r"\*ERROR[^\n]*", log)))[:4]
    converged = status == 0 and "Job finished" in log and "*ERROR" not in log
    result["converged"] = converged
    forces, displacements = [], np.zeros_like(points)
    with open(folder + "/job.dat", encoding="utf-8") as f:
        for line in f:
            w = line.split()
            if len(w) == 3 and re.match(r"^-?\d", w[0]):
                forces.append([float(v) for v in w])
            elif len(w) == 4 and w[0].isdigit():
                displacements[int(w[0]) - 1] = [float(v) for v in w[1:]]
    if not converged:
        raise RuntimeError("last lines: " + " | ".join(l.strip() for l in log.splitlines() if l.strip())[-300:])
    blocks, block = [], None
    with open(folder + "/job.frd", encoding="utf-8") as f:
        for line in f:
            if line.startswith(" -4"):
                block = {} if line.split()[1] == "CONTACT" else None
                if block is not None:
                    blocks.append(block)
            elif line.startswith(" -1") and block is not None:
                block[int(line[3:13]) - 1] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(6)]
            elif line.startswith(" -3"):
                block = None
    last = blocks[-1]
    values = np.array([last.get(int(k), [0.] * 6) for k in slave_nodes])
    factor = 1 / cattaneo.THICKNESS if o.scene == "line" else 2
    P, Q = -forces[-1][2] * factor, abs(forces[-1][0]) * factor
    t, _ = cattaneo.tractions(points, cells[below], displacements, slave_nodes, INTEGRATION[o.elements])
    faces = cattaneo.contact_faces(cells[below], slave_nodes)
    result.update(cattaneo.evaluate(o.scene, points[slave_nodes], faces, t, P, Q))
    if not mortar:
        main = int(abs(values[:, 4:6]).sum(axis=0).argmax())
        printed = np.stack([values[:, 4 + main], values[:, 5 - main], -values[:, 3]], axis=1)
        own = cattaneo.evaluate(o.scene, points[slave_nodes], faces, printed, P, Q)
        result["printed"] = {k: own[k] for k in ("force_from_pressure", "force_from_shear", "error_pressure", "error_shear", "a_nodes", "c_over_a_nodes")}
    result["P_before_shift"] = -forces[0][2] * factor
except (OSError, RuntimeError, IndexError, ValueError) as error:
    result["failure"] = repr(error)[:400]
print(json.dumps(result))
if o.keep:
    print(folder)
else:
    shutil.rmtree(folder)
