#!/usr/bin/env python3
"""Kratos on o_ring.py. Prints a JSON line; one thread.

    pip install KratosMultiphysics KratosStructuralMechanicsApplication KratosConstitutiveLawsApplication KratosContactStructuralMechanicsApplication KratosLinearSolversApplication numpy scipy
    kratos_o_ring.py [--n 2] [--along 6] [--plate 6,6] [--kappa 1e3] [--type ALMContactFrictionless|PenaltyContactFrictionless] [--finer 1]

Mortar contact of linear faces by an augmented Lagrangian. The ring has TotalLagrangianQ1P0MixedElement3D8N (displacements and one pressure in each cell) with the law
HyperElasticQuasiIncompressibleNeoHookean3DLaw and the bulk modulus --kappa, the plate TotalLagrangianElement3D8N. --finer: equal steps in place of each of o_ring.py's."""
import json
import os

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
import KratosMultiphysics as KM
import KratosMultiphysics.ConstitutiveLawsApplication as Laws
import KratosMultiphysics.ContactStructuralMechanicsApplication  # noqa: F401 (adds its conditions)
import KratosMultiphysics.LinearSolversApplication  # noqa: F401 (adds its solvers)
from KratosMultiphysics.StructuralMechanicsApplication.structural_mechanics_analysis import StructuralMechanicsAnalysis

import fit
import o_ring
import spheres

COMPONENTS = (KM.DISPLACEMENT_X, KM.DISPLACEMENT_Y, KM.DISPLACEMENT_Z)
o = fit.arguments(p=1, type="ALMContactFrictionless", along=6, plate="6,6", kappa=1e3, finer=1)
KM.Logger.GetDefaultOutput().SetSeverity(KM.Logger.Severity.WARNING)
clock = spheres.Clock()
(ring, lower), (flat, upper), skin = o_ring.bodies(o.n, o.along, o.plate, 1, spheres.CORNERS // 2)
points = np.concatenate([ring, flat])
cells = [lower, upper + len(ring)]
held = np.argwhere(abs(points) < 1e-9)
top = np.where(points[:, 2] > o_ring.SECTION + o_ring.PLATE[2] - 1e-9)[0]
slave, master = cells[0][skin][:, 4:], cells[1][:, 3::-1]
tolerances = {"%s%s_%s_tolerance" % (c, q, k): v for c in ("", "contact_") for q in ("displacement", "residual") for k, v in (("relative", 1e-5), ("absolute", 1e-9))}
process = dict(model_part_name="Structure", contact_model_part={"0": ["Slave", "Master"]}, assume_master_slave={"0": ["Slave"]}, contact_type="Frictionless", normal_variation="no_derivatives_computation",
               search_parameters=dict(check_gap="check_mapping", search_factor=3.5))
settings = KM.Parameters(json.dumps(dict(
    problem_data=dict(problem_name="ring", parallel_type="OpenMP", start_time=0., end_time=1., echo_level=0),
    solver_settings=dict(buffer_size=2, model_part_name="Structure", domain_size=3, solver_type="Static", echo_level=0, analysis_type="non_linear", time_stepping=dict(time_step=0.2 / o.finer), model_import_settings=dict(input_type="use_input_model_part"),
                         material_import_settings=dict(materials_filename=""), compute_reactions=True, convergence_criterion="contact_residual_criterion", max_iteration=40, linear_solver_settings=dict(solver_type="LinearSolversApplication.sparse_lu"),
                         contact_settings=dict(mortar_type=o.type, use_mixed_ulm_solver=True, fancy_convergence_criterion=False, silent_strategy=True, **{k: v for k, v in tolerances.items() if k.startswith("contact")}),
                         **{k: v for k, v in tolerances.items() if not k.startswith("contact")}),
    processes=dict(contact_process_list=[dict(python_module="alm_contact_process" if o.type.startswith("ALM") else "penalty_contact_process", kratos_module="KratosMultiphysics.ContactStructuralMechanicsApplication", process_name="x", Parameters=process)]), output_processes={})))
result = dict(code="Kratos", element="8N", order=1, n=o.n, cells="%d along, plate %s" % (o.along, o.plate), method="%s, kappa %g" % (o.type.replace("ContactFrictionless", ""), o.kappa) + (", steps / %d" % o.finer if o.finer > 1 else ""))
forces, iterations = [], 0
try:
    model = KM.Model()
    part = model.CreateModelPart("Structure")
    part.ProcessInfo.SetValue(KM.DOMAIN_SIZE, 3)
    analysis = StructuralMechanicsAnalysis(model, settings)
    part.CreateNewProperties(0)
    for k, p in enumerate(points):
        part.CreateNewNode(k + 1, *map(float, p))
    poisson, number = (3 * o.kappa - 2 * o_ring.MU) / 2 / (3 * o.kappa + o_ring.MU), 0
    for body, (name, law, young, nu) in enumerate((("TotalLagrangianQ1P0MixedElement3D8N", Laws.HyperElasticQuasiIncompressibleNeoHookean3DLaw(), 2 * o_ring.MU * (1 + poisson), poisson),
                                                   ("TotalLagrangianElement3D8N", Laws.HyperElastic3DLaw(), o_ring.STIFF, o_ring.POISSON))):
        material = part.CreateNewProperties(body + 1)
        for variable, value in ((KM.YOUNG_MODULUS, young), (KM.POISSON_RATIO, nu), (KM.DENSITY, 1.), (KM.CONSTITUTIVE_LAW, law)):
            material.SetValue(variable, value)
        for number, cell in enumerate(cells[body], number + 1):
            part.CreateNewElement(name, number, [int(k) + 1 for k in cell], material)
    number = 0
    for name, side in (("Slave", slave), ("Master", master)):
        sub = part.CreateSubModelPart(name)
        sub.AddNodes([int(k) + 1 for k in np.unique(side)])
        for number, face in enumerate(side, number + 1):
            sub.CreateNewCondition("SurfaceCondition3D4N", number, [int(k) + 1 for k in face], part.GetProperties(1))
    analysis.Initialize()
    for k, c in held:
        part.Nodes[int(k) + 1].Fix(COMPONENTS[c])
    for k in top:
        part.Nodes[int(k) + 1].Fix(COMPONENTS[2])
    solver = analysis._GetSolver()
    for step in range(1, o.finer * len(o_ring.TIMES) + 1):
        analysis.time = solver.AdvanceInTime(analysis.time)
        analysis.InitializeSolutionStep()
        moved = -o_ring.SQUEEZE * 0.2 * step / o.finer
        for k in np.unique(cells[1]):  # the plate as a whole, as the first guess
            node = part.Nodes[int(k) + 1]
            node.SetSolutionStepValue(COMPONENTS[2], node.GetSolutionStepValue(COMPONENTS[2]) - o_ring.SQUEEZE * 0.2 / o.finer)
        for k in top:
            part.Nodes[int(k) + 1].SetSolutionStepValue(COMPONENTS[2], moved)
        solver.Predict()
        converged = solver.SolveSolutionStep()
        iterations += int(part.ProcessInfo[KM.NL_ITERATION_NUMBER])
        analysis.FinalizeSolutionStep()
        if not converged:
            raise RuntimeError("no convergence after %d iterations" % part.ProcessInfo[KM.NL_ITERATION_NUMBER])
        if step % o.finer == 0:
            forces.append(sum(part.Nodes[int(k) + 1].GetSolutionStepValue(KM.REACTION)[2] for k in top))
except Exception as failure:  # Kratos raises its own errors
    result["failure"] = "t > %g: " % (o_ring.TIMES[len(forces)] - 0.2) + str(failure)[:200]
result.update(clock.stop(), newton=iterations, unknowns=3 * len(points) - len(held) - len(top) + len(np.unique(slave)), **o_ring.measures(forces))
spheres.report(**result)
