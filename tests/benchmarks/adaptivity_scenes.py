#!/usr/bin/env python3
"""Meshes and degrees that follow from an error, scenes with edges and contact: adaptivity_scenes.py MORTISE [--peers DIRECTORY]

Inclusions, re-entrant edges, a crack, waves and balls: estimates, errors where they are known, rates, iterations, seconds, the same on 3 ranks; and, with
--peers, NGSolve on Fichera's corner (ngsolve_fichera.py in DIRECTORY, tests/benchmarks say). Writes doc/adaptivity_scenes.md and .png; needs matplotlib."""
import argparse
import json
import math
import os
import subprocess
import sys

from adaptivity import CORNER, TOP, degrees, error, rows_of_cycles, seconds, unknowns
from contact import contact_of, last, run

COARSE = ["Body inner/Degree=1", "Body outer/Degree=1", "Body inner/Mesh/Subdivisions=1, 1", "Body outer/Mesh/Subdivisions=2, 1"]
WAVE = [f"Body {body}/{s}" for body, cells in (("lower", "2, 1, 8"), ("upper", "3, 1, 12")) for s in ("Degree=1", "Mesh/Refine near=", f"Mesh/Subdivisions={cells}")]
# name, scene, settings, targets, target on 1 and 3 ranks
SCENES = [("shell, stiff inside", "thick_sphere", COARSE + ["Body inner/Material/Young modulus=1e4"], (1e-2, 1e-3), 1e-3),
          ("shell, soft inside", "thick_sphere", COARSE + ["Body inner/Material/Young modulus=1e-2"], (1e-2, 1e-3), 1e-3),
          ("stiff cube", "inclusion", [], (3e-2, 1e-2, 1e-3), 5e-2),
          ("L", "l_interface", [], (1e-1, 4e-2, 2.5e-2, 1e-2), 5e-2),
          ("L, slab the slave", "l_interface", ["Interface between/Slave=slab: zmax", "Interface between/Master=corner: zmin"], (1e-1, 4e-2, 2.5e-2), 5e-2),
          ("crack", "crack", [], (1e-1, 3e-2, 1e-2), 1e-1),
          ("wave", "wavy_surface", WAVE, (1e-1, 1e-2, 1e-3), 1e-2),
          ("ball", "hertz_adaptive", [], (1e-1, 1e-2, 2e-3), 1e-2),
          ("paraboloid", "hertz_half_spaces", [], (1e-1, 1e-2, 2e-3), 1e-2)]
MODULUS = 1000 / (2 * (1 - 0.3**2))
FORCES = {"stiff cube": "pull", "L": "plate", "L, slab the slave": "plate"}
FICHERA = (1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4)


def westergaard():
    """Settings with the displacement between the planes of prm/wavy_surface.prm: Westergaard's functions of psi = pi (x + i z) / 2 above the contact, mirrored
    below, and the stress that holds the sides. With s = sin(pi a / 2), R = sqrt(s^2 - sin^2(psi)), D = R - i sin(psi) and p the mean pressure:
    Z = -2 p cos(psi) / D, its integral -2 p / pi (sin(psi) / D + arcsin(sin(psi) / s))."""
    nu, pressure, z = 0.3, 8.631086 / 4, "abs(z)"
    mu = 1000 / 2 / (1 + nu)
    sine = (f"(sin(pi*x/2)*cosh(pi*{z}/2))", f"(cos(pi*x/2)*sinh(pi*{z}/2))")
    cosine = (f"cos(pi*x/2)*cosh(pi*{z}/2)", f"sin(pi*x/2)*sinh(pi*{z}/2)")  # minus the imaginary part
    real = f"(0.5*cos(pi*x)*cosh(pi*{z}) - 0.25)"  # of R^2, s^2 = 1/4
    size = f"sqrt({real}^2 + 0.25*(sin(pi*x)*sinh(pi*{z}))^2)"
    d = (f"(sqrt(0.5*({size} + {real}) + 1e-20) + {sine[1]})", f"(-sqrt(0.5*({size} - {real}) + 1e-20) - {sine[0]})")
    square = f"({d[0]}^2 + {d[1]}^2)"
    k, across, along = pressure / 2 / mu, 2 * (1 - 2 * nu) / math.pi, 4 * (1 - nu) / math.pi
    x = (f"{k}*({1 - 2 * nu}*x - ((({across}*{sine[0]} + 2*{z}*{cosine[1]})*{d[0]} + ({across}*{sine[1]} + 2*{z}*{cosine[0]})*{d[1]})/{square}"
         f" + {across}*atan2(-{d[1]}, {d[0]})))")
    height = (f"{k}*((({along}*{sine[0]} - 2*{z}*{cosine[1]})*{d[1]} - ({along}*{sine[1]} - 2*{z}*{cosine[0]})*{d[0]})/{square}"
              f" - {along}*(0.5*log({square}) + log(2)) - {nu * (1 - 2 * nu) / (1 - nu)}*{z})")
    half_way = -exact_top() / 2  # each block is pressed together as much as the other
    return [f"Exact solution/Displacement={x}; 0; if(z > 0, 1, -1)*({height}) + {-half_way}"] + [f"Body {body}/Body force=0; 0; 0" for body in ("lower", "upper")]


def exact_top():
    """Blocks of height 4 that cannot widen, and the approach of the waves, p l / (pi E*) (1 + log(p* / p))."""
    pressure = 8.631086 / 4
    return -(8 * pressure * 1.3 * 0.4 / 0.7 / 1000 + 2 * pressure / (math.pi * MODULUS) * (1 + math.log(4)))


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
                whole.append(f"| {name} | {target:.0e} | not reached | | | | | | |")
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
            if "interfaces" in of and any("contact" in interface for interface in of["interfaces"]):
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
        ranks.append(f"| {name} | {moderate:.0e} | {len(both[0]['steps'])} | {unknowns(both[0])} | {'yes' if same else 'NO: ' + differ(*both)} | {apart:.1e} | "
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
    for step in summary["steps"]:
        by_force = "-"
        if name in FORCES:
            reference = force(final, name) / (1 + final["adaptivity"]["estimate"]**2)
            off = force(step, name) / reference - 1
            by_force = f"{math.copysign(math.sqrt(abs(off)), off):+.1e} by force"
        of = step["adaptivity"]
        estimate = f"{of['estimate']:.2e}" if "estimate" in of else "-"
        yield (f"| {name}, {of['target']:.0e} | {step['cycle']} | {degrees(step)} | {sum(b['cells'] for b in step['bodies'])} | {step['dofs']['total']} | {by_force} | {estimate} | - | "
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


def corner(mortise, peers):
    """Errors, unknowns and seconds at Fichera's corner by program."""
    found = {"Mortise": []}
    for target in FICHERA:
        time, summary = seconds(mortise, "fichera", CORNER + [f"Adaptivity/Target error={target}"])
        found["Mortise"].append((error(summary), unknowns(summary), time, time))
    if peers:
        for kind in ("hp", "h"):
            command = [sys.executable, os.path.join(os.path.abspath(peers), "ngsolve_fichera.py"), "--kinds", kind]
            for line in subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines():
                if line.startswith("{"):
                    of = json.loads(line)
                    name = f"NGSolve, hp, size {of['size']}" if kind == "hp" else f"NGSolve, h, order {of['order']}"
                    found.setdefault(name, []).append((of["error_energy"], of["dofs"], of["seconds"], of.get("seconds_with_estimates", of["seconds"])))
    rows = []
    for target in FICHERA:
        row = [f"{target:.0e}"]
        for kind in ("Mortise", "NGSolve, hp", "NGSolve, h,"):
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
        axes[0].loglog(*zip(*points), "x:" if "estimate" in name else "o-", color=colour, label=name, markersize=4)
    axes[0].set_title("scenes; crosses: estimates")
    axes[0].set_ylabel("error in energy")
    for name, points in programs.items():
        style = "o-" if name == "Mortise" else "s--" if "hp" in name else "x:"
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
    figure.savefig(os.path.join(TOP, "doc", "adaptivity_scenes.png"), dpi=100)


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
    with open(os.path.join(TOP, "doc", "adaptivity_scenes.md"), "w") as page:
        page.write(TEXT.format(**{name: "\n".join(rows) for name, rows in tables.items()}))


TEXT = """PLACEHOLDER
{whole}
{rates}
{touches}
{ranks}
{fichera}
{cycles}
"""

if __name__ == "__main__":
    main()
