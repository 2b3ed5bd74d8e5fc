#!/usr/bin/env python3
"""NGSolve on the two scenes of spheres.py. Prints a JSON line; one thread.

    pip install ngsolve numpy
    ngsolve_spheres.py --problem balloon|hill --order 3 --n 2 --m 2 [--elements hex|tet] [--h 0.5] [--pairs th|dg] [--steps 1] [--inverse sparsecholesky|umfpack] [--condense 1]

hex: the mesh of spheres.py, curved by a deformation of the given order; tet: netgen's tetrahedra of size --h, curved. balloon: energy mu/2 (tr C - 3) + q (J - 1) with q continuous of one
order less (th, Taylor-Hood) or discontinuous (dg). hill: energy of the increment whose minimum is the radial return, the plastic strain at the points of integration. Newton's method with
the tangent of the symbolic energy, unknowns within cells condensed. dg has not converged; umfpack takes longer; sparsecholesky, without pivots, sometimes fails on tetrahedra. hill with tetrahedra: the front of the plastic zone is no face of the mesh."""
import argparse
import math

import ngsolve as ng
import netgen.meshing as nm
from netgen.occ import Box, OCCGeometry, Pnt, Sphere
from ngsolve.comp import IntegrationRuleSpace

import spheres


def hexahedra(n, m, order):
    """The mesh in the largest coordinate as radius, whose planes are flat, and the deformation that makes it round."""
    flat, points, faces = nm.Mesh(), {}, {}
    flat.dim = 3
    for name in ("symx", "symy", "symz", "inside", "outside"):
        faces[name] = flat.Add(nm.FaceDescriptor(surfnr=len(faces) + 1, domin=1, domout=0, bc=len(faces) + 1))
        flat.SetBCName(len(faces) - 1, name)
    flat.SetMaterial(1, "shell")
    for f in range(3):
        def at(i, j, k):
            r = spheres.INNER + (spheres.OUTER - spheres.INNER) * k / m
            x = [0.] * 3
            x[f], x[(f + 1) % 3], x[(f + 2) % 3] = r, r * i / n, r * j / n
            key = tuple(round(v * 1e9) for v in x)
            if key not in points:
                points[key] = flat.Add(nm.MeshPoint(nm.Pnt(*x)))
            return points[key]

        def quad(name, *corners):
            flat.Add(nm.Element2D(faces[name], [at(*c) for c in corners]))

        for i in range(n):
            for j in range(n):
                for k in range(m):
                    flat.Add(nm.Element3D(1, [at(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]))
                quad("inside", (i, j, 0), (i, j + 1, 0), (i + 1, j + 1, 0), (i + 1, j, 0))
                quad("outside", (i, j, m), (i + 1, j, m), (i + 1, j + 1, m), (i, j + 1, m))
            for k in range(m):
                quad("sym" + "xyz"[(f + 2) % 3], (i, 0, k), (i + 1, 0, k), (i + 1, 0, k + 1), (i, 0, k + 1))
                quad("sym" + "xyz"[(f + 1) % 3], (0, i, k), (0, i, k + 1), (0, i + 1, k + 1), (0, i + 1, k))
    result = ng.Mesh(flat)
    x, e = (ng.x, ng.y, ng.z), 1e-12

    def round_off(f):
        s, t = (ng.tan(math.pi / 4 * x[(f + a) % 3] / x[f]) for a in (1, 2))
        r = x[f] / ng.sqrt(1 + s * s + t * t)
        y = [None] * 3
        y[f], y[(f + 1) % 3], y[(f + 2) % 3] = r, r * s, r * t
        return ng.CF(tuple(y))

    moved = ng.IfPos(x[0] - x[1] + e, ng.IfPos(x[0] - x[2] + e, round_off(0), round_off(2)), ng.IfPos(x[1] - x[2] + e, round_off(1), round_off(2)))
    deformation = ng.GridFunction(ng.VectorH1(result, order=order))
    deformation.Set(moved - ng.CF(x), dual=True)
    result.SetDeformation(deformation)
    return result


def tetrahedra(h, order):
    origin = Pnt(0, 0, 0)
    shape = (Sphere(origin, spheres.OUTER) - Sphere(origin, spheres.INNER)) * Box(origin, Pnt(3, 3, 3))
    for face in shape.faces:
        low, high = ([getattr(p, c) for c in "xyz"] for p in face.bounding_box)
        plane = [k for k in range(3) if abs(low[k]) < 1e-5 and abs(high[k]) < 1e-5]
        face.name = "sym" + "xyz"[plane[0]] if plane else "inside" if high[0] < 1.1 else "outside"
    result = ng.Mesh(OCCGeometry(shape).GenerateMesh(maxh=h, grading=0.5, segmentsperedge=0.1, curvaturesafety=0.1))
    return result.Curve(order)


def newton(a, u, free, inverse, most=25):
    """Full steps until the decrement is rounding; the number of iterations."""
    residual, step, first = u.vec.CreateVector(), u.vec.CreateVector(), None
    for k in range(most):
        a.Apply(u.vec, residual)
        a.AssembleLinearization(u.vec)
        factor = a.mat.Inverse(free, inverse=inverse)
        if a.condense:
            residual.data += a.harmonic_extension_trans * residual
            step.data = factor * residual
            step.data += a.harmonic_extension * step
            step.data += a.inner_solve * residual
        else:
            step.data = factor * residual
        size = math.sqrt(abs(ng.InnerProduct(step, residual)))
        u.vec.data -= step
        first = first or size
        if size != size:
            break
        if size < 1e-10 * first:
            return k + 1
    raise RuntimeError("no convergence")


def balloon(mesh, o):
    space = ng.VectorH1(mesh, order=o.order, dirichletx="symx|inside", dirichlety="symy|inside", dirichletz="symz|inside")
    pressure = ng.H1(mesh, order=o.order - 1) if o.pairs == "th" else ng.L2(mesh, order=o.order - 1, lowest_order_wb=True)
    both = space * pressure
    (u, q), _ = both.TnT()
    f = ng.Id(3) + ng.Grad(u)
    a = ng.BilinearForm(both, symmetric=True, condense=bool(o.condense))
    a += ng.Variation((spheres.MU / 2 * (ng.InnerProduct(f, f) - 3) - q * (ng.Det(f) - 1)).Compile() * ng.dx)
    x = ng.GridFunction(both)
    x.components[1].Set(spheres.MU)
    whole = ng.GridFunction(space)
    whole.Set(ng.CF((ng.x, ng.y, ng.z)), definedon=mesh.Boundaries("inside"))
    iterations = 0
    for _ in range(o.steps):
        x.components[0].vec.data += 1 / o.steps * whole.vec
        iterations += newton(a, x, both.FreeDofs(bool(o.condense)), o.inverse)
    return x.components[0], both, iterations


def hill(mesh, o):
    space = ng.VectorH1(mesh, order=o.order, dirichletx="symx", dirichlety="symy", dirichletz="symz")
    u = space.TrialFunction()
    shear, bulk = spheres.YOUNG / 2 / (1 + spheres.POISSON), spheres.YOUNG / 3 / (1 - 2 * spheres.POISSON)
    points = IntegrationRuleSpace(mesh, order=o.order)**9
    rules = points.components[0].GetIntegrationRules()
    plastic, pressure = ng.GridFunction(points), ng.Parameter(0)
    rest = ng.CF(tuple(plastic.components), dims=(3, 3))
    bound = math.sqrt(2 / 3) * spheres.YIELD
    deviator = ng.Sym(ng.Grad(u)) - ng.Trace(ng.Grad(u)) / 3 * ng.Id(3) - rest
    size = ng.sqrt(ng.InnerProduct(deviator, deviator) + 1e-30)
    energy = bulk / 2 * ng.Trace(ng.Grad(u))**2 + ng.IfPos(2 * shear * size - bound, bound * size - bound**2 / (4 * shear), shear * size**2)
    a = ng.BilinearForm(space, symmetric=True, condense=bool(o.condense))
    a += ng.Variation(energy.Compile() * ng.dx(intrules=rules))
    a += ng.Variation(pressure * ng.InnerProduct(u, ng.specialcf.normal(3)) * ng.ds("inside"))
    x = ng.GridFunction(space)
    grad = ng.Grad(x)
    found = ng.Sym(grad) - ng.Trace(grad) / 3 * ng.Id(3) - rest
    length = ng.sqrt(ng.InnerProduct(found, found) + 1e-30)
    flow = (rest + ng.IfPos(2 * shear * length - bound, 1 - bound / (2 * shear * length), 0) * found).Compile()
    iterations = 0
    for k in range(o.steps):
        pressure.Set(spheres.PRESSURE["hill"] * (k + 1) / o.steps)
        iterations += newton(a, x, space.FreeDofs(bool(o.condense)), o.inverse)
        plastic.Interpolate(flow)
    return x, space, iterations


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--problem", choices=("balloon", "hill"), default="balloon")
    parser.add_argument("--order", type=int, default=3)
    parser.add_argument("--n", type=int, default=2)
    parser.add_argument("--m", type=int, default=2)
    parser.add_argument("--elements", choices=("hex", "tet"), default="hex")
    parser.add_argument("--h", type=float, default=0.5)
    parser.add_argument("--pairs", choices=("th", "dg"), default="th")
    parser.add_argument("--steps", type=int, default=1)
    parser.add_argument("--inverse", default="sparsecholesky")
    parser.add_argument("--condense", type=int, default=1)
    o = parser.parse_args()
    ng.SetNumThreads(1)
    ng.ngsglobals.msg_level = 0
    ng.SetHeapSize(10**9)
    clock = spheres.Clock()
    result = dict(code="NGSolve", problem=o.problem, element=o.elements + (" " + o.pairs if o.problem == "balloon" else ""), order=o.order, n=o.n, m=o.m, h=o.h, steps=o.steps, inverse=o.inverse)
    try:
        mesh = hexahedra(o.n, o.m, o.order) if o.elements == "hex" else tetrahedra(o.h, o.order)
        u, space, iterations = (balloon if o.problem == "balloon" else hill)(mesh, o)
        result.update(clock.stop(), newton=iterations, unknowns=sum(space.FreeDofs()), cells=mesh.ne)
        x = ng.CF((ng.x, ng.y, ng.z))
        r = ng.Norm(x)
        value, slope = ng_radial(o.problem, r)
        exact = value / r * ng.Id(3) + (slope - value / r) / r**2 * ng.OuterProduct(x, x)
        wrong = ng.Grad(u) - exact
        points = 2 * o.order + 6
        result["error"] = math.sqrt(ng.Integrate(ng.InnerProduct(wrong, wrong), mesh, order=points) / ng.Integrate(ng.InnerProduct(exact, exact), mesh, order=points))
    except Exception as failure:  # NGSolve raises its own
        result["failure"] = str(failure)[-300:]
    spheres.report(**result)


def ng_radial(problem, r):
    """spheres.radial as coefficient functions."""
    if problem == "balloon":
        grown = (r**3 + spheres.GROWN**3 - spheres.INNER**3)**(1 / 3)
        return grown - r, r**2 / grown**2 - 1
    cube, k = spheres.YIELD * spheres.FRONT**3 / spheres.YOUNG, (1 - 2 * spheres.POISSON) / spheres.YOUNG
    inside = 2 * spheres.YIELD * ng.log(r) - spheres.PRESSURE["hill"]
    a, b = 2 * k * spheres.YIELD * spheres.FRONT**3 / 3 / spheres.OUTER**3, (1 + spheres.POISSON) * cube / 3
    inner = spheres.FRONT - r
    return (ng.IfPos(inner, k * r * inside + (1 - spheres.POISSON) * cube / r**2, a * r + b / r**2),
            ng.IfPos(inner, k * (inside + 2 * spheres.YIELD) - 2 * (1 - spheres.POISSON) * cube / r**3, a - 2 * b / r**3))


main()
