#!/usr/bin/env python3
"""FElupe on the two scenes of spheres.py. Prints a JSON line; one thread.

    pip install felupe numpy scipy
    felupe_spheres.py --problem balloon|hill --order 2 --n 2 --m 2 [--dual continuous|cells] [--kappa 1e4] [--hardening 0] [--steps 1]

balloon: three fields (displacement, pressure, volume ratio), NearlyIncompressible with the bulk modulus --kappa around NeoHooke, hexahedra of Lagrange of the given order, pressure and volume
ratio of one order less, continuous between cells or within cells (cells is FElupe's own choice for order 1). hill: LinearElasticPlasticIsotropicHardening with the hardening
modulus --hardening times E. Direct solver of SciPy (SuperLU), as is FElupe's own choice."""
import argparse

import felupe as fem
import numpy as np

import spheres


def lagrange_mesh(n, m, order):
    """Mesh of FElupe, and the nodes of a cell in its order, as integers."""
    nodes = np.round((fem.element.ArbitraryOrderLagrange(order, 3).points + 1) / 2 * order).astype(int)
    points, cells = spheres.mesh(n, m, order, nodes)
    return fem.Mesh(points, cells, "VTK_LAGRANGE_HEXAHEDRON"), nodes


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--problem", choices=("balloon", "hill"), default="balloon")
    parser.add_argument("--order", type=int, default=2)
    parser.add_argument("--n", type=int, default=2)
    parser.add_argument("--m", type=int, default=2)
    parser.add_argument("--dual", choices=("continuous", "cells"), default="continuous")
    parser.add_argument("--kappa", type=float, default=spheres.KAPPA)
    parser.add_argument("--hardening", type=float, default=0.)
    parser.add_argument("--steps", type=int, default=1)
    parser.add_argument("--tolerance", type=float, default=1e-8)
    o = parser.parse_args()
    clock = spheres.Clock()
    result = dict(code="FElupe", problem=o.problem, element="hex " + (o.dual if o.problem == "balloon" else ""), order=o.order, n=o.n, m=o.m, steps=o.steps, kappa=o.kappa)
    try:
        mesh, nodes = lagrange_mesh(o.n, o.m, o.order)
        region = fem.RegionLagrange(mesh, order=o.order, dim=3)
        points = mesh.points
        inner = abs(np.linalg.norm(points, axis=1) - spheres.INNER) < 1e-9
        if o.problem == "balloon":
            field = fem.FieldsMixed(region, n=3, mesh=lagrange_mesh(o.n, o.m, o.order - 1)[0] if o.dual == "continuous" else None)
            solid = fem.SolidBody(fem.NearlyIncompressible(fem.NeoHooke(mu=spheres.MU), bulk=o.kappa), field)
        else:
            field = fem.FieldContainer([fem.Field(region, dim=3)])
            solid = fem.SolidBody(fem.LinearElasticPlasticIsotropicHardening(spheres.YOUNG, spheres.POISSON, spheres.YIELD, o.hardening * spheres.YOUNG), field)
            forces = spheres.pressure_forces(points, mesh.cells[spheres.inner_faces(o.n, o.m)], nodes / o.order)
        iterations = 0
        for step in range(o.steps):
            factor = (step + 1) / o.steps
            bounds = {}
            for c in range(3):
                skip = tuple(int(k != c) for k in range(3))
                plane = abs(points[:, c]) < 1e-9
                bounds["plane%d" % c] = fem.Boundary(field[0], mask=plane, skip=skip)
                if o.problem == "balloon":
                    moved = inner & ~plane
                    bounds["inner%d" % c] = fem.Boundary(field[0], mask=moved, skip=skip, value=factor * points[moved, c])
            dof0, dof1 = fem.dof.partition(field, bounds)
            ext0 = fem.dof.apply(field, bounds, dof0)
            items = [solid] if o.problem == "balloon" else [solid, fem.PointLoad(field, np.arange(len(points)), factor * forces)]
            found = fem.newtonraphson(items=items, dof0=dof0, dof1=dof1, ext0=ext0, tol=o.tolerance, maxiter=40, verbose=0)
            iterations += found.iterations
        result.update(clock.stop(), newton=iterations, unknowns=len(dof1), cells=len(mesh.cells))
        if o.problem == "balloon":
            plane = abs(points[:, 0]) < 1e-9
            result["error_pressure"] = abs(spheres.pressure_of(found.fun.reshape(-1)[:3 * len(points)].reshape(-1, 3)[inner & ~plane, 0].sum()) / spheres.PRESSURE["balloon"] - 1)
        result["error"] = spheres.error(o.problem, points[mesh.cells], field[0].values[mesh.cells], nodes / o.order)
    except Exception as failure:  # FElupe raises its own
        result["failure"] = repr(failure)[-300:]
    spheres.report(**result)


main()
