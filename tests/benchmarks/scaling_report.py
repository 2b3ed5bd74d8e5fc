"""The pages of scaling.py: tables, the model of time over ranks, its picture."""
import itertools
import os
import platform

import numpy as np

from page import TOP, write_part

LATENCY, BANDWIDTH = 2e-6, 10e9  # of a message in seconds; bytes per second and rank
STAGES = ("mesh", "spaces", "interface_search", "coupling", "bulk", "solver_setup", "solve", "postprocess")
near = lambda p, most: most * (p - 1) / (p + most - 1)  # partners among p ranks where there are at most so many
# What the counts may be made of: n dofs in millions, p ranks. The fit takes what explains them, never negative.
CUT = lambda p: 1 - p**(-1 / 3)  # the part of a rank's surface behind which there is another rank
HALO = {"halo": lambda n, p: (n / p)**(2 / 3) * CUT(p), "edges": lambda n, p: (n / p)**(1 / 3) * CUT(p)}
WHOLE = {"n": lambda n, p: n, "n^2/3": lambda n, p: n**(2 / 3)}  # on one rank: all cells, a whole interface
TERMS = {"work": {"n/p": lambda n, p: n / p, "(n/p)^2/3": lambda n, p: (n / p)**(2 / 3), **HALO, "1": lambda n, p: 1., **WHOLE},
         "messages": {"near": lambda n, p: near(p, 26), "far": lambda n, p: near(p, 124), "log2 p": lambda n, p: np.log2(p),
                      "p": lambda n, p: p - 1.},
         "bytes": {**HALO, "n/p": lambda n, p: n / p, "p": lambda n, p: p, "1": lambda n, p: 1., **WHOLE},
         "collectives": {"1": lambda n, p: 1., "log2 p": lambda n, p: np.log2(p)}}


def pick(rows, **wanted):
    return [r for r in rows if all(r[k] == v for k, v in wanted.items())]


def one(rows, **wanted):
    return pick(rows, **wanted)[0]


def value(row, quantity):
    return row["bytes"] + row["collective_bytes"] if quantity == "bytes" else row[quantity]


def fit(rows, quantity, gathered=False):
    """Coefficients of the terms: least squares of relative errors, none negative, few terms, and such as
    grow with all cells or a whole interface only where errors are half as large again without them (a whole
    interface at once where the solver is known to gather it)."""
    rows = [r for r in rows if value(r, quantity) > 0 and (r["ranks"] > 1 or quantity == "work")]
    terms = list(TERMS[quantity])
    amount = np.array([value(r, quantity) for r in rows])
    weight = np.array([1. if "large" in r["scene"] else 0.5 for r in rows])
    matrix = np.array([[TERMS[quantity][t](r["dofs"] / 1e6, r["ranks"]) for t in terms] for r in rows])
    matrix *= (weight / amount)[:, None]
    best, found = np.inf, {}
    for length in range(1, min(4, len(terms)) + 1):
        for columns in itertools.combinations(range(len(terms)), length):
            part = matrix[:, columns]
            c, *_ = np.linalg.lstsq(part, weight, rcond=None)
            penalty = 1.05**length * 1.5**sum(terms[i] in WHOLE and not (gathered and terms[i] == "n^2/3") for i in columns)
            error = np.linalg.norm(part @ c - weight) / np.linalg.norm(weight) * penalty + 1e-9 * length
            if (c > 0).all() and error < best:
                best, found = error, {terms[i]: x for i, x in zip(columns, c)}
    return found


def evaluate(coefficients, quantity, n, p):
    return sum(c * TERMS[quantity][name](n, p) for name, c in coefficients.items())


def fits(rows, family):
    counts = [r for r in pick(rows, study="counts") if r["scene"].startswith(family)]
    together = family == "p4"  # multipliers are on all ranks
    return {s: {q: fit(pick(counts, stage=s), q, together and s in ("solver_setup", "solve")) for q in TERMS} for s in STAGES}


def parts(model, stage, n, p):
    """Seconds of a stage: work, messages, bytes, collectives."""
    amount = {q: evaluate(model[stage][q], q, n, p) for q in TERMS}
    if p == 1:
        return [amount["work"], 0., 0., 0.]
    return [amount["work"], amount["messages"] * LATENCY, amount["bytes"] / BANDWIDTH,
            amount["collectives"] * np.log2(p) * LATENCY]


def seconds(model, n, p):
    return {s: sum(parts(model, s, n, p)) for s in STAGES}


def table(head, rows):
    yield "| " + " | ".join(head) + " |"
    yield "|" + "---|" * len(head)
    for row in rows:
        yield "| " + " | ".join(row) + " |"
    yield ""


def number(x):
    return f"{x:.3g}" if x < 1e4 else f"{x:.1e}".replace("e+0", "e")


def strong_tables(rows):
    for scene in ("p4", "p2"):
        case = pick(rows, study="strong", scene=scene)
        if not case:
            continue
        yield f"Degree {scene[1]}, {case[0]['dofs']:,.0f} dofs:\n"
        lines, totals = [], np.zeros(4)
        for s in STAGES:
            a, b = one(case, stage=s, ranks=1), one(case, stage=s, ranks=2)
            x = np.array([a["seconds"], b["seconds"], a["work"], b["work"]])
            totals += x
            lines.append([s, *ratios(x)])
        yield from table(["stage", "s, 1 rank", "s, 2 ranks", "ratio", "work, 1 rank", "work, 2 ranks", "ratio"],
                         lines + [["all", *ratios(totals)]])
        yield disturbance(case)


def disturbance(case):
    """How much others took of the cores meanwhile."""
    parts = [f"{r['others']:.2f} on {r['ranks']:.0f}" for r in pick(case, stage="solve") if r.get("others", "") != ""]
    return "Cores that others took meanwhile, with ranks: " + ", ".join(parts) + ".\n" if parts else ""


def ratios(x):
    return [f"{x[0]:.3f}", f"{x[1]:.3f}", f"{x[0] / x[1]:.2f}", f"{x[2]:.3f}", f"{x[3]:.3f}", f"{x[2] / x[3]:.2f}"]


def weak_table(rows):
    case, lines, totals = pick(rows, study="weak"), [], np.zeros(4)
    if not case:
        return
    half = one(case, ranks=1, stage="solve")["dofs"] / (one(case, ranks=2, stage="solve")["dofs"] / 2)
    for s in STAGES:
        a, b = one(case, stage=s, ranks=1), one(case, stage=s, ranks=2)
        x = np.array([a["seconds"] / half, b["seconds"], a["work"] / half, b["work"]])
        totals += x
        lines.append([s, *ratios(x)])
    yield f"{one(case, ranks=1, stage='solve')['dofs']:,.0f} dofs on one rank, {one(case, ranks=2, stage='solve')['dofs']:,.0f} on two; seconds of the first times {1 / half:.3f}, so that 1 is ideal.\n"
    yield from table(["stage", "s, 1 rank", "s, 2 ranks", "ratio", "work, 1 rank", "work, 2 ranks", "ratio"], lines + [["all", *ratios(totals)]])
    yield disturbance(case)


def count_tables(rows):
    counts = pick(rows, study="counts")
    for scene in ("p4 large", "p2 large"):
        case = pick(counts, scene=scene)
        ranks = sorted({r["ranks"] for r in case})
        if not case:
            continue
        most = ranks[-1]
        yield f"Degree {scene[1]}, {case[0]['dofs']:,.0f} dofs, {most:.0f} ranks; largest over all ranks / mean:\n"
        yield from table(["stage", "messages", "KiB", "partners", "collectives", "KiB in them", "work, ms", "largest / mean work"],
                         [[s, *(f"{number(r[k] / d)} / {number(r[k + '_mean'] / d)}" for k, d in (("messages", 1), ("bytes", 1024), ("partners", 1))),
                           number(r["collectives"]), number(r["collective_bytes"] / 1024),
                           f"{number(1e3 * r['work'])} / {number(1e3 * r['work_mean'])}", f"{r['work'] / r['work_mean']:.2f}"]
                          for s in STAGES for r in [one(case, stage=s, ranks=most)]])
    for title, key in (("Largest over mean work", lambda r: f"{r['work'] / r['work_mean']:.2f}"),
                       ("Largest number of messages of a rank", lambda r: number(r["messages"])),
                       ("Bytes of the busiest rank over those of the mean", lambda r: f"{r['bytes'] / max(1., r['bytes_mean']):.2f}")):
        yield f"{title}, over ranks:\n"
        scenes = [(s, n) for s in ("p4 small", "p4 large", "p2 large") for n in ((8, 64) if "small" in s else (4, 16, 64))]
        yield from table(["stage", *(f"{s}, {n:.0f}" for s, n in scenes)],
                         [[stage, *(key(one(counts, scene=s, ranks=n, stage=stage)) for s, n in scenes)] for stage in STAGES])
    yield "The interface's integration cells, largest over mean; iterations; peak memory of a process, largest / mean (MiB):\n"
    yield from table(["scene", "dofs", "ranks", "cells", "iterations", "MiB"],
                     [[r["scene"], f"{r['dofs']:,.0f}", f"{r['ranks']:.0f}", f"{r['cells_over_mean']:.2f}", f"{r['iterations']:.0f}",
                       f"{r['peak_mib']:.0f} / {r['peak_mib_mean']:.0f}"] for r in pick(counts, stage="postprocess")])


def formula(coefficients):
    return " + ".join(f"{number(c)}" + ("" if name == "1" else f" {name}") for name, c in coefficients.items()) or "0"


def model_tables(rows):
    for family, name in FAMILIES.items():
        model = fits(rows, family)
        yield f"{name}, work in seconds:\n"
        yield from table(["stage", "work", "messages", "bytes", "collectives"],
                         [[s, *(formula(model[s][q]) for q in TERMS)] for s in STAGES])
        lines = []
        for n in SIZES[family]:
            for p in (64, 1000, 10000):
                times = seconds(model, n, p)
                efficiency = sum(seconds(model, n, 1).values()) / p / sum(times.values())
                slow = sorted(STAGES, key=lambda s: -times[s])[:2]
                share = lambda s: f"{s} {100 * times[s] / sum(times.values()):.0f} % ({PARTS[int(np.argmax(parts(model, s, n, p)))]})"
                lines.append([f"{1e6 * n:.0e}".replace("e+0", "e"), str(p), number(sum(times.values())), f"{100 * efficiency:.1f} %", ", ".join(map(share, slow))])
        yield from table(["dofs", "ranks", "s", "efficiency", "most of it"], lines)


FAMILIES = {"p2": "Degree 2, multipliers by parts: large scenes",
            "p4": "Degree 4, multipliers factorised on all ranks: scenes up to 30,000 of them"}
SIZES = {"p2": (1e1, 1e2, 1e3), "p4": (0.3, 1.)}  # millions of dofs of the model's tables
PARTS = ("work", "messages", "bytes", "collectives")


def picture(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plot
    figure, axes = plot.subplots(2, 3, figsize=(15, 9.5))
    colors = dict(zip(STAGES, plot.cm.tab10.colors))
    ranks = np.geomspace(1, 10000, 60)
    model = fits(rows, "p2")
    case = pick(rows, study="counts", scene="p2 large")
    for axis, (q, label) in zip(axes[0], (("work", "work of the busiest rank, s"), ("messages", "messages of the busiest rank"), ("bytes", "bytes of the busiest rank"))):
        for s in STAGES:
            points = sorted((r["ranks"], value(r, q)) for r in pick(case, stage=s) if r["ranks"] > 1 or q == "work")
            axis.loglog(*zip(*points), "o", color=colors[s], label=s)
            line = ranks[ranks >= (1 if q == "work" else 2)]
            axis.loglog(line, [evaluate(model[s][q], q, case[0]["dofs"] / 1e6, p) for p in line], "-", color=colors[s], lw=1)
        axis.set_ylabel(label)
        axis.set_title(f"{case[0]['dofs'] / 1e6:.2f} million dofs, degree 2: counted (dots), fitted")
        axis.axvspan(64, 1e4, color="0.95")
    axes[0][0].legend(fontsize=8)
    for axis, n in zip(axes[1], (1e1, 1e2, 1e3)):
        times = [seconds(model, n, p) for p in ranks]
        for s in STAGES:
            axis.loglog(ranks, [t[s] for t in times], color=colors[s], lw=1.2)
        total = np.array([sum(t.values()) for t in times])
        axis.loglog(ranks, total, "k", lw=2.5, label="all stages, degree 2")
        axis.loglog(ranks, total[0] / ranks, "k:", label="ideal")
        axis.set_title(f"model, {n:g} million dofs")
        axis.set_ylabel("seconds")
        axis.legend(fontsize=8)
        axis.set_ylim(bottom=1e-4)
    for axis in axes.flat:
        axis.set_xlabel("ranks")
        axis.grid(True, alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=80)


def machine():
    names = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")] if os.path.exists("/proc/cpuinfo") else [platform.processor()]
    return f"{names[0]}, {len(names)} cores"


def report(rows):
    """Write the parts of doc/measurements/scaling.md and its picture."""
    for name, lines in (("machine", [machine()]), ("strong", strong_tables(rows)), ("weak", weak_table(rows)),
                        ("counts", count_tables(rows)), ("model", model_tables(rows))):
        write_part("scaling.md", name, "\n".join(lines))
    picture(rows, os.path.join(TOP, "doc", "measurements", "scaling.png"))
