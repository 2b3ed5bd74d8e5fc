#!/usr/bin/python3
"""GetFEM on ironing.py. Prints a JSON line; one thread, MUMPS.

    getfem_ironing.py --p 1|2 [--augment 10] [--finer 1]

Integral large-sliding contact brick by ray tracing with Coulomb's friction, slip from the displacement of the step before; --augment: its parameter; --finer: equal steps in place of each
of ironing.py's. The first guess of a step moves the die with its inside."""
import getfem as gf
import numpy as np

import fit
import ironing
import spheres

o = fit.arguments(augment=10., finer=1)
gf.util_trace_level(0)
gf.util_warning_level(0)
clock = spheres.Clock()
transformation, most = gf.GeoTrans("GT_QK(3,%d)" % o.p), 40
element = gf.Fem("FEM_QK(3,%d)" % o.p)
model = gf.Model("real")
result = dict(code="GetFEM", order=o.p, scale=1, method="augmentation %g, steps / %d" % (o.augment, o.finer))
times, forces, iterations, rules = [], [], 0, []
try:
    for k, (young, (points, cells)) in enumerate(zip((ironing.SOFT, ironing.STIFF), ironing.bodies(1, 1, np.array(transformation.pts()).T)), 1):
        mesh = gf.Mesh("empty", 3)
        mesh.add_convex(transformation, np.asfortranarray(np.transpose(points[cells], (2, 1, 0))))
        at = mesh.pts()
        height = 0.6 - np.hypot(at[0] - 1, at[2] - 0.6) if k == 2 else at[2]  # above the interface
        for region, on in ((1, abs(height - (-1, 0.3)[k - 1]) < 1e-9), (2, abs(height) < 1e-9), (3, abs(at[1]) < 1e-9), (4, abs(at[1] - ironing.WIDTH) < 1e-9)):
            mesh.set_region(region, mesh.faces_from_pid(np.where(on)[0]))
        mesh.set_region(5, np.concatenate([mesh.region(r) for r in (3, 4)], axis=1))
        field, whole = gf.MeshFem(mesh, 3), gf.MeshFem(mesh, 1)
        field.set_fem(element)
        whole.set_fem(element)
        rule = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,%d)" % (2 * o.p)))
        rules.append(gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(3,%d)" % (2 * o.p + 2))))
        model.add_fem_variable("u%d" % k, field)
        model.add_initialized_data("law%d" % k, [young * ironing.POISSON / (1 + ironing.POISSON) / (1 - 2 * ironing.POISSON), young / 2 / (1 + ironing.POISSON)])
        model.add_finite_strain_elasticity_brick(rule, "Compressible_Neo_Hookean_Bonet", "u%d" % k, "law%d" % k)
        model.add_initialized_fem_data("w%d" % k, field, np.zeros(field.nbdof()))
        model.add_filtered_fem_variable("y%d" % k, whole, 5)
        model.add_linear_term(rule, "u%d(2)*Test_y%d + y%d*Test_u%d(2)" % (k, k, k, k), 5)
        for c in (1, 3):
            name = "h%d%d" % (k, c)
            model.add_filtered_fem_variable(name, whole, 1)
            model.add_initialized_data("m" + name, [0.])
            model.add_linear_term(rule, "(u%d(%d)-m%s)*Test_%s + %s*Test_u%d(%d)" % (k, c, name, name, name, k, c), 1)
    model.add_filtered_fem_variable("l", field, 2)
    model.add_initialized_data("r", [o.augment])
    model.add_initialized_data("f", [ironing.MU])
    brick = model.add_integral_large_sliding_contact_brick_raytracing("r", 0.3, "f")
    model.add_slave_contact_boundary_to_large_sliding_contact_brick(brick, rules[1], 2, "u2", "l", "w2")
    model.add_master_contact_boundary_to_large_sliding_contact_brick(brick, rules[0], 2, "u1", "w1")
    before, last = 0., ironing.motion(0)
    for time in ironing.TIMES:
        for s in range(1, o.finer + 1):
            move = ironing.motion(before + (time - before) * s / o.finer)
            guess = np.array(model.variable("u2"))
            for c in (0, 2):
                model.set_variable("mh2%d" % (c + 1), [move[c]])
                guess[c::3] += move[c] - last[c]
            model.set_variable("u2", guess)
            last = move
            found = model.solve("max_res", 1e-6, "max_iter", most, "lsolver", "mumps")
            steps = int(np.asarray(found[0] if isinstance(found, (tuple, list)) else found).ravel()[0])
            iterations += steps
            if steps >= most:
                raise RuntimeError("no convergence")
            for k in (1, 2):
                model.set_variable("w%d" % k, model.variable("u%d" % k))
        before = time
        times.append(time)
        forces.append([float(np.asarray(gf.asm_generic(rules[1], 0, "h2%d" % c, 1, model)).ravel()[0]) for c in (1, 3)])
except Exception as failure:  # GetFEM raises its own errors
    result["failure"] = "t > %g: " % (times[-1] if times else 0) + str(failure)[:200]
result.update(clock.stop(), newton=iterations, steps_taken=len(times) * o.finer, unknowns=model.nbdof())
if times:
    result.update(ironing.measures(times, forces))
spheres.report(**result)
