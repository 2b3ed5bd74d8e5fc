#!/usr/bin/env python3
"""NGSolve on the press fit of fit.py. Prints a JSON line; one thread.

    pip install ngsolve numpy scipy
    ngsolve_fit.py --p 3 --h 1.0 [--penalty 1e3] [--rule 5] [--tolerance 1e-3]

Netgen's tetrahedra, curved, of the sizes h and 0.8 h, whose making, `mesh` in seconds, is left out of cpu_solve. ContactBoundary with the energy penalty E/2 (overlap)^2, the overlap along the
normal of the deformed inner ball; pairs of points are found again in each iteration of Newton's method (full steps, symbolic tangent, unknowns within cells condensed). --rule: order of the
points on the interface; --tolerance: of the last decrement beside the largest one."""
import math

import netgen.occ as occ
import ngsolve as ng
import numpy as np

import fit
import spheres

BODIES = (("inner", fit.INNER), ("outer", fit.OUTER))


def tetrahedra(o):
    origin, balls = occ.Pnt(0, 0, 0), []
    for (name, (start, end)), h in zip(BODIES, (o.h, 0.8 * o.h)):
        ball = (occ.Sphere(origin, end) - occ.Sphere(origin, start)) * occ.Box(origin, occ.Pnt(3, 3, 3))
        ball.mat(name)
        ball.solids[0].maxh = h
        for face in ball.faces:
            low, high = ([getattr(p, c) for c in "xyz"] for p in face.bounding_box)
            plane = [k for k in range(3) if abs(low[k]) < 1e-5 and abs(high[k]) < 1e-5]
            face.name = "sym" + "xyz"[plane[0]] if plane else "free" if abs(high[0] - (start if name == "inner" else end)) < 0.05 else "touch_" + name
        balls.append(ball)
    return ng.Mesh(occ.OCCGeometry(occ.Compound(balls)).GenerateMesh(maxh=o.h, grading=0.5, segmentsperedge=0.1, curvaturesafety=0.1)).Curve(o.p)


def newton(a, update, u, free, tolerance, most=30):
    """Full steps; the number of iterations."""
    residual, step, sizes = u.vec.CreateVector(), u.vec.CreateVector(), []
    for k in range(most):
        update()
        a.Apply(u.vec, residual)
        a.AssembleLinearization(u.vec)
        factor = a.mat.Inverse(free, inverse="sparsecholesky")
        if a.condense:
            residual.data += a.harmonic_extension_trans * residual
            step.data = factor * residual
            step.data += a.harmonic_extension * step
            step.data += a.inner_solve * residual
        else:
            step.data = factor * residual
        sizes.append(math.sqrt(abs(ng.InnerProduct(step, residual))))
        u.vec.data -= step
        if not sizes[-1] < 1e3:
            break
        if sizes[-1] < tolerance * max(sizes):
            return k + 1
    raise RuntimeError("no convergence: " + " ".join("%.1e" % s for s in sizes[-12:]))


def solve(mesh, o):
    space = ng.VectorH1(mesh, order=o.p, dirichletx="symx", dirichlety="symy", dirichletz="symz")
    u = space.TrialFunction()
    f = ng.Id(3) + ng.Grad(u)
    j = ng.Det(f)
    a = ng.BilinearForm(space, symmetric=True, condense=o.p >= 4)
    a += ng.Variation((fit.MU / 2 * (ng.InnerProduct(f, f) - 3 - 2 * ng.log(j)) + fit.LAMBDA / 2 * ng.log(j)**2).Compile() * ng.dx)
    touch = ng.ContactBoundary(mesh.Boundaries("touch_inner"), mesh.Boundaries("touch_outer"))
    x = ng.CF((ng.x, ng.y, ng.z))
    overlap = (x + u.Trace() - x.Other() - u.Trace().Other()) * touch.normal
    touch.AddEnergy(ng.IfPos(overlap, o.penalty * fit.YOUNG / 2 * overlap**2, 0))
    found = ng.GridFunction(space)
    return found, a, touch, newton(a, lambda: touch.Update(found, bf=a, intorder=o.rule, maxdist=0.3), found, space.FreeDofs(a.condense), o.tolerance)


def measures(mesh, found, a, touch, o):
    exact, x = fit.Exact(), ng.CF((ng.x, ng.y, ng.z))
    r, value = ng.Norm(x), {}
    for body, (name, ends) in enumerate(BODIES):
        series = np.polynomial.Chebyshev.interpolate(lambda s, b=body: exact.displacement(b, s), 12, domain=ends).convert(kind=np.polynomial.Polynomial)
        value[name] = sum(float(c) * r**k for k, c in enumerate(series.coef))
    right = mesh.MaterialCF(value) / r * x
    error = math.sqrt(np.divide(*(ng.Integrate(ng.InnerProduct(v, v), mesh, order=2 * o.p + 6) for v in (found - right, right))))
    residual, inner, w, forces = found.vec.CreateVector(), ng.BitArray(found.space.ndof), ng.GridFunction(found.space), []
    a.Apply(found.vec, residual)
    inner[:] = 0
    for element in mesh.Materials("inner").Elements():
        for d in found.space.GetDofNrs(element):
            inner[d] = 1
    for c in range(3):
        w.vec[:] = 0
        w.components[c].Set(1, definedon=mesh.Boundaries("sym" + "xyz"[c]))
        forces.append(ng.InnerProduct(residual, (ng.Projector(inner, True) * w.vec).Evaluate()))
    at = mesh.MapToAllElements({ng.TRIG: ng.IntegrationRule(ng.TRIG, 2 * o.p)}, mesh.Boundaries("touch_inner"))
    penalties = np.array((o.penalty * fit.YOUNG * -ng.InnerProduct(touch.gap, touch.normal))(at)) / (exact.p * (exact.c / fit.INNER[1])**2)
    f = ng.Id(3) + ng.Grad(found)
    stress = fit.MU / ng.Det(f) * (f * f.trans - ng.Id(3)) + fit.LAMBDA * ng.log(ng.Det(f)) / ng.Det(f) * ng.Id(3)
    normal = ng.Cof(f) * ng.specialcf.normal(3)
    stresses = np.array((-ng.InnerProduct(ng.BoundaryFromVolumeCF(stress) * normal, normal) / ng.InnerProduct(normal, normal))(at)) / exact.p
    return dict(error=error, error_pressure=exact.pressure_error(forces), error_pressure_max=float(abs(stresses - 1).max()), error_penalty_max=float(abs(penalties - 1).max()))


def main():
    o = fit.arguments(h=1., penalty=1e3, rule=5, tolerance=1e-3)
    ng.SetNumThreads(1)
    ng.ngsglobals.msg_level = 0
    clock = spheres.Clock()
    result = dict(code="NGSolve", element="tet", order=o.p, h=o.h, method="penalty %g, rule %d" % (o.penalty, o.rule))
    try:
        mesh = tetrahedra(o)
        result["mesh"] = clock.stop()["cpu_solve"]
        found, a, touch, iterations = solve(mesh, o)
        result.update(clock.stop(), newton=iterations, unknowns=sum(found.space.FreeDofs()))
        result["cpu_solve"] = round(result["cpu_solve"] - result["mesh"], 3)
        result.update(measures(mesh, found, a, touch, o))
    except Exception as failure:  # NGSolve raises its own
        result.update(clock.stop(), failure=str(failure)[:300])
    spheres.report(**result)


if __name__ == "__main__":
    main()
