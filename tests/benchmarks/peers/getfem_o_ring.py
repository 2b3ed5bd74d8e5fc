#!/usr/bin/python3
"""GetFEM on o_ring.py. Prints a JSON line; one thread, MUMPS.

    apt-get install python3-getfem++ python3-scipy
    getfem_o_ring.py --p 2 [--n 1] [--along 4] [--plate 4,4] [--elements hex|tet] [--rule 0] [--augment 100] [--finer 1]

Taylor-Hood elements (displacements of degree p, pressures of degree p - 1). Integral large-sliding contact brick by ray tracing without friction, an augmented Lagrangian with vector multipliers of the
degree of the displacements on the skin of the ring; --augment: its parameter; --rule: order of integration there, 2 p + 2 unless given. tet: each hexahedron cut into six. --finer: equal steps in
place of each of o_ring.py's. Each step begins with a plate that is moved as a whole."""
import getfem as gf
import numpy as np

import fit
import getfem_cells
import o_ring
import spheres

o = fit.arguments(elements="hex", rule=0, augment=100., finer=1, along=4, plate="4,4", n=1)
gf.util_trace_level(0)
gf.util_warning_level(0)
clock = spheres.Clock()
family, most = "QK" if o.elements == "hex" else "PK", 40
transformation = gf.GeoTrans("GT_%s(3,%d)" % (family, o.p))
reference = np.array(transformation.pts()).T


def space(mesh, components, degree):
    result = gf.MeshFem(mesh, components)
    result.set_fem(gf.Fem("FEM_%s(3,%d)" % (family, degree)))
    return result


def planes(points, body):
    """Points of the planes of symmetry, of the interface, and of the plate's top."""
    low = o_ring.SECTION
    on_skin = abs(np.hypot(np.hypot(points[0], points[1]) - o_ring.RADIUS, points[2]) - o_ring.SECTION) < 1e-6
    return [abs(points[0]) < 1e-9, abs(points[1]) < 1e-9, abs(points[2]) < 1e-9, on_skin if body == 0 else abs(points[2] - low) < 1e-9, points[2] > low + o_ring.PLATE[2] - 1e-9]


model = gf.Model("real")
result = dict(code="GetFEM", element=o.elements, order=o.p, n=o.n, cells="%d along, plate %s" % (o.along, o.plate), method="augmentation %g, rule %d" % (o.augment, o.rule or 2 * o.p + 2) + (", steps / %d" % o.finer if o.finer > 1 else ""))
forces, iterations, contact_rules, rules = [], 0, [], []
try:
    meshes = [gf.Mesh("empty", 3) for _ in range(2)]
    for part in getfem_cells.parts(o.elements, reference):
        for mesh, (points, cells) in zip(meshes, o_ring.bodies(o.n, o.along, o.plate, 1, part)):
            mesh.add_convex(transformation, np.asfortranarray(np.transpose(points[cells], (2, 1, 0))))
    for k, mesh in enumerate(meshes, 1):
        for region, on in enumerate(planes(mesh.pts(), k - 1), 1):
            if on.any():
                mesh.set_region(region, mesh.faces_from_pid(np.where(on)[0]))
        rules.append(getfem_cells.integration(mesh, o.elements, 2 * o.p + 2))
        contact_rules.append(getfem_cells.integration(mesh, o.elements, o.rule or 2 * o.p + 2))
        field = space(mesh, 3, o.p)
        model.add_fem_variable("u%d" % k, field)
        for c in range(3):
            region = {1: (1, 2, 3), 2: (1, 2, 5)}[k][c]
            name = "h%d%d" % (k, c)
            model.add_filtered_fem_variable(name, space(mesh, 1, o.p), region)
            model.add_initialized_data("m" + name, [0.])
            model.add_linear_term(rules[-1], "(u%d(%d)-m%s)*Test_%s + %s*Test_u%d(%d)" % (k, c + 1, name, name, name, k, c + 1), region)
    model.add_fem_variable("q", space(meshes[0], 1, o.p - 1))
    f = "(Id(3)+Grad_u1)"
    model.add_nonlinear_term(rules[0], "%g*%s:Grad_Test_u1 - q*Det%s*(Inv%s'):Grad_Test_u1 - Test_q*(Det%s-1)" % (o_ring.MU, f, f, f, f))
    model.set_variable("q", o_ring.MU * np.ones(len(model.variable("q"))))
    model.add_initialized_data("law", [o_ring.STIFF * o_ring.POISSON / (1 + o_ring.POISSON) / (1 - 2 * o_ring.POISSON), o_ring.STIFF / 2 / (1 + o_ring.POISSON)])
    model.add_finite_strain_elasticity_brick(rules[1], "Compressible_Neo_Hookean_Bonet", "u2", "law")
    model.add_filtered_fem_variable("l", space(meshes[0], 3, o.p), 4)
    model.add_initialized_data("r", [o.augment])
    model.add_initialized_data("f", [0.])
    brick = model.add_integral_large_sliding_contact_brick_raytracing("r", 0.5, "f")
    model.add_slave_contact_boundary_to_large_sliding_contact_brick(brick, contact_rules[0], 4, "u1", "l")
    model.add_master_contact_boundary_to_large_sliding_contact_brick(brick, contact_rules[1], 4, "u2")
    moved = 0.
    for targets in o_ring.heights(o.finer):
        for target in targets:
            guess = np.array(model.variable("u2"))
            guess[2::3] += target - moved
            model.set_variable("u2", guess)
            model.set_variable("mh22", [target])
            moved = target
            found = model.solve("max_res", 1e-7, "max_iter", most, "lsolver", "mumps")
            steps = int(np.asarray(found[0] if isinstance(found, (tuple, list)) else found).ravel()[0])
            iterations += steps
            if steps >= most:
                raise RuntimeError("no convergence")
        forces.append(float(np.asarray(gf.asm_generic(rules[1], 0, "h22", 5, model)).ravel()[0]))
except Exception as failure:  # GetFEM raises its own errors
    result["failure"] = "t > %g: " % (o_ring.TIMES[len(forces)] - 0.2) + str(failure)[:200]
result.update(clock.stop(), newton=iterations, unknowns=model.nbdof(), **o_ring.measures(forces))
spheres.report(**result)
