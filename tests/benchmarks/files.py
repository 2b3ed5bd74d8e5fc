#!/usr/bin/env python3
"""Two bodies meshed by gmsh, each on its own, tied: files.py [--beside PROGRAM] MORTISE

Boxes and plates of tetrahedra that were not refined, over degrees, on one and two ranks, medians of --repeats runs. With
--beside another program, of an earlier commit say, runs in turn. Writes doc/measurements/files.md."""
import argparse
import json
import os
import statistics
import subprocess
import tempfile

from processor import on_ranks, openblas

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
GEOMETRY = """SetFactory("OpenCASCADE");
Box(1) = {{0, 0, {bottom}, 1, 1, {height}}};
MeshSize{{:}} = {size};
Physical Volume("box") = {{1}};
Physical Surface("xmin") = {{1}};
Physical Surface("zmin") = {{5}};
Physical Surface("zmax") = {{6}};
"""
BODY = """subsection Body {name}
  subsection Mesh
    set Source = file
    set File = {name}.msh
  end
  subsection Material
    set Young modulus = 10
    set Poisson ratio = 0.3
  end
  subsection Boundary {boundary}
    set {condition}
  end
end
"""
# height of each body, edges of the cells of the lower and the upper, boundary of the lower one that is held, degrees
SCENES = {"boxes": (0.5, 0.0415, 0.0385, "zmin", (1, 2, 3)), "plates": (0.02, 0.025, 0.02, "xmin", (1,))}


def write_scene(directory, height, lower, upper, held):
    """Meshes, and the parameters that read them; returns the number of cells."""
    for name, bottom, size in (("lower", 0, lower), ("upper", height, upper)):
        with open(os.path.join(directory, name + ".geo"), "w") as file:
            file.write(GEOMETRY.format(bottom=bottom, height=height, size=size))
        subprocess.run(["gmsh", "-3", "-format", "msh41", name + ".geo"], cwd=directory, check=True, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
    with open(os.path.join(directory, "scene.prm"), "w") as file:
        file.write("set Bodies = lower, upper\nset Interfaces = glue\n" +
                   BODY.format(name="lower", boundary=held, condition="Displacement = 0, 0, 0") +
                   BODY.format(name="upper", boundary="zmax", condition="Traction = 0.1, 0, 1") +
                   "subsection Interface glue\n  set Slave = lower: zmax\n  set Master = upper: zmin\nend\n"
                   "subsection Solver\n  set Tolerance = 1e-8\nend\n")


def run(program, directory, degree, ranks):
    command = (on_ranks(ranks) if ranks > 1 else []) + [program, "scene.prm", "--output", "results", "--set", "Output/Fields="]
    for body in ("lower", "upper"):
        command += ["--set", f"Body {body}/Degree={degree}"]
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", DEAL_II_NUM_THREADS="1", **openblas())
    subprocess.run(command, cwd=directory, check=True, stdout=subprocess.DEVNULL, env=environment)
    with open(os.path.join(directory, "results", "summary.json")) as file:
        summary = json.load(file)
    step, times = summary["steps"][-1], summary["timings_s"]
    return {"dofs": step["dofs"]["displacement"], "cells": sum(body["cells"] for body in step["bodies"]), "iterations": step["solver"]["iterations"],
            "setup": times["solver_setup"], "solve": times["solve"], "total": times["total"],
            "memory": summary["memory_mib"]["peak_sum_over_ranks"] / step["dofs"]["displacement"] * 1e6}


def medians(programs, repeats, *options):
    found = [[run(program, *options) for program in programs] for _ in range(repeats)]  # in turn
    return [{key: statistics.median(round_[k][key] for round_ in found) for key in found[0][k]} for k in range(len(programs))]


def rows(programs, repeats):
    with tempfile.TemporaryDirectory() as directory:
        for name, (height, lower, upper, held, degrees) in SCENES.items():
            write_scene(directory, height, lower, upper, held)
            for degree in degrees:
                for ranks in (1, 2):
                    new, *old = medians(programs, repeats, directory, degree, ranks)
                    line = (f"| {name} | {new['cells']} | {degree} | {new['dofs']} | {ranks} | {new['iterations']} | {new['setup']:.2f} | "
                            f"{new['solve']:.2f} | {new['total']:.2f} | {new['memory']:.0f} |")
                    for other in old:
                        line += (f" {other['iterations']} | {other['setup']:.2f} | {other['solve']:.2f} | "
                                 f"{(new['setup'] + new['solve']) / (other['setup'] + other['solve']):.2f} |")
                    print(line, flush=True)
                    yield line


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("mortise")
    parser.add_argument("--beside", help="another program")
    parser.add_argument("--with-name", default="the other", help="what it is, for the page")
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args()
    programs = [os.path.abspath(program) for program in (given.mortise, given.beside) if program]
    with open("/proc/cpuinfo") as file:
        model, flags = (next(line.split(":")[1].strip() for line in file if line.startswith(word)) for word in ("model name", "flags"))
    width = ("with" if "avx512f" in flags else "without") + " AVX-512"
    head = "| scene | cells | p | dofs | ranks | iterations | setup | solve | whole run | MiB per million dofs |"
    note = ""
    if given.beside:
        head += " its iterations | its setup | its solve | of its setup and solve |"
        note = f" `--beside`: {given.with_name}, in turn."
    lines = [f"# Meshes from files\n\nRegenerate: `tests/benchmarks/files.py build/mortise` (with `--beside PROGRAM` another program runs in turn).\n"
             f"Two boxes, and two plates a fiftieth as high as wide, each meshed by gmsh with edges of its own, tetrahedra of straight edges, not "
             f"refined; seconds,\nmedians of {given.repeats}, on {model} {width}; tolerance 1e-8.{note}\n",
             head, "|" + "---|" * (head.count("|") - 1), *rows(programs, given.repeats)]
    with open(os.path.join(TOP, "doc", "measurements", "files.md"), "w") as page:
        print(*lines, sep="\n", file=page)


if __name__ == "__main__":
    main()
