#!/usr/bin/env python3
"""Meshes and degrees that follow from an error, scenes with edges and contact: adaptivity_scenes.py MORTISE [--peers DIRECTORY]

Inclusions, re-entrant edges, a crack, waves and balls: estimates, errors where they are known, rates, iterations, seconds, the same on 3 ranks; and, with
--peers, NGSolve and CalculiX on Fichera's corner (ngsolve_fichera.py and calculix_fichera.py in DIRECTORY, tests/benchmarks say). Writes its part of doc/measurements/adaptivity.md and adaptivity_scenes.png; needs matplotlib."""
import argparse
import json
import math
import os
import subprocess
import sys

from adaptivity import CORNER, degrees, error, rows_of_cycles, seconds, unknowns
from contact import MODULUS, contact_of, last, run, westergaard
from page import TOP, write_part

COARSE = ["Body inner/Degree=1", "Body outer/Degree=1", "Body inner/Mesh/Subdivisions=1, 1", "Body outer/Mesh/Subdivisions=2, 1"]
WAVE = [f"Body {body}/{s}" for body, cells in (("lower", "2, 1, 8"), ("upper", "3, 1, 12")) for s in ("Degree=1", "Mesh/Refine near=", f"Mesh/Subdivisions={cells}")]
# name, scene, settings, targets, target on 1 and 3 ranks
SCENES = [("shell, stiff inside", "thick_sphere", COARSE + ["Body inner/Material/Young modulus=1e4"], (1e-2, 1e-3), 1e-3),
          ("shell, soft inside", "thick_sphere", COARSE + ["Body inner/Material/Young modulus=1e-2"], (1e-2, 1e-3), 1e-3),
          ("stiff cube", "inclusion", [], (3e-2, 1e-2, 1e-3), 3e-2),
          ("L, 24 cells", "l_interface", ["Body corner/Mesh/Refinements=1", "Adaptivity/Largest number of unknowns=5e6"], (1e-1, 2.5e-2, 1.4e-2), 2.5e-2),
          ("L", "l_interface", [], (1e-1, 4e-2, 2.5e-2, 1e-2), 2.5e-2),
          ("L, slab the slave", "l_interface", ["Interface between/Slave=slab: zmax", "Interface between/Master=corner: zmin"], (1e-1, 4e-2, 2.5e-2),
           2.5e-2),
          ("crack", "crack", [], (1e-1, 3e-2, 1e-2), 5e-2),
          ("wave", "wavy_surface", WAVE, (1e-1, 1e-2, 1e-3), 1e-2),
          ("ball", "hertz_adaptive", [], (1e-1, 1e-2, 2e-3), 1e-2),
          ("paraboloid", "hertz_half_spaces", [], (1e-1, 1e-2, 2e-3), 1e-2)]
FORCES = {"stiff cube": "pull", "L": "plate", "L, slab the slave": "plate", "L, 24 cells": "plate"}
REFERENCES = {}  # of forces, by name: of the finest run of the first scene that has it
FICHERA = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4)


def rate(points):
    """r of N^-r by least squares in logarithms."""
    logs = [(math.log(n), math.log(e)) for n, e in points]
    mean = [sum(c) / len(logs) for c in zip(*logs)]
    return -sum((a - mean[0]) * (b - mean[1]) for a, b in logs) / sum((a - mean[0])**2 for a, _ in logs)


def estimates(summary):
    return [(step["dofs"]["total"], step["adaptivity"]["estimate"]) for step in summary["steps"] if "estimate" in step["adaptivity"]]


def force(step, name):
    return abs(dict(step["quantities"])[FORCES[name]][2])


def attempt(mortise, scene, settings, times):
    """Nothing where the target is not reached."""
    try:
        return seconds(mortise, scene, settings, times)
    except subprocess.CalledProcessError as failure:
        if failure.returncode != 3:
            raise
        return None


def most_iterations(summary):
    return max(step["solver"]["iterations"] for step in summary["steps"])


def meshes(summary):
    return [[(b["cells"], b["degree_min"], b["degree_max"], b["dofs"]) for b in step["bodies"]] for step in summary["steps"]]


def scenes(mortise):
    """Rows of all, of cycles, of rates, of contact, of ranks; points of the plot."""
    whole, cycles, rates, touches, ranks, plots = [], [], [], [], [], {}
    for name, scene, settings, targets, moderate in SCENES:
        summary = None
        for target in targets:
            found = attempt(mortise, scene, settings + [f"Adaptivity/Target error={target}"], 1 if target < 1.5e-2 else 3)
            if not found:
                whole.append(f"| {name} | {target:.1e} | not reached (exit code 3) | | | | | | |")
                print(whole[-1], flush=True)
                continue
            time, summary = found
            of = last(summary)
            if name == "wave":  # what the exact solution costs is not in the seconds
                summary = run(mortise, scene, *settings, f"Adaptivity/Target error={target}", *westergaard())
                assert unknowns(summary) == of["dofs"]["total"]
                of = last(summary)
            known = f"{error(summary):.2e} | {of['adaptivity']['estimate'] / error(summary):.2f}" if "errors" in of else "- | -"
            met = ("yes" if error(summary) <= target else "no") if "errors" in of else "-"
            whole.append(f"| {name} | {target:.1e} | {of['adaptivity']['estimate']:.2e} | {known} | {met} | {unknowns(summary)} | {time:.2f} | {most_iterations(summary)} |")
            print(whole[-1], flush=True)
            if any("contact" in interface for interface in of["interfaces"]):
                touches.append(touch(name, target, of))
        plots[name + ", estimate"] = estimates(summary)
        half = estimates(summary)[-max(4, len(estimates(summary)) // 2):]
        parts = [f"{rate(half):.2f}", "-", f"{rate(estimates(summary)):.2f}", "-"]
        if "errors" in last(summary):
            plots[name] = [(step["dofs"]["total"], step["errors"]["energy"]) for step in summary["steps"]]
            parts[1], parts[3] = f"{rate(plots[name][-len(half):]):.2f}", f"{rate(plots[name]):.2f}"
        rates.append(f"| {name} | {' | '.join(parts)} | {half[0][0]} to {half[-1][0]} |")
        cycles.extend(of_cycles(name, summary))
        both = [run(mortise, scene, *settings, f"Adaptivity/Target error={moderate}", ranks=n) for n in (1, 3)]
        same = meshes(both[0]) == meshes(both[1])
        apart = max(abs(a[1] / b[1] - 1) for a, b in zip(*map(estimates, both)))
        ranks.append(f"| {name} | {moderate:.1e} | {len(both[0]['steps'])} | {unknowns(both[0])} | {'yes' if same else 'NO: ' + differ(*both)} | {apart:.1e} | "
                     f"{most_iterations(both[0])} and {most_iterations(both[1])} |")
        print(rates[-1], ranks[-1], *touches[-1:], sep="\n", flush=True)
    return whole, cycles, rates, touches, ranks, plots


def differ(one, three):
    """The first cycle that is not the same."""
    for a, b, c, d in zip(meshes(one), meshes(three), one["steps"], three["steps"]):
        if a != b:
            return f"cycle {c['cycle']}, {c['dofs']['total']} and {d['dofs']['total']}"
    return f"{len(one['steps'])} and {len(three['steps'])} cycles"


def of_cycles(name, summary):
    if "errors" in last(summary):
        yield from rows_of_cycles(name, last(summary)["adaptivity"]["target"], summary)
        return
    final = last(summary)
    if name in FORCES:
        less = final["adaptivity"]["estimate"]**2 if name == "stiff cube" else 0.
        REFERENCES.setdefault(FORCES[name], force(final, name) / (1 + less))
    for step in summary["steps"]:
        by_force = "-"
        if name in FORCES:
            off = force(step, name) / REFERENCES[FORCES[name]] - 1
            by_force = f"force {off:+.1e}" + (f", {math.sqrt(off):.2e}" if off > 0 else "")
        of = step["adaptivity"]
        estimate = f"{of['estimate']:.2e}" if "estimate" in of else "-"
        yield (f"| {name}, {of['target']:.1e} | {step['cycle']} | {degrees(step)} | {sum(b['cells'] for b in step['bodies'])} | {step['dofs']['total']} | {by_force} | {estimate} | - | "
               f"{step['solver']['iterations']} |")


def touch(name, target, step):
    contact = contact_of(step)
    if name == "wave":
        return (f"| {name} | {target:.0e} | {step['dofs']['total']} | {contact['area'] / 0.25 * 3 - 1:+.2e} | {contact['pressure_max'] / 8.631086 - 1:+.1e} | "
                f"{step['solver']['active_sets']} | {step['solver']['linear_iterations']} |")
    whole = 4 * abs(contact["force"][2])
    radius = (3 * whole / (4 * MODULUS))**(1 / 3)
    return (f"| {name} | {target:.0e} | {step['dofs']['total']} | {math.sqrt(4 * contact['area'] / math.pi) / radius - 1:+.2e} | "
            f"{contact['pressure_max'] / (3 * whole / (2 * math.pi * radius**2)) - 1:+.1e} | {step['solver']['active_sets']} | {step['solver']['linear_iterations']} |")


def lines_of(script, *arguments):
    """What a script of another program prints."""
    output = subprocess.run([sys.executable, script, *arguments], check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in output.splitlines() if line.startswith("{")]


def corner(mortise, peers):
    """Errors, unknowns and seconds at Fichera's corner by program."""
    found = {"Mortise": []}
    for target in FICHERA:
        time, summary = seconds(mortise, "fichera", CORNER + [f"Adaptivity/Target error={target}"])
        found["Mortise"].append((error(summary), unknowns(summary), time, time))
    if peers:
        peers = os.path.abspath(peers)
        for of in lines_of(os.path.join(peers, "ngsolve_fichera.py")):
            name = f"NGSolve, hp, size {of['size']}" if of["kind"] == "hp" else f"NGSolve, h, order {of['order']}"
            found.setdefault(name, []).append((of["error_energy"], of["dofs"], of["seconds"], of.get("seconds_with_estimates", of["seconds"])))
        for of in lines_of(os.path.join(peers, "calculix_fichera.py"), "--most", "90000"):
            if of["fastest"]:
                found.setdefault(f"CalculiX, {of['element']}", []).append((of["error_energy"], of["dofs"], of["seconds"], of["seconds"]))
    rows = []
    for target in FICHERA:
        row = [f"{target:.0e}"]
        for kind in ("Mortise", "NGSolve, hp", "NGSolve, h,", "CalculiX"):
            good = [(run[2], run, name) for name, runs in found.items() if name.startswith(kind) for run in runs if run[0] <= target]
            if not good:
                row += ["not reached", "", ""]
                continue
            _, (reached, n, alone, with_estimates), name = min(good)
            time = f"{alone:.2f}" if alone == with_estimates else f"{alone:.2f} ({with_estimates:.2f}), {name.split(', ')[-1]}"
            row += [f"{reached:.1e}", str(n), time]
        rows.append(f"| {' | '.join(row)} |")
        print(rows[-1], flush=True)
    return rows, found


def draw(plots, programs):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 3, figsize=(15, 4.5))
    colours = {}
    for name, points in plots.items():
        scene = name.replace(", estimate", "")
        colour = colours.setdefault(scene, f"C{len(colours)}")
        axes[0].loglog(*zip(*points), "x:" if "estimate" in name else "o-", color=colour, markersize=4,
                       label=None if name != scene and scene in plots else name)
    axes[0].set_title("scenes; crosses: estimates")
    axes[0].set_ylabel("error in energy")
    for name, points in programs.items():
        style = "o-" if name == "Mortise" else "s--" if "hp" in name else "^-." if name.startswith("CalculiX") else "x:"
        axes[1].loglog([p[1] for p in points], [p[0] for p in points], style, label=name)
        axes[2].loglog([p[2] for p in points], [p[0] for p in points], style, label=name)
    axes[1].set_title("Fichera's corner")
    axes[2].set_title("Fichera's corner")
    for ax, x in zip(axes, ("unknowns", "unknowns", "seconds, all cycles, one core")):
        ax.set_xlabel(x)
        ax.grid(alpha=0.3)
    axes[0].legend(fontsize=6)
    axes[1].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(os.path.join(TOP, "doc", "measurements", "adaptivity_scenes.png"), dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mortise")
    parser.add_argument("--peers")
    arguments = parser.parse_args()
    mortise = os.path.abspath(arguments.mortise)
    whole, cycles, rates, touches, ranks, plots = scenes(mortise)
    fichera, programs = corner(mortise, arguments.peers)
    draw(plots, programs)
    tables = {"whole": whole, "cycles": cycles, "rates": rates, "touches": touches, "ranks": ranks, "fichera": fichera}
    write_part("adaptivity.md", "edges", TEXT.format(**{name: "\n".join(rows) for name, rows in tables.items()}))


TEXT = """## Edges and contact

Regenerate: `tests/benchmarks/adaptivity_scenes.py build/mortise --peers tests/benchmarks` writes this section and the plot; without NGSolve leave
out `--peers`. Intel Xeon with AVX-512, one core; the other core was busy, which makes seconds 1.3 to 2 times too long.

What is missed:

- Unknowns of the L: three cubes have an error of 7.6e-2 with 1,800 unknowns, but 1e-1 is only accepted with 9,510. The L of 24 cells has 2.6e-2
  with 45,024 unknowns, and 2.5e-2 is accepted with 119,916 (the errors are computed from fields, see "Hard scenes"). With the slab as the slave 1e-1 takes 38,229.
- The stiff cube does not reach 1e-3 and the crack does not reach 1e-2 with 2 million unknowns: cells are isotropic, and errors at edges fall as N^-0.5.
- At the crack estimates are 1.54 to 1.55 times the error from cycle 4 on, although the error falls by exactly the root of 2 from cycle to cycle:
  15,245 unknowns would meet 1e-1 (64,349 are taken) and 134,841 would meet 3e-2 (545,541). The goal at the end is 0.9 to 1.5; a shell has 0.84.
  Over all cycles the largest is 2.34 (crack, cycle 2) and the least 0.84.
- The wave meets 1e-3 with 212,445 unknowns, but ends with 368,021, since its estimate is 1.92 times the error there.
- The radius of contact by its area (goal: 0.1 %) is off by 0.06 % for the ball and 0.12 % for the paraboloid at 2e-3, and by 0.5 and 0.4 % at 1e-2.
  The half-width of the wave is off by 3.1 % at 1e-2 and by 0.8 % at 1e-3: the area is known up to one cell. Largest pressures are off by 1e-4 to 4e-4 at 1e-2.
- First estimates of contact are up to 1.25 (paraboloid).
- NGSolve takes 0.1 to 0.6 of the unknowns at Fichera's corner, and less time down to 3e-2, if it is told where the corner is.

![Scenes, and Fichera's corner beside NGSolve](adaptivity_scenes.png)

### All scenes with edges or contact

Goals: the error is below the target, the estimate is 0.9 to 1.5 times the error at the end, and no cycle has more than 14 iterations. All begin
with degree 1. Seconds are those of all cycles without the reading of meshes and without the exact solution of the wave; they are medians of 3, below 1.5e-2 of 1.

- Shells: `prm/thick_sphere.prm` from 3 and 12 cells, the inner shell a thousand times as stiff or as soft as the outer one, Lame's solution.
- Stiff cube: `prm/inclusion.prm`, an octant of a block around a cube that is a thousand times as stiff; no exact solution.
- L: `prm/l_interface.prm`, seven cubes around a re-entrant corner of the interface; no exact solution. The slave is the L, of 3 or 24 cells, or the slab below.
- Crack: `prm/crack.prm`, the edge of a crack on the interface, with the exact solution of mode I.
- Wave: `prm/wavy_surface.prm` from 16 and 36 cells, with Westergaard's displacement. Ball: `prm/hertz_adaptive.prm`. Paraboloid:
  `prm/hertz_half_spaces.prm`. The last two have no exact solution.

| scene | target | estimate | error | estimate by error | met | unknowns | seconds | most iterations |
|---|---|---|---|---|---|---|---|---|
{whole}

### Rates at edges and in contact

The table has r of N^-r by least squares, for the last half of the cycles (at least four) and for all. The goal for contact is 1 and more; at edges
isotropic cells give 0.5.

| scene | estimates, last half | errors, last half | estimates, all | errors, all | unknowns of the last half |
|---|---|---|---|---|---|
{rates}

### Contact

The half-width of the wave is compared with 1/3 and its pressure with 8.6311; radius and largest pressure of ball and paraboloid are compared with
Hertz's for the computed force. The goal is a radius to 1e-3. Westergaard's exact displacement is that of `tests/benchmarks/contact.py`
(`westergaard`). The root of the work of the load is not the energy error here: with cells graded twice at p = 2 and three times at p = 4 errors are
6.9e-3 and 2.4e-4, and those roots 5.0e-3 and 2.0e-3. Hertz's formulas hold to about (a/R)^2 = 1e-2 for the ball, since a circle is not his
parabola, and to about (1/16)^3 for the paraboloid between blocks of 16 radii.

| scene | target | unknowns | width or radius - 1 | largest pressure - 1 | sets of the last cycle | iterations of all of them |
|---|---|---|---|---|---|---|
{touches}

### One rank and three

The goal is the same cells, degrees and unknowns in every cycle.

| scene | target | cycles | unknowns | the same | estimates apart | most iterations |
|---|---|---|---|---|---|---|
{ranks}

### NGSolve and CalculiX on Fichera's corner

All programs have the same solution and loads and one core; the table shows of each the fastest run that meets the target.

NGSolve 6.2.2608 (`tests/benchmarks/ngsolve_fichera.py`) has one conforming mesh of tetrahedra. In the series "hp" the corner is named in advance:
`RefineHP` with as many levels as the order, on 33 or about 300 elements, and one solve. In the series "h" the orders are 1 to 4 with ZZ estimates
and bisection, and seconds are those of the solves of all cycles (in brackets with the recovery of fluxes). The faster of BDDC with CG and a sparse
Cholesky factorisation counts, above 50,000 unknowns BDDC. Seconds of NGSolve are those for spaces, assembly and solution; those of Mortise are all
stages and cycles with errors and estimates, from seven cubes without a hint where the corner is. NGSolve has no hp refinement of hexahedra at a
vertex. Its series end at about 40,000 to 85,000 unknowns.

CalculiX 2.20 (`tests/benchmarks/calculix_fichera.py`) has one conforming mesh of seven cubes, uniformly refined, C3D8 and C3D20, with up to 90,000
unknowns. Its seconds are those of `ccx` with reading and writing and the fastest of its solvers (iterative ones stop at 0.5 % of the mean load). Its
errors fall as N^-0.30 and N^-0.36.

| target | Mortise, error | unknowns | seconds | NGSolve hp, error | unknowns | seconds | NGSolve h, error | unknowns | seconds | CalculiX, error | unknowns | seconds |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
{fichera}

### Each cycle at edges and in contact

Where there is no exact solution, "force" is the force on the loaded plane divided by that of the finest run, minus 1, and its root. (For the stiff
cube the square of the estimate is subtracted from the reference; for the L the reference is that with 24 cells, which is itself 1.1e-2 off.) The plane
is moved by a given amount, so that the root is the error in energy as far as the ties hold exactly. At the L of three cells they do not: in cycle 2
the root is 3.0e-2 where the fields have an error of 7.6e-2, and with the slab as the slave the force falls below the limit in cycle 3. All roots of
the L lack the error of the finest run.

| scene and target | cycle | degrees | cells | unknowns | error | estimate | by error | iterations |
|---|---|---|---|---|---|---|---|---|
{cycles}
"""

if __name__ == "__main__":
    main()
