#!/usr/bin/env python3
"""Bodies in mixed form up to nu = 0.5: incompressible.py [--quick] [--part PART] MORTISE

Errors of the thick sphere and cylinder over Poisson's ratio, tied beside conforming; iterations to 1e-8 over
degree, mesh, nu, moduli, slave and ranks, and of a clamped cube; time and memory of nu = 0.5 beside the
displacement form at nu = 0.3. Writes doc/measurements/incompressible.csv and doc/measurements/incompressible.md. With --part (errors,
iterations, time or none) the rows of the other parts are those of the last run."""
import argparse
import csv
import itertools
import json
import math
import os
import resource
import statistics
import subprocess
import tempfile
import time

from processor import on_ranks, openblas

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FILES = os.path.join(TOP, "doc", "measurements", "incompressible")
STAGES = ("spaces", "interface_search", "interface_clipping", "coupling", "bulk", "solver_setup", "solve")  # as run_time.py
RATIOS = ("0.3", "0.49", "0.4999", "0.499999", "0.5")
LAYERS = ("inner", "outer")
NORMS = {"l2": "displacement_l2", "h1": "displacement_h1", "pressure": "pressure_l2", "multiplier": "multiplier_l2"}
# the coarser n of (n, 2n) by degree
SIZES = {("thick_sphere", "hexahedra"): {2: 4, 3: 4, 4: 4, 5: 2, 6: 2}, ("thick_cylinder", "hexahedra"): {2: 8, 3: 8, 4: 4, 5: 4, 6: 4},
         ("thick_sphere", "tetrahedra"): {2: 4, 3: 2, 4: 2}, ("thick_cylinder", "tetrahedra"): {2: 8, 3: 4, 4: 4}}
MESHES = {2: "8,4:12,6", 3: "4,2:6,3", 4: "4,2:6,3", 5: "4,2:6,3", 6: "2,1:3,2", 7: "2,1:3,2", 8: "2,1:3,2"}
REFINED = {2: ("4,2:6,3", "8,4:12,6", "16,8:24,12"), 4: ("2,1:3,2", "4,2:6,3", "8,4:12,6")}
TIMED = {2: ("7,4:8,4", "9,5:12,6", "14,7:21,10"), 3: ("4,2:6,3", "6,3:8,4", "9,5:13,7"), 4: ("3,2:4,3", "4,2:6,3", "7,4:9,5")}
CUBE = """set Bodies = cube
subsection Body cube
  set Body force = sin(pi*x); y^2; x*z
  subsection Mesh
    set Source = box
    set Extent = 0, 0, 0, 1, 1, 1
  end
""" + "".join(f"  subsection Boundary {side}\n    set Displacement = 0, 0, 0\n  end\n" for side in ("xmin", "xmax", "ymin", "ymax", "zmin")) + "end\n"


def run(mortise, scene, settings, ranks=1):
    """Summary of a run, which may end without convergence; with the seconds of the process, elapsed and of work."""
    with tempfile.TemporaryDirectory() as work:
        if scene == "cube":
            with open(os.path.join(work, "cube.prm"), "w") as file:
                file.write(CUBE)
        folder = work if scene == "cube" else os.path.join(TOP, "prm")
        command = [mortise, os.path.join(folder, scene + ".prm"), "--output", work]
        for setting in ["Output/Fields=", *settings]:
            command += ["--set", setting]
        if ranks > 1:
            command = on_ranks(ranks) + command
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", **openblas())
        start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
        result = subprocess.run(command, stdout=subprocess.DEVNULL, cwd=TOP, env=environment)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if result.returncode not in (0, 3):
            raise SystemExit(f"exit code {result.returncode} of " + " ".join(f'"{word}"' for word in command))
        with open(os.path.join(work, "summary.json")) as file:
            summary = json.load(file)
    return {**summary, "converged": result.returncode == 0, "process": time.perf_counter() - start,
            "work": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime}


PARAMETERS = {"nu": "Material/Poisson ratio", "form": "Formulation", "young": "Material/Young modulus", "degree": "Degree", "cells": "Mesh/Cells"}


def of_bodies(names, subdivisions, **parameters):
    """Settings of all bodies; a value may hold one entry per body, separated by " | "."""
    settings = [f"Body {body}/Mesh/Subdivisions={mesh}" for body, mesh in zip(names, subdivisions)]
    for name, value in parameters.items():
        values = str(value).split(" | ")
        settings += [f"Body {body}/{PARAMETERS[name]}={values[i % len(values)]}" for i, body in enumerate(names)]
    return settings


# ---- errors


def layers(scene, n):
    """Subdivisions of the inner and the outer layer, 2 : 3 cells, and of the conforming twin."""
    m, end = n // 2, ("", "") if scene == "thick_sphere" else (", 1", ", 2")
    return {"tied": (f"{n}, {m}{end[0]}", f"{3 * n // 2}, {m}{end[1]}"), "conforming": (f"{n}, {2 * m}{end[0]}",)}


def error_rows(mortise, quick):
    for (scene, cells), sizes in SIZES.items():
        for p, n, kind in itertools.product(sizes, (1, 2), ("tied", "conforming")):
            if quick and p > 3:
                continue
            n *= sizes[p]
            for nu in RATIOS if kind == "tied" else RATIOS[-1:]:
                names = LAYERS if kind == "tied" else ("shell",)
                settings = of_bodies(names, layers(scene, n)[kind], degree=p, cells=cells, nu=nu, form="mixed") + ["Solver/Tolerance=1e-11"]
                result = run(mortise, scene + ("" if kind == "tied" else "_conforming"), settings)
                step = result["steps"][-1]
                yield {"part": "errors", "scene": scene, "cells": cells, "degree": p, "mesh": n, "kind": kind, "nu": nu, "form": "mixed",
                       "dofs": step["dofs"]["total"], "method": step["solver"]["method"], "iterations": step["solver"]["iterations"],
                       "converged": result["converged"], "process": result["process"],
                       **{key: step["errors"].get(name) for key, name in NORMS.items()}}


def over_ratios(rows):
    """For each scene, shape and degree: factors over nu, rates at nu = 0.5, and tied over conforming."""
    rows = [r for r in rows if r["part"] == "errors"]
    for case in dict.fromkeys((r["scene"], r["cells"], r["degree"]) for r in rows):
        part = [r for r in rows if (r["scene"], r["cells"], r["degree"]) == case]
        meshes = sorted({r["mesh"] for r in part})
        at = {(r["kind"], r["mesh"], r["nu"]): r for r in part}
        result = {"scene": case[0].replace("thick_", ""), "cells": case[1], "degree": case[2], "meshes": meshes,
                  "dofs": at["tied", meshes[-1], "0.5"]["dofs"]}
        rate = lambda kind, key: math.log(at[kind, meshes[0], "0.5"][key] / at[kind, meshes[-1], "0.5"][key]) / math.log(meshes[-1] / meshes[0])
        for key in NORMS:
            result["factor", key] = max(max(e) / min(e) for e in ([at["tied", n, nu][key] for nu in RATIOS] for n in meshes))
            result["rate", key] = rate("tied", key)
            if key != "multiplier":
                result["rate of twin", key] = rate("conforming", key)
                result["over twin", key] = max(at["tied", n, "0.5"][key] / at["conforming", n, "0.5"][key] for n in meshes)
        yield result


# ---- iterations


CG, GMRES = "condensed", "saddle point"
REFERENCES = {("displacement", "0.3", CG): "0.3, displacement, CG", ("displacement", "0.3", GMRES): "0.3, displacement, GMRES",
              ("mixed", "0.3", GMRES): "0.3, mixed"}
MIXED = {("mixed", nu, GMRES): nu for nu in RATIOS[1:]}
HALF = {("mixed", "0.5", GMRES): "0.5"}
ONE = {("mixed | displacement", "0.5 | 0.3", GMRES): "0.5 : 0.3, displacement",
       ("displacement | mixed", "0.3 | 0.5", GMRES): "0.3, displacement : 0.5"}
CASE = ("table", "scene", "cells", "degree", "mesh", "slave", "young", "ranks")
TABLES = {"degree": "Over degree and nu", "mesh": "Over the mesh", "moduli": "Over Young's moduli (inner : outer) and side of the slave",
          "one": "One body incompressible, the other with nu = 0.3 in displacement form (inner : outer)",
          "tetrahedra": "Tetrahedra", "cube": "A cube clamped on five sides, no interface"}
BRIEF = {"degree": "degrees", "mesh": "meshes", "moduli": "moduli", "one": "one body incompressible",
         "tetrahedra": "tetrahedra", "cube": "clamped cube"}
SHOWN = {"moduli": ("degree", "slave", "young"), "one": ("degree", "slave"), "tetrahedra": ("degree", "mesh", "ranks")}


def iteration_jobs(quick):
    """Dictionaries of what is run; what is compared has all in common but form, nu and method."""
    def jobs(name, variants, **case):
        for form, nu, method in (*REFERENCES, *variants):
            yield {"table": name, "scene": "thick_sphere", "cells": "hexahedra", "slave": "inner", "young": "10", "ranks": 1,
                   "form": form, "nu": nu, "method": method, **case}
    few = (2,) if quick else (2, 4)
    for p in (p for p in MESHES if not quick or p < 5):
        yield from jobs("degree", MIXED, degree=p, mesh=MESHES[p])
    for p, meshes in REFINED.items():
        for mesh in meshes[:2] if quick else meshes:
            yield from jobs("mesh", HALF, degree=p, mesh=mesh)
    for p, slave, factor in itertools.product(few, LAYERS, (1e-6, 1e-3, 1e3, 1e6)):
        yield from jobs("moduli", HALF, degree=p, mesh="4,2:6,3", slave=slave, young=f"{10 * factor:g} | 10")
    for p, slave in itertools.product(few, LAYERS):
        yield from jobs("one", {**ONE, **HALF}, degree=p, mesh="4,2:6,3", slave=slave)
    for p, ranks in itertools.product((2, 3), (1, 2)):
        yield from jobs("tetrahedra", MIXED, degree=p, mesh={2: "4,2:6,3", 3: "2,1:3,2"}[p], cells="tetrahedra", ranks=ranks)
    for mesh in ("3,3,3", "6,6,6"):
        yield from jobs("cube", MIXED, scene="cube", degree=3, mesh=mesh)


def iteration_rows(mortise, quick):
    known = {}  # the same run may stand in two tables
    for job in iteration_jobs(quick):
        settings = of_bodies(("cube",) if job["scene"] == "cube" else LAYERS, job["mesh"].split(":"),
                             **{k: job[k] for k in ("degree", "cells", "nu", "form", "young")})
        settings += ["Solver/Tolerance=1e-8", f"Solver/Method={job['method']}"]
        if job["slave"] == "outer":
            settings += ["Interface glue/Slave=outer: inside", "Interface glue/Master=inner: outside"]
        key = (job["scene"], job["ranks"], *settings)
        if key not in known:
            result = run(mortise, job["scene"], settings, job["ranks"])
            step = result["steps"][-1]
            known[key] = {"dofs": step["dofs"]["total"], "iterations": step["solver"]["iterations"], "converged": result["converged"],
                          "process": result["process"]}
        yield {"part": "iterations", **job, **known[key]}


def cases(rows, name=None):
    """Rows of iterations by case: {case: {(form, nu, method): row}}."""
    found = {}
    for r in rows:
        if r["part"] == "iterations" and name in (None, r["table"]):
            found.setdefault(tuple(r[k] for k in CASE), {})[r["form"], r["nu"], r["method"]] = r
    return found


def worst_over(case, reference):
    """Most iterations with an incompressible or nearly incompressible body over those of a reference."""
    return max(r["iterations"] for variant, r in case.items() if variant not in REFERENCES) / case[reference]["iterations"]


# ---- time


TIMES = ("seconds", "process", "work", "memory_mib")
FORMS = (("displacement", "0.3"), ("mixed", "0.5"))


def time_rows(mortise, quick):
    for p, meshes in TIMED.items():
        for mesh in meshes[:1] if quick else meshes:
            results = {form: [] for form in FORMS}
            for _ in range(2 if quick else 5):
                for form, nu in FORMS:
                    settings = of_bodies(LAYERS, mesh.split(":"), degree=p, form=form, nu=nu) + ["Solver/Tolerance=1e-8"]
                    results[form, nu].append(run(mortise, "thick_sphere", settings))
            for (form, nu), runs in results.items():
                step = runs[0]["steps"][-1]
                for r in runs:
                    r.update(seconds=sum(r["timings_s"].get(s, 0) for s in STAGES), memory_mib=r["memory_mib"]["peak_sum_over_ranks"])
                yield {"part": "time", "scene": "thick_sphere", "cells": "hexahedra", "degree": p, "mesh": mesh, "form": form, "nu": nu,
                       "dofs": step["dofs"]["total"], "method": step["solver"]["method"], "iterations": step["solver"]["iterations"],
                       "h1": step["errors"]["displacement_h1"], **{key: statistics.median(r[key] for r in runs) for key in TIMES},
                       **{"in_" + s: statistics.median(r["timings_s"].get(s, 0) for r in runs) for s in STAGES}}


# ---- page


FIELDS = ("part", "table", "scene", "cells", "kind", "degree", "mesh", "slave", "young", "ranks", "form", "nu", "method", "dofs", "iterations", "converged",
          *NORMS, *TIMES, *("in_" + s for s in STAGES))


def table(columns, rows):
    line = lambda row: "| " + " | ".join(map(str, row)) + " |"
    return "\n".join([line(columns), "|" + "---|" * len(columns), *map(line, rows)]) + "\n"


def error_tables(rows):
    found = list(over_ratios(rows))
    yield table(("scene", "cells", "p", "n", "dofs", "factor: L2", "H1", "pressure", "multiplier", "rate: L2", "H1", "pressure", "multiplier",
                 "of twin: L2", "H1", "pressure", "tied / twin: H1", "pressure"),
                ((r["scene"], r["cells"][:3], r["degree"], ", ".join(map(str, r["meshes"])), r["dofs"], *(f"{r['factor', k]:.2f}" for k in NORMS),
                  *(f"{r['rate', k]:.2f}" for k in NORMS), *(f"{r['rate of twin', k]:.2f}" for k in ("l2", "h1", "pressure")),
                  *(f"{r['over twin', k]:.3f}" for k in ("h1", "pressure"))) for r in found))
    shown = [r for r in rows if r["part"] == "errors" and r["kind"] == "tied" and r["degree"] in (2, 4) and r["cells"] == "hexahedra"]
    finest = {(r["scene"], r["degree"]): max(o["mesh"] for o in shown if (o["scene"], o["degree"]) == (r["scene"], r["degree"])) for r in shown}
    shown = {(r["scene"], r["degree"], r["nu"]): r for r in shown if r["mesh"] == finest[r["scene"], r["degree"]]}
    yield table(("scene", "p", "n", "error", *("nu = " + nu for nu in RATIOS)),
                ((scene.replace("thick_", ""), p, n, name, *(f"{shown[scene, p, nu][key]:.3e}" for nu in RATIOS))
                 for (scene, p), n in finest.items() for key, name in zip(NORMS, ("L2", "H1", "pressure", "multiplier"))))


def iteration_table(rows, name):
    found = cases(rows, name)
    titles = {**REFERENCES, **ONE, **MIXED}
    variants = [v for v in titles if any(v in case for case in found.values())]
    columns = SHOWN.get(name, ("degree", "mesh"))
    count = lambda r: ("" if r["converged"] else "> ") + str(r["iterations"])
    show = lambda key: (str(dict(zip(CASE, key))[c]).replace(" |", " :") for c in columns)
    return table((*({"degree": "p", "young": "moduli"}.get(c, c) for c in columns), *(titles[v] for v in variants),
                  "over CG", "over GMRES", "over 0.3, mixed"),
                 ((*show(key), *(count(case[v]) for v in variants), *(f"{worst_over(case, v):.2f}" for v in REFERENCES))
                  for key, case in found.items()))


def time_table(rows):
    found = {(r["degree"], r["mesh"], r["form"]): r for r in rows if r["part"] == "time"}
    for p, mesh, _ in (key for key in found if key[2] == "mixed"):
        a, b = found[p, mesh, "displacement"], found[p, mesh, "mixed"]
        both = lambda key, digits: (f"{a[key]:.{digits}f}", f"{b[key]:.{digits}f}", f"{b[key] / a[key]:.2f}")
        yield (p, mesh, a["dofs"], b["dofs"], a["iterations"], b["iterations"], *both("seconds", 2), *both("process", 2), both("work", 2)[2],
               *both("memory_mib", 0))


def name_of(r):
    return f"{r['scene']} {r['cells'][:3]} p {r['degree']}"


def error_verdicts(rows):
    found = list(over_ratios(rows))
    if not found:
        return
    worst, key, r = max(((r["factor", k], k, r) for r in found for k in NORMS), key=lambda entry: entry[0])
    yield ("errors of any two nu within a factor of 2", f"largest {worst:.2f} ({key}, {name_of(r)})",
           [f"{name_of(r)} ({k} {r['factor', k]:.2f})" for r in found for k in NORMS if r["factor", k] > 2])
    pairs = [(r["degree"] + (k == "l2") - r["rate", k], k, r) for r in found for k in ("l2", "h1", "pressure")]
    least, key, r = max(pairs, key=lambda entry: entry[0])
    twin = max(abs(r["rate", k] - r["rate of twin", k]) for _, k, r in pairs)
    short = {name_of(r): max(d for d, _, o in pairs if o is r) for r in found}
    yield ("nu = 0.5: H1 error and pressure h^p, L2 error h^(p+1)",
           f"least {r['rate', key]:.2f} of {r['degree'] + (key == 'l2')} ({key}, {name_of(r)}); all within {twin:.2f} of conforming meshes",
           [f"{name} (by up to {d:.2f})" for name, d in short.items() if d > 0.3])
    worst, key, r = max(((r["over twin", k], k, r) for r in found for k in ("h1", "pressure")), key=lambda entry: entry[0])
    yield ("nu = 0.5: H1 error and pressure tied at most 1.1 times conforming", f"largest {worst:.3f} ({key}, {name_of(r)})",
           [f"{name_of(r)} ({k} {r['over twin', k]:.3f})" for r in found for k in ("h1", "pressure") if r["over twin", k] > 1.1])


def iteration_verdicts(rows):
    found = cases(rows)
    if not found:
        return
    for reference, name in REFERENCES.items():
        ratios = {key: worst_over(case, reference) for key, case in found.items()}
        most = {t: max(v for key, v in ratios.items() if key[0] == t) for t in TABLES}
        yield (f"iterations at most 1.5 times those of nu = {name}", f"above 1.5 in {sum(v > 1.5 for v in ratios.values())} of {len(ratios)} cases",
               [f"{BRIEF[t]} (up to {v:.2f})" for t, v in most.items() if v > 1.5])
    counts = [[case[v]["iterations"] for v in MIXED] for case in found.values() if set(MIXED) <= set(case)]
    spread = lambda first: max(max(n[first:]) - min(n[first:]) for n in counts)
    yield ("iterations the same for every nu", f"within {spread(1)} from 0.4999 to 0.5, within {spread(0)} from 0.49 to 0.5; fewer at 0.3", [])


def verdicts(rows):
    """What is claimed, what was measured, and where it is missed."""
    yield from error_verdicts(rows)
    yield from iteration_verdicts(rows)
    found = {(r["degree"], r["mesh"], r["form"]): r for r in rows if r["part"] == "time"}
    ratios = {key[:2]: r["seconds"] / found[(*key[:2], "displacement")]["seconds"] for key, r in found.items() if key[2] == "mixed"}
    if ratios:
        yield ("solve at nu = 0.5 at most 3 times that of nu = 0.3 in displacement form",
               f"{min(ratios.values()):.2f} to {max(ratios.values()):.2f} times",
               [f"p {p}, {mesh} ({ratio:.2f})" for (p, mesh), ratio in ratios.items() if ratio > 3])


INTRODUCTION = """# Incompressible bodies

Regenerate: `tests/benchmarks/incompressible.py build/mortise` (writes this page and [all rows](incompressible.csv)).
"""
FORM = """## The form

A body in mixed form (`Formulation`) has a pressure of its own, continuous and one degree lower than the displacement
(Taylor-Hood, p / p-1); it jumps from body to body. The law is

    sigma = 2 mu eps + lambda_u tr(eps) I - p I,   tr(eps) + c p = 0,

with lambda_u = 1 / (1 / lambda + 1 / (mu / 2)), the bounded part of lambda that the displacement keeps, and c = 1 / (lambda -
lambda_u), which is zero for nu = 0.5. The solver is GMRES with an upper block triangle: for displacements multigrid in
the degree among what satisfies the tie, for pressures a mass matrix scaled by
c + 1 / (2/3 mu + lambda_u), but the Schur complement of the cell where displacements are prescribed
(cells of degree 4 at most with a face held in all components); by a polynomial of Chebyshev in its scaled diagonal.
Errors are relative; "pressure" is the mean pressure -tr(sigma) / 3, whatever the form.
"""
ERRORS = """## Errors

Scenes `prm/thick_sphere.prm`, `prm/thick_cylinder.prm` and their conforming twins, all bodies in mixed form, tied with 2 : 3 cells,
tolerance 1e-11. n: cells per patch edge or around of the inner body, on the two meshes. Factor: the largest between the
errors of any two of nu = """ + ", ".join(RATIOS) + """, on both meshes; rates at nu = 0.5; twin: one conforming mesh.
The exact mean pressure is constant in these scenes, for every nu. Where the sphere has 2 and 4 cells per
patch edge (p = 5, 6 and tetrahedra from p = 3 on) that is still too coarse for the limits, as it is for the displacement
form ([rates](rates.md)).
"""
ITERATIONS = """## Iterations

To a residual of 1e-8. Columns: nu and form (mixed unless it is said), beside the two methods for displacements alone:
conjugate gradients on those that satisfy the tie (`condensed`, the default) and GMRES (`saddle point`). "Over": the most iterations
with a body of nu = 0.49 or more over those of each column with nu = 0.3. Thick sphere, subdivisions
inner : outer, hexahedra without a matrix, unless something else is said.
"""
CUBE_TEXT = """The cube [0, 1]^3 with body force (sin(pi x), y^2, x z) gives way through one side only, so the inf-sup constant is
small: with a mass matrix alone the counts at nu = 0.5 are 31 and 32.
"""
TIME = """## Time

Tied thick sphere to 1e-8 on one core; a: nu = 0.3 in displacement form (CG), b: nu = 0.5. Medians
of five runs each, taken alternately. Seconds; "solve" is all stages but mesh, postprocess and output, "process" the whole
process, "work" the ratio of its processor time; the cores are shared with other work. MiB: peak memory. Subdivisions
inner : outer.
"""


def page(rows):
    yield INTRODUCTION
    yield table(("claimed", "measured", "missed in"), ((a, b, "; ".join(c) or "-") for a, b, c in verdicts(rows)))
    yield FORM
    yield ERRORS
    yield from error_tables(rows)
    yield ITERATIONS
    for name, title in TABLES.items():
        yield f"{title}{', 4,2:6,3' if name in ('moduli', 'one') else ''}:\n"
        yield iteration_table(rows, name)
    yield CUBE_TEXT
    yield TIME
    yield table(("p", "mesh", "dofs a", "b", "iterations a", "b", "solve a", "b", "b / a", "process a", "b", "b / a", "work b / a",
                 "MiB a", "b", "b / a"), time_table(rows))


# ---- files


def number(text):
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return None if text == "" else {"True": True, "False": False}.get(text, text)


def earlier_rows(parts):
    if not os.path.exists(FILES + ".csv"):
        return []
    with open(FILES + ".csv") as file:
        return [{k: v if k in ("nu", "young") else number(v) for k, v in row.items()} for row in csv.DictReader(file) if row["part"] in parts]


def write(rows):
    with open(FILES + ".csv", "w") as file:
        output = csv.DictWriter(file, FIELDS, lineterminator="\n")
        output.writeheader()
        output.writerows(rows)
    with open(FILES + ".md", "w") as file:
        file.write("\n".join(page(rows)).rstrip() + "\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--part", choices=("errors", "iterations", "time", "none"))
    parser.add_argument("mortise")
    options = parser.parse_args()
    mortise, rows = os.path.abspath(options.mortise), []
    for part, measure in (("errors", error_rows), ("iterations", iteration_rows), ("time", time_rows)):
        if options.part not in (None, part):
            rows += earlier_rows((part,))
            continue
        for row in measure(mortise, options.quick):
            rows.append({k: float(f"{v:.6g}") if isinstance(v, float) else v for k, v in row.items()})
            print(*(f"{v:.4g}" if isinstance(v, float) else v for v in row.values()), flush=True)
    write(rows)


if __name__ == "__main__":
    main()
