"""The sections of the report."""

from __future__ import annotations

import math
from collections import defaultdict
from html import escape
from typing import Any, Dict, List, Mapping, Optional, Sequence

from .page import Cell, paragraph, rounded, shown, table
from .results import Results
from .scene import Scene
from .section import parameter_at
from .svg import bars, curves, number

most_rows = 60


def _norm(vector: Optional[Sequence[Optional[float]]]) -> Optional[float]:
    return None if not vector else math.sqrt(sum((c or 0.0) ** 2 for c in vector))


def _small(value: Optional[float], warn: float, bad: float, title: str = "") -> Cell:
    """A number that should be small."""
    verdict = "" if value is None else "good" if value < warn else "warn" if value < bad else "bad"
    return Cell(value, verdict, title)


def status_badge(results: Results) -> str:
    kind = {"done": "good", "running": "warn"}.get(results.status, "bad")
    return f'<span class="badge {kind}">{escape(results.status)}</span>'


def facts(results: Results) -> str:
    summary, steps = results.summary, results.steps
    seconds = summary["timings_s"].get("total")
    cards = [("time", f"{seconds:.3g} s" if seconds is not None else "–"),
             ("memory", f"{summary['memory_mib']['peak_sum_over_ranks']:.0f} MiB"), ("ranks", shown(summary["program"]["ranks"]))]
    if steps:
        last = steps[-1]
        cards = [("bodies", shown(len(last["bodies"]))), ("interfaces", shown(len(last["interfaces"]))),
                 ("cells", shown(sum(body["cells"] for body in last["bodies"]))),
                 ("unknowns", shown(last["dofs"]["total"]))] + cards
        estimate = last.get("adaptivity", {}).get("estimate")
        if estimate is not None:
            cards.insert(0, ("estimated error", f"{100 * estimate:.3g} %"))
    if len(steps) > 1:
        cards.insert(0, ("steps" if steps[-1]["step"] else "cycles", shown(len(steps))))
    return '<div class="facts">' + "".join(f"<div><b>{v}</b><span>{k}</span></div>" for k, v in cards) + "</div>"


def _failure(results: Results) -> str:
    """What the program said at its end, as far as it was kept."""
    lines = results.log.splitlines()
    starts = [i for i, line in enumerate(lines) if line.startswith(("error: ", "not converged: "))]
    return "\n".join(lines[starts[-1] :]) if starts else ""


def warnings(results: Results) -> str:
    meaning = {"not converged": "The run did not converge: results are those that were reached last.",
               "stopped": "The run was stopped before its end: results are those that were reached.",
               "running": "The run was not finished when this was written: it goes on, or was interrupted."}
    parts = []
    if results.status in meaning:
        parts.append(paragraph(meaning[results.status] + "\n" + _failure(results), "failure"))
    parts += [paragraph(text, "warning") for text in results.warnings]
    if "warnings" not in results.summary:
        parts.append(paragraph("These results are of a version of the program that kept no warnings.", "note"))
    return "".join(parts) or paragraph("None.")


def peaks(results: Results) -> str:
    if not results.steps:
        return ""
    rows = []
    for body in results.last["bodies"]:
        u, s, p = (body.get(k) or {} for k in ("displacement_max", "von_mises_max", "plastic_strain_max"))
        ratio = s["jump"] / s["value"] if s.get("jump") is not None and s.get("value") else None
        rows.append([body["name"], u.get("value"), u.get("at"), s.get("value"), s.get("averaged"), s.get("at"),
                     _small(ratio, 0.1, 0.3, "the jump of the stress between cells there, divided by the stress"),
                     p.get("value"), p.get("at")])
    return table(["body", "displacement", "at", "von Mises", "averaged", "at", "jump / stress", "plastic strain", "at"], rows,
                 name="peaks") + paragraph(
        "The jump of the stress between cells tells how well the largest stress is known: above 0.1 take it with care, above 0.3 take a "
        "finer mesh or a higher degree there. At re-entrant corners the exact stress is infinite.", "note")


def quantities(results: Results) -> str:
    if not results.steps:
        return ""
    rows = [[name, *(rounded(values) + [None] * 3)[:3], _norm(values) if len(values) == 3 else None]
            for name, values in results.last["quantities"].items()]
    return table(["quantity", "x", "y", "z", "magnitude"], rows, name="quantities") if rows else ""


def coupling(results: Results) -> str:
    if not results.steps or not results.last["interfaces"]:
        return ""
    quality, forces, contact = [], [], []
    for i in results.last["interfaces"]:
        covered = i["covered_area"] / i["slave_area"] if i["slave_area"] else None
        force, contact_law = _norm(i["force"]) or 0.0, "contact" in i  # whose sides may lie apart
        quality.append([i["name"], i["slave_faces"], i["pairs"],
                        Cell(covered, "" if covered is None or contact_law else "good" if covered > 0.999 else "warn",
                             "part of the slave that has a partner"),
                        _small(i.get("partition_of_unity_error"), 1e-8, 1e-5), _small(i.get("force_residual"), 1e-8, 1e-5),
                        _small(i.get("moment_residual"), 1e-8, 1e-5), i.get("linear_completeness_error") if contact_law else _small(i.get("linear_completeness_error"), 1e-3, 1e-1),
                        i["distance_mean"], i["distance_max"], i["gap_mean"]])
        preload = i.get("preload") or {}
        forces.append([i["name"], i["area"], i["force"] or None, force or None, i["moment"] or None, preload.get("force"),
                       preload.get("shortening")])
        if "contact" in i:
            c, f = i["contact"], i["contact"].get("friction") or {}
            contact.append([i["name"], c["area"], c["pressure_mean"], c["pressure_max"], c["penetration_max"], c["active"],
                            c["inactive"], f.get("stick"), f.get("slip"), f.get("slip_max"), f.get("dissipated_energy")])
    text = table(["interface", "slave faces", "pairs", "coverage", "unity", "imbalance", "of moments", "linear", "distance, mean",
                  "largest", "gap, mean"], quality, name="coupling")
    text += paragraph("Unity, imbalance and that of moments are rounding where constants and forces pass exactly from side to side; linear "
                      "tells how well the two surfaces agree in geometry. A coverage below 1 is right where bodies overlap in part.", "note")
    text += "<h3>Forces from slave to master</h3>" + table(
        ["interface", "area", "force", "magnitude", "moment", "preload", "shortening"], forces, name="forces")
    if contact:
        text += "<h3>Contact</h3>" + table(
            ["interface", "contact area", "pressure, mean", "largest", "penetration", "active nodes", "open", "stick", "slip",
             "largest slip", "dissipated energy"], contact, name="contact")
    return text


def equilibrium(results: Results) -> str:
    if not results.steps or "equilibrium" not in results.last:
        return ""
    e = results.last["equilibrium"]
    size = _force_size([results.last])
    rows = [[name, *e[key], _norm(e[key])] for name, key in (("loads", "applied"), ("reactions", "reactions"), ("sum", "sum"))]
    text = table(["forces on all bodies", "x", "y", "z", "magnitude"], rows, name="equilibrium")
    if "periodic_cell" in results.last:
        cell = results.last["periodic_cell"]
        text += "<h3>Periodic cell</h3>" + table(
            ["", "xx", "yy", "zz", "yz", "zx", "xy"],
            [[name.replace("_", " "), *cell[name]] for name in ("mean_strain", "mean_stress")], name="periodic_cell")
    return text + (paragraph(f"The sum is {number((_norm(e['sum']) or 0.0) / size)} of the largest force of the scene; it is zero up to "
                             "the solver's tolerance.", "note") if size else "")


def _force_size(steps: Sequence[Mapping[str, Any]]) -> float:
    """The largest of all forces, as a measure of what is rounding: those of a step may balance themselves."""
    forces = [0.0]
    for step in steps:
        e = step.get("equilibrium", {})
        forces += [_norm(e.get("applied")), _norm(e.get("reactions"))]
        for i in step["interfaces"]:
            forces += [_norm(i["force"]), i["contact"]["area"] * i["contact"]["pressure_mean"] if "contact" in i else None]
    return max(force or 0.0 for force in forces)


def _is_rounding(name: str, values: Sequence[Sequence[Optional[float]]], results: Results) -> bool:
    """Is a quantity nothing in all steps? Points are displacements; resultants have a moment beside their force."""
    largest = max((_norm(v) or 0.0 for v in values), default=0.0)
    others = results.last["quantities"]
    if name.endswith(", moment") and name[: -len(", moment")] in others:
        return largest == 0.0
    size = _force_size(results.steps) if f"{name}, moment" in others else max(
        ((b.get("displacement_max") or {}).get("value") or 0.0 for s in results.steps for b in s["bodies"]), default=0.0)
    return largest <= 1e-9 * size


def _times(results: Results) -> "tuple[str, List[float]]":
    """What histories are drawn over."""
    steps = results.steps
    if all("time" in s for s in steps) and len({s["time"] for s in steps}) == len(steps):
        return "time", [s["time"] for s in steps]
    return ("cycle", [s["cycle"] for s in steps]) if len({s["cycle"] for s in steps}) == len(steps) else (
        "step or cycle", list(range(len(steps))))


def _place(step: Mapping[str, Any]) -> List[Any]:
    """Step, cycle and time, as far as the scene has them."""
    return [step["step"] or None, step["cycle"] if "adaptivity" in step else None, step.get("time")]


def _by_name(results: Results, part: str, value: Any) -> List[Any]:
    """Curves of all bodies or interfaces."""
    names: Dict[str, None] = {}
    for step in results.steps:
        names.update(dict.fromkeys(p["name"] for p in step[part]))
    of_step = [{p["name"]: p for p in step[part]} for step in results.steps]
    return [(name, [value(parts[name]) if name in parts else None for parts in of_step]) for name in names]


def history(results: Results) -> str:
    if len(results.steps) < 2:
        return ""
    label, x = _times(results)
    charts = [curves("Largest displacement", label, x, _by_name(results, "bodies", lambda b: (b.get("displacement_max") or {}).get("value"))),
              curves("Largest von Mises stress", label, x, _by_name(results, "bodies", lambda b: (b.get("von_mises_max") or {}).get("value"))),
              ]
    forces = [(name, values) for name, values in _by_name(results, "interfaces", lambda i: _norm(i["force"]))
              if max(v or 0.0 for v in values) > 1e-9 * _force_size(results.steps)]
    charts.append(curves("Force of interfaces", label, x, forces))
    if any("contact" in i for i in results.last["interfaces"]):
        charts += [curves("Contact area", label, x, _by_name(results, "interfaces", lambda i: i.get("contact", {}).get("area"))),
                   curves("Largest pressure", label, x, _by_name(results, "interfaces", lambda i: i.get("contact", {}).get("pressure_max")))]
    for name in results.last["quantities"]:
        values = [step["quantities"].get(name) or [None] for step in results.steps]
        if not _is_rounding(name, values, results):
            charts.append(curves(f"Components of {name}", label, x, [(c, [v[k] if k < len(v) else None for v in values])
                                                  for k, c in enumerate("xyz"[: max(map(len, values))])]))
    rows = [[*_place(s), s["dofs"]["total"],
             *(max((b[k]["value"] for b in s["bodies"] if k in b), default=None) for k in ("displacement_max", "von_mises_max")),
             _norm(s.get("equilibrium", {}).get("applied")), _norm(s.get("equilibrium", {}).get("sum"))] for s in results.steps]
    heading = ["step", "cycle", "time", "unknowns", "largest displacement", "largest von Mises", "loads", "loads + reactions"]
    return ('<div class="row">' + "".join(f"<div>{c}</div>" for c in charts if c) + "</div>"
            + _folded("All steps", table(heading, rows, 0, name="history"), len(rows)))


def _folded(what: str, text: str, rows: int) -> str:
    return text if rows <= 12 else f"<details><summary>{escape(what)} ({rows})</summary>{text}</details>"


def convergence(results: Results) -> str:
    solved = [s for s in results.steps if "solver" in s]
    if not solved:
        return ""
    last, label_x = solved[-1]["solver"], _times(results)
    text = paragraph(f"Linear solver: {last['method']}" + (f"; {last['preconditioner']}" if last.get("preconditioner") else "") + ".")
    heading = ["step", "cycle", "time", "iterations", "residual", "active sets", "Newton iterations", "linear iterations"]
    rows = [[*_place(s), *(s["solver"].get(k) for k in (
        "iterations", "relative_residual", "active_sets", "newton_iterations", "linear_iterations"))] for s in solved]
    text += _folded("All steps", table(heading, rows, 0, name="convergence"), len(rows))
    if len(solved) > 1 and len(solved) == len(results.steps):
        lines = [(name, [s["solver"].get(k) for s in solved]) for name, k in (
            ("last linear solve", "iterations"), ("active sets", "active_sets"), ("Newton iterations", "newton_iterations"))]
        text += f'<div class="row"><div>{curves("Iterations", *label_x, lines)}</div>{_adaptivity_chart(results)}</div>'
    return text + _adaptivity(results) + _errors(results)


def _adaptivity_chart(results: Results) -> str:
    steps = [s for s in results.steps if s.get("adaptivity", {}).get("estimate")]
    if len(steps) < 2:
        return ""
    lines = [("estimate", [s["adaptivity"]["estimate"] for s in steps]), ("target", [s["adaptivity"]["target"] for s in steps])]
    if all("energy" in s.get("errors", {}) for s in steps):
        lines.append(("error", [s["errors"]["energy"] for s in steps]))
    chart = curves("Relative error over the unknowns (log10)", "log10 of the unknowns",
                   [math.log10(s["dofs"]["total"]) for s in steps], lines, logarithmic=True)
    return f"<div>{chart}</div>"


def _adaptivity(results: Results) -> str:
    rows = [[*_place(s)[:2], s["dofs"]["total"], *(s["adaptivity"].get(k) for k in (
        "target", "estimate", "estimate_bulk", "estimate_interface", "value", "effectivity"))]
        for s in results.steps if "adaptivity" in s]
    return "<h3>Target error</h3>" + _folded("All cycles", table(
        ["step", "cycle", "unknowns", "target", "estimate", "of bodies", "of interfaces", "quantity", "estimate / error"],
        rows, 0, name="adaptivity"), len(rows)) if rows else ""


def _errors(results: Results) -> str:
    names = {"displacement_l2": "displacement, L2", "displacement_h1": "displacement, H1", "energy": "energy norm",
             "multiplier_l2": "traction, L2", "pressure_l2": "pressure, L2"}
    rows = [[*_place(s), *(s["errors"].get(k) for k in names)] for s in results.steps if "errors" in s]
    return "<h3>Relative errors against the exact solution</h3>" + _folded(
        "All steps", table(["step", "cycle", "time", *names.values()], rows, 0, name="errors"), len(rows)) if rows else ""


def meshes(results: Results) -> str:
    if not results.steps:
        return ""
    rows = [[b["name"], b["material"], b["shape"], b["cells"],
             str(b["degree_min"]) if b["degree_min"] == b["degree_max"] else f"{b['degree_min']} to {b['degree_max']}",
             b["dofs"], b["volume"], b.get("mass")] for b in results.last["bodies"]]
    return table(["body", "material", "cells", "number", "degree", "unknowns", "volume", "mass"], rows, 3, name="meshes")


def scene(results: Results) -> str:
    parameters: Mapping[str, str] = results.summary.get("parameters", {})
    if not parameters:
        return paragraph("These results are of a version of the program that kept no parameters.", "note")
    by_section: Dict[str, List[Any]] = defaultdict(list)
    for path, value in parameters.items():
        section, _, name = path.rpartition("/")
        unit = parameter_at(Scene, path).get("unit", "")
        by_section[section].append([name, Cell(value, "wide"), unit if unit != "-" else ""])
    tables = [(f"<h3>{escape(name)}</h3>" if name else "") + table(["parameter", "value", "unit"], rows, 3, name=f"scene {name}")
              for name, rows in by_section.items()]
    file = results.summary.get("file", "")
    return (paragraph(f"What {file or 'the parameter file'} and the command line set; all else is at its default "
                      "(mortise --parameters).", "note")
            + f"<details{' open' if len(parameters) <= 40 else ''}><summary>{len(parameters)} parameters</summary>"
            + '<div class="row">' + "".join(f"<div>{t}</div>" for t in tables) + "</div></details>")


def times(results: Results) -> str:
    rows = [(name.replace("_", " "), seconds) for name, seconds in results.summary["timings_s"].items() if name != "total"]
    balance = [[name, b["largest"], b["mean"], b["largest"] / b["mean"] if b["mean"] else None]
               for name, b in results.summary.get("integration_cells_per_rank", {}).items()]
    return (bars(rows, "s") if rows else "") + (
        "<h3>Integration cells per rank</h3>" + table(["interface", "largest", "mean", "ratio"], balance, name="balance") if balance else "")


def log(results: Results) -> str:
    lines = results.log.splitlines()
    shortened = lines if len(lines) <= 2000 else [*lines[:500], f"... {len(lines) - 1000} lines ...", *lines[-500:]]
    return f"<details><summary>What the program printed ({len(lines)} lines)</summary><pre>{escape(chr(10).join(shortened))}</pre></details>" if lines else ""
