#!/usr/bin/env python3
"""sliding.py MORTISE: contact that follows the bodies beside the same bodies with pairs that stay and with a tie. Writes its part of
doc/measurements/deformed_contact.md: iterations by step and seconds of a ball that is pushed in a cup, of a block and of a die that slide
over another one, and of scenes with friction.
sliding.py MORTISE --ironing N: prm/ironing.prm with 194,190 unknowns on two processes, which is pressed in four steps and drawn in N; prints seconds and iterations of a
step that is drawn, and the memory of a process."""
import json
import math
import os
import re
import sys
import tempfile

from contact import contact_of, last, outcome
from page import write_part

STAR = 0.5 / (1 - 0.3**2)  # E = 1 on both sides

BALL = """set Bodies     = ball, cup
set Interfaces = touch
{ball}{cup}subsection Interface touch
  set Slave   = ball: outside
  set Master  = cup: inside
  set Law     = {law}
{sliding}end
subsection Steps
  set Step     = 0.25
  set End time = 1
end
subsection Output
  set Fields =
end
"""

SHELL = """subsection Body {name}
  set Degree = {degree}
  subsection Mesh
    set Source       = shell octant
    set Extent       = {extent}
    set Subdivisions = {cells}
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 1
    set Poisson ratio = 0.3
  end
  subsection Boundary {held}
    set Displacement = {displacement}
  end
  subsection Boundary xmin
    set Displacement = 0, -, -
  end
  subsection Boundary ymin
    set Displacement = -, 0, -
  end
end
"""


def ball(degree, n, push, law, sliding):
    bodies = [SHELL.format(name=name, degree=degree, extent=extent, cells=f"{cells}, {max(1, cells // 2)}", held=held, displacement=displacement)
              for name, extent, cells, held, displacement in (("ball", "0.5, 1", 3 * n, "inside", f"0, 0, {push}*t"), ("cup", "1.02, 1.5", 2 * n, "outside", "0, 0, 0"))]
    return BALL.format(ball=bodies[0], cup=bodies[1], law=law, sliding=f"  set Sliding = {sliding}\n" if sliding else "")


def measure(mortise, text):
    """The summary of a run, or None where it ends early."""
    with tempfile.TemporaryDirectory() as work:
        scene = os.path.join(work, "scene")
        with open(scene + ".prm", "w") as file:
            file.write(text)
        code, summary, _ = outcome(mortise, scene)
        return summary if code == 0 else None


def newton(summary):
    return " ".join(str(step["solver"]["newton_iterations"]) for step in summary["steps"]) if summary else "-"


def pairing_share(summary):
    times = summary["timings_s"]
    return sum(times.get(name, 0.) for name in ("interface_search", "interface_clipping", "coupling")) / times["total"]


def balls(mortise):
    rows = ["| p | cells along an edge of ball, cup | unknowns | pmax/E* | Newton, by step | pairs that stay | tied | seconds | pairs that stay | tied | search, clipping and coupling |", "|---" * 11 + "|"]
    for degree, n in ((1, 4), (2, 2), (3, 1), (3, 2), (4, 1)):
        for push in (0.05, 0.15, 0.25):
            follows, stays, tied = (measure(mortise, ball(degree, n, push, law, sliding)) for law, sliding in (("contact", "finite"), ("contact", "small"), ("tie", None)))
            seconds = " | ".join(f"{one['timings_s']['total']:.2f}" if one else "-" for one in (follows, stays, tied))
            unknowns, pressure, share = "", "", ""
            if follows:
                unknowns = last(follows)["dofs"]["total"]
                pressure = f"{contact_of(last(follows))['pressure_max'] / STAR:.2f}"
                share = f"{100 * pairing_share(follows):.0f} %"
            rows.append(f"| {degree} | {3 * n}, {2 * n} | {unknowns} | {pressure} | {newton(follows)} | {newton(stays)} | {newton(tied)} | {seconds} | {share} |")
            print(rows[-1], flush=True)
    return rows


def deviations(forces):
    """Columns: the mean normal force, the largest deviation from it and the largest tangential force, both beside it."""
    mean = sum(f[2] for f in forces) / len(forces)
    return f"{mean:.5g} | {max(abs(f[2] / mean - 1) for f in forces):.1e} | {max(abs(f[0] / mean) for f in forces):.1e}"


def slides(mortise):
    top = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "field", "block_slides_on_rubber.prm")
    with open(top) as file:
        text = file.read()
    rows = ["| p | Newton, by step | normal force, mean | largest deviation, relative | tangential force, largest, relative |", "|---" * 5 + "|"]
    for degree in (1, 2, 3):
        summary = measure(mortise, re.sub(r"set Degree = \d", f"set Degree = {degree}", text))
        if not summary:
            rows.append(f"| {degree} | - | | | |")
            continue
        rows.append(f"| {degree} | {newton(summary)} | {deviations([step['quantities']['top'] for step in summary['steps'] if step['time'] > 2 - 1e-9])} |")
        print(rows[-1], flush=True)
    return rows


def ripple(mortise):
    """The force on a round die without friction, drawn over 20 faces of the block in 41 steps, each of which ends at another place of a face."""
    rows = ["| p | unknowns | Newton, mean | force, mean | largest deviation, relative | tangential force, largest, relative |", "|---" * 6 + "|"]
    for degree in (1, 2, 3, 4):
        code, summary, _ = outcome(mortise, "ironing", f"Body block/Degree={degree}", "Body block/Mesh/Extent=0, 0, -0.5, 6, 0.125, 0", "Body block/Mesh/Subdivisions=144, 1, 8",
                                   f"Body die/Degree={degree}", "Body die/Mesh/Subdivisions=13, 3, 1", "Body die/Mesh/Translate=2.4, 0.125, 0.6", "Body die/Material/Young modulus=1",
                                   "Body die/Boundary inside/Displacement=5/6*max(t - 1, 0), 0, -0.08*min(t, 1)", "Interface touch/Friction coefficient=0",
                                   "Steps/Step=" + ", ".join(f"{t:.10g}" for t in [0.25, 0.5, 0.75, 1.] + [1 + k / 41 for k in range(1, 42)]))
        if code != 0:
            rows.append(f"| {degree} | - | | | | |")
            continue
        steps = [step for step in summary["steps"] if step["time"] > 1 + 1e-9]
        rows.append(f"| {degree} | {last(summary)['dofs']['total']} | {sum(step['solver']['newton_iterations'] for step in steps) / len(steps):.1f} | "
                    f"{deviations([step['quantities']['die'] for step in steps])} |")
        print(rows[-1], flush=True)
    return rows


def friction(mortise):
    rows = ["| scene | p | unknowns | Newton, mean | most | seconds | ratio of forces, mean | largest deviation | from theory |", "|---" * 9 + "|"]
    held = lambda step: math.hypot(*step["quantities"]["end"][:2]) * 200  # the pull at the other end is 1 / 200
    along = lambda step: -step["quantities"]["die"][0] / step["quantities"]["die"][2]
    driven = lambda step: step["quantities"]["axle"][0] / step["quantities"]["axle"][2]
    for scene, bodies, degrees, first, ratio, theory in (("ironing", ("block", "die"), (1, 2, 3), 1.19, along, "0.3, but for the front of the die"),
                                                         ("belt", ("drum", "belt"), (2, 3), 1.09, held, "1.5837"), ("rolling", ("track", "wheel"), (1, 2), 1.69, driven, "")):
        for degree in degrees:
            code, summary, _ = outcome(mortise, scene, *(f"Body {body}/Degree={degree}" for body in bodies))
            if code != 0:
                rows.append(f"| `{scene}` | {degree} | - | - | - | - | - | - | {theory} |")
                continue
            steps = [step for step in summary["steps"] if step["time"] > first]
            iterations = [step["solver"]["newton_iterations"] for step in steps]
            ratios = [ratio(step) for step in steps]
            mean = sum(ratios) / len(ratios)
            rows.append(f"| `{scene}` | {degree} | {last(summary)['dofs']['total']} | {sum(iterations) / len(iterations):.1f} | {max(iterations)} | "
                        f"{summary['timings_s']['total']:.1f} | {mean:.4f} | {max(abs(one - mean) for one in ratios):.4f} | {theory} |")
            print(rows[-1], flush=True)
    return rows


def ironing(mortise, n):
    """On meshes three times as fine along the block and four cells wide; a step draws by half a cell."""
    times = [0.25, 0.5, 0.75, 1.] + [1 + k / 80 for k in range(1, n + 1)]
    code, summary, log = outcome(mortise, "ironing", "Body block/Mesh/Extent=0, 0, -1, 4, 0.5, 0", "Body block/Mesh/Subdivisions=96, 4, 14", "Body die/Mesh/Extent=0.3, 0.6, 0.5",
                                 "Body die/Mesh/Subdivisions=36, 10, 4", "Body die/Mesh/Translate=1, 0.5, 0.6", "Steps/Step=" + ", ".join(f"{t:g}" for t in times), ranks=2)
    ends = [float(seconds) for seconds in re.findall(r"% done in ([0-9.e+]+) s", log)]
    drawn = [step["solver"]["newton_iterations"] for step in summary["steps"] if step["time"] > 1 + 1e-9]
    print(f"exit code {code}, {last(summary)['dofs']['total']} unknowns, {len(drawn)} steps of {n}: {(ends[-1] - ends[3]) / len(drawn):.2f} s each, "
          f"{sum(drawn) / len(drawn):.1f} iterations; {json.dumps(summary['memory_mib'])}")


def main(mortise):
    text = ["### A ball in a cup", "", "An octant of a hollow ball (radii 0.5 and 1) is pushed by 0.05, 0.15 and 0.25 in four steps against a cup of the same neo-Hookean material (radii 1.02 and 1.5).", ""]
    text += balls(mortise) + ["", "### A block slides over another one", "", "`tests/field/block_slides_on_rubber.prm`: from t = 2 on, four lengths of the block, over 22 faces of the longer one, of which each is less than one of its own.", ""]
    text += slides(mortise) + ["", "### A round die slides over a block", "", "Without friction and with E = 1 on both sides, over 20 faces of the block (by the way of `prm/ironing.prm` with meshes of one cell across), about seven of which are in contact.", ""]
    text += ripple(mortise) + ["", "### Friction", "", "Scenes of `prm/` with their degrees changed; iterations and ratios of tangential to normal forces, of the forces at the ends of the belt, in steps in which all slips or rolls.", ""]
    write_part("deformed_contact.md", "three dimensions", "\n".join(text + friction(mortise)))


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[2] == "--ironing":
        ironing(os.path.abspath(sys.argv[1]), int(sys.argv[3]))
    elif len(sys.argv) == 2:
        main(os.path.abspath(sys.argv[1]))
    else:
        sys.exit(__doc__)
