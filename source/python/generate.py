#!/usr/bin/env python3
"""Makes the classes of parameters from what the program says of them.

    build/mortise --parameters=json | python3 source/python/generate.py [--check]

writes bodies.py and scene.py of the package; --check only says whether they are what it would write.
"""

import json
import pathlib
import sys
import textwrap

package = pathlib.Path(__file__).parent / "mortise"
sys.path.insert(0, str(package))  # what it makes is not there yet
from values import value_of  # noqa: E402

plural = {"Body": "bodies", "Boundary": "boundaries", "Interface": "interfaces"}
classes_of_bodies = ("Mesh", "Material", "Boundary", "Body")
heading = '''"""{what} (made by source/python/generate.py from mortise --parameters=json)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import {typing}

from .{base} import {names}
'''


def identifier(name):
    return "".join(c if c.isalnum() else "_" for c in name.lower())


def class_name(path):
    last = path.split("/")[-1].replace(" NAME", "")
    return "".join(word.capitalize() for word in last.split()) or "Scene"


def annotation(entry):
    kind = entry["type"]
    choices = "Literal[" + ", ".join(json.dumps(c) for c in entry.get("selections", [])) + "]"
    empty = entry["default"] == ""
    optional = "Optional[%s]" if empty else "%s"
    if kind.startswith("list of "):
        of = {"reals": "float", "integers": "int", "expressions": "Expression"}.get(kind[8:], choices)
        return "Expressions" if of == "Expression" else f"Sequence[{of}]"
    return {
        "boolean": "bool",
        "integer": optional % "int",
        "real": optional % "float",
        "expression": optional % "Expression",
        "selection": choices,
        "text": "str",
    }[kind]


def docstring(entry):
    text = f"{entry['text']} Allowed: {entry['allowed']}."
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    closed = ' """' if text.endswith('"') else '"""'
    return textwrap.fill('"""' + text + closed, 130, initial_indent="    ", subsequent_indent="    ",
                         break_long_words=False, break_on_hyphens=False)


def field(entry):
    default = value_of(entry["default"], entry["type"])
    unit = f', "{entry["unit"]}"' if entry["unit"] else ""
    line = (f"    {identifier(entry['name'])}: {annotation(entry)} = "
            f'parameter("{entry["name"]}", {default!r}, "{entry["type"]}"{unit})')
    return line + "\n" + docstring(entry)


def class_text(section, below):
    path = section["path"]
    base = "SceneFile" if path == "" else "Section"
    where = f"The parameters in `{path}`." if path else "A scene: what a parameter file contains."
    lines = [f"@dataclass\nclass {class_name(path)}({base}):", f'    """{where}"""\n']
    lines += [field(e) for e in section["parameters"] if e["type"] != "list of names"]
    for child in below:
        name = child.split("/")[-1]
        kind = class_name(child)
        if name.endswith(" NAME"):
            word = name[: -len(" NAME")]
            lines.append(f'    {plural[word]}: Dict[str, {kind}] = subsections("{word}", {kind})')
            lines.append(f'    """Sections `{name}` by NAME."""')
        else:
            lines.append(f'    {identifier(name)}: {kind} = subsection("{name}", {kind})')
            lines.append(f'    """The section `{name}`."""')
    return "\n".join(lines) + "\n"


def files(reference):
    sections = {s["path"]: s for s in reference["sections"]}

    def children(path):
        return [p for p in sections if p and p.rpartition("/")[0] == path]

    texts = {class_name(p): class_text(s, children(p)) for p, s in sections.items()}
    order = [class_name(p) for p in sorted(sections, key=lambda p: (p == "", -p.count("/")))]
    bodies = [texts[c] for c in order if c in classes_of_bodies]
    others = [texts[c] for c in order if c not in classes_of_bodies]
    names = "Section, parameter, subsection, subsections\nfrom .values import Expression, Expressions"
    yield "bodies.py", "\n\n".join(
        [heading.format(what="Parameters of a body", typing="Dict, Literal, Optional, Sequence", base="section",
                        names=names)] + bodies)
    yield "scene.py", "\n\n".join(
        [heading.format(what="Parameters of a scene", typing="Dict, Literal, Optional, Sequence", base="bodies",
                        names="Body") + f"from .scene_file import SceneFile\nfrom .section import {names}\n"]
        + others)


def main():
    check = "--check" in sys.argv[1:]
    stale = []
    for name, text in files(json.load(sys.stdin)):
        file = package / name
        if check and (not file.exists() or file.read_text() != text):
            stale.append(name)
        elif not check:
            file.write_text(text)
    if stale:
        sys.exit(f"{', '.join(stale)}: not what the program says; run\n"
                 "  build/mortise --parameters=json | python3 source/python/generate.py")


main()
