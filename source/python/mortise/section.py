"""Sections of a parameter file as dataclasses."""

from __future__ import annotations

import dataclasses
import difflib
import itertools
from typing import Any, Dict, Iterator, List, Mapping, Sequence, Tuple

from .errors import InputError
from .values import text_of, value_of


def parameter(name: str, default: Any, type: str, unit: str = "") -> Any:
    """A field of a section: the name in a parameter file, the program's default, type and unit."""
    return dataclasses.field(default=default, metadata={"name": name, "type": type, "unit": unit})


def subsection(name: str, kind: type) -> Any:
    """A field that is a subsection."""
    return dataclasses.field(default_factory=kind, metadata={"subsection": name, "kind": kind})


def subsections(word: str, kind: type) -> Any:
    """A field that has subsections "WORD NAME" by their names."""
    return dataclasses.field(default_factory=dict, metadata={"subsections": word, "kind": kind})


class Section:
    """Base of all sections. Setting a name that is none is an error."""

    def __setattr__(self, name: str, value: Any) -> None:
        names = [field.name for field in dataclasses.fields(self)]  # type: ignore[arg-type]
        if name not in names:
            near = difflib.get_close_matches(name, names, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise AttributeError(f"{type(self).__name__} has no parameter {name!r}{hint}")
        super().__setattr__(name, value)

    def assigned(self, path: Tuple[str, ...] = ()) -> Iterator[Tuple[Tuple[str, ...], str, str]]:
        """(sections, name, text) of all parameters that differ from their defaults; ("", "") for a
        named subsection, which counts by its being there."""
        below: List[Iterator[Tuple[Tuple[str, ...], str, str]]] = []
        for field in dataclasses.fields(self):  # type: ignore[arg-type]
            value, meta = getattr(self, field.name), field.metadata
            if "name" in meta and text_of(value, meta["type"]) != text_of(field.default, meta["type"]):
                yield path, meta["name"], text_of(value, meta["type"])
            elif "subsection" in meta:
                below.append(value.assigned(path + (meta["subsection"],)))
            elif "subsections" in meta:
                for name, section in value.items():
                    here = path + (f"{meta['subsections']} {name}",)
                    below.append(itertools.chain([(here, "", "")], section.assigned(here)))
        yield from itertools.chain.from_iterable(below)

    def assign(self, sections: Sequence[str], name: str, text: str, origin: str) -> None:
        """Set a parameter by its path as a parameter file does."""
        known: Dict[str, Any] = {}
        for field in dataclasses.fields(self):  # type: ignore[arg-type]
            meta = field.metadata
            if not sections and meta.get("name") == name:
                return setattr(self, field.name, value_of(text, meta["type"]))
            if sections and meta.get("subsection") == sections[0]:
                return getattr(self, field.name).assign(sections[1:], name, text, origin)
            word, _, of = sections[0].partition(" ") if sections else ("", "", "")
            if of and meta.get("subsections") == word:
                section = getattr(self, field.name).setdefault(of, meta["kind"]())
                return section.assign(sections[1:], name, text, origin) if name or sections[1:] else None
            known[meta.get("name", meta.get("subsection", f"{meta.get('subsections')} NAME"))] = None
        what = sections[0] if sections else name
        if not what:
            return None  # the opening of a subsection
        near = difflib.get_close_matches(what, known, 1)
        raise InputError(
            f"unknown {'subsection' if sections else 'parameter'} \"{what}\" ({origin})"
            + (f' (did you mean "{near[0]}"?)' if near else "")
        )


def parameter_at(root: type, path: str) -> Mapping[str, Any]:
    """Name, type and unit of a parameter, by its path below the class root; empty if there is none."""
    *sections, name = path.split("/")
    for section in sections:
        word = section.partition(" ")[0]
        below = [field.metadata["kind"] for field in dataclasses.fields(root)
                 if section == field.metadata.get("subsection") or word == field.metadata.get("subsections")]
        if not below:
            return {}
        root = below[0]
    return next((field.metadata for field in dataclasses.fields(root) if field.metadata.get("name") == name), {})
