#!/usr/bin/env python3
"""Read the surface files of scenes with other programs: read_back.py MORTISE SCENE.prm...

Every scene is run; the traction of each interface is integrated over its file as meshio and as PyVista (VTK) read it. VTK says
itself where the points of a cell are and what a field is between its nodes; with meshio the nodes are taken in the order that
VTK documents. Both have to give the force that summary.json tells. Needs meshio and pyvista (PyPI)."""
import json
import os
import subprocess
import sys
import tempfile

import meshio
import numpy
import pyvista
import vtk

FLAT = {"triangle", "VTK_LAGRANGE_TRIANGLE"}


def gauss(triangle, n=12):
    """Points in [0, 1]^2, or in the triangle by collapsed coordinates, and weights."""
    x, w = numpy.polynomial.legendre.leggauss(n)
    x, w = (x + 1) / 2, w / 2
    r, s = (a.ravel() for a in numpy.meshgrid(x, x))
    weights = numpy.outer(w, w).ravel()
    return (numpy.stack([r * (1 - s), s], 1), weights * (1 - s)) if triangle else (numpy.stack([r, s], 1), weights)


def vtk_functions(cell, points):
    """Values and slopes of the functions of the nodes of a cell of VTK; the slopes by differences of fourth order."""
    def at(r, s):
        values, x = [0.] * cell.GetNumberOfPoints(), [0.] * 3
        cell.EvaluateLocation(vtk.reference(0), [r, s, 0.], x, values)
        return numpy.array(values)

    def slope(r, s, dr, ds, h=1e-3):
        near, far = (at(r + k * h * dr, s + k * h * ds) - at(r - k * h * dr, s - k * h * ds) for k in (1, 2))
        return (8 * near - far) / (12 * h)

    return numpy.array([at(r, s) for r, s in points]), numpy.array([[slope(r, s, 1, 0), slope(r, s, 0, 1)] for r, s in points])


def documented_nodes(triangle, n):
    """Corners, edges around the face (those of a square along their axes), then what is inside."""
    if not triangle:
        edge = range(1, n)
        return numpy.array([(0, 0), (n, 0), (n, n), (0, n)] + [(i, 0) for i in edge] + [(n, j) for j in edge] + [(i, n) for i in edge] +
                           [(0, j) for j in edge] + [(i, j) for j in edge for i in edge]) / n
    nodes = []

    def add(origin, m):
        if m == 0:
            nodes.append((origin, origin))
            return
        corners = [numpy.array(c) for c in ((origin, origin), (origin + m, origin), (origin, origin + m))]
        nodes.extend(corners)
        for a, b in ((0, 1), (1, 2), (2, 0)):
            nodes.extend(corners[a] + (corners[b] - corners[a]) // m * i for i in range(1, m))
        if m > 2:
            add(origin + 1, m - 3)

    add(0, n)
    return numpy.array(nodes) / n


def own_functions(triangle, n_nodes, points):
    """The same by solving for the polynomials that are one at a node and zero at the others."""
    n = next(n for n in range(1, 17) if ((n + 1) * (n + 2) // 2 if triangle else (n + 1)**2) == n_nodes)
    powers = [(i, j) for i in range(n + 1) for j in range(n + 1) if not triangle or i + j <= n]

    def legendre(k, x, slope):
        series = numpy.polynomial.legendre.Legendre.basis(k, [0, 1])
        return (series.deriv() if slope else series)(x)

    def table(x, d):
        return numpy.array([legendre(i, x[:, 0], d == 0) * legendre(j, x[:, 1], d == 1) for i, j in powers]).T

    inverse = numpy.linalg.inv(table(documented_nodes(triangle, n), None))
    return table(points, None) @ inverse, numpy.stack([table(points, d) @ inverse for d in (0, 1)], 1)


def integral(x, traction, functions, weights):
    """Of cells of one kind, by their nodes."""
    values, slopes = functions
    tangents = numpy.einsum("qdi,cik->cqdk", slopes, x)
    area = numpy.linalg.norm(numpy.cross(tangents[:, :, 0], tangents[:, :, 1]), axis=2) * weights
    return numpy.einsum("cq,qi,cik->k", area, values, traction)


def by_pyvista(file):
    mesh = pyvista.read(file)
    force = numpy.zeros(3)
    nodes = [mesh.get_cell(c).point_ids for c in range(mesh.n_cells)]
    for kind in {(mesh.celltypes[c], len(nodes[c])) for c in range(mesh.n_cells)}:
        cells = [c for c in range(mesh.n_cells) if (mesh.celltypes[c], len(nodes[c])) == kind and mesh["covered"][c] > 1e-6]
        if cells:
            points, weights = gauss(kind[0] in (vtk.VTK_TRIANGLE, vtk.VTK_LAGRANGE_TRIANGLE))
            ids = numpy.array([nodes[c] for c in cells])
            force += integral(mesh.points[ids], mesh["traction"][ids].astype(float), vtk_functions(mesh.GetCell(cells[0]), points), weights)
    return force


def by_meshio(file):
    mesh = meshio.read(file)
    force = numpy.zeros(3)
    for block, covered in zip(mesh.cells, mesh.cell_data["covered"]):
        ids = block.data[numpy.ravel(covered) > 1e-6]
        if len(ids):
            points, weights = gauss(block.type in FLAT)
            force += integral(mesh.points[ids], mesh.point_data["traction"][ids].astype(float),
                              own_functions(block.type in FLAT, ids.shape[1], points), weights)
    return force


def main(program, scenes):
    worst = 0.
    for scene in scenes:
        with tempfile.TemporaryDirectory() as work:
            subprocess.run([program, "--output", work, "--set", "Output/Fields=traction", scene], check=True, stdout=subprocess.DEVNULL)
            step = json.load(open(os.path.join(work, "summary.json")))["steps"][-1]
            for interface in step["interfaces"]:
                name = interface["name"]
                files = [f for f in sorted(os.listdir(work)) if f == name + ".vtu" or (f.startswith(name + "_") and f.endswith(".vtu"))]
                told = -numpy.array(interface["force"])  # on the slave, as the traction is
                for reader in (by_meshio, by_pyvista):
                    read = reader(os.path.join(work, files[-1]))
                    error = numpy.abs(read - told).max() / numpy.abs(told).max()
                    worst = max(worst, error)
                    print(f"{os.path.basename(scene):32} {name:16} {reader.__name__[3:]:8} force {read}  told {told}  off by {error:.1e}")
    print("largest difference", worst)
    return 0 if worst < 1e-6 else 1


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
