#!/usr/bin/env python3
"""SfePy on the balloon of spheres.py (it has no plasticity). Prints a JSON line; one thread.

    pip install sfepy numpy
    sfepy_spheres.py --order 2 --n 4 --m 4 [--steps 4]

Mixed total Lagrangian terms (dw_tl_he_neohook, dw_tl_bulk_pressure, dw_tl_volume), displacement of the given order, pressure of one less, incompressible. Meshes are of hexahedra of eight
nodes, which SfePy does not curve: the body has flat faces, so that errors fall by h^2 at best, whatever the order. Direct solver of SciPy."""
import argparse

import numpy as np
from sfepy.base.base import IndexedStruct, output
from sfepy.discrete import Equation, Equations, FieldVariable, Function, Integral, Material, Problem
from sfepy.discrete.conditions import Conditions, EssentialBC
from sfepy.discrete.fem import FEDomain, Field, Mesh
from sfepy.solvers.ls import ScipyDirect
from sfepy.solvers.nls import Newton
from sfepy.solvers.ts_solvers import SimpleTimeSteppingSolver
from sfepy.terms import Term

import spheres

parser = argparse.ArgumentParser()
parser.add_argument("--order", type=int, default=2)
parser.add_argument("--n", type=int, default=2)
parser.add_argument("--m", type=int, default=2)
parser.add_argument("--steps", type=int, default=4)
o = parser.parse_args()
output.set_output(quiet=True)
clock = spheres.Clock()
result = dict(code="SfePy", problem="balloon", element="hex flat", order=o.order, n=o.n, m=o.m, steps=o.steps)
try:
    points, cells = spheres.mesh(o.n, o.m, 1, spheres.CORNERS // 2)
    domain = FEDomain("domain", Mesh.from_data("shell", points, None, [cells.astype(np.int32)], [np.zeros(len(cells), np.int32)], ["3_8"]))
    omega = domain.create_region("Omega", "all")
    planes = [domain.create_region("plane%d" % c, "vertices in (%s < 1e-9)" % "xyz"[c], "facet") for c in range(3)]
    find = Function("find", lambda x, domain=None: np.where(abs(np.linalg.norm(x, axis=1) - spheres.INNER) < 1e-9)[0])
    inner = domain.create_region("inner", "vertices by find", "facet", functions={"find": find})
    displacement = Field.from_args("fu", np.float64, "vector", omega, approx_order=o.order)
    pressure = Field.from_args("fp", np.float64, "scalar", omega, approx_order=o.order - 1)
    u, p = FieldVariable("u", "unknown", displacement, history=1), FieldVariable("p", "unknown", pressure, history=1)
    v, q = FieldVariable("v", "test", displacement, primary_var_name="u"), FieldVariable("q", "test", pressure, primary_var_name="p")
    material, integral = Material("m", mu=spheres.MU), Integral("i", order=2 * o.order + 1)
    balance = Term.new("dw_tl_he_neohook(m.mu, v, u)", integral, omega, m=material, v=v, u=u) + Term.new("dw_tl_bulk_pressure(v, u, p)", integral, omega, v=v, u=u, p=p)
    volume = Term.new("dw_tl_volume(q, u)", integral, omega, q=q, u=u, term_mode="volume") - Term.new("dw_integrate(q)", integral, omega, q=q)
    held = [EssentialBC("plane%d" % c, planes[c], {"u.%d" % c: 0.}) for c in range(3)]
    held += [EssentialBC("inner%d" % c, inner, {"u.%d" % c: Function("moved%d" % c, lambda ts, x, bc=None, problem=None, c=c, **_: ts.time * x[:, c])}) for c in range(3)]
    status = IndexedStruct()
    problem = Problem("balloon", equations=Equations([Equation("balance", balance), Equation("volume", volume)]))
    problem.set_bcs(ebcs=Conditions(held))
    newton = Newton({"i_max": 30, "eps_a": 1e-9, "eps_r": 1e-9, "ls_on": 1e9}, lin_solver=ScipyDirect({}), status=status)
    problem.set_ics(ics=Conditions([]))
    problem.set_solver(SimpleTimeSteppingSolver({"t0": 0., "t1": 1., "n_step": o.steps + 1}, nls=newton, context=problem))
    iterations = []

    def after_step(*_):
        iterations.append(getattr(status, "n_iter", 0))
        if getattr(status, "condition", 0) != 0:
            raise RuntimeError("step %d of %d did not converge" % (len(iterations) - 1, o.steps))

    problem.solve(status=status, save_results=False, step_hook=after_step)
    result.update(clock.stop(), newton=sum(iterations), unknowns=problem.equations.variables.adi.n_dof_total, cells=len(cells))
    nodes = spheres.lattice(o.order)
    flat = np.einsum("qn,eni->eqi", spheres.basis(spheres.CORNERS / 2., "q", nodes / o.order)[0], points[cells])
    places = {tuple(np.round(x * 1e7).astype(int)): k for k, x in enumerate(displacement.get_coor())}
    index = np.array([[places[tuple(np.round(x * 1e7).astype(int))] for x in cell] for cell in flat])
    result["error"] = spheres.error("balloon", flat, u().reshape(-1, 3)[index], nodes / o.order)
except Exception as failure:  # SfePy raises its own errors
    result["failure"] = repr(failure)[-300:]
spheres.report(**result)
