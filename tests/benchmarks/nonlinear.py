#!/usr/bin/env python3
"""nonlinear.py BENCHMARK_NONLINEAR MORTISE: write the tables of doc/measurements/nonlinear.md that stand below its
mark: products with tangents beside Hooke's, Newton's method on the scenes of prm/ with nonlinear laws, steps of plasticity beside linear
solves, and errors of the balloon of tests/field/balloon_to_a_target.prm."""
import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PAGE = os.path.join(TOP, "doc", "measurements", "nonlinear.md")
MARK = "<!-- tables -->\n"
SCENES = ["balloon", "torsion", "cantilever_large", "column", "autofrettage"]

RATES = """The balloon under a given pressure, a = 1.5: the inner layer has 2 k, the outer one 3 k cells along an edge of a patch, and k layers each; conforming: both
2 k. Expected are h^p in the energy norm (of logarithmic strains) and h^(p+1)."""

CUBE = """set Bodies = cube
subsection Body cube
  set Degree = 4
  subsection Mesh
    set Source       = box
    set Extent       = 0, 0, 0, 1, 1, 1
    set Subdivisions = {n}, {n}, {n}
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 1
    set Poisson ratio = 0.3
  end
  subsection Boundary zmin
    set Displacement = 0, 0, 0
  end
  subsection Boundary zmax
    set Displacement = 0, 0, 0.5 * t
  end
end
subsection Steps
  set Step = 0.2
  set End time = 1
end
subsection Output
  set Fields =
end
"""


def run(command):
    begin = time.time()
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(command)}: {done.stdout[-500:]}{done.stderr}")
    return done.stdout, time.time() - begin


def products(program):
    rows = ["| cells | p | law | Hooke, ns | product | single | residual | linearise | levels |", "|---|---|---|---|---|---|---|---|---|"]
    for line in run([program])[0].splitlines():
        words = line.split()
        cells, p, law, numbers = words[0], words[1], " ".join(words[3:-6]), words[-6:]
        rows.append(f"| {cells} | {p} | {law} | " + " | ".join(numbers) + " |")
    return rows


def scene_row(name, output, seconds):
    steps = json.load(open(os.path.join(output, "summary.json")))
    newton = [s["solver"]["newton_iterations"] for s in steps["steps"]]
    linear = sum(s["solver"]["linear_iterations"] for s in steps["steps"])
    dofs = steps["steps"][0]["dofs"]["total"]
    memory = steps["memory_mib"]["peak_max_rank"]
    return f"| {name} | {dofs} | {len(newton)} | {sum(newton)} | {max(newton)} | {linear / sum(newton):.1f} | {seconds:.1f} | {memory:.0f} |"


def scenes(program):
    rows = ["| scene | unknowns | steps | Newton | most in a step | linear iterations each | seconds | MiB per rank |", "|---|---|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as work:
        for name in SCENES:
            output = os.path.join(work, name)
            _, seconds = run([program, "--output", output, "--set", "Output/Fields=", os.path.join(TOP, "prm", name + ".prm")])
            rows.append(scene_row("`" + name + "`", output, seconds))
        for n, ranks in ((8, 1), (17, 2)):
            file = os.path.join(work, f"cube{n}.prm")
            open(file, "w").write(CUBE.format(n=n))
            output = os.path.join(work, f"cube{n}")
            _, seconds = run([os.path.join(TOP, "tests", "mpi.sh"), str(ranks), program, "--output", output, file])
            rows.append(scene_row(f"cube, p = 4, {n}^3 cells, stretched by 50 %, {ranks} rank{'s' * (ranks > 1)}", output, seconds))
    return rows


FLOW = """`autofrettage` beside the same bodies with a linear law. Seconds of the processor are those of all that a step does; the first one has the
first set-up of the solver, as a linear scene has. Its first yield is at t = 0.53, and from t = 1 on it is unloaded. Medians of 5 runs."""


def times_of_steps(program, work, settings, scene):
    """Medians of the seconds of each step over five runs, and the summary of the last."""
    runs = []
    for _ in range(5):
        log, _ = run([program, "--output", work, "--set", "Output/Fields="] + [word for setting in settings for word in ("--set", setting)] + [scene])
        ends = [float(t) for t in re.findall(r"done in (\S+) s", log)]
        begin = sum(float(t) for t in re.findall(r"^  (?:mesh|spaces|interface \w+|coupling|bulk) +(\S+) s", log, re.M))
        runs.append([b - a for a, b in zip([begin] + ends, ends)])
    with open(os.path.join(work, "summary.json")) as file:
        return [statistics.median(times) for times in zip(*runs)], json.load(file)["steps"]


def flow(program):
    rows = ["| p | unknowns | linear: iterations | seconds | J2: to t | Newton | linear iterations | seconds | by the linear step |", "|---|---|---|---|---|---|---|---|---|"]
    scene = os.path.join(TOP, "prm", "autofrettage.prm")
    with tempfile.TemporaryDirectory() as work:
        linear = os.path.join(work, "linear.prm")
        with open(scene) as file, open(linear, "w") as to:
            to.writelines(line for line in file if "set Law" not in line and "set Yield" not in line)
        for p, inner, outer in ((2, "8, 4", "6, 4"), (3, "6, 4", "5, 3"), (4, "6, 3", "5, 3")):
            mesh = [f"Body inner/Degree={p}", f"Body outer/Degree={p}", f"Body inner/Mesh/Subdivisions={inner}", f"Body outer/Mesh/Subdivisions={outer}"]
            (once,), (step,) = times_of_steps(program, work, mesh + ["Steps/Step=1", "Steps/End time=1"], linear)
            start = f"| {p} | {step['dofs']['total']} | {step['solver']['iterations']} | {once:.3f} |"
            for seconds, step in zip(*times_of_steps(program, work, mesh + ["Steps/Step=0.25, 0.75, 0.9, 1, 2"], scene)):
                solver = step["solver"]
                rows.append(f"{start} {step['time']:g} | {solver['newton_iterations']} | {solver['linear_iterations']} | {seconds:.3f} | {seconds / once:.2f} |")
                start = "| | | | |"
    return rows


def errors_of(program, output, settings):
    """The steps of the balloon."""
    scene = os.path.join(TOP, "tests", "field", "balloon_to_a_target.prm")
    run([program, "--output", output, "--set", "Output/Fields="] + [word for setting in settings for word in ("--set", setting)] + [scene])
    return json.load(open(os.path.join(output, "summary.json")))["steps"]


def rates(program):
    rows = ["| p | k | tied: energy | rate | displacement, L2 | rate | tied by conforming: energy | L2 |", "|---|---|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as work:
        for p in range(2, 7):
            before = None
            for k in (1, 2, 4) if p < 5 else (1, 2):
                common = ["Adaptivity/Target error=", "Solver/Tolerance=1e-11", f"Body inner/Degree={p}", f"Body outer/Degree={p}", f"Body inner/Mesh/Subdivisions={2 * k}, {k}"]
                found = []
                for n in (3 * k, 2 * k):
                    errors = errors_of(program, work, common + [f"Body outer/Mesh/Subdivisions={n}, {k}"])[-1]["errors"]
                    found.append([errors["energy"], errors["displacement_l2"]])
                tied, conforming = found
                rate = [f"{math.log2(a / b):.2f}" for a, b in zip(before, tied)] if before else ["", ""]
                rows.append(f"| {p} | {k} | {tied[0]:.2e} | {rate[0]} | {tied[1]:.2e} | {rate[1]} | {tied[0] / conforming[0]:.3f} | {tied[1] / conforming[1]:.3f} |")
                before = tied
    return rows


def targets(program):
    rows = ["| target | cycles | unknowns | estimate | error | Newton by cycle |", "|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as work:
        for target in ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6"):
            steps = errors_of(program, work, ["Adaptivity/Target error=" + target])
            newton = ", ".join(str(s["solver"]["newton_iterations"]) for s in steps)
            last = steps[-1]
            rows.append(f"| {target} | {len(steps)} | {last['dofs']['total']} | {last['adaptivity']['estimate']:.2e} | {last['errors']['energy']:.2e} | {newton} |")
    return rows


def main(benchmark, mortise):
    text = open(PAGE).read()
    head = text[:text.index(MARK) + len(MARK)]
    tables = ["## Products", ""] + products(benchmark) + ["", "## Scenes", ""] + scenes(mortise)
    tables += ["", "## Steps of plasticity", "", FLOW, ""] + flow(mortise)
    tables += ["", "## Rates", "", RATES, ""] + rates(mortise) + ["", "## Target errors", ""] + targets(mortise)
    open(PAGE, "w").write(head + "\n" + "\n".join(tables) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*map(os.path.abspath, sys.argv[1:]))
