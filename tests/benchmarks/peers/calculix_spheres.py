#!/usr/bin/env python3
"""CalculiX on the two scenes of spheres.py. Prints a JSON line; one thread, SPOOLES.

    apt-get install calculix-ccx; pip install numpy
    calculix_spheres.py --problem balloon|hill --elements C3D20R|C3D20|C3D8 --n 4 --m 4 [--kappa 1e4] [--hardening 0] [--residual 1e-6] [--longest SECONDS] [--keep]

balloon: *HYPERELASTIC, NEO HOOKE with the bulk modulus --kappa (D1 = 2/kappa); CalculiX has no incompressible elements, so that the error has a floor and thin elements may lock.
hill: *PLASTIC, which CalculiX takes at finite strain, so that E is 1e6 here in place of 1000 and displacements are multiplied by 1000 (--hardening times E
is the hardening modulus). One increment, which it cuts where it does not converge: C3D20R needs 5 to 11 for the balloon, and C3D20 fails there or locks. cpu: the process ccx and writing of its input; cpu_solve: the same, as its start-up is nothing."""
import argparse
import os
import shutil
import subprocess
import tempfile
import threading
import time

import numpy as np

import spheres

parser = argparse.ArgumentParser()
parser.add_argument("--problem", choices=("balloon", "hill"), default="balloon")
parser.add_argument("--elements", choices=("C3D8", "C3D20", "C3D20R"), default="C3D20R")
parser.add_argument("--n", type=int, default=2)
parser.add_argument("--m", type=int, default=2)
parser.add_argument("--kappa", type=float, default=spheres.KAPPA)
parser.add_argument("--hardening", type=float, default=0.)
parser.add_argument("--residual", type=float, default=1e-6, help="allowed residual over the mean force")
parser.add_argument("--longest", type=float, default=300)
parser.add_argument("--keep", action="store_true")
o = parser.parse_args()
STIFFER = 1000.

order = 1 if o.elements == "C3D8" else 2
nodes = spheres.CORNERS // 2 if order == 1 else spheres.HEX20
begin = time.process_time()
points, cells = spheres.mesh(o.n, o.m, order, nodes)
folder = tempfile.mkdtemp()
with open(folder + "/job.inp", "w", encoding="utf-8") as f:
    f.write("*NODE,NSET=NALL\n")
    f.writelines("%d,%.15g,%.15g,%.15g\n" % (k + 1, *p) for k, p in enumerate(points))
    f.write("*ELEMENT,TYPE=%s,ELSET=EALL\n" % o.elements)
    for e, c in enumerate(cells):
        row = [str(e + 1)] + [str(k + 1) for k in c]
        f.write(",".join(row) + "\n" if len(row) <= 16 else ",".join(row[:16]) + ",\n" + ",".join(row[16:]) + "\n")
    f.write("*MATERIAL,NAME=M\n")
    if o.problem == "balloon":
        f.write("*HYPERELASTIC,NEO HOOKE\n%.12g,%.12g\n" % (spheres.MU / 2, 2 / o.kappa))
    else:
        stiff = STIFFER * spheres.YOUNG
        f.write("*ELASTIC\n%g,%g\n*PLASTIC\n%g,0.\n%.12g,1.\n" % (stiff, spheres.POISSON, spheres.YIELD, spheres.YIELD + o.hardening * stiff))
    f.write("*SOLID SECTION,ELSET=EALL,MATERIAL=M\n")
    inner = abs(np.linalg.norm(points, axis=1) - spheres.INNER) < 1e-9
    held = abs(points) < 1e-9
    if o.problem == "balloon":
        held &= ~inner[:, None]
    f.write("*BOUNDARY\n")
    f.writelines("%d,%d,%d\n" % (k + 1, c + 1, c + 1) for k, c in np.argwhere(held))
    f.write("*STEP,INC=1000%s\n*STATIC,SOLVER=SPOOLES\n1.,1.,1e-6,1.\n" % (",NLGEOM" if o.problem == "balloon" else ""))
    f.write("*CONTROLS,PARAMETERS=FIELD\n%g,%g\n" % (o.residual, o.residual))
    if o.problem == "balloon":
        f.write("*BOUNDARY\n")
        f.writelines("%d,%d,%d,%.15g\n" % (k + 1, c + 1, c + 1, points[k, c] if abs(points[k, c]) > 1e-12 else 0) for k in np.where(inner)[0] for c in range(3))
    else:
        f.write("*DLOAD\n")
        f.writelines("%d,P1,%.15g\n" % (e + 1, spheres.PRESSURE["hill"]) for e in spheres.inner_faces(o.n, o.m))
    f.write("*NODE PRINT,NSET=NALL,FREQUENCY=1000\nU\n*END STEP\n")
begin = time.process_time() - begin
os.environ["OMP_NUM_THREADS"] = "1"
start = time.perf_counter()
with open(folder + "/job.log", "w", encoding="utf-8") as log_file:
    process = subprocess.Popen(["ccx", "-i", "job"], cwd=folder, stdout=log_file, stderr=subprocess.STDOUT)
    killer = threading.Timer(o.longest, process.kill)
    killer.start()
    _, status, usage = os.wait4(process.pid, 0)
    killer.cancel()
seconds = time.perf_counter() - start
cpu = begin + usage.ru_utime + usage.ru_stime
result = dict(code="CalculiX", problem=o.problem, element=o.elements, order=order, n=o.n, m=o.m, kappa=o.kappa, cpu=round(cpu, 3), cpu_solve=round(cpu, 3), wall=round(seconds, 3), wall_solve=round(seconds, 3),
              memory_MB=round(usage.ru_maxrss / 1024), unknowns=3 * len(points) - int(held.sum()) - 3 * int(inner.sum()) * (o.problem == "balloon"), cells=len(cells))
with open(folder + "/job.log", encoding="utf-8", errors="replace") as f:
    log = f.read()
try:
    with open(folder + "/job.sta", encoding="utf-8") as f:
        rows = [line.split() for line in f if line.split() and line.split()[0].isdigit()]
    result.update(solves=len(rows), newton=sum(int(r[3]) for r in rows))
    if status or "*ERROR" in log or "Job finished" not in log:
        raise RuntimeError(" | ".join(line.strip() for line in log.splitlines() if line.strip())[-300:])
    displacements = np.zeros_like(points)
    with open(folder + "/job.dat", encoding="utf-8") as f:
        for line in f:
            w = line.split()
            if len(w) == 4 and w[0].isdigit():
                displacements[int(w[0]) - 1] = [float(v) for v in w[1:]]
    if o.problem == "hill":
        displacements *= STIFFER
    result["error"] = spheres.error(o.problem, points[cells], displacements[cells], nodes / order, "q" if order == 1 else "serendipity")
except (OSError, RuntimeError, IndexError, ValueError) as failure:
    result["failure"] = str(failure)[-300:]
spheres.report(**result)
if o.keep:
    print(folder)
else:
    shutil.rmtree(folder)
