"""Parts of an HTML page that needs nothing beside it."""

from __future__ import annotations

import math
from html import escape
from typing import Any, List, Optional, Sequence, Union

from .svg import number

style = """
:root { --ink: #1d2733; --dim: #64707d; --line: #dde3e9; --accent: #1f5fa8; --good: #1e7d4a; --warn: #a65c00; --bad: #b3261e; }
* { box-sizing: border-box; }
body { margin: 0; background: #f3f5f8; color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 0 24px 48px; }
header { background: #16324f; color: #fff; padding: 26px 0 22px; margin-bottom: 22px; }
header div { max-width: 1180px; margin: 0 auto; padding: 0 24px; }
header h1 { margin: 0 0 6px; font-size: 27px; font-weight: 600; }
header p { margin: 0; color: #c5d3e2; }
section { background: #fff; border: 1px solid var(--line); border-radius: 8px; padding: 18px 22px 20px; margin: 0 0 18px; }
h2 { margin: 0 0 10px; font-size: 18px; font-weight: 600; }
h3 { margin: 18px 0 6px; font-size: 15px; font-weight: 600; }
p { margin: 6px 0; max-width: 90ch; }
.dim, .note { color: var(--dim); }
.note { font-size: 13.5px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13.5px; font-variant-numeric: tabular-nums; margin: 4px 0 6px; }
th { text-align: right; font-weight: 600; color: var(--dim); border-bottom: 2px solid var(--line); padding: 4px 12px; vertical-align: bottom; }
td { text-align: right; border-bottom: 1px solid var(--line); padding: 4px 12px; white-space: nowrap; }
th.text, td.text { text-align: left; }
td.wide { white-space: normal; min-width: 24ch; max-width: 70ch; }
th:first-child, td:first-child { padding-left: 0; }
.badge { display: inline-block; border-radius: 20px; padding: 1px 12px; font-size: 13px; font-weight: 600; color: #fff; background: var(--dim); }
.badge.good { background: var(--good); } .badge.warn { background: var(--warn); } .badge.bad { background: var(--bad); }
td.good { color: var(--good); } td.warn { color: var(--warn); font-weight: 600; } td.bad { color: var(--bad); font-weight: 600; }
.warning { border-left: 4px solid var(--warn); background: #fff6e8; padding: 7px 14px; margin: 8px 0; max-width: none; overflow-wrap: anywhere; }
.failure { border-left: 4px solid var(--bad); background: #fdeceb; padding: 7px 14px; margin: 8px 0; max-width: none; white-space: pre-wrap; overflow-wrap: anywhere; }
.facts { display: grid; grid-template-columns: repeat(auto-fit, minmax(118px, 1fr)); gap: 12px; margin: 0 0 18px; }
.facts div { background: #fff; border: 1px solid var(--line); border-radius: 8px; padding: 10px 14px; }
.facts b { display: block; font-size: 20px; font-weight: 600; } .facts span { color: var(--dim); font-size: 13px; }
.row { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(440px, 100%), 1fr)); gap: 16px; }
figure { margin: 0; } figure img { width: 100%; border: 1px solid var(--line); border-radius: 6px; display: block; }
figcaption { font-size: 13px; color: var(--dim); margin-top: 4px; }
.chart { width: 100%; max-width: 760px; height: auto; font-size: 12.5px; }
.row .chart { max-width: 560px; }
.chart text { fill: var(--ink); } .chart .dim { fill: var(--dim); } .chart .head { font-weight: 600; font-size: 14px; }
.chart .grid { stroke: var(--line); fill: none; } .chart .axis { stroke: var(--dim); fill: none; }
details > summary { cursor: pointer; color: var(--accent); margin: 6px 0; }
pre { background: #f3f5f8; border: 1px solid var(--line); border-radius: 6px; padding: 10px 14px; overflow: auto; font-size: 12px; max-height: 480px; }
a { color: var(--accent); }
footer { color: var(--dim); font-size: 13px; text-align: center; padding: 8px 0 0; }
@media print { body { background: #fff; } section, .facts div { break-inside: avoid; } header { print-color-adjust: exact; } }
"""


class Cell:
    """A cell with a verdict: "good", "warn" or "bad"."""

    def __init__(self, value: Any, verdict: str = "", title: str = ""):
        self.value, self.verdict, self.title = value, verdict, title


def shown(value: Any) -> str:
    """A value as people read it."""
    if value is None:
        return "–"
    if isinstance(value, bool) or isinstance(value, str):
        return escape(str(value))
    if isinstance(value, (list, tuple)):
        return "(" + ", ".join(map(shown, rounded(value))) + ")"
    if isinstance(value, int):
        return f"{value:,}".replace(",", "\u202f") if abs(value) >= 10000 else str(value)
    return number(value) if math.isfinite(value) else "–"


def rounded(vector: Sequence[Any]) -> List[Any]:
    """Components without what is rounding beside the others."""
    largest = max((abs(part) for part in vector if isinstance(part, float)), default=0.0)
    return [0.0 if isinstance(part, float) and abs(part) < 1e-12 * largest else part for part in vector]


def table(heading: Sequence[str], rows: Sequence[Sequence[Union[Any, Cell]]], texts: int = 1, name: str = "") -> str:
    """Rows of values; the first columns are texts. Columns in which no row has a value are left out."""
    def value(cell: Any) -> Any:
        return cell.value if isinstance(cell, Cell) else cell

    kept = [c for c in range(len(heading)) if any(value(row[c]) not in (None, "") for row in rows)]
    if not kept:
        return ""
    text: List[str] = [f'<div class="scroll"><table data-name="{escape(name)}"><thead><tr>']
    text += [f'<th{" class=text" if c < texts else ""}>{escape(heading[c])}</th>' for c in kept]
    text.append("</tr></thead><tbody>")
    for row in rows:
        text.append("<tr>")
        for c in kept:
            cell = row[c] if isinstance(row[c], Cell) else Cell(row[c])
            kinds = " ".join(k for k in ("text" if c < texts else "", cell.verdict) if k)
            title = f' title="{escape(cell.title)}"' if cell.title else ""
            text.append(f'<td{f" class={chr(34)}{kinds}{chr(34)}" if kinds else ""}{title}>{shown(cell.value)}</td>')
        text.append("</tr>")
    return "".join(text) + "</tbody></table></div>"


def section(heading: str, *parts: Optional[str]) -> str:
    """A section with a heading; nothing if all parts are empty."""
    body = "\n".join(part for part in parts if part)
    name = heading.lower().replace(" ", "-")
    return f'<section id="{name}"><h2>{escape(heading)}</h2>\n{body}\n</section>\n' if body else ""


def paragraph(text: str, kind: str = "") -> str:
    return f'<p{f" class={kind}" if kind else ""}>{escape(text)}</p>'


def page(title: str, header: str, body: str) -> str:
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            '<meta name="viewport" content="width=device-width, initial-scale=1"><link rel="icon" href="data:,">'
            f"<title>{escape(title)}</title><style>{style}</style></head>\n"
            f"<body><header><div>{header}</div></header>\n<main>\n{body}</main></body></html>\n")
