#!/usr/bin/env python3
"""Meshes and degrees that follow from an error: adaptivity.py MORTISE

Cycles of scenes with a target: unknowns, estimates beside errors, and seconds of all cycles beside the best run of one degree and mesh size,
or beside the mesh that was graded by hand. Writes doc/adaptivity.md and doc/adaptivity.png; needs matplotlib."""
import argparse
import math
import os
import statistics

from contact import run

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SPHERES = ("thick_sphere", ("inner", "outer"))
BLOCKS = ("manufactured", ("lower", "upper"))
TETRAHEDRA = ["Mesh/Cells=tetrahedra"]
# name, scene, bodies, first degree, targets, more, largest degree of uniform meshes without and with a refinement
SCENES = [("spheres", *SPHERES, 1, (1e-3, 1e-5, 1e-7), [], (8, 3)), ("spheres, tetrahedra", *SPHERES, 1, (1e-4,), TETRAHEDRA, (5, 2)),
          ("spheres, incompressible", *SPHERES, 2, (1e-4,), ["Material/Poisson ratio=0.5"], (6, 2)),
          ("curved blocks", *BLOCKS, 1, (1e-3, 1e-5, 1e-7), [], (8, 3)), ("curved blocks, tetrahedra", *BLOCKS, 1, (1e-4,), TETRAHEDRA, (5, 2)),
          ("press fit, slides", "press_fit", ("bush", "hub"), 1, (1e-4,), [], (6, 2))]
CORNER = [f"Body {body}/Degree=1" for body in BLOCKS[1]] + [f"Body {body}/Mesh/Refine near=" for body in BLOCKS[1]] + [
    "Body lower/Mesh/Subdivisions=2, 2, 1", "Body upper/Mesh/Refinements=0"]


def seconds(mortise, scene, settings, times=3):
    all_times, summary = [], {}
    for _ in range(times):
        summary = run(mortise, scene, *settings)
        all_times.append(summary["timings_s"]["total"] - (0. if "geo" in "".join(settings) else summary["timings_s"]["mesh"]))
    return statistics.median(all_times), summary


def degrees(step):
    return " and ".join(str(b["degree_min"]) if b["degree_min"] == b["degree_max"] else f"{b['degree_min']} to {b['degree_max']}" for b in step["bodies"])


def error(summary):
    return summary["steps"][-1]["errors"]["energy"]


def unknowns(summary):
    return summary["steps"][-1]["dofs"]["total"]


def rows_of_cycles(name, target, summary):
    for step in summary["steps"]:
        of = step["adaptivity"]
        estimate = f"{of['estimate']:.2e} | {of['effectivity']:.2f}" if "estimate" in of else "- | -"
        yield (f"| {name}, {target:.0e} | {step['cycle']} | {degrees(step)} | {sum(b['cells'] for b in step['bodies'])} | {step['dofs']['total']} | "
               f"{step['errors']['energy']:.2e} | {estimate} | {step['solver']['iterations']} |")


def row(name, target, adaptive, best, how):
    (time, summary), (best_time, best_summary) = adaptive, best
    return (f"| {name} | {target:.0e} | {error(summary):.2e} | {unknowns(summary)} | {time:.2f} | {how} | {error(best_summary):.2e} | {unknowns(best_summary)} | {best_time:.2f} | "
            f"{unknowns(summary) / unknowns(best_summary):.2f} | {time / best_time:.1f} |")


def smooth(mortise, cycles, whole):
    for name, scene, bodies, first, targets, more, largest in SCENES:
        common = [f"Body {body}/{setting}" for body in bodies for setting in more]
        uniform = {}
        for n_refinements, most in enumerate(largest):
            for p in range(first, most + 1):
                settings = common + [f"Body {body}/{s}" for body in bodies for s in (f"Degree={p}", f"Mesh/Refinements={n_refinements}")]
                uniform[p, n_refinements] = (settings, run(mortise, scene, *settings))
        for target in targets:
            adaptive = seconds(mortise, scene, common + [f"Body {body}/Degree={first}" for body in bodies] + [f"Adaptivity/Target error={target}"])
            cycles.extend(rows_of_cycles(name, target, adaptive[1]))
            good = [(unknowns(summary), p, n, settings) for (p, n), (settings, summary) in uniform.items() if error(summary) <= target]
            _, p, n, settings = min(good)
            best = seconds(mortise, scene, settings + [f"Solver/Tolerance={1e-3 * target}"])
            whole.append(row(name, target, adaptive, best, f"degree {p}" + (", halved" if n else "")))
            print(whole[-1], flush=True)


def corner(mortise, cycles, whole):
    """Points of the plot: by name errors, unknowns and seconds of runs."""
    by_hand, plots = [], {"graded by hand": [], "hp": [], "hp, estimate": [], "h": [], "p": []}
    for p in range(1, 7):
        settings = [f"Body {body}/{s}" for body in BLOCKS[1] for s in (f"Degree={p}", f"Mesh/Refine near=0, 0, 0, 1e-6, {p}")]
        by_hand.append(seconds(mortise, "fichera", settings + ["Solver/Tolerance=1e-7"], 1))
        plots["graded by hand"].append((error(by_hand[-1][1]), unknowns(by_hand[-1][1]), by_hand[-1][0]))
    for strategy, targets in (("hp", (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4)), ("h", (1e-1, 5e-2)), ("p", (1e-1, 2e-2))):
        for target in targets:
            adaptive = seconds(mortise, "fichera", CORNER + [f"Adaptivity/Strategy={strategy}", f"Adaptivity/Target error={target}"])
            summary = adaptive[1]
            plots[strategy].append((error(summary), unknowns(summary), adaptive[0]))
            if strategy == "hp":
                plots["hp, estimate"].append((summary["steps"][-1]["adaptivity"]["estimate"], unknowns(summary), adaptive[0]))
            best = next((run for run in by_hand if error(run[1]) <= target), None)
            if strategy == "hp" and best and target <= 1e-2:
                whole.append(row("Fichera", target, adaptive, best, "graded by hand"))
                print(whole[-1], flush=True)
        cycles.extend(rows_of_cycles(f"Fichera, {strategy}", targets[-1], summary))
    return plots


def exponent(points):
    """c of exp(-c N^(1/4)), by least squares in logarithms."""
    return -statistics.linear_regression([n**0.25 for _, n, _ in points], [math.log(e) for e, _, _ in points]).slope


def new_meshes(mortise, cycles, whole):
    """The corner with tetrahedra of a geometry: new meshes beside degrees alone."""
    fixed = CORNER + ["Body upper/Mesh/File=../meshes/l_shape_tet.geo", "Body upper/Mesh/Mesh size=0.7"]
    alone = run(mortise, "fichera", *fixed, *(f"Body {body}/Degree=8" for body in BLOCKS[1]))
    for target in (1e-2, 3e-3, 1e-3):
        time, summary = seconds(mortise, "fichera", fixed + [f"Adaptivity/Target error={target}"])
        whole.append(f"| {target:.0e} | {error(summary):.2e} | {unknowns(summary)} | {time:.2f} | {summary['steps'][-1]['adaptivity']['effectivity']:.2f} |")
        print(whole[-1], flush=True)
    cycles.extend(rows_of_cycles("Fichera, new meshes", target, summary))
    return f"degree 8 on all cells leaves an error of {error(alone):.1e} with {unknowns(alone)} unknowns"


def draw(plots):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4), sharey=True)
    for name, points in plots.items():
        style = "o--" if name == "graded by hand" else "x:" if "estimate" in name else "o-"
        left.loglog([p[1] for p in points], [p[0] for p in points], style, label=name)
        right.loglog([p[2] for p in points], [p[0] for p in points], style, label=name)
    left.set_xlabel("unknowns")
    left.set_ylabel("error in energy")
    right.set_xlabel("seconds, all cycles")
    left.legend()
    for axes in (left, right):
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(os.path.join(TOP, "doc", "adaptivity.png"), dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mortise")
    mortise = os.path.abspath(parser.parse_args().mortise)
    cycles, whole = [], []
    smooth(mortise, cycles, whole)
    plots = corner(mortise, cycles, whole)
    draw(plots)
    flange = run(mortise, "flange_adaptive")
    meshes = []
    alone = new_meshes(mortise, cycles, meshes)
    with open(os.path.join(TOP, "doc", "adaptivity.md"), "w") as page:
        page.write(TEXT.format(whole="\n".join(whole), cycles="\n".join(cycles), meshes="\n".join(meshes), alone=alone, flange_seconds=flange["timings_s"]["total"],
                               flange_estimate=flange["steps"][-1]["adaptivity"]["estimate"], flange_unknowns=unknowns(flange), exponent=exponent(plots["hp"]), by_hand=exponent(plots["graded by hand"])))


TEXT = """# An error in place of a mesh

Regenerate: `tests/benchmarks/adaptivity.py build/mortise` (writes this page and the plot). Intel Xeon with AVX-512, one core.
Edges, cracks, contact, NGSolve and CalculiX beside it: [adaptivity_scenes.md](adaptivity_scenes.md); one number as target: [adaptivity_quantities.md](adaptivity_quantities.md);
bodies of which one is far coarser, flat or nearly incompressible, contact in load steps: [adaptivity_hard.md](adaptivity_hard.md).

Missed or not there:

- Meshes that go on from step to step: with `Steps` each begins with the first mesh again and has all cycles of its own.
- A solver tolerance that follows the estimate: tried. Solves are a tenth of the time of all cycles (curved blocks at 1e-7: 0.11 of 1.15 s); a tolerance ten times
  as large gains 3 %, one a hundred times as large makes estimates wrong.
- Estimates 0.8 to 4 times the error in single cycles: 0.68 and 0.64 (curved blocks, the first two). At the end 0.9 to 1.5: curved blocks 1.76 and 1.69 at 1e-5 and 1e-7.
- Seconds three times those of the best run without: 6.5, 4.1 and 4.7 beside cells graded by hand (Fichera at 1e-3, 3e-4 and 1e-4: an estimate that is 0.96 of the target is not enough, the
  next cycle leaves 0.4 of it), 4.1 and 4.6 beside the best uniform degree (curved blocks at 1e-3 and 1e-7). Unknowns are up to 1.70 times (Fichera at 1e-3; goal 1.5).
- New meshes to 1e-2 take 79,878 unknowns, degree 8 on all cells of the first mesh 58,803. `prm/flange_adaptive.prm` takes 290,045 unknowns; estimated by changes it ended with 74,753, where
  residuals estimate 0.07, perhaps 0.10.

![Fichera's corner: error over unknowns and over seconds](adaptivity.png)

## All cycles

Hexahedra are cut or rise in degree (`Strategy = hp`), tetrahedra rise, from the first degree and the mesh of the scene; Fichera's corner from seven cubes (`prm/fichera_adaptive.prm`). Beside
them the uniform degree and mesh (the scene's, or halved) with the fewest unknowns that meets the target, and, at the corner, cells that were graded by hand
(`doc/hp.md`). Seconds without reading meshes, medians of 3 (by hand 1); linear solves of both stop at a thousandth of the target (by hand 1e-7). Goals: unknowns 1.5 times, seconds 3 times.

| scene | target | error | unknowns | seconds | best run without | its error | unknowns | seconds | ratio of unknowns | of seconds |
|---|---|---|---|---|---|---|---|---|---|---|
{whole}

At Fichera's corner errors at the end fall as exp(-{exponent:.2f} N^(1/4)) from 1e-1 to 1e-4, those of cells graded by hand as exp(-{by_hand:.2f} N^(1/4)).

`prm/flange_adaptive.prm`, five bodies of gmsh, to 1 % of its energy (a tenth of its norm): estimate {flange_estimate:.3f}, {flange_unknowns} unknowns, {flange_seconds:.1f} s (goal 30 s on
two cores; no exact solution).

Fichera's corner from four cubes and, above them, 162 tetrahedra (`meshes/l_shape_tet.geo`), which gmsh meshes again up to three times; {alone}. On a new mesh degrees begin two below the old ones, at the first one where
cells were too large, and a cycle passes without an estimate. Where both bodies are tetrahedra 1e-3 is not reached in a minute.

| target | error | unknowns | seconds, with gmsh | estimate by error |
|---|---|---|---|---|
{meshes}

## How

- **Estimate**: of the solution itself what it leaves of its equations: forces inside of cells, tractions between them, on boundaries and on both sides of interfaces (multipliers are their tractions), as squares (h / (pi p))^2 f^2 / E
  and h / p t^2 / E; and the energy that it takes to close what is missing of prescribed displacements (`include/mortise/adapt/residuals.h`). That looks at no other solution, so that no change which is small by chance hides an error. By how much the error is larger
  is seen: a refinement changed the solution by as much, in squares, as the error became smaller (the rest is orthogonal to it), while residuals fell from one number to another; of all bodies together, or of a body alone if that is more (beside one cell
  whose residual falls fast the error of 512 others was 2.1 times the estimate). What earlier cycles have seen counts 0.8 times per cycle, 0.4 of the residual before anything is seen,
  0.8 where it did not fall, 0.15 at least. Errors were 0.15 to 0.74 of residuals in 98 of 100 of 106 meshes of all kinds and degrees 1 to 8, 0.31 in the median.
- **What was tried beside it**: on 60 starts of the campaign below with 12 targets each, by the meshes that today's choice of cells made, measured once before the choice, without a command (false: error above the target at exit code 0; cost: unknowns of all cycles, mean of ratios; not reached: with 20,000 unknowns):

  | target is met by | false of met | largest error by target | cost | reached, of 720 |
  |---|---|---|---|---|
  | changes and how they fall (what was there) | 29 of 427 | 2.9 | 1 | 427 |
  | the same, and two changes that fell have been seen | 8 of 373 | 2.0 | 1.35 | 373 |
  | residuals, times 0.30 always | 0 of 392 | 0.99 | 1.21 | 392 |
  | changes and residuals times 0.30, the larger | 0 of 353 | 0.95 | 1.35 | 353 |
  | residuals, times what was seen in two cycles (built: cell by cell) | 0 of 445 | 0.95 | 1.12 | 445 |

  One more cycle proves nothing: of odd and even degrees, and of cells that miss a field, two changes fall before a large one. Residuals times a constant are a bound up to that constant; what was seen makes it three times sharper. Force inside of cells by h / p, not h / (pi p), spreads errors by residuals
  over 7.3 rather than 5.1 (1 to 99 of 100).
- **Own part**: where the degree of a cell rises, what of its change is its own is at most four times the energy of its new modes, those of the highest degree; how changes fall (h or p, below) is asked of that.
- **Cells that were cut**: likewise, of a family of eight what goes on in those siblings whose coefficients fall about as slowly as the slowest (by factors of at least 0.7 times theirs). Of a `Quantity` errors still follow from changes and how they fall.
- **Perhaps**: errors by residuals are not the same on all cells: the estimate, e, times 1.5 and, where n > 2 refinements in a row have shown how they fall, 1 + 1 / (2 (n - 1)), 7/6 at least, beside what the exact solution may have less than the computed one where displacements are prescribed: e / sqrt(1 - e^2)
  (in the log "estimated error 0.13, perhaps 0.16").
- **Met**: where that is 0.9 of the target or less.
- **Interfaces**: ties and contact hold in the mean over the multipliers' functions. The share of an interface is the energy that it takes to close the jump of the displacements at
  its quadrature points, with two half-spaces and the wave number pi p / h (`include/mortise/mortar/violation.h`); of springs likewise (cells that are thin beside their faces bend), of contact overlap, tension and, of gap and
  pressure, the less. The exact solution has no jump: as far as half-spaces are right this is a lower bound (Pythagoras), and it is added to the estimate, in squares. In `summary.json` squares of
  `estimate_interface` and `estimate_bulk` add up to that of `estimate`; the log names the worst body or interface. Of the true error it is two thirds with one cell below 8x8x8, 0.15
  to 0.4 with ratio 2:3 of curved blocks, a third at the crack, a thousandth or less on spheres; in contact 0.6 to 1.3 (the wave), so there it bounds nothing.
  With `Quantity` there are no residuals, own parts and shares.
- **Edges of contact**: cells, on both sides, of whose faces part presses and part is open are cut from degree three on: behind an edge of contact stresses go as the root of the distance,
  which coefficients up to degree five do not tell from a smooth solution. The wave to 1e-3 took 459,200 unknowns without this. Faces there become smaller than what sides move: partners are looked for as far as they moved in the last cycle.
- **Checkpoints**: `Output/Checkpoint every` counts cycles (with `Steps` those of each step); `--restart` goes on after any of them, on any number of ranks, also with another target or other limits.
- **h or p**: where the degree rises to three and more, Legendre coefficients of derivatives fall by 0.3 to 0.4 per degree on cells at Fichera's corner, by 0.2 to 0.26 on those beside it;
  at 0.28 and above a cell is cut (of bodies in mixed form coefficients of pressures by the modulus count as derivatives: what is missing of a pressure makes rough displacements), unless its changes have fallen tenfold per degree. Three is the least degree at which there are two coefficients beside the constant one.
- **New meshes**: changes of tetrahedra at the corner fall by 0.26 from degree two to three, as squares, by 0.13 beside it; above 0.2 they are not smooth. If those have most of the error of all tetrahedra, edges shrink
  at vertices that have at least 0.3 of the error around them that the worst has, eightfold at most, and sizes are linear from vertex to vertex; without the first condition 126 cells became 40,000.
- **Which cells**: those above a quarter of an equal share of the error that is allowed or, while that is larger, of the error that is there; fewer if that is enough. Where a cell rises, those around it with less do.

## Starts by lot

`tests/benchmarks/adaptivity_starts.py --binary build/mortise --beside BEFORE --number N --seed S --unknowns U`: boxes, two boxes, seven cubes, an L, shells and cylinders with subdivisions, degrees 1 to 6 (also in a ball), cells cut near corners, tetrahedra, moduli, nu to 0.4999, boundary conditions, strategies and
fields by lot (waves, bumps, poles, layers, fronts, polynomials, r^a at corners and edges); targets 0.08 to 0.9 of the first error. Seconds of the processor, without those of an empty run. A hundred of them are `tests/scenes/adaptivity_starts`.

| seed | unknowns at most | starts | before: met, false, largest error by target | now: met, false, largest | seconds, median of ratios |
|---|---|---|---|---|---|
| 61, by an estimate of 1.25 times | 8000 | 106 | 53, 2, 1.72 | 50, 0, 0.90 | 0.83 |
| 1618033, before bodies learn alone | 20000 | 726 | - | 476, 0, 0.87 | - |
| 5772156 | 20000 | 720 | - | 458, 0, 0.90 | - |
| 141421 | 8000 | 86 | 43, 3, 1.49 | 43, 0, 0.65 | 1.00 |

## Each cycle

Goal: estimates 0.8 to 4 times the error, 0.9 to 1.5 at the end; at most 14 iterations.

| scene and target | cycle | degrees | cells | unknowns | error | estimate | by error | iterations |
|---|---|---|---|---|---|---|---|---|
{cycles}
"""

if __name__ == "__main__":
    main()
