"""Tables of a summary: a row for each step, body, interface, quantity and stage."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Sequence, Tuple


def array(values: Sequence[Any]) -> Any:
    """A numpy array, numbers that are missing as NaN; a list where numpy is not installed."""
    if any(isinstance(value, str) for value in values):
        numbers, kind = ["" if value is None else value for value in values], None
    else:
        numbers, kind = [float("nan") if value is None else value for value in values], None
    try:
        import numpy
    except ImportError:
        return numbers
    return numpy.array(numbers, dtype=kind)


class Table:
    """Columns by name: table["time"] is an array. Rows are lists."""

    def __init__(self, rows: Sequence[Mapping[str, Any]]):
        columns: Dict[str, None] = {}
        for row in rows:
            columns.update(dict.fromkeys(row))
        self.columns: List[str] = list(columns)
        self.rows: List[List[Any]] = [[row.get(name) for name in self.columns] for row in rows]

    def __len__(self) -> int:
        return len(self.rows)

    def __contains__(self, name: str) -> bool:
        return name in self.columns

    def __getitem__(self, name: str) -> Any:
        if name not in self.columns:
            raise KeyError(f"there is no column {name!r}; there are: {', '.join(self.columns)}")
        i = self.columns.index(name)
        return array([row[i] for row in self.rows])

    def where(self, **values: Any) -> "Table":
        """The rows in which columns have these values: table.where(name="glue")."""
        indices = {self.columns.index(name): value for name, value in values.items()}
        chosen = Table([])
        chosen.columns = self.columns
        chosen.rows = [row for row in self.rows if all(row[i] == value for i, value in indices.items())]
        return chosen

    def write_csv(self, file: Path) -> None:
        with open(file, "w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream)
            writer.writerow(self.columns)
            writer.writerows(self.rows)


def _flat(part: Mapping[str, Any], prefix: str = "") -> Iterator[Tuple[str, Any]]:
    """Entries of a part of the summary as columns: vectors by components, parts by their names."""
    for key, value in part.items():
        name = prefix.rstrip("_") if key == "value" and prefix else prefix + key
        if isinstance(value, Mapping):
            yield from _flat(value, name + "_")
        elif isinstance(value, list):
            letters = "xyz" if len(value) == 3 else [str(i) for i in range(len(value))]
            yield from ((f"{name}_{c}", v) for c, v in zip(letters, value))
        else:
            yield name, value


def tables(summary: Mapping[str, Any]) -> Dict[str, Table]:
    """All of a summary but its heading."""
    rows: Dict[str, List[Dict[str, Any]]] = {name: [] for name in ("steps", "bodies", "interfaces", "quantities")}
    for step in summary["steps"]:
        key = {name: step[name] for name in ("step", "cycle", "time") if name in step}
        parts = {k: v for k, v in step.items() if k not in ("bodies", "interfaces", "quantities")}
        dofs = {f"dofs_{k}": v for k, v in parts.pop("dofs", {}).items()}
        rows["steps"].append({**key, **dofs, **dict(_flat(parts))})
        for name in ("bodies", "interfaces"):
            rows[name] += [{**key, **dict(_flat(part))} for part in step[name]]
        for name, values in step["quantities"].items():
            rows["quantities"].append({**key, "name": name, **dict(zip("xyz", values))})
    result = {name: Table(of) for name, of in rows.items()}
    result["timings"] = Table([{"stage": k, "seconds": v} for k, v in summary["timings_s"].items()])
    return result
