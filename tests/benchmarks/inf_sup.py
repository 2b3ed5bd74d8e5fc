#!/usr/bin/env python3
"""Inf-sup constants of pressures and multipliers: inf_sup.py [BENCHMARK_INF_SUP [TABLE ...]]

Runs the program benchmark_inf_sup (ninja benchmark_inf_sup) on all cases, two at a time, into doc/measurements/inf_sup.csv and writes
doc/measurements/inf_sup.md from it; without a program it only writes the page again. With names of tables
only those are computed, the other rows are kept. The page itself is in inf_sup_report.py."""
import concurrent.futures
import csv
import json
import os
import subprocess
import sys

import inf_sup_report

HERE = os.path.dirname(os.path.abspath(__file__))
DOC = os.path.join(os.path.dirname(os.path.dirname(HERE)), "doc", "measurements")
DEGREES = range(1, 7)


def cube(n):
    return f"{n},{n},{n}"


def layer(n):
    return f"{n},{n},{(n + 1) // 2}"


def pressure_cases():
    meshes = {2: (2, 4, 8), 3: (2, 4, 6), 4: (2, 4), 5: (2,), 6: (2,)}
    for cells in ("hexahedra", "tetrahedra"):
        for p, sizes in meshes.items():
            for n in sizes:
                given = {"degree": p, "cells": cells, "subdivisions": cube(n)}
                yield "closed", given | {"clamped": "all"}
                if n * (p - 1) < 12:
                    yield "held", given | {"clamped": "zmin"}
            given = {"degree": p, "cells": cells, "subdivisions": "2,2,2", "clamped": "all"}
            yield "distorted", given | {"distort": 0.2}
            if p <= 4:
                yield "equal", given | {"equal": 1}
    for p in (2, 3, 4, 5):
        given = {"degree": p, "cells": "hexahedra", "subdivisions": "2,2,2", "clamped": "all", "refine": "1,1,1,0.1,1"}
        yield "hanging", given
        yield "hp", given | {"regions": f"0:{p + 1},3:{min(p + 2, 6)}"}
        yield "curved", {"degree": p, "source": "shell octant", "extent": "1,2", "subdivisions": "1,1", "clamped": "outside"}


STATES = (("stretch", 1), ("stretch", 2), ("stretch", 4), ("press", 2), ("shear", 1), ("shear", 3), ("twist", 1))


def stretched_cases():
    for cells in ("hexahedra", "tetrahedra"):
        for p, n in ((2, 2), (2, 4), (3, 2), (4, 2)):
            for state, size in STATES:
                yield "stretched", {"degree": p, "cells": cells, "subdivisions": cube(n), "clamped": "all", "state": state, "size": size}


RIMS = {"free": {}, "both": {"clamped": "sides", "master_clamped": "sides"}, "slave": {"clamped": "sides"},
        "master": {"master_clamped": "sides"}, "ends": {"clamped": "xmin,xmax", "master_clamped": "xmin,xmax"}}


def tie(p, slave, master, rim, **more):
    return {"degree": p, "master_degree": p, "subdivisions": slave, "master_subdivisions": master} | RIMS[rim] | more


def block_cases():
    # slave on master, largest degree
    pairs = {(2, 2): 6, (2, 3): 6, (2, 4): 6, (2, 10): 4, (3, 2): 6, (4, 2): 4, (5, 1): 3, (6, 4): 2, (9, 6): 1}
    for (n, m), top in pairs.items():
        for p in DEGREES:
            for rim in ("free", "both"):
                if p <= top:
                    yield "block", tie(p, layer(n), layer(m), rim)
            for rim in ("slave", "master"):
                if (n, m) in ((3, 2), (2, 3)) and p <= 4:
                    yield "block", tie(p, layer(n), layer(m), rim)
            for rim in ("free", "both"):
                if (n, m) in ((3, 2), (2, 3), (2, 4), (4, 2)) and p <= min(top, 4):
                    yield "dual", tie(p, layer(n), layer(m), rim, dual=1)
            if (n, m) in ((3, 2), (2, 4)) and p <= 4:
                yield "unreduced", tie(p, layer(n), layer(m), "both", reduced=0)
    for rim in ("free", "both"):
        yield "norm", tie(1, layer(3), layer(2), rim, halvings=2)
        yield "norm", tie(4, layer(3), layer(2), rim, **{"raise": 4})
    for p in (1, 2, 3, 4):
        for shapes in (("tetrahedra", "hexahedra"), ("hexahedra", "tetrahedra"), ("tetrahedra", "tetrahedra")):
            for rim in ("free", "both"):
                yield "shapes", tie(p, layer(3), layer(2), rim, cells=shapes[0], master_cells=shapes[1])
        for rim in ("free", "both"):
            yield "distorted tie", tie(p, layer(3), layer(2), rim, distort=0.2, master_distort=0.2)
            yield "distorted dual", tie(p, layer(3), layer(2), rim, distort=0.2, master_distort=0.2, dual=1)


def strip_cases():
    for fine in (10, 20):
        width = 1 / fine
        extents = {"extent": f"0,0,0,1,{width},{width}", "master_extent": f"0,0,{width},1,{width},{2 * width}"}
        for p in DEGREES:
            for slave, master in ((fine, 1), (1, fine)) + (((fine, fine),) if fine == 10 and p <= 4 else ()):
                for rim in ("free", "ends"):
                    yield "strip", tie(p, f"{slave},1,1", f"{master},1,1", rim, **extents)


def run(program, case):
    table, given = case
    kind = "multiplier" if "master_degree" in given else "pressure"
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    command = [program, kind] + [f"{k}={v}" for k, v in given.items()]
    result = subprocess.run(command, capture_output=True, text=True, env=environment)
    if result.returncode != 0:
        print("FAILED", *command, result.stderr, flush=True)
        return None
    return {"table": table} | given | json.loads(result.stdout)


def rows_of_last_run():
    with open(os.path.join(DOC, "inf_sup.csv")) as table:
        return list(csv.DictReader(table))


def compute(program, tables):
    cases = [case for cases in (pressure_cases(), stretched_cases(), block_cases(), strip_cases()) for case in cases]
    kept = [row for row in rows_of_last_run() if row["table"] not in tables] if tables else []
    cases.sort(key=lambda case: case[1]["degree"])
    names = ["table"]
    for _, given in cases:
        names += [name for name in given if name not in names]
    names += ["displacements", "pressures", "kernel", "multipliers", "beta", "largest", "slave"]
    with open(os.path.join(DOC, "inf_sup.csv"), "w") as file, concurrent.futures.ThreadPoolExecutor(2) as pool:
        writer = csv.DictWriter(file, names)
        writer.writeheader()
        writer.writerows(kept)
        chosen = [case for case in cases if not tables or case[0] in tables]
        for row in pool.map(lambda case: run(program, case), chosen):
            if row:
                writer.writerow(row)
                file.flush()
                print(*row.values(), flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        compute(os.path.abspath(sys.argv[1]), sys.argv[2:])
    rows = rows_of_last_run()
    with open(os.path.join(DOC, "inf_sup.md"), "w") as out:
        out.write(inf_sup_report.page(rows))
