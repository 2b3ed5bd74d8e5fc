#!/usr/bin/env python3
"""NGSolve on the corner of prm/fichera.prm: ngsolve_fichera.py [--most UNKNOWNS] [--kinds hp,h]

One conforming mesh of tetrahedra of the cube (-1,1)^3 without the octant x, y, z > 0; solution, body force, tractions on the three inner squares and values
on the six outer sides as in the scene. hp: RefineHP towards the corner, as many levels as the order (the corner is named in advance, so one solve is timed).
h: order 1 to 4, the flux is recovered by averaging (ZZ), elements above a quarter of the largest part are bisected; seconds of all cycles. One thread.
Seconds: spaces, assembling and solving (above 50,000 unknowns BDDC with CG to 1e-6 of the residual, below that or a sparse Cholesky factor, whichever is faster),
without meshes, and without the estimator unless named. Ends a series beyond the given number of unknowns. Prints a JSON line per solve; needs ngsolve."""
import argparse
import json
import math
import time

import ngsolve as ng
from netgen.occ import Box, OCCGeometry, Pnt
from ngsolve.krylovspace import CGSolver

YOUNG, POISSON = 10., 0.3
MU, LAME = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
AMPLITUDES, POWER = (0.1, 0.05, -0.07), 0.6
POINT = ng.CF((ng.x, ng.y, ng.z))
RADIUS2 = ng.x * ng.x + ng.y * ng.y + ng.z * ng.z + 1e-60
VECTOR = ng.CF(AMPLITUDES)
EXACT = RADIUS2**(POWER / 2) * VECTOR
EXACT_GRADIENT = POWER * RADIUS2**(POWER / 2 - 1) * ng.OuterProduct(VECTOR, POINT)
ALONG = sum(a * c for a, c in zip(AMPLITUDES, (ng.x, ng.y, ng.z)))
FORCE = -POWER * RADIUS2**(POWER / 2 - 1) * (MU * (POWER + 1) * VECTOR + (LAME + MU) * (VECTOR + (POWER - 2) * ALONG / RADIUS2 * POINT))


def strain(gradient):
    return 0.5 * (gradient + gradient.trans)


def stress(strain_of):
    return 2 * MU * strain_of + LAME * ng.Trace(strain_of) * ng.Id(3)


def geometry(at_corner):
    shape = Box(Pnt(-1, -1, -1), Pnt(1, 1, 1)) - Box(Pnt(0, 0, 0), Pnt(1, 1, 1))
    for face in shape.faces:
        low, high = face.bounding_box
        outside = any(abs(getattr(low, c) - getattr(high, c)) < 1e-4 and abs(abs(getattr(low, c)) - 1) < 1e-4 for c in "xyz")
        face.name = "outside" if outside else "inner"
    if at_corner:
        for vertex in shape.vertices:
            if vertex.p.x**2 + vertex.p.y**2 + vertex.p.z**2 < 1e-12:
                vertex.hpref = 1
    return OCCGeometry(shape)


def solve(mesh, order, solver, tolerance):
    """The solution, free unknowns, seconds, iterations."""
    start = time.perf_counter()
    space = ng.VectorH1(mesh, order=order, dirichlet="outside")
    u, v = space.TnT()
    a = ng.BilinearForm(space, symmetric=True, condense=order > 1)
    a += ng.InnerProduct(stress(strain(ng.Grad(u))), strain(ng.Grad(v))).Compile() * ng.dx
    preconditioner = ng.Preconditioner(a, "bddc") if solver == "bddc" else None
    a.Assemble()
    f = ng.LinearForm(space)
    f += ng.InnerProduct(FORCE, v) * ng.dx(bonus_intorder=4)
    f += ng.InnerProduct(stress(strain(EXACT_GRADIENT)) * ng.specialcf.normal(3), v.Trace()) * ng.ds("inner", bonus_intorder=4)
    f.Assemble()
    solution = ng.GridFunction(space)
    solution.Set(EXACT, definedon=mesh.Boundaries("outside"))
    residual = f.vec.CreateVector()
    residual.data = f.vec - a.mat * solution.vec
    if order > 1:
        residual.data += a.harmonic_extension_trans * residual
    if solver == "bddc":
        inverse = CGSolver(a.mat, preconditioner.mat, tol=tolerance, maxiter=500, printrates=False)
    else:
        inverse = a.mat.Inverse(space.FreeDofs(order > 1), inverse="sparsecholesky")
    solution.vec.data += inverse * residual
    if order > 1:
        solution.vec.data += a.harmonic_extension * solution.vec
        solution.vec.data += a.inner_solve * f.vec
    return solution, sum(space.FreeDofs()), time.perf_counter() - start, inverse.iterations if solver == "bddc" else 0


def norm(gradient, mesh, order):
    e = strain(gradient)
    return math.sqrt(ng.Integrate(ng.InnerProduct(stress(e), e), mesh, order=order))


def error(solution, mesh, order):
    points = 2 * order + 6
    return norm(ng.Grad(solution) - EXACT_GRADIENT, mesh, points) / norm(EXACT_GRADIENT, mesh, points)


def faster(mesh, order, tolerance):
    first = solve(mesh, order, "bddc", tolerance)
    if first[1] > 50000:
        return (*first, "bddc")
    return min((*first, "bddc"), (*solve(mesh, order, "sparsecholesky", tolerance), "sparsecholesky"), key=lambda run: run[2])


def graded(most):
    """As many levels towards the corner as the order."""
    for size in (1., 0.5):
        for order in range(2, 9):
            mesh = ng.Mesh(geometry(True).GenerateMesh(maxh=size))
            mesh.RefineHP(order, 0.25)
            solution, n, seconds, iterations, solver = faster(mesh, order, 1e-8)
            print(json.dumps({"kind": "hp", "size": size, "order": order, "cycle": 0, "elements": mesh.ne, "dofs": n, "error_energy": error(solution, mesh, order),
                              "seconds": seconds, "solver": solver, "iterations": iterations}), flush=True)
            if n > most:
                break


def adaptive(order, most):
    mesh, total, with_estimates = ng.Mesh(geometry(False).GenerateMesh(maxh=1.)), 0., 0.
    for cycle in range(60):
        solution, n, seconds, iterations, solver = faster(mesh, order, 1e-6)
        total += seconds
        start = time.perf_counter()
        flux = stress(strain(ng.Grad(solution)))
        recovered = ng.GridFunction(ng.MatrixValued(ng.H1(mesh, order=order)))
        recovered.Set(flux)
        off = recovered - flux
        energy = (ng.InnerProduct(off, off) - POISSON / (1 + POISSON) * ng.Trace(off)**2) / (2 * MU)
        parts = ng.Integrate(energy, mesh, ng.VOL, element_wise=True).NumPy()
        with_estimates += seconds + time.perf_counter() - start
        print(json.dumps({"kind": "h", "order": order, "cycle": cycle, "elements": mesh.ne, "dofs": n, "error_energy": error(solution, mesh, order), "seconds": total,
                          "seconds_with_estimates": with_estimates, "estimate": math.sqrt(sum(parts)) / norm(ng.Grad(solution), mesh, 2 * order), "solver": solver,
                          "iterations": iterations}), flush=True)
        if n > most:
            break
        largest = max(parts)
        mesh.ngmesh.Elements3D().NumPy()["refine"] = parts > 0.25 * largest
        mesh.Refine()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", type=int, default=40000)
    parser.add_argument("--kinds", default="hp,h")
    arguments = parser.parse_args()
    ng.SetNumThreads(1)
    ng.ngsglobals.msg_level = 0
    if "hp" in arguments.kinds.split(","):
        graded(arguments.most)
    if "h" in arguments.kinds.split(","):
        for order in range(1, 5):
            adaptive(order, arguments.most)


if __name__ == "__main__":
    main()
