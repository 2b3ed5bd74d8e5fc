#!/usr/bin/env python3
"""Iterations where a part of the multipliers is active: active_sets.py BENCHMARK

BENCHMARK: the program benchmark_active_sets. Writes doc/measurements/active_sets.md."""
import argparse
import os
import re
import subprocess

from processor import on_ranks

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
GOAL = 12
CELLS = {1: 12, 2: 8, 3: 6, 4: 4, 6: 3}  # of the slave in a line, by degree


def run(benchmark, ranks=1, **options):
    """(name, iterations, their setup and solve in seconds, iterations and setup with the coarse levels of the set before) by set."""
    command = [benchmark, *(f"{name}={value}" for name, value in options.items())]
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    text = subprocess.run(on_ranks(ranks) + command if ranks > 1 else command, check=True, stdout=subprocess.PIPE, text=True,
                          env=environment).stdout
    pattern = (r"^(\S.*?) +\d+ of +\d+  iterations +(\d+)( not converged)?  setup (\S+)  solve (\S+)  with the coarse levels of the "
               r"set before (\d+)( not converged)?  setup (\S+)$")
    return [(name, "-" if failed else int(iterations), float(setup), float(solve), "-" if worse else int(changed), float(change))
            for name, iterations, failed, setup, solve, changed, worse, change in re.findall(pattern, text, re.MULTILINE)]


def table(benchmark, title, first, rows):
    print(title)
    yield f"\n{title}\n"
    for number, (label, options) in enumerate(rows):
        sets = run(benchmark, **options)
        if number == 0:
            yield f"| {first} | " + " | ".join(entry[0] for entry in sets) + " |\n|" + "---|" * (len(sets) + 1)
        yield f"| {label} | " + " | ".join(str(entry[1]) for entry in sets) + " |"


def missed(lines):
    """What is above the goal, one line for each table of iterations."""
    title = header = ""
    above = {}  # by title: largest number by set
    for line in lines:
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.strip().endswith(":"):
            title = line.strip().rstrip(":")
        elif line.startswith("| law, p |") or line.startswith("| p, "):
            header = cells
        elif line.startswith("| ") and header and len(cells) == len(header):
            for name, entry in zip(header[1:], cells[1:]):
                if entry == "-" or int(entry) > GOAL:
                    above.setdefault(title, {}).setdefault(name, []).append(entry)
    for title, sets in above.items():
        yield f"- {title}: " + "; ".join(f"{name} {', '.join(entries)}" for name, entries in sets.items())


def report(benchmark):
    yield ("# Active sets\n\nRegenerate: `tests/benchmarks/active_sets.py build/benchmark_active_sets`. Iterations to "
           "a relative residual of\n1e-8, `condensed`, or of the mixed form `saddle point`. The sets: each node drawn with a half or "
           "a tenth; boards of\n0.12 and 0.3 of the interface's radius; discs of such radii; one node. `sphere`: an octant of the "
           "thick sphere in two layers;\n`blocks`: two with a curved interface. About 2 : 3 cells unless said. Coarse levels see on "
           "each slave face the penalty of the\ntie times the square of the share of its multipliers that is active: with the share "
           "itself it was 22 where a\ntenth is drawn at p = 4, 14 for the largest disc, 13 for the half; with all or nothing, above a half, 26, 12, 21.")
    for scene in ("sphere", "blocks"):
        yield from table(benchmark, f"Over degrees, `{scene}`:", "law, p",
                         [(f"{law}, {p}", dict(scene=scene, law=law, p=p, n=n)) for law in ("tie", "slide") for p, n in CELLS.items()])
    yield from table(benchmark, "Over meshes, `sphere`, `slide`:", "p, cells in a line",
                     [(f"{p}, {n}", dict(p=p, n=n)) for p, cells in ((1, (8, 16, 24)), (2, (4, 8, 16)), (4, (2, 4, 8))) for n in cells])
    yield from table(benchmark, "Over ranks, `sphere`, `slide`:", "p, ranks",
                     [(f"{p}, {ranks}", dict(p=p, n=CELLS[p], ranks=ranks)) for p in (1, 3) for ranks in (1, 2, 3)])
    for scene in ("sphere", "blocks"):
        yield from table(benchmark, f"Over the modulus of the slave, that of the master being 1, `{scene}`, `slide`:", "p, modulus",
                         [(f"{p}, {contrast}", dict(scene=scene, p=p, n=CELLS[p], contrast=contrast))
                          for p in (2, 4) for contrast in ("1e-6", "1e-3", "1e3", "1e6")])
    yield from table(benchmark, "Ten cells of the slave in a line for one of the master, `slide`:", "p, scene",
                     [(f"{p}, {scene}", dict(p=p, n=10, fine=10, scene=scene)) for p in (2, 4) for scene in ("sphere", "blocks")])
    for scene in ("sphere", "blocks"):
        yield from table(benchmark, f"Incompressible, mixed form, `{scene}`:", "law, p",
                         [(f"{law}, {p}", dict(scene=scene, p=p, n=CELLS[p], nu=0.5, law=law)) for law in ("tie", "slide") for p in (2, 4)])
    title = ("Another set, in seconds: all anew (`update()`), or only what is active (`update_active()`), coarse levels as they were for the "
             "set\nbefore; from the disc of 0.3 to that of 0.32, `sphere`:")
    print(title)
    yield f"\n{title}\n\n| law, p, cells in a line | anew | iterations | solve | only active | iterations | of a solve |\n|" + "---|" * 7
    for law in ("tie", "slide"):
        for p, n in ((1, 24), (2, 20), (4, 8), (6, 4)):
            _, iterations, setup, solve, changed, change = next(e for e in run(benchmark, law=law, p=p, n=n) if e[0] == "disc 0.32")
            yield (f"| {law}, {p}, {n} | {setup:.3g} | {iterations} | {solve:.3g} | {change:.2g} | {changed} | {change / solve:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("benchmark", help="the program benchmark_active_sets")
    head, *lines = report(os.path.abspath(parser.parse_args().benchmark))
    lines = "\n".join(lines).split("\n")
    lines = [head, f"\nAbove the goal of {GOAL}:", *missed(lines), *lines]
    with open(os.path.join(TOP, "doc", "measurements", "active_sets.md"), "w") as page:
        print(*lines, sep="\n", file=page)


if __name__ == "__main__":
    main()
