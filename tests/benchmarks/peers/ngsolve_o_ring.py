#!/usr/bin/env python3
"""NGSolve on o_ring.py. Prints a JSON line; one thread.

    pip install ngsolve numpy scipy
    ngsolve_o_ring.py --p 2 --h 0.5 [--penalty 1e3] [--rule 5] [--tolerance 1e-4] [--finer 1]

Netgen's tetrahedra, curved, of the size h, of the plate 2 h; their making, `mesh` in seconds, is left out of cpu_solve. Taylor-Hood elements with the bulk modulus 1e6, so that
its Cholesky factorisation exists. ContactBoundary with the energy penalty mu/2 (overlap)^2 along the normal of the plate's underside at the deformed ring. --finer: equal steps in place of each."""
import netgen.occ as occ
import ngsolve as ng

import fit
import o_ring
import spheres
from ngsolve_fit import newton

BULK = 1e6


def tetrahedra(o):
    axis = occ.Axis(occ.Pnt(0, 0, 0), occ.Z)
    face = occ.WorkPlane(occ.Axes(occ.Pnt(o_ring.RADIUS, 0, 0), -occ.Y, occ.X)).Circle(o_ring.SECTION).Face()
    ring = face.Revolve(axis, 90) * occ.Box(occ.Pnt(-1, -1, 0), occ.Pnt(7, 7, 2))
    low, high, thick = o_ring.PLATE
    tube = [occ.Cylinder(occ.Pnt(0, 0, o_ring.SECTION), occ.Z, r=r, h=thick) for r in (high, low)]
    plate = (tube[0] - tube[1]) * occ.Box(occ.Pnt(0, 0, 0), occ.Pnt(7, 7, 2))
    for shape, name, h in ((ring, "ring", o.h), (plate, "plate", 2 * o.h)):
        shape.mat(name)
        shape.solids[0].maxh = h
        for part in shape.faces:
            a, b = ([getattr(p, c) for c in "xyz"] for p in part.bounding_box)
            plane = [k for k in range(3) if abs(a[k]) < 1e-5 and abs(b[k]) < 1e-5]
            part.name = "sym" + "xyz"[plane[0]] if plane else "skin" if name == "ring" else "under" if b[2] < o_ring.SECTION + 1e-5 else "top" if a[2] > o_ring.SECTION + thick - 1e-5 else "free"
    return ng.Mesh(occ.OCCGeometry(occ.Compound([ring, plate])).GenerateMesh(maxh=2 * o.h, grading=0.5, segmentsperedge=0.1, curvaturesafety=0.1)).Curve(o.p)


def solve(mesh, o, forces):
    """Adds to forces; the number of iterations and of unknowns."""
    space = ng.VectorH1(mesh, order=o.p, dirichletx="symx", dirichlety="symy", dirichletz="symz|top")
    pressure = ng.H1(mesh, order=o.p - 1, definedon=mesh.Materials("ring"))
    both = space * pressure
    (u, q), _ = both.TnT()
    f = ng.Id(3) + ng.Grad(u)
    j = ng.Det(f)
    shear, first = o_ring.STIFF / 2 / (1 + o_ring.POISSON), o_ring.STIFF * o_ring.POISSON / (1 + o_ring.POISSON) / (1 - 2 * o_ring.POISSON)
    a = ng.BilinearForm(both, symmetric=True, condense=o.p >= 4)
    a += ng.Variation((o_ring.MU / 2 * (ng.InnerProduct(f, f) - 3) - q * (j - 1) - q**2 / 2 / BULK).Compile() * ng.dx("ring"))
    a += ng.Variation((shear / 2 * (ng.InnerProduct(f, f) - 3 - 2 * ng.log(j)) + first / 2 * ng.log(j)**2).Compile() * ng.dx("plate"))
    touch = ng.ContactBoundary(mesh.Boundaries("skin"), mesh.Boundaries("under"))
    x = ng.CF((ng.x, ng.y, ng.z))
    overlap = (x + u.Trace() - x.Other() - u.Trace().Other()) * ng.CF((0, 0, 1))
    touch.AddEnergy(ng.IfPos(overlap, o.penalty * o_ring.MU / 2 * overlap**2, 0))
    found, iterations = ng.GridFunction(both), 0
    found.components[1].Set(o_ring.MU, definedon=mesh.Materials("ring"))
    residual, mover, moved = found.vec.CreateVector(), ng.GridFunction(both), 0.
    mover.components[0].components[2].Set(1, definedon=mesh.Boundaries("top"))
    whole = ng.GridFunction(space)
    whole.components[2].Set(1, definedon=mesh.Materials("plate"))
    for targets in o_ring.heights(o.finer):
        for target in targets:
            found.components[0].vec.data += (target - moved) * whole.vec
            moved = target
            iterations += newton(a, lambda: touch.Update(found.components[0], bf=a, intorder=o.rule, maxdist=0.5), found, both.FreeDofs(a.condense), o.tolerance)
        a.Apply(found.vec, residual)
        forces.append(ng.InnerProduct(residual, mover.vec))
    return iterations, sum(both.FreeDofs())


o = fit.arguments(h=0.5, penalty=1e3, rule=5, tolerance=1e-4, finer=1)
ng.SetNumThreads(1)
ng.ngsglobals.msg_level = 0
clock = spheres.Clock()
result, forces = dict(code="NGSolve", element="tet", order=o.p, h=o.h, method="penalty %g, rule %d" % (o.penalty, o.rule) + (", steps / %d" % o.finer if o.finer > 1 else "")), []
try:
    mesh = tetrahedra(o)
    result["mesh"] = clock.stop()["cpu_solve"]
    result["newton"], result["unknowns"] = solve(mesh, o, forces)
except Exception as failure:  # NGSolve raises its own
    result["failure"] = "t > %g: " % (o_ring.TIMES[len(forces)] - 0.2) + str(failure)[:250]
result.update(clock.stop(), **o_ring.measures(forces))
result["cpu_solve"] = round(result["cpu_solve"] - result.get("mesh", 0), 3)
spheres.report(**result)
