#!/usr/bin/env python3
"""Products without a matrix, one core and two: bulk_operator.py BENCHMARK_BULK

Runs the program benchmark_bulk (ninja benchmark_bulk) on one and two ranks and writes the part of doc/measurements/bulk.md that
is about processors of this kind, with or without AVX-512."""
import os
import subprocess
import sys

from page import write_part
from processor import on_ranks


def rows(program, ranks):
    command = on_ranks(ranks) + [program, str(3e5 * ranks)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    peak = lines[-1].split()
    return [line.rsplit(None, 4) for line in lines[:-1]], *(float(peak[k]) for k in (3, 4, 6, 8, 10))


def flops_per_dof(p):
    """Of a product on curved cells, counted from the kernel: lines by even and odd parts (tensor_kernel.h), 108 at
    each point, one addition per number that is scattered."""
    n = p + 1
    h, r = n // 2, (n + 1) // 2
    line = 4 * h + h * (2 * r - 1 + 2 * h - 1) + (2 * r - 1 if n % 2 else 0)
    return (3 * (12 * n**2 * line + 2 * n**3) + 108 * n**3 + 3 * n**3) / (3 * p**3)


def bytes_per_dof(p, number):
    """That a product on curved cells has to move at least: the metric, the places of nodes, the source once, the
    result twice."""
    n = p + 1
    return ((9 * number + 4) * n**3 + 3 * 3 * p**3 * number) / (3 * p**3)


def workspace_per_dof(p, number):
    """Bytes that the passes over lines, 36 of which 6 add, and the points read and write beside that."""
    return (2 * 36 + 6 + 2 * 9) * (p + 1)**3 * number / (3 * p**3)


def main():
    (one, *peaks, bandwidth, caches, width), (two, *_) = (rows(os.path.abspath(sys.argv[1]), ranks) for ranks in (1, 2))
    with open("/sys/devices/system/cpu/cpu0/cache/index0/size") as size:
        first_cache = size.read().strip().rstrip("K")
    model = next(line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    text = [f"## {'With' if width == 64 else 'Without'} AVX-512", "",
            f"{model}, registers of {width:.0f} bytes.", "",
            "| mesh | p | dofs | double | single | double, both cores | single, both cores |", "|---|---|---|---|---|---|---|"]
    for (mesh, p, dofs, double, single), (*_, double2, single2) in zip(one, two):
        text.append(f"| {mesh.strip()} | {p} | {dofs} | {double} | {single} | {double2} | {single2} |")
    text += ["", "What bounds the products:", "",
             f"One core does {peaks[0]:.0f} Gflop/s in double and {peaks[1]:.0f} in single precision. It moves {bandwidth:.0f} GB/s from and to memory,",
             f"and {caches:.0f} GB/s on the {12 * 125 * width / 1e3:.0f} kB that are the workspace of {width / 8:.0f} cells of degree 4 (first cache: {first_cache} KiB).", "",
             "| p | precision | per dof: flops | bytes | of the workspace | measured | Gflop/s | GB/s | of the workspace | "
             "bound by flops | by bytes | by the workspace |", "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    shares = {"double": [], "single": []}
    for mesh, p, _, *rates in one:
        if mesh.strip() == "shell octant, hexahedra" and int(p) > 1:
            for name, number, peak, rate in zip(("double", "single"), (8, 4), peaks, map(float, rates)):
                counts = flops_per_dof(int(p)), bytes_per_dof(int(p), number), workspace_per_dof(int(p), number)
                bounds = [1e3 * limit / count for limit, count in zip((peak, bandwidth, caches), counts)]
                shares[name].append((rate / min(bounds), ("flops", "memory", "the workspace")[bounds.index(min(bounds))]))
                text.append(f"| {p} | {name} | " + " | ".join(f"{count:.0f}" for count in counts) + f" | {rate:.0f} | " +
                            " | ".join(f"{rate * count / 1e3:.0f}" for count in counts) + " | " +
                            " | ".join(f"{bound:.0f}" for bound in bounds) + " |")
    text += ["", "Products reach of their lowest bound " + ", ".join(
        f"in {name} precision {min(share)[0]:.2f} to {max(share)[0]:.2f} ("
        f"{' and '.join(sorted({what for _, what in share}))})" for name, share in shares.items()) + "."]
    write_part("bulk.md", f"{width:.0f} bytes", "\n".join(text))
    print("\n".join(text))


if __name__ == "__main__":
    main()
