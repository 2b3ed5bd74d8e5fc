#!/usr/bin/env python3
"""Kratos on the two scenes of spheres.py. Prints a JSON line; one thread.

    pip install KratosMultiphysics KratosStructuralMechanicsApplication KratosConstitutiveLawsApplication KratosLinearSolversApplication numpy
    kratos_spheres.py --problem balloon|hill --element TotalLagrangianQ1P0MixedElement3D8N --n 4 --m 4 [--kappa 1e4] [--law NAME] [--steps 1] [--solver LinearSolversApplication.sparse_lu]

balloon: total Lagrangian elements (Q1P0: displacement and one pressure in each cell) with HyperElasticQuasiIncompressibleNeoHookean3DLaw or HyperElastic3DLaw, bulk modulus --kappa. hill:
SmallDisplacementElement3D8N, 3D20N or 3D27N with SmallStrainJ2Plasticity3DLaw or SmallStrainIsotropicPlasticity3DVonMisesVonMises (perfect plasticity), the pressure as forces at nodes; a first step
of 0.4 times the load, which is elastic, goes before --steps equal ones, since these laws are elastic in the first step."""
import argparse
import json
import os
import re

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
import KratosMultiphysics as KM
import KratosMultiphysics.ConstitutiveLawsApplication as Laws
import KratosMultiphysics.LinearSolversApplication  # noqa: F401 (adds its solvers)
import KratosMultiphysics.StructuralMechanicsApplication as Structure
from KratosMultiphysics.StructuralMechanicsApplication.structural_mechanics_analysis import StructuralMechanicsAnalysis

import spheres

HEX27 = [(1, 1, 0), (1, 0, 1), (2, 1, 1), (1, 2, 1), (0, 1, 1), (1, 1, 2), (1, 1, 1)]
parser = argparse.ArgumentParser()
parser.add_argument("--problem", choices=("balloon", "hill"), default="balloon")
parser.add_argument("--element")
parser.add_argument("--law")
parser.add_argument("--n", type=int, default=2)
parser.add_argument("--m", type=int, default=2)
parser.add_argument("--kappa", type=float, default=spheres.KAPPA)
parser.add_argument("--steps", type=int, default=1)
parser.add_argument("--most", type=int, default=40)
parser.add_argument("--tolerance", type=float, default=1e-8)
parser.add_argument("--solver", default="LinearSolversApplication.sparse_lu")
o = parser.parse_args()
balloon = o.problem == "balloon"
o.element = o.element or ("TotalLagrangianQ1P0MixedElement3D8N" if balloon else "SmallDisplacementElement3D20N")
o.law = o.law or ("HyperElasticQuasiIncompressibleNeoHookean3DLaw" if balloon else "SmallStrainJ2Plasticity3DLaw")
KM.Logger.GetDefaultOutput().SetSeverity(KM.Logger.Severity.WARNING)
count = int(re.search(r"3D(\d+)N", o.element).group(1))
order = 1 if count == 8 else 2
nodes = spheres.CORNERS // 2 if count == 8 else np.concatenate([spheres.CORNERS, spheres.MIDDLES[[0, 1, 2, 3, 8, 9, 10, 11, 4, 5, 6, 7]]] + [np.array(HEX27)] * (count == 27))
kind = "serendipity" if count == 20 else "q"

clock = spheres.Clock()
points, cells = spheres.mesh(o.n, o.m, order, nodes)
parameters = KM.Parameters(json.dumps(dict(
    problem_data=dict(problem_name="spheres", parallel_type="OpenMP", start_time=0., end_time=float(o.steps), echo_level=0),
    solver_settings=dict(model_part_name="Structure", domain_size=3, solver_type="Static", echo_level=0, analysis_type="non_linear", time_stepping=dict(time_step=1.), model_import_settings=dict(input_type="use_input_model_part"),
                         material_import_settings=dict(materials_filename=""), compute_reactions=True, convergence_criterion="residual_criterion", residual_relative_tolerance=o.tolerance, residual_absolute_tolerance=1e-10,
                         displacement_relative_tolerance=o.tolerance, displacement_absolute_tolerance=1e-12, max_iteration=o.most, line_search=False, linear_solver_settings=dict(solver_type=o.solver)),
    processes={}, output_processes={})))
model = KM.Model()
part = model.CreateModelPart("Structure")
part.ProcessInfo.SetValue(KM.DOMAIN_SIZE, 3)
analysis = StructuralMechanicsAnalysis(model, parameters)
material = part.CreateNewProperties(1)
poisson = (3 * o.kappa - 2 * spheres.MU) / 2 / (3 * o.kappa + spheres.MU) if balloon else spheres.POISSON
constants = [(KM.YOUNG_MODULUS, 2 * spheres.MU * (1 + poisson) if balloon else spheres.YOUNG), (KM.POISSON_RATIO, poisson), (KM.DENSITY, 1.)]
if not balloon:
    constants += [(KM.YIELD_STRESS, spheres.YIELD)]
    for name, value in dict(EXPONENTIAL_SATURATION_YIELD_STRESS=spheres.YIELD, ISOTROPIC_HARDENING_MODULUS=0., HARDENING_EXPONENT=0., HARDENING_CURVE=3, FRACTURE_ENERGY=1e6).items():
        constants.append((next(getattr(module, name) for module in (KM, Structure, Laws) if hasattr(module, name)), value))
for variable, value in constants:
    material.SetValue(variable, value)
material.SetValue(KM.CONSTITUTIVE_LAW, getattr(Laws, o.law)())
for k, p in enumerate(points):
    part.CreateNewNode(k + 1, *map(float, p))
for e, c in enumerate(cells):
    part.CreateNewElement(o.element, e + 1, [int(k) + 1 for k in c], material)
inner = abs(np.linalg.norm(points, axis=1) - spheres.INNER) < 1e-9
forces = None
if not balloon:
    forces = spheres.pressure_forces(points, cells[spheres.inner_faces(o.n, o.m)], nodes / order, kind)
    part.CreateNewProperties(0)
    loaded = [int(k) for k in np.where(abs(forces).max(axis=1) > 0)[0]]
    for i, k in enumerate(loaded):
        part.CreateNewCondition("PointLoadCondition3D1N", i + 1, [k + 1], part.GetProperties(0))

result = dict(code="Kratos", problem=o.problem, element=o.element, order=order, n=o.n, m=o.m, steps=o.steps, law=o.law, kappa=o.kappa)
try:
    analysis.Initialize()
    all_nodes = [part.Nodes[k + 1] for k in range(len(points))]
    components = (KM.DISPLACEMENT_X, KM.DISPLACEMENT_Y, KM.DISPLACEMENT_Z)
    held = (abs(points) < 1e-9) | (inner[:, None] & balloon)
    for k, c in np.argwhere(held):
        all_nodes[k].Fix(components[c])
    solver, iterations = analysis._GetSolver(), 0
    factors = [0.4] * (not balloon) + [(step + 1) / o.steps for step in range(o.steps)]
    for step, factor in enumerate(factors):
        analysis.time = solver.AdvanceInTime(analysis.time)
        analysis.InitializeSolutionStep()
        if balloon:
            for k in np.where(inner)[0]:
                for c in range(3):
                    all_nodes[k].SetSolutionStepValue(components[c], factor * points[k, c])
        else:
            for k in loaded:
                all_nodes[k].SetSolutionStepValue(Structure.POINT_LOAD, [factor * v for v in forces[k]])
        solver.Predict()
        converged = solver.SolveSolutionStep()
        iterations += int(part.ProcessInfo[KM.NL_ITERATION_NUMBER])
        analysis.FinalizeSolutionStep()
        if not converged:
            raise RuntimeError("step %d of %d did not converge" % (step + 1, len(factors)))
    result.update(clock.stop(), newton=iterations, unknowns=int((~held).sum()), cells=len(cells))
    displacements = np.array([list(n.GetSolutionStepValue(KM.DISPLACEMENT)) for n in all_nodes])
    result["error"] = spheres.error(o.problem, points[cells], displacements[cells], nodes / order, kind)
except Exception as failure:  # Kratos raises its own errors
    result["failure"] = str(failure)[:300]
spheres.report(**result)
