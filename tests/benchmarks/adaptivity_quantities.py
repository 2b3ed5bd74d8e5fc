#!/usr/bin/env python3
"""Errors of numbers: adaptivity_quantities.py MORTISE

Cycles whose target is that of a displacement at a point or of a force, where exact values are known: estimates beside errors, and unknowns
beside those of cycles for the energy. Writes its part of doc/measurements/adaptivity.md and doc/measurements/adaptivity_quantities.png; needs numpy and matplotlib."""
import argparse
import math
import os
import re
import statistics

import numpy

from adaptivity import CORNER as SEVEN_CUBES
from contact import outcome
from page import TOP, write_part

STEP = 1e-30


class Lame:
    """A layer of a thick cylinder in plane strain (n = 2) or of a thick sphere (3) under pressures inside and outside."""

    def __init__(self, n, radii, pressures, modulus, ratio):
        (a, b), (inside, outside) = radii, pressures
        self.n, self.modulus, self.ratio = n, modulus, ratio
        self.c = (inside * a**n - outside * b**n) / (b**n - a**n)
        self.d = (inside - outside) * (a * b)**n / (b**n - a**n) / (n - 1)

    def radial(self, r):
        of_d = (1 + self.ratio) * self.d / r**(self.n - 1)
        of_c = (1 - 2 * self.ratio) * self.c * r * (1 + self.ratio if self.n == 2 else 1)
        return (of_c + of_d) / self.modulus

    def displacement(self, point):
        x = numpy.array(point[:self.n])
        r = math.sqrt(x @ x)
        return numpy.append(self.radial(r) * x / r, [0.] * (3 - self.n))

    def on_plane(self, r1, r2, length=1.):
        """The force on a plane of symmetry, along its normal, which points outward to -x or -y."""
        part = (lambda r: length * (self.c * r - self.d / r)) if self.n == 2 else (lambda r: math.pi / 2 * (self.c * r**2 / 2 - self.d / r))
        return part(r1) - part(r2)

    def at_end(self, r1, r2):
        """The force on the end zmin of a quarter of a cylinder, along z."""
        return -2 * self.ratio * self.c * math.pi / 4 * (r2**2 - r1**2)

    def outside(self, r, length=1.):
        """The force on the outer surface of a quarter or an octant, along x."""
        stress = self.c - (self.n - 1) * self.d / r**self.n
        return stress * (r * length if self.n == 2 else math.pi / 4 * r**2)


class Formula:
    """A displacement u(x, y, z) of material with E = 10 and nu = 0.3."""
    modulus, ratio = 10., 0.3

    def __init__(self, u):
        self.u = u

    def displacement(self, point):
        return numpy.array(self.u(*point)).real

    def stress(self, point):
        gradient = numpy.array([[u.imag / STEP for u in self.u(*(complex(x, STEP * (j == k)) for k, x in enumerate(point)))] for j in range(3)]).T
        strain = (gradient + gradient.T) / 2
        mu = self.modulus / (2 * (1 + self.ratio))
        return 2 * mu * strain + 2 * mu * self.ratio / (1 - 2 * self.ratio) * numpy.trace(strain) * numpy.eye(3)

    def force(self, axis, at, outward, first, second):
        """The force on the part of the plane x_axis = at, whose other coordinates lie in first and, functions of it, in second."""
        x, w = numpy.polynomial.legendre.leggauss(24)
        result, others = numpy.zeros(3), [k for k in range(3) if k != axis]
        for x1, w1 in zip(x, w):
            s = (first[0] + first[1] + x1 * (first[1] - first[0])) / 2
            low, high = (limit(s) if callable(limit) else limit for limit in second)
            for x2, w2 in zip(x, w):
                point = [at] * 3
                point[others[0]], point[others[1]] = s, (low + high + x2 * (high - low)) / 2
                result += w1 * w2 * (first[1] - first[0]) * (high - low) / 4 * outward * self.stress(point)[:, axis]
        return result


def smooth(x, y, z):
    return (0.1 * numpy.sin(x + 2 * y) * numpy.cos(z), 0.1 * numpy.cos(2 * x) * numpy.sin(y + z), 0.1 * numpy.exp(x / 2) * numpy.sin(y) * numpy.cos(z))


def corner(x, y, z):
    return tuple(a * (x**2 + y**2 + z**2)**0.3 for a in (0.1, 0.05, -0.07))


def wave(x, y):
    return 0.5 + 0.1 * math.sin(math.pi / 2 * (2 * x - 1) + 0.5) * math.cos(math.pi / 2 * (2 * y - 1))


def press_fit():
    """Bush and hub, 0.01 too large."""
    layers = [lambda p: Lame(2, (1, 2), (0, p), 1000, 0.3), lambda p: Lame(2, (2, 3), (p, 0), 500, 0.25)]
    bush, hub = (layer(1.).radial(2) for layer in layers)
    return [layer(0.01 / (hub - bush)) for layer in layers]


SPHERE, CYLINDER, SOFT, SOFT_CYLINDER = (Lame(n, (1, 2), (1, 0), 10, ratio) for ratio in (0.3, 0.5) for n in (3, 2))
BUSH, HUB = press_fit()
SMOOTH, CORNER = Formula(smooth), Formula(corner)
SHELLS, BLOCKS, FIT = ("inner", "outer"), ("lower", "upper"), ("bush", "hub")
TETRAHEDRA, INCOMPRESSIBLE = ["Mesh/Cells=tetrahedra"], ["Material/Poisson ratio=0.5"]
TARGETS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
MOST = 300000  # unknowns of runs for the energy
KINDS = ("hexahedra", "tetrahedra", "incompressible", "press fit", "corner")
LOADED = ["Body corner/Boundary zmax/Displacement=", "Body corner/Boundary zmax/Traction=0; 0; -0.1"]
# name, place, target of the reference
OF_L = (("tip", "1, -1, 1", 2e-4), ("far", "-0.8, -0.8, 0.6", 1e-3), ("beside", "-0.05, -0.05, 0.05", 1e-3))


class Scene:
    """A file of prm/ with settings: kind, file, bodies, settings of each, more settings, first degree, targets."""

    def __init__(self, kind, file, bodies, of_bodies=(), more=(), first=1, targets=TARGETS):
        self.kind, self.file, self.targets = kind, file, targets
        self.settings = [f"Body {body}/{setting}" for body in bodies for setting in (f"Degree={first}", *of_bodies)] + list(more)


SCENES = {
    "sphere": Scene("hexahedra", "thick_sphere", SHELLS), "cylinder": Scene("hexahedra", "thick_cylinder", SHELLS),
    "curved blocks": Scene("hexahedra", "manufactured", BLOCKS),
    "sphere, tetrahedra": Scene("tetrahedra", "thick_sphere", SHELLS, TETRAHEDRA),
    "curved blocks, tetrahedra": Scene("tetrahedra", "manufactured", BLOCKS, TETRAHEDRA),
    "sphere, incompressible": Scene("incompressible", "thick_sphere", SHELLS, INCOMPRESSIBLE, first=2),
    "cylinder, incompressible": Scene("incompressible", "thick_cylinder", SHELLS, INCOMPRESSIBLE, first=2),
    "press fit": Scene("press fit", "press_fit", FIT), "Fichera": Scene("corner", "fichera", BLOCKS, more=SEVEN_CUBES, targets=(1e-2, 1e-3))}


class Quantity:
    """A component of the displacement at a point, where is its place, or of the force on a boundary, its name."""

    def __init__(self, scene, name, body, where, component, exact):
        self.scene, self.name, self.component, self.exact = scene, name, component, exact
        self.is_point = not isinstance(where, str)
        entry = ", ".join(f"{x:g}" for x in where) if self.is_point else where
        self.target = f"{name}, {'xyz'[component]}"
        self.text = f"{name} ({entry if self.is_point else body + ': ' + where}), {'xyz'[component]}"
        self.entry = f"{name}: {body}: {entry}"


def point(scene, name, body, where, component, exact):
    return Quantity(scene, name, body, where, component, exact.displacement(where)[component])


def quantities():
    up = (0.6, 0.64, 0.48)
    along = lambda r, direction=up: tuple(round(r * x, 6) for x in direction)
    flat = lambda r, z, direction=(0.8, 0.6): tuple(round(r * x, 6) for x in direction) + (z,)
    lower_side = (lambda s: 0., lambda s: wave(0., s))
    upper_side = (lambda s: wave(s, 0.), lambda s: 1.)
    result = []
    for name, of in (("sphere", SPHERE), ("sphere, tetrahedra", SPHERE), ("sphere, incompressible", SOFT)):
        result += [point(name, "vertex inside", "inner", (1., 0., 0.), 0, of), point(name, "near the tie", "inner", along(1.45), 1, of),
                   Quantity(name, "symmetry", "inner", "xmin", 0, of.on_plane(1, 1.5))]
        if name == "sphere":
            result += [point(name, "interior", "outer", along(1.75), 2, of), point(name, "vertex outside", "outer", (0., 2., 0.), 1, of),
                       Quantity(name, "across the tie", "inner", "outside", 0, of.outside(1.5))]
    for name, of in (("cylinder", CYLINDER), ("cylinder, incompressible", SOFT_CYLINDER)):
        result += [point(name, "near the tie", "outer", flat(1.55, 0.2), 1, of), Quantity(name, "symmetry", "outer", "ymin", 1, of.on_plane(1.5, 2, 0.5))]
        if name == "cylinder":
            result += [point(name, "vertex inside", "inner", (0., 1., 0.25), 1, of), Quantity(name, "end", "inner", "zmin", 2, of.at_end(1, 1.5))]
    for name in ("curved blocks", "curved blocks, tetrahedra"):
        result += [point(name, "interior", "lower", (0.3, 0.4, 0.2), 0, SMOOTH), point(name, "near the tie", "upper", (0.55, 0.45, 0.57), 1, SMOOTH),
                   Quantity(name, "below", "lower", "zmin", 2, SMOOTH.force(2, 0., -1, (0., 1.), (0., 1.))[2])]
        if name == "curved blocks":
            result += [point(name, "top", "upper", (0.4, 0.7, 1.), 2, SMOOTH), point(name, "near the tie, below", "lower", (0.6, 0.55, 0.52), 2, SMOOTH),
                       Quantity(name, "left", "lower", "xmin", 0, SMOOTH.force(0, 0., -1, (0., 1.), lower_side)[0]),
                       Quantity(name, "front", "upper", "ymin", 1, SMOOTH.force(1, 0., -1, (0., 1.), upper_side)[1])]
    result += [point("press fit", "vertex inside", "bush", (1., 0., 0.5), 0, BUSH), point("press fit", "near the fit", "bush", flat(1.95, 0.4), 1, BUSH),
               point("press fit", "interior", "hub", flat(2.45, 0.3, (0.6, 0.8)), 1, HUB),
               Quantity("press fit", "symmetry", "hub", "ymin", 1, HUB.on_plane(2, 3)),
               Quantity("press fit", "across the fit", "bush", "outside", 0, BUSH.outside(2))]
    result += [point("Fichera", "interior", "lower", (-0.55, -0.35, -0.45), 0, CORNER),
               point("Fichera", "near the corner", "upper", (-0.1, -0.08, 0.12), 2, CORNER),
               point("Fichera", "re-entrant edge", "upper", (0., 0., 0.5), 2, CORNER),
               Quantity("Fichera", "left", "lower", "xmin", 0, CORNER.force(0, -1., -1, (-1., 1.), (-1., 0.))[0]),
               Quantity("Fichera", "above", "upper", "zmax", 2, sum(CORNER.force(2, 1., 1, *of) for of in (((-1., 0.), (-1., 1.)), ((0., 1.), (-1., 0.))))[2])]
    return result


def cycles(mortise, scene, settings):
    """Summary of a run, whether it met its target, and of each cycle the iterations of its dual problem."""
    code, summary, log = outcome(mortise, scene, *settings)
    return summary, code == 0, [int(n) for n in re.findall(r"^  dual .*?(\d+) iterations", log, re.MULTILINE)]


class Cycle:
    def __init__(self, step, exact):
        of = step["adaptivity"]
        self.unknowns, self.iterations = step["dofs"]["total"], step["solver"]["iterations"]
        self.value, self.estimate, self.correction = of["value"], of.get("estimate"), of.get("correction")
        self.error = abs(self.value / exact - 1)
        if self.estimate is not None:
            self.ratio, self.corrected = self.estimate / self.error, abs((self.value + self.correction) / exact - 1)
            self.right_sign = self.correction * (exact - self.value) > 0


class Run:
    def __init__(self, mortise, quantity, target):
        self.quantity, self.target, scene = quantity, target, SCENES[quantity.scene]
        self.kind, place = scene.kind, "Points" if quantity.is_point else "Resultants"
        summary, self.met, self.dual = cycles(mortise, scene.file, scene.settings + [
            "Output/Points=", "Output/Resultants=", f"Output/{place}={quantity.entry}", f"Adaptivity/Quantity={quantity.target}",
            f"Adaptivity/Target error={target}"])
        self.seconds = summary["timings_s"]["total"]
        self.cycles = [Cycle(step, quantity.exact) for step in summary["steps"]]
        self.last, self.iterations = self.cycles[-1], max(cycle.iterations for cycle in self.cycles)
        first, *self.later = [cycle for cycle in self.cycles if cycle.estimate is not None]
        self.first = [first]


def ends_for_energy(mortise, scene, wanted):
    """Of runs for the energy, to smaller and smaller targets: unknowns and by number its error. Until two in a row have the errors that are wanted,
    or MOST unknowns are not enough."""
    ends, target, good = [], 0.1, 0
    places = [f"Output/{place}=" + "; ".join(q.entry for q in wanted if q.is_point == (place == "Points")) for place in ("Points", "Resultants")]
    while good < 2:
        summary, met, _ = cycles(mortise, scene.file, scene.settings + places + [
            f"Adaptivity/Target error={target:.3g}", f"Adaptivity/Largest number of unknowns={MOST}"])
        last = summary["steps"][-1]
        errors = {q.name: abs(last["quantities"][q.name][q.component] / q.exact - 1) for q in wanted}
        ends.append((last["dofs"]["total"], errors))
        good = good + 1 if all(errors[q.name] <= error for q, error in wanted.items()) else 0
        if not met:
            break
        target = min(target / math.sqrt(10), 0.9 * last["adaptivity"]["estimate"])
    return ends


def with_energy(ends, name, error):
    """Unknowns of the first end that has, as the next one has, at most this error of the number."""
    for (unknowns, errors), (_, next_errors) in zip(ends, ends[1:]):
        if max(errors[name], next_errors[name]) <= error:
            return unknowns
    return None


def quantiles(numbers):
    return " | ".join(f"{number:.2g}" if number < 10 else f"{number:.0f}" for number in numpy.quantile(numbers, (0.1, 0.5, 0.9)))


def share(numbers, low, high):
    return f"{100 * numpy.mean([low <= number <= high for number in numbers]):.0f} %"


def groups(runs):
    """Names and runs, those of each kind and of points and forces."""
    yield "all", runs
    for kind in KINDS:
        yield kind, [run for run in runs if run.kind == kind]
    for name, is_point in (("points", True), ("forces", False)):
        yield name, [run for run in runs if run.quantity.is_point == is_point]


def row_of_ends(name, runs):
    ratios = [run.last.ratio for run in runs]
    above = [run.last.error / run.target for run in runs if run.last.error > run.target]
    worst = f"{max(above):.2f}" if above else "-"
    return (f"| {name} | {len({run.quantity for run in runs})} | {len(runs)} | {sum(run.met for run in runs)} | {len(above)} | {worst} | "
            f"{quantiles(ratios)} | {share(ratios, 0.8, 4)} | {share(ratios, 0.9, 1.5)} |")


def row_of_cycles(name, of_first, of_later):
    def part(of):
        return f"{len(of)} | {quantiles([c.ratio for c in of])} | {share([c.ratio for c in of], 0.8, 4)}"
    return f"| {name} | {part(of_later)} | {part(of_first)} |"


def corrections(cycles_of_runs):
    """Of corrections: how much of the error they leave, and how often they have its sign."""
    left = [cycle.corrected / cycle.error for cycle in cycles_of_runs]
    return (f"{statistics.median(left):.2f} times the error in the median (less than the error in {share(left, 0, 1)}), and has the right sign in "
            f"{share([c.right_sign for c in cycles_of_runs], 1, 1)}")


def of_all_runs(mortise, numbers):
    """All runs, and those to the finest target of each number."""
    runs, finest = [], []
    for quantity in numbers:
        for target in SCENES[quantity.scene].targets:
            runs.append(Run(mortise, quantity, target))
        finest.append(runs[-1])
        print(row_of_number(runs[-1]), flush=True)
    return runs, finest


def row_of_number(run):
    last = run.last
    return (f"| {run.quantity.scene}: {run.quantity.text} | {run.target:.0e} | {last.error:.1e} | {last.estimate:.1e} | {last.ratio:.2f} | {len(run.cycles)} | "
            f"{last.unknowns} | {run.iterations} | {max(run.dual)} | {run.seconds:.2f} |")


def beside_energy(mortise, runs):
    """Rows, and the unknowns of all runs by those for the energy that reach the same error, and that reach the target."""
    rows, same, to_target, not_reached = [], [], [], 0
    for scene in SCENES:
        of_scene = [run for run in runs if run.quantity.scene == scene]
        wanted = {}
        for run in of_scene:
            wanted[run.quantity] = min(wanted.get(run.quantity, math.inf), run.last.error)
        ends = ends_for_energy(mortise, SCENES[scene], wanted)
        for run in of_scene:
            reached = [with_energy(ends, run.quantity.name, error) for error in (run.last.error, run.target)]
            ratios = [run.last.unknowns / n if n else None for n in reached]
            not_reached += reached[0] is None
            for ratio, found in zip(ratios, (same, to_target)):
                if ratio:
                    found.append((ratio, run))
            if run.target in (SCENES[scene].targets[-1], 1e-4) or scene == "Fichera":
                both = " | ".join(f"{n} | {ratio:.2f}" if n else "not reached | -" for n, ratio in zip(reached, ratios))
                rows.append(f"| {scene}: {run.quantity.text} | {run.target:.0e} | {run.last.error:.1e} | {run.last.unknowns} | {both} |")
                print(rows[-1], flush=True)
    return rows, same, to_target, not_reached


def at_the_l(mortise):
    """Points at the L: unknowns to two targets beside those of cycles for the energy."""
    places = "Output/Points=" + "; ".join(f"{name}: corner: {place}" for name, place, _ in OF_L)
    energy, rows = cycles(mortise, "l_interface", LOADED + [places, "Adaptivity/Target error=1.5e-2"])[0]["steps"], []
    for name, place, finest in OF_L:
        settings = LOADED + [places, f"Adaptivity/Quantity={name}, z"]
        reference = cycles(mortise, "l_interface", settings + [f"Adaptivity/Target error={finest}"])[0]["steps"][-1]["adaptivity"]
        of_energy = [(step["dofs"]["total"], abs(step["quantities"][name][2] / reference["value"] - 1)) for step in energy]
        for target in (1e-2, 3e-3):
            step = cycles(mortise, "l_interface", settings + [f"Adaptivity/Target error={target}"])[0]["steps"][-1]
            error, parts = abs(step["adaptivity"]["value"] / reference["value"] - 1), []
            for limit in (error, target):
                stays = [k for k in range(len(energy)) if all(e <= limit for _, e in of_energy[k:])]
                parts.append(f"{of_energy[stays[0]][0]}" if stays else "not reached")
            rows.append(f"| {name} ({place}), z | {target:.0e} | {error:.1e} | {step['adaptivity']['estimate']:.1e} | {step['dofs']['total']} | "
                        f"{' | '.join(parts)} | {reference['estimate']:.0e} |")
            print(rows[-1], flush=True)
    return rows


def draw(runs, finest):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.5))
    for k, kind in enumerate(KINDS):
        for is_point, style in ((True, "o"), (False, "x")):
            of = [run.last for run in runs if run.kind == kind and run.quantity.is_point == is_point]
            left.loglog([c.error for c in of], [c.estimate for c in of], style, color=f"C{k}", markersize=4,
                        label=kind + (", points" if is_point else ", forces"))
    line = numpy.array([1e-9, 1e-2])
    left.loglog(line, 0.8 * line, "k-", line, 4 * line, "k-", linewidth=0.5)
    left.set_title("ends of runs; lines: 0.8 and 4 times the error")
    left.set_xlabel("error of the number")
    left.set_ylabel("estimate")
    left.legend(fontsize=6)
    for name, of in (("ends of runs", [run.last for run in runs]), ("single cycles", [c for run in finest for c in run.later]),
                     ("first estimates", [c for run in finest for c in run.first])):
        right.semilogx(sorted(c.ratio for c in of), numpy.arange(1, len(of) + 1) / len(of), label=name)
    right.axvspan(0.8, 4, alpha=0.15, color="k")
    right.set_title("share of estimates below so many times the error")
    right.set_xlabel("estimate by error")
    right.legend()
    for axes in (left, right):
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(os.path.join(TOP, "doc", "measurements", "adaptivity_quantities.png"), dpi=100)


def normal(x):
    """The share of normally distributed numbers whose size is below x times their deviation."""
    return math.erf(x / math.sqrt(2))


def listed(runs):
    return "; ".join(f"{run.quantity.scene}, {run.quantity.name}, {run.last.error:.2e} at {run.target:.0e}" for run in runs)


def of_unknowns(ratios):
    numbers = [ratio for ratio, _ in ratios]
    low, middle, high = numpy.quantile(numbers, (0.1, 0.5, 0.9))
    return f"{low:.2f} to {high:.2f} times as many in 8 of 10 runs, {middle:.2f} in the median, more in {share(numbers, 1 + 1e-9, math.inf)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mortise")
    mortise = os.path.abspath(parser.parse_args().mortise)
    numbers = quantities()
    runs, finest = of_all_runs(mortise, numbers)
    rows, same, to_target, not_reached = beside_energy(mortise, runs)
    of_l = at_the_l(mortise)
    draw(runs, finest)
    ratios = [run.last.ratio for run in runs]
    later, first = [c for run in finest for c in run.later], [c for run in finest for c in run.first]
    above = [run for run in runs if run.met and run.last.error > run.target]
    low, middle, high = quantiles(ratios).split(" | ")
    corner = [ratio for ratio, run in same if run.kind == "corner"]
    _, zero_met, _ = cycles(mortise, "thick_sphere", SCENES["sphere"].settings + ["Adaptivity/Quantity=at r 1, y", "Adaptivity/Target error=1e-2"])
    by_kind = {kind: max(max(*run.dual, run.iterations) for run in runs if run.kind == kind) for kind in KINDS}
    values = {
        "zero": 0 if zero_met else 3, "most": f"{MOST:,}",
        "normal": f"{100 * (normal(2 / 0.8) - normal(2 / 4)):.0f} %", "normal_narrow": f"{100 * (normal(2 / 0.9) - normal(2 / 1.5)):.0f} %",
        "n_numbers": len(numbers),
        "n_points": sum(q.is_point for q in numbers), "n_forces": sum(not q.is_point for q in numbers), "n_runs": len(runs),
        "n_met": sum(run.met for run in runs),
        "low": low, "middle": middle, "high": high, "in_goal": share(ratios, 0.8, 4),
        "in_narrow": share(ratios, 0.9, 1.5), "smallest": f"{min(ratios):.2f}",
        "below": share(ratios, 0, 0.8), "largest": f"{max(ratios):,.0f}",
        "later_in_goal": share([c.ratio for c in later], 0.8, 4),
        "later_below": share([c.ratio for c in later], 0, 0.8),
        "later_smallest": f"{min(c.ratio for c in later):.2f}", "first_in_goal": share([c.ratio for c in first], 0.8, 4),
        "first_middle": f"{statistics.median(c.ratio for c in first):.0f}", "first_largest": f"{max(c.ratio for c in first):,.0f}",
        "n_above": len(above), "above": listed(above), "corrections": corrections(later), "first_corrections": corrections(first),
        "energy_same": of_unknowns(same), "energy_target": of_unknowns(to_target), "not_reached": not_reached,
        "corner": f"{min(corner):.2f} to {max(corner):.2f}", "iterations": ", ".join(f"{name} {n}" for name, n in by_kind.items()),
        "n_over": sum(max(*run.dual, run.iterations) > 14 for run in runs),
        "ends": "\n".join(row_of_ends(name, of) for name, of in groups(runs)),
        "single": "\n".join(row_of_cycles(name, [c for run in of for c in run.first], [c for run in of for c in run.later]) for name, of in groups(finest)),
        "numbers": "\n".join(row_of_number(run) for run in finest), "energy": "\n".join(rows), "l": "\n".join(of_l)}
    write_part("adaptivity.md", "quantities", TEXT.format(**values))


TEXT = """## One number as the target

Regenerate: `tests/benchmarks/adaptivity_quantities.py build/mortise` writes this section and the plot. Intel Xeon with AVX-512, one core, the other one busy.

What is missed (goals: estimates 0.8 to 4 times the error in every cycle and 0.9 to 1.5 at the end, targets met by the true error, at most 14 iterations):

- At the end of {n_runs} runs estimates are {low} to {high} times the error in 8 of 10, {middle} in the median; 0.8 to 4 in {in_goal}, 0.9 to 1.5 in
  {in_narrow}, below 0.8 in {below} (least {smallest}, most {largest}).
- In single cycles they are 0.8 to 4 in {later_in_goal}, below 0.8 in {later_below} (least {later_smallest}). First estimates: {first_in_goal}; {first_middle} times the error
  in the median, {first_largest} at most.
- The error is above the target in {n_above} of the {n_met} runs that end with exit code 0 (of {n_runs}): {above}.
- The problem or its dual takes more than 14 iterations in {n_over} runs (linear solves stop at a thousandth of the target); most: {iterations}.
- Unknowns: the number as the target takes {energy_same}, beside runs for the energy that reach the same error of the number. Beside those whose
  error just reaches the target, which they cannot tell, it takes {energy_target}.

![Estimates over errors, and how many times the error they are](adaptivity_quantities.png)

### All numbers

`Quantity = tip, z` makes the target that of one number, a displacement at a point or a force. {n_numbers} numbers with known answers, {n_points} displacements and
{n_forces} forces, are computed to 1e-2, 1e-3 and so on to 1e-6 (at the corner to 1e-3), from degree one (incompressible bodies: two) and the mesh of
the scene. Errors are |value / exact - 1|. Runs to neighbouring targets share cycles, and some end in the same one.

- Hexahedra: `prm/thick_sphere.prm`, `prm/thick_cylinder.prm`, `prm/manufactured.prm` (curved blocks). Tetrahedra: sphere and curved blocks.
  Incompressible: sphere and cylinder with Poisson's ratio 0.5. Press fit: `prm/press_fit.prm`, which slides. Corner: `prm/fichera.prm` from seven cubes.
- Exact displacements are Lame's (press fit: with the pressure that closes the interference) or the given ones. Exact forces are Lame's stresses,
  integrated by hand, or stresses of the given displacement, integrated by Gauss's rule with 24 x 24 points on the plane.

| runs | numbers | runs | target met, by estimate | error above target | at most, times | estimate by error, 10 % | 50 % | 90 % | 0.8 to 4 | 0.9 to 1.5 |
|---|---|---|---|---|---|---|---|---|---|---|
{ends}

The next table has estimate by error in each cycle of the runs to the finest target. First estimates are those of the second cycle; single cycles are
all that follow.

| runs | single cycles | 10 % | 50 % | 90 % | 0.8 to 4 | first estimates | 10 % | 50 % | 90 % | 0.8 to 4 |
|---|---|---|---|---|---|---|---|---|---|---|
{single}

The `correction` in `summary.json` is the error with a sign, as far as one is known. Added to the value it leaves {corrections}; the first one {first_corrections}.

An error with a sign is small by chance now and then. Were it normally distributed with the deviation R ([how](../guide/adaptivity.md)), then 2 R would be
0.8 to 4 times the error in {normal} of all cases and 0.9 to 1.5 times in {normal_narrow}. A number that is zero beside the other components of its
displacement or force, to the tolerance of the solver, has no relative error: exit code {zero} (`prm/thick_sphere.prm` from degree 1 with `Quantity = at r 1, y`).

### Each number

The table is for the finest target. Iterations: the most of all cycles, of the problem and of its dual. Seconds: all cycles of one run.

| number | target | error | estimate | by error | cycles | unknowns | iterations | of the dual | seconds |
|---|---|---|---|---|---|---|---|---|---|
{numbers}

### Unknowns beside the energy as the target

The runs for the energy have targets that begin with 1e-1 and fall by the root of 10, or to 0.9 times the estimate at the end of the last run if that is
less. The first run counts that has at most this error of the number at its end, if the next one has it as well, so that it is not small there by
chance. No estimate tells this error in such a run. Of all runs {not_reached} have an error that is not reached with {most} unknowns and degree 8. At
Fichera's corner the number as the target takes {corner} times as many unknowns for the same error. The table has 1e-4 and the finest target, at the
corner both.

| number | target | its error | unknowns | energy, the same error | ratio | energy, the target | ratio |
|---|---|---|---|---|---|---|---|
{energy}

### Beside an edge

`prm/l_interface.prm` with a load of 0.1 on its top in place of the plate; there is no exact solution. Errors are relative to the last value of a run to
1e-3 (tip: 2e-4), whose own estimate is in the last column: smaller errors are not known to a digit. Beside it stands a run for the energy to 1.5e-2:
the cycle from which on the error of the number stays at most that of the run, or the target.

| number | target | error | estimate | unknowns | energy, the same error | energy, the target | estimate of the reference |
|---|---|---|---|---|---|---|---|
{l}
"""

if __name__ == "__main__":
    main()
