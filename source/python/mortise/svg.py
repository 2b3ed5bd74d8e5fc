"""Charts as inline SVG."""

from __future__ import annotations

import math
from html import escape
from typing import List, Optional, Sequence, Tuple

colours = ("#1f5fa8", "#c4501b", "#2e8b57", "#8a4fae", "#b8860b", "#3a9bb0", "#a83250", "#5b6770")


def number(value: float) -> str:
    """Four significant digits."""
    return f"{value:.4g}"


def ticks(low: float, high: float, most: int = 6) -> List[float]:
    """Round numbers from low to high."""
    if not high > low:
        return [low]
    step = 10 ** math.floor(math.log10((high - low) / most))
    step *= next(f for f in (1, 2, 5, 10) if (high - low) / (f * step) <= most)
    first = math.ceil(low / step - 1e-9)
    return [i * step for i in range(first, math.floor(high / step + 1e-9) + 1)]


def bars(rows: Sequence[Tuple[str, float]], unit: str) -> str:
    """Horizontal bars with their numbers."""
    height, left, width = 24, 160, 440
    most = max((value for _, value in rows), default=0.0) or 1.0
    total = sum(value for _, value in rows) or 1.0
    lines = [f'<svg viewBox="0 0 760 {height * len(rows) + 6}" class="chart" role="img">']
    for i, (name, value) in enumerate(rows):
        y, w = i * height + 3, max(1.0, width * value / most)
        lines.append(f'<text x="{left - 8}" y="{y + 15}" text-anchor="end">{escape(name)}</text>'
                     f'<rect x="{left}" y="{y}" width="{w:.1f}" height="{height - 6}" rx="2" fill="{colours[0]}"/>'
                     f'<text x="{left + w + 8:.1f}" y="{y + 15}">{number(value)} {escape(unit)} '
                     f'<tspan class="dim">{100 * value / total:.0f} %</tspan></text>')
    return "".join(lines) + "</svg>"


def _scale(values: Sequence[float], logarithmic: bool) -> Tuple[float, float]:
    low, high = min(values), max(values)
    if logarithmic:
        return low, high if high > low else low + 1
    if low > 0 and low < 0.6 * high:
        low = 0.0
    if high < 0 and high > 0.6 * low:
        high = 0.0
    # a curve that hardly changes is a straight line
    margin = max((high - low) * 0.05, max(abs(low), abs(high)) * 0.01) or 1.0
    return (low if low == 0 < high else low - margin), (high if high == 0 > low else high + margin)


def curves(title: str, x_label: str, x: Sequence[float], lines: Sequence[Tuple[str, Sequence[Optional[float]]]],
           logarithmic: bool = False) -> str:
    """Curves over x with a legend; points that are missing or no numbers are left out."""
    usable = [(name, [(a, math.log10(b) if logarithmic else b) for a, b in zip(x, y)
                      if b is not None and math.isfinite(b) and (b > 0 or not logarithmic)]) for name, y in lines]
    usable = [(name, points) for name, points in usable if points]
    if not usable:
        return ""
    width, height, left, right, top, bottom = 560, 300, 74, 14, 34, 42
    rows = (len(usable) + 2) // 3
    all_y = [b for _, points in usable for _, b in points]
    x0, x1 = min(x), max(x)
    x1 = x1 if x1 > x0 else x0 + 1
    y0, y1 = _scale(all_y, logarithmic)

    def place(a: float, b: float) -> Tuple[float, float]:
        return (left + (a - x0) / (x1 - x0) * (width - left - right),
                height - bottom - (b - y0) / (y1 - y0) * (height - top - bottom))

    text = [f'<svg viewBox="0 0 {width} {height + 18 * rows}" class="chart" role="img"><title>{escape(title)}</title>',
            f'<text x="{left}" y="18" class="head">{escape(title)}</text>']
    y_ticks = range(math.ceil(y0 - 1e-9), math.floor(y1 + 1e-9) + 1) if logarithmic else ticks(y0, y1)
    for b in y_ticks:
        _, y = place(x0, b)
        text.append(f'<path d="M{left} {y:.1f}H{width - right}" class="grid"/><text x="{left - 6}" y="{y + 4:.1f}" '
                    f'text-anchor="end">{number(10.0 ** b if logarithmic else b if abs(b) > 1e-12 * (y1 - y0) else 0)}</text>')
    for a in ticks(x0, x1):
        position, _ = place(a, y0)
        text.append(f'<text x="{position:.1f}" y="{height - bottom + 17}" text-anchor="middle">{number(a)}</text>')
    text.append(f'<path d="M{left} {top}V{height - bottom}H{width - right}" class="axis"/>'
                f'<text x="{(left + width - right) / 2}" y="{height - 6}" text-anchor="middle">{escape(x_label)}</text>')
    for i, (name, points) in enumerate(usable):
        colour, at = colours[i % len(colours)], [place(a, b) for a, b in points]
        text.append('<polyline fill="none" stroke-width="2" stroke="%s" points="%s"/>'
                    % (colour, " ".join(f"{a:.1f},{b:.1f}" for a, b in at)))
        if len(at) <= 40:
            text += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.6" fill="{colour}"/>' for a, b in at]
        lx, ly = left + (i % 3) * 162, height + 18 * (i // 3) + 10
        text.append(f'<path d="M{lx} {ly - 4}h16" stroke="{colour}" stroke-width="3"/>'
                    f'<text x="{lx + 21}" y="{ly}">{escape(name[:24])}</text>')
    return "".join(text) + "</svg>"
