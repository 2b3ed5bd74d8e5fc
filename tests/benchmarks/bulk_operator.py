#!/usr/bin/env python3
"""Products without a matrix, one core and two: bulk_operator.py BENCHMARK_BULK

Runs the program benchmark_bulk (ninja benchmark_bulk) on one and two ranks and writes doc/bulk.md."""
import os
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def rows(program, ranks):
    root = ["--allow-run-as-root"] if os.getuid() == 0 else []
    command = ["mpirun", "-q", "-n", str(ranks), "--bind-to", "none"] + root + [program, str(3e5 * ranks)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return [line.rsplit(None, 4) for line in lines]


def main():
    one, two = (rows(os.path.abspath(sys.argv[1]), ranks) for ranks in (1, 2))
    model = next(line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    text = ["# Products with the stiffness without a matrix", "",
            "Regenerate: `ninja -C build benchmark_bulk && tests/benchmarks/bulk_operator.py build/benchmark_bulk`.",
            f"Million displacements per second and core on {model}, medians of nine products on 0.3 million",
            "displacements per core; gathering, scattering and the ghost entries' place included, no communication.",
            "`shell octant`: curved cells, nine numbers per point; `box`: constant Jacobians.", "",
            "| mesh | p | dofs | double | single | double, both cores | single, both cores |", "|---|---|---|---|---|---|---|"]
    for (mesh, p, dofs, double, single), (*_, double2, single2) in zip(one, two):
        text.append(f"| {mesh.strip()} | {p} | {dofs} | {double} | {single} | {double2} | {single2} |")
    with open(os.path.join(TOP, "doc", "bulk.md"), "w") as out:
        out.write("\n".join(text) + "\n")
    print("\n".join(text))


if __name__ == "__main__":
    main()
