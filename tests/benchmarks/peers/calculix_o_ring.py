#!/usr/bin/env python3
"""CalculiX on o_ring.py. Prints a JSON line; one thread, SPOOLES.

    apt-get install calculix-ccx
    calculix_o_ring.py [--elements C3D20R|C3D8] [--n 2] [--along 8] [--plate 8,8] [--kappa 1e3] [--penalty 1e3]

The law `isochoric` of fit.py with the bulk modulus --kappa, as it has no incompressible elements. Contact SURFACE TO SURFACE with the stiffness --penalty per area, in units of mu; forces may be off by
1e-4 of the mean one in equilibrium."""
import re
import tempfile

import numpy as np

import calculix_fit as ccx
import fit
import o_ring
import spheres

o = fit.arguments(elements="C3D20R", along=8, plate="8,8", kappa=1e3, penalty=1e3)
quadratic = o.elements.startswith("C3D20")
(ring, lower), (flat, upper), skin = o_ring.bodies(o.n, o.along, o.plate, 2 if quadratic else 1, spheres.HEX20 if quadratic else spheres.CORNERS // 2)
points = np.concatenate([ring, flat])
held = abs(points) < 1e-9
top = points[:, 2] > o_ring.SECTION + o_ring.PLATE[2] - 1e-9
with tempfile.TemporaryDirectory() as folder:
    with open(folder + "/job.inp", "w", encoding="utf-8") as f:
        f.write("*NODE,NSET=NALL\n")
        f.writelines("%d,%.15g,%.15g,%.15g\n" % (k + 1, *p) for k, p in enumerate(points))
        ccx.elements(f, o.elements, "RING", lower)
        ccx.elements(f, o.elements, "PLATE", upper + len(ring), len(lower))
        f.write("*MATERIAL,NAME=MRING\n*HYPERELASTIC,NEO HOOKE\n%.15g,%.15g\n*SOLID SECTION,ELSET=ERING,MATERIAL=MRING\n" % (o_ring.MU / 2, 2 / o.kappa))
        ccx.material(f, "PLATE", o_ring.STIFF, o_ring.POISSON)
        ccx.surface(f, "SSKIN", skin, 2)
        ccx.surface(f, "SUNDER", len(lower) + np.arange(len(upper)), 1)
        f.write("*NSET,NSET=NTOP\n" + "".join("%d,\n" % (k + 1) for k in np.where(top)[0]))
        f.write("*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR\n%g\n" % (o.penalty * o_ring.MU))
        f.write("*CONTACT PAIR,INTERACTION=SI,TYPE=SURFACE TO SURFACE\nSSKIN,SUNDER\n*BOUNDARY\n")
        f.writelines("%d,%d,%d\n" % (k + 1, c + 1, c + 1) for k, c in np.argwhere(held))
        for t in o_ring.TIMES:
            f.write("*STEP,INC=1000,NLGEOM\n*STATIC,SOLVER=SPOOLES\n1.,1.,1e-4,1.\n*CONTROLS,PARAMETERS=FIELD\n1e-4,1e-3\n*BOUNDARY\nNTOP,3,3,%.15g\n*NODE PRINT,NSET=NTOP,TOTALS=ONLY,FREQUENCY=1000\nRF\n*END STEP\n" % (-o_ring.SQUEEZE * t))
    result = dict(code="CalculiX", element=o.elements, order=2 if quadratic else 1, n=o.n, cells="%d along, plate %s" % (o.along, o.plate), method="kappa %g, penalty %g" % (o.kappa, o.penalty), unknowns=int((~held).sum() - top.sum()), **ccx.run(folder, 600))
    with open(folder + "/job.dat", encoding="utf-8") as f:
        forces = [float(w[2]) for w in map(str.split, f) if len(w) == 3 and re.match(r"^-?\d", w[0])]
result.update(o_ring.measures(forces))
spheres.report(**result)
