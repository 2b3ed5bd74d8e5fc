#!/usr/bin/python3
"""GetFEM on the press fit of fit.py. Prints a JSON line; one thread, MUMPS.

    apt-get install python3-getfem++ python3-scipy
    getfem_fit.py --p 2 --n 2 [--layers 1,1] [--elements hex|tet] [--rule 10]

Integral large-sliding contact brick by ray tracing without friction, an augmented Lagrangian with vector multipliers of the degree of the displacements on the outside of the inner ball; the
law `log` is its Compressible_Neo_Hookean_Bonet. Multipliers hold single components on the planes of symmetry. tet: each hexahedron cut into six. --rule: order of integration on the interface."""
import math

import getfem as gf
import numpy as np

import fit
import getfem_cells
import spheres

AUGMENT, RELEASE = 10 * fit.YOUNG, 0.2
o = fit.arguments(elements="hex", rule=0)
gf.util_trace_level(0)
gf.util_warning_level(0)
clock = spheres.Clock()
family = "QK" if o.elements == "hex" else "PK"
transformation = gf.GeoTrans("GT_%s(3,%d)" % (family, o.p))
reference = np.array(transformation.pts()).T


def ball(n, m, start, end):
    """The mesh of fit.shells in this transformation's nodes; regions 1 to 3: planes of symmetry; 4, 5: inside, outside."""
    parts, cells = getfem_cells.parts(o.elements, reference), []
    for f, i, j, k in np.ndindex(3, n, n, m):
        for part in parts:
            s, t = (np.tan(math.pi / 4 * (part[:, c] + a) / n) for c, a in ((0, i), (1, j)))
            r = (start + (end - start) * (part[:, 2] + k) / m) / np.sqrt(1 + s * s + t * t)
            cells.append(np.roll(np.stack([r, r * s, r * t], axis=1), f, axis=1))
    cells = np.array(cells)
    cells[abs(cells) < 1e-13] = 0
    mesh = gf.Mesh("empty", 3)
    mesh.add_convex(transformation, np.asfortranarray(np.transpose(cells, (2, 1, 0))))
    points = mesh.pts()
    radius = np.linalg.norm(points, axis=0)
    for region, on in enumerate([*(abs(points) < 1e-9), abs(radius - start) < 1e-9, abs(radius - end) < 1e-9], 1):
        mesh.set_region(region, mesh.faces_from_pid(np.where(on)[0]))
    return mesh


def space(mesh, components):
    result = gf.MeshFem(mesh, components)
    result.set_fem(gf.Fem("FEM_%s(3,%d)" % (family, o.p)))
    return result


result = dict(code="GetFEM", element=o.elements, order=o.p, n=o.n, layers=o.layers, method="rule %d" % (o.rule or 2 * o.p + 2))
try:
    meshes = [ball(o.n, o.m[0], *fit.INNER), ball(o.n + 1, o.m[1], *fit.OUTER)]
    model = gf.Model("real")
    model.add_initialized_data("law", [fit.LAMBDA, fit.MU])
    fields, rules = [space(mesh, 3) for mesh in meshes], [getfem_cells.integration(mesh, o.elements, 2 * o.p + 2) for mesh in meshes]
    for k, (mesh, field, rule) in enumerate(zip(meshes, fields, rules), 1):
        model.add_fem_variable("u%d" % k, field)
        model.add_finite_strain_elasticity_brick(rule, "Compressible_Neo_Hookean_Bonet", "u%d" % k, "law")
        for c in range(3):
            model.add_filtered_fem_variable("h%d%d" % (k, c), space(mesh, 1), c + 1)
            model.add_linear_term(rule, "u%d(%d)*Test_h%d%d + h%d%d*Test_u%d(%d)" % (k, c + 1, k, c, k, c, k, c + 1), c + 1)
    contact_rules = [getfem_cells.integration(mesh, o.elements, o.rule or 2 * o.p + 2) for mesh in meshes]
    model.add_filtered_fem_variable("l", space(meshes[0], 3), 5)
    model.add_initialized_data("r", [AUGMENT])
    model.add_initialized_data("f", [0.])
    brick = model.add_integral_large_sliding_contact_brick_raytracing("r", RELEASE, "f")
    model.add_slave_contact_boundary_to_large_sliding_contact_brick(brick, contact_rules[0], 5, "u1", "l")
    model.add_master_contact_boundary_to_large_sliding_contact_brick(brick, contact_rules[1], 4, "u2")
    found = model.solve("max_res", 1e-7, "max_iter", 40, "lsolver", "mumps")
    result.update(clock.stop(), newton=int(np.asarray(found[0] if isinstance(found, (tuple, list)) else found).ravel()[0]), unknowns=model.nbdof())
    exact, wrong, whole = fit.Exact(), 0., 0.
    for body, (mesh, field, ends) in enumerate(zip(meshes, fields, (fit.INNER, fit.OUTER))):
        series = np.polynomial.Chebyshev.interpolate(lambda s, b=body: exact.displacement(b, s), 10, domain=ends).convert(kind=np.polynomial.Polynomial)
        right = "(%s)*Normalized(X)" % "+".join("(%.17g)*pow(Norm(X),%d)" % (c, d) for d, c in enumerate(series.coef))
        square = [float(np.asarray(gf.asm_generic(getfem_cells.integration(mesh, o.elements, 2 * o.p + 6), 0, "Norm_sqr(%s)" % text, -1, "u", 0, field, model.variable("u%d" % (body + 1)))).ravel()[0]) for text in ("u-" + right, right)]
        wrong, whole = wrong + square[0], whole + square[1]
    forces = [float(np.asarray(gf.asm_generic(rules[0], 0, "h1%d" % c, c + 1, model)).ravel()[0]) for c in range(3)]
    pressures = np.linalg.norm(np.asarray(model.variable("l")).reshape(-1, 3), axis=1) / (exact.p * (exact.c / fit.INNER[1])**2)
    result.update(error=math.sqrt(wrong / whole), error_pressure=exact.pressure_error(forces), error_pressure_max=float(abs(pressures - 1).max()))
except Exception as failure:  # GetFEM raises its own errors
    result.update(clock.stop(), failure=str(failure)[:300])
spheres.report(**result)
