"""Results of a run: the directory that it wrote."""

from __future__ import annotations

import json
import os
import xml.etree.ElementTree as xml
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Union

from .tables import Table, tables
from .vtu import Grid, read_vtu


class Record(Dict[str, Any]):
    """A dictionary whose entries are attributes, too: summary.steps[-1].solver.iterations."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no {name!r}; there are: {', '.join(self)}") from None

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *(key for key in self if key.isidentifier())]


class FieldFile(NamedTuple):
    time: Optional[float]  #: None in a scene without steps
    path: Path


class Results:
    """The results in a directory. Raises OSError where there is no summary.json."""

    def __init__(self, directory: Union[str, "os.PathLike[str]"]):
        self.directory = Path(directory)
        text = (self.directory / "summary.json").read_text()
        #: all of summary.json, entries as attributes
        self.summary: Record = json.loads(text, object_hook=Record)

    def __repr__(self) -> str:
        return f"<Results of {self.directory}: {self.status}, {len(self.steps)} steps>"

    @property
    def status(self) -> str:
        """ "done", "not converged", "stopped", or "running"."""
        return self.summary["status"]

    @property
    def warnings(self) -> List[str]:
        return self.summary.get("warnings", [])

    @property
    def steps(self) -> List[Record]:
        """An entry for each load step and cycle of adaptivity."""
        return self.summary["steps"]

    @property
    def last(self) -> Record:
        """The last of the steps."""
        return self.steps[-1]

    def body(self, name: str, step: int = -1) -> Record:
        """What the summary says of a body."""
        return _named(self.steps[step]["bodies"], name)

    def interface(self, name: str, step: int = -1) -> Record:
        """What the summary says of an interface."""
        return _named(self.steps[step]["interfaces"], name)

    def quantity(self, name: str, step: int = -1) -> Any:
        """An entry of Output/Points or Output/Resultants; a moment as "NAME, moment"."""
        from .tables import array

        return array(self.steps[step]["quantities"][name])

    @property
    def tables(self) -> Dict[str, Table]:
        """Tables "steps", "bodies", "interfaces", "quantities" and "timings", whose columns are arrays."""
        return tables(self.summary)

    @property
    def log(self) -> str:
        """What the program printed, if run() has started it."""
        file = self.directory / "log.txt"
        return file.read_text() if file.exists() else ""

    def field_files(self, name: str) -> List[FieldFile]:
        """The files of fields of a body or an interface, with their times."""
        gathered = self.directory / f"{name}.pvd"
        if gathered.exists():
            return [FieldFile(float(entry.get("timestep", "nan")), self.directory / entry.get("file", ""))
                    for entry in xml.parse(gathered).iter("DataSet")]
        alone = self.directory / f"{name}.vtu"
        return [FieldFile(None, alone)] if alone.exists() else []

    @property
    def field_names(self) -> List[str]:
        """Bodies and interfaces that have files of fields."""
        last = self.steps[-1] if self.steps else {}
        return [part["name"] for part in (*last.get("bodies", ()), *last.get("interfaces", ()))
                if self.field_files(part["name"])]

    def _field_file(self, name: str, step: int) -> Path:
        files = self.field_files(name)
        if not files:
            raise KeyError(f"there are no fields of {name!r} in {self.directory}; there are those of: "
                           f"{', '.join(self.field_names) or 'nothing'}. Output/Fields asks for them")
        return files[step].path

    def fields(self, name: str, step: int = -1) -> Grid:
        """Points, cells and fields of a body or an interface as numpy arrays."""
        return read_vtu(self._field_file(name, step))

    def mesh(self, name: str, step: int = -1) -> Any:
        """The same as a mesh of PyVista, which has to be installed."""
        import pyvista

        return pyvista.read(self._field_file(name, step))

    def report(self) -> Path:
        """Write report.html and its tables beside the results."""
        from .report import write_report

        return write_report(self.directory)


def _named(parts: List[Record], name: str) -> Record:
    for part in parts:
        if part["name"] == name:
            return part
    raise KeyError(f"there is no {name!r}; there are: {', '.join(part['name'] for part in parts)}")
