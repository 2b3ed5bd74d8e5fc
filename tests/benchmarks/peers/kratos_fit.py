#!/usr/bin/env python3
"""Kratos on the press fit of fit.py. Prints a JSON line; one thread.

    pip install KratosMultiphysics KratosStructuralMechanicsApplication KratosConstitutiveLawsApplication KratosContactStructuralMechanicsApplication KratosLinearSolversApplication numpy scipy
    kratos_fit.py --n 7 [--layers 3,3] [--type ALMContactFrictionless|PenaltyContactFrictionless] [--slave inner|outer] [--simplified] [--guess]

Mortar contact of linear faces, which are all that it has, by an augmented Lagrangian; HyperElastic3DLaw is the law `log`. The overlap is that of the meshes; --guess: both sides at the middle
radius as a first guess; --simplified: simplified_semi_smooth_newton."""
import json
import os

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
import KratosMultiphysics as KM
import KratosMultiphysics.ConstitutiveLawsApplication as Laws
import KratosMultiphysics.ContactStructuralMechanicsApplication as Contact
import KratosMultiphysics.LinearSolversApplication  # noqa: F401 (adds its solvers)
from KratosMultiphysics.StructuralMechanicsApplication.structural_mechanics_analysis import StructuralMechanicsAnalysis

import fit
import spheres

COMPONENTS = (KM.DISPLACEMENT_X, KM.DISPLACEMENT_Y, KM.DISPLACEMENT_Z)
o = fit.arguments(p=1, type="ALMContactFrictionless", simplified=False, slave="inner", guess=False)
augmented = o.type.startswith("ALM")
KM.Logger.GetDefaultOutput().SetSeverity(KM.Logger.Severity.WARNING)
clock = spheres.Clock()
nodes = spheres.CORNERS // 2
bodies = fit.shells(o.n, o.m, 1, nodes)
count = len(bodies[0][0])
points = np.concatenate([b[0] for b in bodies])
cells = [bodies[0][1], bodies[1][1] + count]
faces = [body[side][:, on] for body, side, on in zip(cells, fit.side_cells(o.n, o.m), (slice(4, None), slice(3, None, -1)))]
slave, master = faces if o.slave == "inner" else faces[::-1]
held = np.argwhere(abs(points) < 1e-9)
tolerances = {"%s%s_%s_tolerance" % (c, q, k): v for c in ("", "contact_") for q in ("displacement", "residual") for k, v in (("relative", 1e-6), ("absolute", 1e-10))}
process = dict(model_part_name="Structure", contact_model_part={"0": ["Slave", "Master"]}, assume_master_slave={"0": ["Slave"]}, contact_type="Frictionless", normal_variation="no_derivatives_computation",
               search_parameters=dict(check_gap="check_mapping", search_factor=3.5))
settings = KM.Parameters(json.dumps(dict(
    problem_data=dict(problem_name="fit", parallel_type="OpenMP", start_time=0., end_time=1., echo_level=0),
    solver_settings=dict(buffer_size=2, model_part_name="Structure", domain_size=3, solver_type="Static", echo_level=0, analysis_type="non_linear", time_stepping=dict(time_step=1.), model_import_settings=dict(input_type="use_input_model_part"),
                         material_import_settings=dict(materials_filename=""), compute_reactions=True, convergence_criterion="contact_residual_criterion", max_iteration=50, linear_solver_settings=dict(solver_type="LinearSolversApplication.sparse_lu"),
                         contact_settings=dict(mortar_type=o.type, use_mixed_ulm_solver=True, fancy_convergence_criterion=False, simplified_semi_smooth_newton=o.simplified, silent_strategy=True,
                                               **{k: v for k, v in tolerances.items() if k.startswith("contact")}), **{k: v for k, v in tolerances.items() if not k.startswith("contact")}),
    processes=dict(contact_process_list=[dict(python_module="alm_contact_process" if augmented else "penalty_contact_process", kratos_module="KratosMultiphysics.ContactStructuralMechanicsApplication", process_name="x", Parameters=process)]), output_processes={})))
result = dict(code="Kratos", element="8N", order=1, n=o.n, layers=o.layers, method=", ".join([o.type.replace("ContactFrictionless", "")] + ["simplified"] * o.simplified + ["guess"] * o.guess + ["slave outer"] * (o.slave == "outer")))
try:
    model = KM.Model()
    part = model.CreateModelPart("Structure")
    part.ProcessInfo.SetValue(KM.DOMAIN_SIZE, 3)
    analysis = StructuralMechanicsAnalysis(model, settings)
    part.CreateNewProperties(0)
    material = part.CreateNewProperties(1)
    for variable, value in ((KM.YOUNG_MODULUS, fit.YOUNG), (KM.POISSON_RATIO, fit.POISSON), (KM.DENSITY, 1.), (KM.CONSTITUTIVE_LAW, Laws.HyperElastic3DLaw())):
        material.SetValue(variable, value)
    for k, p in enumerate(points):
        part.CreateNewNode(k + 1, *map(float, p))
    for e, c in enumerate(np.concatenate(cells)):
        part.CreateNewElement("TotalLagrangianElement3D8N", e + 1, [int(k) + 1 for k in c], material)
    number = 0
    for name, side in (("Slave", slave), ("Master", master)):
        sub = part.CreateSubModelPart(name)
        sub.AddNodes([int(k) + 1 for k in np.unique(side)])
        for number, face in enumerate(side, number + 1):
            sub.CreateNewCondition("SurfaceCondition3D4N", number, [int(k) + 1 for k in face], material)
    analysis.Initialize()
    for k, c in held:
        part.Nodes[int(k) + 1].Fix(COMPONENTS[c])
    solver = analysis._GetSolver()
    analysis.time = solver.AdvanceInTime(analysis.time)
    analysis.InitializeSolutionStep()
    if o.guess:
        middle = (fit.INNER[1] + fit.OUTER[0]) / 2
        for k, x in enumerate(points):
            r, (start, end) = np.linalg.norm(x), fit.INNER if k < count else fit.OUTER
            moved = (middle - end) * (r - start) / (end - start) if k < count else (middle - start) * (end - r) / (end - start)
            node = part.Nodes[k + 1]
            node.SetSolutionStepValue(KM.DISPLACEMENT, [float(v) for v in x * moved / r])
            node.X, node.Y, node.Z = (float(v) for v in x * (1 + moved / r))
    solver.Predict()
    converged = solver.SolveSolutionStep()
    analysis.FinalizeSolutionStep()
    if not converged:
        raise RuntimeError("no convergence after %d iterations" % part.ProcessInfo[KM.NL_ITERATION_NUMBER])
    result.update(clock.stop(), newton=int(part.ProcessInfo[KM.NL_ITERATION_NUMBER]), unknowns=3 * len(points) - len(held) + len(np.unique(slave)))
    u, reactions = (np.array([list(part.Nodes[k + 1].GetSolutionStepValue(v)) for k in range(len(points))]) for v in (KM.DISPLACEMENT, KM.REACTION))
    exact, inner = fit.Exact(), held[held[:, 0] < count]
    result.update(error=fit.error(exact, bodies, (u[:count], u[count:]), nodes), error_pressure=exact.pressure_error([reactions[inner[inner[:, 1] == c, 0], c].sum() for c in range(3)]))
    if augmented:
        found = np.array([part.Nodes[int(k) + 1].GetSolutionStepValue(Contact.LAGRANGE_MULTIPLIER_CONTACT_PRESSURE) for k in np.unique(slave)]) * part.ProcessInfo[KM.SCALE_FACTOR]
        radius = fit.INNER[1] if o.slave == "inner" else fit.OUTER[0]
        result["error_pressure_max"] = float(abs(-found / (exact.p * (exact.c / radius)**2) - 1).max())
except Exception as failure:  # Kratos raises its own errors
    result.update(clock.stop(), failure=str(failure)[:200])
spheres.report(**result)
