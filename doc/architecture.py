#!/usr/bin/env python3
"""Draw doc/architecture.svg: the rooms of include/mortise with their arrows, and the stages of a run beside them.

Reads the includes of all headers and sources; exits with 1 and the list if one points to a later room. Needs nothing
but Python."""
import collections
import pathlib
import re
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
ROOMS = ["base", "material", "contact", "body", "interface", "mortar", "operators", "solvers", "adapt", "output", "problem"]
HOLDS = {
    "base": "types, expressions, log, timers, errors",
    "material": "laws at a point, exact solutions",
    "body": "meshes, elements, spaces, conformity",
    "interface": "surfaces, search, projection, clipping",
    "mortar": "multipliers, D and M",
    "contact": "laws of interfaces, active sets",
    "operators": "stiffness without a matrix, its levels, loads",
    "solvers": "linear solvers, preconditioners, Newton",
    "adapt": "errors of cells, smoothness, cut meshes",
    "output": "errors, fields, summary, checkpoints",
    "problem": "parameters, discretisation, steps, run",
}
# of problem, in this order; what lies directly in it comes last
SUB_ROOMS = ["input", "import", "support", "scene", "contact", "results", "adaptive"]
STAGES = [  # of a run: name, room that does most of it
    ("parameters", "problem"),
    ("meshes", "body"),
    ("spaces, constraints", "body"),
    ("pairs, clipping", "interface"),
    ("multipliers, coupling", "mortar"),
    ("operator", "operators"),
    ("preconditioner", "solvers"),
    ("loads and g(t)", "operators"),
    ("solve", "solvers"),
    ("errors, fields, checkpoint", "output"),
]
FIRST_OF_STEP = 7


def arrows():
    """How many files of each room include each other room."""
    counts, backwards = collections.Counter(), []
    for base in ("include/mortise", "source"):
        for path in sorted((TOP / base).rglob("*")):
            if path.suffix not in (".h", ".cc") or path.parent == TOP / "source":
                continue
            room = path.relative_to(TOP / base).parts[0]
            others = {m.split("/")[0] for m in re.findall(r"#include <mortise/([\w/]+)\.h>", path.read_text())}
            for other in others - {room}:
                counts[room, other] += 1
                if ROOMS.index(other) > ROOMS.index(room):
                    backwards.append(f"{path.relative_to(TOP)} includes {other}")
    return counts, backwards


def backwards_in_problem():
    """Includes of a later sub-room of problem."""
    def place(parts):
        return SUB_ROOMS.index(parts[1]) if len(parts) > 2 else len(SUB_ROOMS)
    found = []
    for base in ("include/mortise", "source"):
        for path in sorted((TOP / base / "problem").rglob("*")):
            if path.suffix in (".h", ".cc"):
                own = place(path.relative_to(TOP / base).parts)
                others = re.findall(r"#include <mortise/(problem/[\w/]+)\.h>", path.read_text())
                found += [f"{path.relative_to(TOP)} includes {other}" for other in others if place(other.split("/")) > own]
    return found


def draw(counts):
    height, width, left = 62, 270, 190
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" width="1010" height="{len(ROOMS) * height + 60}" '
           'font-family="sans-serif" font-size="13">',
           '<defs><marker id="a" markerWidth="8" markerHeight="8" refX="7" refY="3" orient="auto">'
           '<path d="M0,0 L7,3 L0,6 z" fill="#555"/></marker></defs>',
           '<rect width="100%" height="100%" fill="white"/>',
           f'<text x="{left}" y="24" font-weight="bold">rooms (arrows: who includes whom, by number of files)</text>',
           '<text x="650" y="24" font-weight="bold">a run</text>']
    y = {room: 40 + i * height for i, room in enumerate(ROOMS)}
    for room in ROOMS:
        svg.append(f'<rect x="{left}" y="{y[room]}" width="{width}" height="40" rx="5" fill="#e8f0fa" stroke="#36648b"/>'
                   f'<text x="{left + 8}" y="{y[room] + 17}" font-weight="bold">{room}</text>'
                   f'<text x="{left + 8}" y="{y[room] + 33}" font-size="11">{HOLDS[room]}</text>')
    for (room, other), n in sorted(counts.items()):
        span = ROOMS.index(room) - ROOMS.index(other)
        x, reach = left, 22 * span
        start, end = y[room] + 12, y[other] + 28
        svg.append(f'<path d="M{x},{start} C{x - reach},{start} {x - reach},{end} {x},{end}" fill="none" stroke="#555" '
                   f'stroke-width="{0.4 + 0.05 * min(n, 40):.2f}" marker-end="url(#a)" opacity="0.6"/>')
    step = (len(ROOMS) * height) / len(STAGES)
    for i, (name, room) in enumerate(STAGES):
        top = 40 + i * step
        colour = "#fdf2df" if i >= FIRST_OF_STEP else "#eef7ea"
        svg.append(f'<rect x="650" y="{top:.0f}" width="230" height="34" rx="5" fill="{colour}" stroke="#8b6914"/>'
                   f'<text x="658" y="{top + 21:.0f}">{name}</text>'
                   f'<line x1="650" y1="{top + 17:.0f}" x2="{left + width + 4}" y2="{y[room] + 20}" stroke="#bbb" '
                   'stroke-dasharray="3,3"/>')
        if i + 1 < len(STAGES):
            svg.append(f'<line x1="765" y1="{top + 34:.0f}" x2="765" y2="{top + step - 2:.0f}" stroke="#555" '
                       'marker-end="url(#a)"/>')
    first, last = 40 + FIRST_OF_STEP * step, 40 + (len(STAGES) - 1) * step
    svg.append(f'<path d="M880,{last + 17:.0f} C940,{last + 17:.0f} 940,{first + 17:.0f} 884,{first + 17:.0f}" fill="none" '
               f'stroke="#555" marker-end="url(#a)"/><text x="946" y="{(first + last) / 2 + 20:.0f}">each step</text>')
    return "\n".join(svg + ["</svg>"]) + "\n"


def main():
    counts, backwards = arrows()
    backwards += backwards_in_problem()
    if backwards:
        sys.exit("includes of later rooms:\n" + "\n".join(backwards))
    (TOP / "doc" / "architecture.svg").write_text(draw(counts))


if __name__ == "__main__":
    main()
