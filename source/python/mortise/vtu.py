"""Files of fields (.vtu) as numpy arrays: those that the program writes."""

from __future__ import annotations

import base64
import struct
import xml.etree.ElementTree as xml
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict


@dataclass
class Grid:
    """Cells with points of their own, so that fields may jump between cells."""

    points: Any  #: n x 3
    connectivity: Any  #: indices of points, cell by cell
    offsets: Any  #: by cell: the number of indices up to its end
    types: Any  #: by cell: VTK's type, 72 for Lagrange hexahedra, 71 for tetrahedra
    point_data: Dict[str, Any]  #: fields by their names: n, n x 3 or n x 9
    cell_data: Dict[str, Any]

    def __getitem__(self, name: str) -> Any:
        """The field of that name, at the points or by cell."""
        for data in (self.point_data, self.cell_data):
            if name in data:
                return data[name]
        raise KeyError(f"there is no field {name!r}; there are: {', '.join([*self.point_data, *self.cell_data])}")


def _bytes(text: str) -> bytes:
    """The data of an array, which stands there in base 64: sizes, then compressed blocks."""
    text = "".join(text.split())
    (n_blocks,) = struct.unpack("<I", base64.b64decode(text[:8])[:4])
    length = (4 * (3 + n_blocks) + 2) // 3 * 4
    sizes = struct.unpack(f"<{3 + n_blocks}I", base64.b64decode(text[:length])[: 4 * (3 + n_blocks)])[3:]
    data, parts, start = base64.b64decode(text[length:]), [], 0
    for size in sizes:
        parts.append(zlib.decompress(data[start : start + size]))
        start += size
    return b"".join(parts)


def _arrays(element: Any) -> Dict[str, Any]:
    import numpy

    kinds = {"Float64": "<f8", "Float32": "<f4", "Int32": "<i4", "UInt8": "u1"}
    result = {}
    for array in element.iter("DataArray") if element is not None else ():
        values = numpy.frombuffer(_bytes(array.text), kinds[array.get("type")])
        n = int(array.get("NumberOfComponents", "1"))
        result[array.get("Name")] = values if n == 1 else values.reshape(-1, n)
    return result


def read_vtu(file: Path) -> Grid:
    """The cells of all ranks. Needs numpy."""
    import numpy

    root = xml.parse(file).getroot()
    if root.get("compressor") != "vtkZLibDataCompressor" or root.get("header_type", "UInt32") != "UInt32":
        raise ValueError(f"{file}: not as Mortise writes files of fields")
    pieces = [{name: _arrays(piece.find(name)) for name in ("Points", "Cells", "PointData", "CellData")}
              for piece in root.iter("Piece")]
    n_points = numpy.cumsum([0] + [len(piece["Points"]["Points"]) for piece in pieces])

    def joined(part: str, name: str) -> Any:
        shifts = n_points if name in ("connectivity", "offsets") else numpy.zeros_like(n_points)
        arrays = [piece[part][name] for piece in pieces]
        return numpy.concatenate([a + s if s else a for a, s in zip(arrays, shifts)])

    fields = {part: {name: joined(part, name) for name in pieces[0][part]} for part in ("PointData", "CellData")}
    cells = (joined("Cells", name) for name in ("connectivity", "offsets", "types"))
    return Grid(joined("Points", "Points"), *cells, fields["PointData"], fields["CellData"])
