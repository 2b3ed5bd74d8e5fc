#!/usr/bin/env python3
"""CalculiX on the press fit of fit.py. Prints a JSON line; one thread, SPOOLES.

    apt-get install calculix-ccx; pip install numpy scipy
    calculix_fit.py --elements C3D20R|C3D20|C3D8|C3D8I --n 2 [--layers 1,1] [--method "SURFACE TO SURFACE"|MORTAR|LINMORTAR|PGLINMORTAR] [--penalty 1e3] [--hard] [--slave inner|outer]

*HYPERELASTIC, NEO HOOKE is the law `isochoric`, beside whose exact answer errors are taken. The overlap is that of the meshes; one increment, which CalculiX may cut. --penalty: normal
stiffness per area, in Young's moduli."""
import os
import re
import subprocess
import tempfile
import time

import numpy as np

import fit
import spheres


def elements(f, kind, name, cells, first=0):
    f.write("*ELEMENT,TYPE=%s,ELSET=E%s\n" % (kind, name))
    for e, c in enumerate(cells, first + 1):
        row = [str(e)] + [str(k + 1) for k in c]
        f.write(",".join(row[:16]) + (",\n" + ",".join(row[16:]) if row[16:] else "") + "\n")


def material(f, name, young, poisson):
    f.write("*MATERIAL,NAME=M%s\n*HYPERELASTIC,NEO HOOKE\n%.15g,%.15g\n*SOLID SECTION,ELSET=E%s,MATERIAL=M%s\n" % (name, young / 4 / (1 + poisson), 6 * (1 - 2 * poisson) / young, name, name))


def surface(f, name, cells, side):
    f.write("*SURFACE,NAME=%s\n" % name + "".join("%d,S%d\n" % (e + 1, side) for e in cells))


def run(folder, longest):
    """What ccx took and did with job.inp of a folder, with `failure` where it failed."""
    start = time.perf_counter()
    with open(folder + "/job.log", "w", encoding="utf-8") as log:
        process = subprocess.Popen(["timeout", "%g" % longest, "ccx", "-i", "job"], cwd=folder, stdout=log, stderr=subprocess.STDOUT, env=dict(os.environ, OMP_NUM_THREADS="1"))
        _, status, usage = os.wait4(process.pid, 0)
    result = fit.child_times(usage, time.perf_counter() - start)
    with open(folder + "/job.log", encoding="utf-8", errors="replace") as f:
        log = f.read()
    rows = []
    if os.path.exists(folder + "/job.sta"):
        with open(folder + "/job.sta", encoding="utf-8") as f:
            rows = [line.split() for line in f if line.split() and line.split()[0].isdigit()]
    result.update(steps_taken=len(rows), newton=sum(int(r[3]) for r in rows))
    if status or "*ERROR" in log or "Job finished" not in log:
        result["failure"] = " | ".join(re.findall(r"\*ERROR[^\n]*", log)[:1] or [line.strip() for line in log.splitlines() if line.strip()][-2:])[-250:]
    return result


def main():
    o = fit.arguments(elements="C3D20R", method="SURFACE TO SURFACE", penalty=1e3, hard=False, slave="inner")
    quadratic = o.elements.startswith("C3D20")
    nodes, kind = (spheres.HEX20, "serendipity") if quadratic else (spheres.CORNERS // 2, "q")
    bodies = fit.shells(o.n, o.m, 2 if quadratic else 1, nodes)
    sides = fit.side_cells(o.n, o.m)
    count = len(bodies[0][0])
    points = np.concatenate([b[0] for b in bodies])
    held = abs(points) < 1e-9
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + "/job.inp", "w", encoding="utf-8") as f:
            f.write("*NODE,NSET=NALL\n")
            f.writelines("%d,%.15g,%.15g,%.15g\n" % (k + 1, *p) for k, p in enumerate(points))
            elements(f, o.elements, "ALL", np.concatenate([bodies[0][1], bodies[1][1] + count]))
            material(f, "ALL", fit.YOUNG, fit.POISSON)
            surface(f, "SINNER", sides[0], 2)
            surface(f, "SOUTER", sides[1] + len(bodies[0][1]), 1)
            f.write("*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=%s\n" % ("HARD" if o.hard else "LINEAR\n%g" % (o.penalty * fit.YOUNG)))
            f.write("*CONTACT PAIR,INTERACTION=SI,TYPE=%s\n%s,%s\n*BOUNDARY\n" % (o.method, *("SINNER", "SOUTER")[::1 if o.slave == "inner" else -1]))
            f.writelines("%d,%d,%d\n" % (k + 1, c + 1, c + 1) for k, c in np.argwhere(held))
            f.write("*STEP,INC=200,NLGEOM\n*STATIC,SOLVER=SPOOLES\n1.,1.,1e-4,1.\n*CONTROLS,PARAMETERS=FIELD\n1e-4,1e-4\n*NODE PRINT,NSET=NALL,FREQUENCY=1000\nU,RF\n*END STEP\n")
        result = dict(code="CalculiX", element=o.elements, order=2 if quadratic else 1, n=o.n, layers=o.layers, method=o.method.lower() + (" hard" if o.hard else " %g" % o.penalty) + (", slave outer" if o.slave == "outer" else ""),
                      unknowns=int((~held).sum()), **run(folder, 300))
        if "failure" not in result:
            tables = {}
            with open(folder + "/job.dat", encoding="utf-8") as f:
                for line in f:
                    w = line.split()
                    if w and w[0] in ("displacements", "forces"):
                        table = tables[w[0]] = np.zeros_like(points)
                    elif len(w) == 4 and w[0].isdigit():
                        table[int(w[0]) - 1] = [float(v) for v in w[1:]]
            u, forces, exact = tables["displacements"], tables["forces"][:count], fit.Exact("isochoric")
            result.update(error=fit.error(exact, bodies, (u[:count], u[count:]), nodes / nodes.max(), kind), error_pressure=exact.pressure_error([forces[held[:count, c], c].sum() for c in range(3)]))
        spheres.report(**result)


if __name__ == "__main__":
    main()
