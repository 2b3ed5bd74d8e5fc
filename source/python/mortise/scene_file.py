"""Parameter files: reading and writing scenes."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Iterator, List, Optional, Tuple, Type, TypeVar, Union

from .errors import InputError
from .section import Section

Line = Tuple[Tuple[str, ...], str, str, str]
S = TypeVar("S", bound="SceneFile")


def _joined_lines(file: Path, text: str) -> Iterator[Tuple[str, str]]:
    """(text, origin) of the lines without comments, continued ones joined."""
    joined, first = "", 0
    for number, raw in enumerate(text.splitlines(), 1):
        first = first if joined else number
        raw = raw.split("#")[0].rstrip()
        joined += raw[:-1] if raw.endswith("\\") else raw
        if raw.endswith("\\"):
            continue
        if joined.strip():
            yield " ".join(joined.split()), f"line {first} of {file}"
        joined = ""


def scan(file: Path, sections: Tuple[str, ...] = (), depth: int = 0) -> Iterator[Line]:
    """(sections, name, value, origin) of each line, those of included files among them. The opening
    of a subsection has neither name nor value."""
    try:
        text = file.read_text(errors="replace")
    except OSError as error:
        raise InputError(f'parameter file "{file}": cannot be read: {error.strerror}') from None
    if depth > 20:
        raise InputError(f'parameter file "{file}": more than 20 files within each other; does one include itself?')
    path: List[str] = list(sections)
    for line, origin in _joined_lines(file, text):
        keyword, _, rest = line.partition(" ")
        keyword, rest = keyword.lower(), rest.strip()
        if keyword == "set" and "=" in rest:
            name, _, value = rest.partition("=")
            yield tuple(path), name.strip(), value.strip(), origin
        elif keyword == "subsection" and rest:
            path.append(rest)
            yield tuple(path), "", "", origin
        elif keyword == "end" and not rest and len(path) > len(sections):
            path.pop()
        elif keyword == "include" and rest:
            beside = file.parent / rest
            yield from scan(beside if beside.exists() else Path(rest), tuple(path), depth + 1)
        else:
            raise InputError(f'{origin}: cannot understand "{line}"')
    if len(path) > len(sections):
        raise InputError(f'subsection "{path[-1]}": "end" is missing before the end of {file}')


class SceneFile(Section):
    """What a scene can do beside having parameters."""

    @classmethod
    def read(cls: Type[S], file: Union[str, "os.PathLike[str]"]) -> S:
        """The scene of a parameter file. Mesh files are sought beside it when the scene is run."""
        scene, names = cls(), {"Bodies": "bodies", "Interfaces": "interfaces"}
        lines = list(scan(Path(file)))
        for sections, name, value, _ in lines:
            if not sections and name in names:
                # those that are named, in the order of their names
                known = {n.strip(): None for n in value.split(",") if n.strip()}
                object.__setattr__(scene, names[name], {n: cls._kind_of(names[name])() for n in known})
        for sections, name, value, origin in lines:
            if sections or name not in names:
                scene._check_named(sections, origin)
                scene.assign(sections, name, value, origin)
        object.__setattr__(scene, "_directory", Path(file).resolve().parent)
        return scene

    @classmethod
    def _kind_of(cls, field: str) -> type:
        return cls.__dataclass_fields__[field].metadata["kind"]  # type: ignore[attr-defined]

    def _check_named(self, sections: Tuple[str, ...], origin: str) -> None:
        for word, field in (("Body", "bodies"), ("Interface", "interfaces")):
            start = sections[0] if sections else ""
            if start.startswith(word + " ") and start[len(word) + 1 :] not in getattr(self, field):
                raise InputError(
                    f'unknown subsection "{start}" ({origin}): "set {field.capitalize()} = '
                    f'{", ".join(getattr(self, field))}" does not name it'
                )

    @property
    def directory(self) -> Optional[Path]:
        """Of the file that the scene was read from, where the files of its meshes are."""
        return self.__dict__.get("_directory")

    def text(self) -> str:
        """The parameter file: all that differs from the program's defaults."""
        lines: List[str] = []
        for word, field in (("Bodies", "bodies"), ("Interfaces", "interfaces")):
            if getattr(self, field):
                lines.append(f"set {word} = {', '.join(getattr(self, field))}")
        path: Tuple[str, ...] = ()
        for sections, name, value in self.assigned():
            shared = len(os.path.commonprefix([path, sections]))
            lines += ["  " * (len(path) - i - 1) + "end" for i in range(len(path) - shared)]
            for depth in range(shared, len(sections)):
                lines += [""] * (depth == 0) + ["  " * depth + "subsection " + sections[depth]]
            path = sections
            if name:
                lines.append("  " * len(path) + f"set {name} = {value}".rstrip())
        lines += ["  " * (len(path) - i - 1) + "end" for i in range(len(path))]
        return "\n".join(lines) + "\n"

    def write(self, file: Union[str, "os.PathLike[str]"]) -> Path:
        """Write the parameter file."""
        Path(file).write_text(self.text())
        return Path(file)
