#!/usr/bin/env python3
"""Kratos on partial slip of Cattaneo and Mindlin (scene, meshes and figures: cattaneo.py). The last line of stdout is a JSON line.

    pip install KratosMultiphysics KratosStructuralMechanicsApplication KratosContactStructuralMechanicsApplication KratosLinearSolversApplication numpy scipy
    kratos_cattaneo.py --scene line|point --n 48 [--type ALMContactFrictional|PenaltyContactFrictional] [--normal 2] [--tangential 4] [--most 60]
                       [--tolerance 1e-6] [--tangent FACTOR] [--mixed 0|1] [--builder elimination|block] [--solver LinearSolversApplication.sparse_lu]

Mortar contact with an augmented Lagrangian (or a penalty); in three dimensions hexahedra of eight nodes only (SmallDisplacementElement3D8N). Where nodes are held in y the
multipliers across the load are fixed, too, since their rows are empty; that needs the builder that eliminates fixed unknowns: with `block` the matrix is singular. --mixed 1 is
Kratos's default, which condenses the multipliers; here it does not converge. The surfaces given to the search end at --reach times B. On the point the matrix becomes
singular in some steps and not in others: --normal 1 --tangential 8 passes for n = 8 and 12, the default steps do not. One thread (OMP_NUM_THREADS=1).

Figures come from the forces at the nodes; `printed` has those of the multipliers and of the slip flags. seconds: wall time of initialising contact and of all steps; cpu: the same of
the processor. iterations: of each step; a step that does not converge within --most iterations ends the run unless --go_on 1."""
import argparse
import json
import os
import resource
import time

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
import KratosMultiphysics as KM
import KratosMultiphysics.ContactStructuralMechanicsApplication as Contact
import KratosMultiphysics.LinearSolversApplication  # noqa: F401 (adds its solvers)
import KratosMultiphysics.StructuralMechanicsApplication as Structure
from KratosMultiphysics.StructuralMechanicsApplication.structural_mechanics_analysis import StructuralMechanicsAnalysis

import cattaneo

parser = argparse.ArgumentParser()
parser.add_argument("--scene", choices=("line", "point"), default="line")
parser.add_argument("--n", type=int, default=24)
parser.add_argument("--type", default="ALMContactFrictional")
parser.add_argument("--normal", type=int, default=2)
parser.add_argument("--tangential", type=int, default=4)
parser.add_argument("--most", type=int, default=60)
parser.add_argument("--tolerance", type=float, default=1e-6)
parser.add_argument("--tangent", type=float, default=None)
parser.add_argument("--mixed", type=int, default=0)
parser.add_argument("--solver", default="LinearSolversApplication.sparse_lu")
parser.add_argument("--criterion", default="contact_residual_criterion")
parser.add_argument("--settings", default="{}", help="further contact_settings, JSON")
parser.add_argument("--process", default="{}", help="further parameters of the contact process, JSON")
parser.add_argument("--go_on", type=int, default=0)
parser.add_argument("--fix", type=int, default=1, help="fix the multipliers in y where both sides are held")
parser.add_argument("--reach", type=float, default=1., help="half-width of the contact surfaces over B")
parser.add_argument("--builder", default="elimination")
parser.add_argument("--echo", type=int, default=0)
o = parser.parse_args()
if not o.echo:
    KM.Logger.GetDefaultOutput().SetSeverity(KM.Logger.Severity.WARNING)

points, cells, n_lower, cells_lower, below, above = cattaneo.scene_mesh(o.scene, o.n, 1)
slave = np.where((abs(points[:, 2]) < 1e-9) & (np.arange(len(points)) < n_lower))[0]
on_y = np.ones(len(points), bool) if o.scene == "line" else abs(points[:, 1]) < 1e-9
bottom = np.where(abs(points[:, 2] + cattaneo.EXTENT) < 1e-9)[0]
top = np.where(abs(points[:, 2] - cattaneo.EXTENT) < 1e-9)[0]

penalty = o.type.startswith("Penalty")
contact_settings = dict(mortar_type=o.type, fancy_convergence_criterion=False, use_mixed_ulm_solver=bool(o.mixed), silent_strategy=not o.echo)
for name in ("contact", "frictional_stick_contact", "frictional_slip_contact"):
    contact_settings[name + "_residual_relative_tolerance"] = o.tolerance
    contact_settings[name + "_displacement_relative_tolerance"] = o.tolerance
contact_settings.update(json.loads(o.settings))
process = dict(model_part_name="Structure", contact_model_part={"0": ["Contact_Part_Slave", "Contact_Part_Master"]}, assume_master_slave={"0": ["Contact_Part_Slave"]}, contact_type="Frictional",
               friction_coefficients={"0": cattaneo.FRICTION}, search_parameters=dict(check_gap="check_mapping"))
if o.tangent is not None:
    process["tangent_factor"] = o.tangent
process.update(json.loads(o.process))
parameters = KM.Parameters(json.dumps(dict(
    problem_data=dict(problem_name="cattaneo", parallel_type="OpenMP", start_time=0., end_time=float(o.normal + o.tangential), echo_level=0),
    solver_settings=dict(model_part_name="Structure", domain_size=3, solver_type="Static", echo_level=o.echo, analysis_type="non_linear", time_stepping=dict(time_step=1.), buffer_size=3, model_import_settings=dict(input_type="use_input_model_part"),
                         material_import_settings=dict(materials_filename=""), compute_reactions=True, contact_settings=contact_settings, convergence_criterion=o.criterion,
                         residual_relative_tolerance=o.tolerance, residual_absolute_tolerance=1e-12, displacement_relative_tolerance=o.tolerance, displacement_absolute_tolerance=1e-14,
                         max_iteration=o.most, builder_and_solver_settings=dict(type=o.builder), linear_solver_settings=dict(solver_type=o.solver)),
    processes=dict(contact_process_list=[dict(python_module="penalty_contact_process" if penalty else "alm_contact_process", kratos_module="KratosMultiphysics.ContactStructuralMechanicsApplication",
                                              process_name="PenaltyContactProcess" if penalty else "ALMContactProcess", Parameters=process)]),
    output_processes={})))

model = KM.Model()
part = model.CreateModelPart("Structure")
part.ProcessInfo.SetValue(KM.DOMAIN_SIZE, 3)
analysis = StructuralMechanicsAnalysis(model, parameters)
material = part.CreateNewProperties(1)
for variable, value in ((KM.YOUNG_MODULUS, cattaneo.YOUNG), (KM.POISSON_RATIO, cattaneo.POISSON), (KM.DENSITY, 1.), (KM.CONSTITUTIVE_LAW, Structure.LinearElastic3DLaw())):
    material.SetValue(variable, value)
part.CreateNewProperties(0)
for k, p in enumerate(points):
    part.CreateNewNode(k + 1, *map(float, p))
for e, c in enumerate(cells):
    part.CreateNewElement("SmallDisplacementElement3D8N", e + 1, [int(k) + 1 for k in c], material)
count = 0
def close(which, factor):
    """Cells whose contact face lies within the part of the surfaces that is given to the search."""
    x = abs(points[cells[which]]).min(axis=1)
    reach = o.reach * factor * cattaneo.PATCH[o.scene]
    return which[(x[:, 0] < reach) & ((x[:, 1] < reach) | (o.scene == "line"))]


for name, which, quad in (("Contact_Part_Slave", close(below, 1.), [4, 5, 6, 7]), ("Contact_Part_Master", close(above, 1.3), [0, 3, 2, 1])):
    side = part.CreateSubModelPart(name)
    side.AddNodes([int(k) + 1 for k in np.unique(cells[which][:, quad])])
    for c in cells[which]:
        count += 1
        side.CreateNewCondition("SurfaceCondition3D4N", count, [int(k) + 1 for k in c[quad]], material)

start, cpu = time.perf_counter(), time.process_time()
analysis.Initialize()
nodes = [part.Nodes[k + 1] for k in range(len(points))]
for k in np.where(on_y)[0]:
    if o.fix != 2 or not (points[k, 2] == 0 and k < n_lower):
        nodes[k].Fix(KM.DISPLACEMENT_Y)
    if o.fix == 1 and not penalty and points[k, 2] == 0 and k < n_lower:
        nodes[k].Fix(KM.VECTOR_LAGRANGE_MULTIPLIER_Y)
for k in np.concatenate([bottom, top]):
    for variable in (KM.DISPLACEMENT_X, KM.DISPLACEMENT_Y, KM.DISPLACEMENT_Z):
        nodes[k].Fix(variable)
factor = 1 / cattaneo.THICKNESS if o.scene == "line" else 2
iterations, converged, failure = [], [], None
solver = analysis._GetSolver()
try:
    for number, (d, s) in enumerate(cattaneo.steps(o.scene, o.normal, o.tangential)):
        analysis.time = solver.AdvanceInTime(analysis.time)
        analysis.InitializeSolutionStep()
        for k in top:
            nodes[k].SetSolutionStepValue(KM.DISPLACEMENT_X, s)
            nodes[k].SetSolutionStepValue(KM.DISPLACEMENT_Z, -d)
        solver.Predict()
        converged.append(bool(solver.SolveSolutionStep()))
        iterations.append(int(part.ProcessInfo[KM.NL_ITERATION_NUMBER]))
        analysis.FinalizeSolutionStep()
        if not converged[-1] and not o.go_on:
            failure = "step %d of %d did not converge in %d iterations" % (number + 1, o.normal + o.tangential, o.most)
            break
except Exception as error:  # Kratos raises its own errors
    failure = repr(error)[:200]
seconds, cpu = time.perf_counter() - start, time.process_time() - cpu
usage = resource.getrusage(resource.RUSAGE_SELF)
result = dict(code="kratos " + KM.Kernel.Version().split("-")[0].replace('"', ""), scene=o.scene, n=o.n, order=1, elements="hexahedra of 8 nodes", method=o.type, tolerance=o.tolerance, steps=[o.normal, o.tangential], unknowns=3 * len(points),
              seconds=round(seconds, 2), cpu=round(cpu, 2), memory_MB=round(usage.ru_maxrss / 1024), solver=o.solver, options={k: v for k, v in vars(o).items() if k in ("tangent", "mixed", "builder", "criterion", "reach")},
              iterations=[iterations[:o.normal], iterations[o.normal:]], converged=failure is None and all(converged), failure=failure)
displacements = np.array([list(n.GetSolutionStepValue(KM.DISPLACEMENT)) for n in nodes])
faces = cattaneo.contact_faces(cells[below], slave)
traction, force = cattaneo.tractions(points, cells[below], displacements, slave, 2)
P, Q = -force[2] * factor, abs(force[0]) * factor
if P > 0:
    slips = np.array([nodes[k].Is(KM.SLIP) for k in slave])
    figures = cattaneo.evaluate(o.scene, points[slave], faces, traction, P, Q)
    result.update(figures)
    if not penalty:
        scale = part.ProcessInfo[KM.SCALE_FACTOR]
        multipliers = scale * np.array([list(nodes[k].GetSolutionStepValue(KM.VECTOR_LAGRANGE_MULTIPLIER)) for k in slave])
        multipliers *= -np.sign(multipliers[:, 2].sum()) or 1
        own = cattaneo.evaluate(o.scene, points[slave], faces, multipliers, P, Q, slips)
        result["printed"] = {k: own[k] for k in ("force_from_pressure", "force_from_shear", "error_pressure", "error_shear", "a_nodes", "c_over_a_nodes") if k in own}
print(json.dumps(result))
