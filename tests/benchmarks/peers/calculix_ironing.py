#!/usr/bin/env python3
"""CalculiX on ironing.py. Prints a JSON line; one thread, SPOOLES.

    calculix_ironing.py --elements C3D8|C3D8I|C3D20R [--scale 1] [--increment 0.05] [--stick 1]

Contact SURFACE TO SURFACE with the normal stiffness 100 and the sticking stiffness --stick per area, in Young's moduli of the block; the law is the law `isochoric` of fit.py. --increment: largest one
of the sliding, which CalculiX may cut. Forces may be off by 0.005 of the mean one in equilibrium, its default."""
import re
import tempfile

import numpy as np

import calculix_fit as ccx
import fit
import ironing
import spheres

o = fit.arguments(elements="C3D8", scale=1, increment=0.05, stick=1.)
quadratic = o.elements.startswith("C3D20")
(block, lower), (tube, upper) = ironing.bodies(o.scale, 2 if quadratic else 1, spheres.HEX20 if quadratic else spheres.CORNERS // 2)
points = np.concatenate([block, tube])
die = np.arange(len(points)) >= len(block)
inside, below = die & (abs(np.hypot(points[:, 0] - 1, points[:, 2] - 0.6) - 0.3) < 1e-9), ~die & (abs(points[:, 2] + 1) < 1e-9)
across = abs(abs(points[:, 1] - ironing.WIDTH / 2) - ironing.WIDTH / 2) < 1e-9
with tempfile.TemporaryDirectory() as folder:
    with open(folder + "/job.inp", "w", encoding="utf-8") as f:
        f.write("*NODE,NSET=NALL\n")
        f.writelines("%d,%.15g,%.15g,%.15g\n" % (k + 1, *p) for k, p in enumerate(points))
        ccx.elements(f, o.elements, "BLOCK", lower)
        ccx.elements(f, o.elements, "DIE", upper + len(block), len(lower))
        ccx.material(f, "BLOCK", ironing.SOFT, ironing.POISSON)
        ccx.material(f, "DIE", ironing.STIFF, ironing.POISSON)
        ccx.surface(f, "STOP", np.arange(6 * o.scale - 1, len(lower), 6 * o.scale), 2)
        ccx.surface(f, "SDIE", len(lower) + np.arange(0, len(upper), 2 * o.scale), 1)
        for name, on in (("NIN", inside), ("NLOW", below), ("NY", across)):
            f.write("*NSET,NSET=%s\n" % name + "".join("%d,\n" % (k + 1) for k in np.where(on)[0]))
        f.write("*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n100\n*FRICTION\n%g,%g\n" % (ironing.MU, o.stick))
        f.write("*CONTACT PAIR,INTERACTION=SI,TYPE=SURFACE TO SURFACE\nSDIE,STOP\n*BOUNDARY\nNLOW,1,3\nNY,2,2\n")
        for increment, end in ((0.2, ironing.motion(1)), (o.increment, ironing.motion(2))):
            f.write("*STEP,INC=1000,NLGEOM\n*STATIC,SOLVER=SPOOLES\n%g,1.,1e-5,%g\n*CONTROLS,PARAMETERS=FIELD\n0.005,0.01\n*BOUNDARY\nNIN,1,1,%.15g\nNIN,3,3,%.15g\n" % (increment, increment, end[0], end[2]))
            f.write("*NODE PRINT,NSET=NIN,TOTALS=ONLY\nRF\n*END STEP\n")
    result = dict(code="CalculiX", element=o.elements, order=2 if quadratic else 1, scale=o.scale, method="increments %g, stick %g" % (o.increment, o.stick), unknowns=int(3 * len(points) - 2 * inside.sum() - 2 * below.sum() - across.sum()), **ccx.run(folder, 300))
    times, forces = [], []
    with open(folder + "/job.dat", encoding="utf-8") as f:
        for line in f:
            w = line.split()
            if "time" in w:
                times.append(float(w[-1]))
            elif len(w) == 3 and re.match(r"^-?\d", w[0]):
                forces.append((float(w[0]), float(w[2])))
if forces:
    result.update(ironing.measures(times[:len(forces)], forces))
spheres.report(**result)
