#!/usr/bin/env python3
"""Seconds to assemble the stiffness of a thick sphere's octant in tetrahedra, Mortise beside NGSolve.
Not a test: it prints a table for doc/assembly.md. One thread on both sides, runs alternate.

  pip install ngsolve numpy
  ninja -C build benchmarks && python3 tests/benchmarks/assembly.py build/benchmark_assembly [runs]

Both assemble all degrees of freedom, without conditions and loads, interiors of cells condensed,
pattern and allocation of the matrix included: what a program does once per mesh. NGSolve stores
one triangle of the matrix, Mortise both.
  straight  the mesh of Mortise with straight cells in both programs
  curved    the same mesh; all cells of degree p in both: in NGSolve by a deformation of degree p
  own       the same cells in Mortise as in 'curved'; in NGSolve its own mesh of the octant, curved
            to degree p, where only cells at the surface are: microseconds per cell compare
"""
import os
import subprocess
import sys
import tempfile
import time

for name in ('OMP_NUM_THREADS', 'OPENBLAS_NUM_THREADS', 'MKL_NUM_THREADS'):
    os.environ[name] = '1'

import netgen.meshing as netgen
import numpy
from netgen.occ import Box, OCCGeometry, Pnt, Sphere
from ngsolve import (BilinearForm, CF, GridFunction, Id, InnerProduct, Mesh, SetNumThreads, Sym, Trace,
                     VectorH1, dx, Grad, sqrt, x, y, z)

SUBDIVISIONS = (4, 4)
DEGREES = (2, 3, 4, 5)
E, NU = 10., 0.3
MU, LAMBDA = E / 2 / (1 + NU), E * NU / (1 + NU) / (1 - 2 * NU)


class Mortise:
    """One process that assembles once for each line that it is sent."""

    def __init__(self, program, degree, kind, mesh_file):
        self.process = subprocess.Popen(
            [program, str(degree), *map(str, SUBDIVISIONS), kind, mesh_file],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.cells, self.dofs = map(int, self.process.stdout.readline().split())

    def seconds(self):
        self.process.stdin.write('\n')
        self.process.stdin.flush()
        return [float(t) for t in self.process.stdout.readline().split()]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def mesh_from(mesh_file):
    """NGSolve's mesh of the vertices and cells in a file of benchmark_assembly."""
    with open(mesh_file) as file:
        n_vertices, n_cells = map(int, file.readline().split())
        vertices = [tuple(map(float, file.readline().split())) for _ in range(n_vertices)]
        cells = [tuple(map(int, file.readline().split())) for _ in range(n_cells)]
    mesh = netgen.Mesh()
    mesh.dim = 3
    points = [mesh.Add(netgen.MeshPoint(netgen.Pnt(*v))) for v in vertices]
    mesh.Add(netgen.FaceDescriptor(surfnr=1, domin=1, bc=1))
    mesh.SetMaterial(1, 'shell')
    faces = {}
    for cell in cells:
        a, b, c, d = cell
        at = numpy.array([vertices[v] for v in cell])
        if numpy.linalg.det(at[1:] - at[0]) < 0:
            c, d = d, c
        # netgen counts a tetrahedron as positive the other way round
        mesh.Add(netgen.Element3D(1, [points[v] for v in (a, c, b, d)]))
        for face in ((a, b, c), (a, b, d), (a, c, d), (b, c, d)):
            faces.setdefault(tuple(sorted(face)), []).append(face)
    for found in faces.values():
        if len(found) == 1:
            mesh.Add(netgen.Element2D(1, [points[v] for v in found[0]]))
    return Mesh(mesh)


def curve(mesh, degree):
    """Move all points but those at the vertices, as curved cells of degree p have it."""
    space = VectorH1(mesh, order=degree)
    shift = GridFunction(space)
    r = sqrt(x * x + y * y + z * z)
    shift.Set(1e-2 * r * CF((y * z, x * z, x * y)))
    mesh.SetDeformation(shift)
    return shift


def strain(u):
    return Sym(Grad(u))


def ngsolve_seconds(space):
    u, v = space.TnT()
    e = strain(u)
    start = time.perf_counter()
    form = BilinearForm(space, symmetric=True, condense=True)
    form += InnerProduct(2 * MU * e + LAMBDA * Trace(e) * Id(3), strain(v)).Compile() * dx
    form.Assemble()
    return time.perf_counter() - start


def compare(program, degree, kind, runs):
    with tempfile.NamedTemporaryFile() as file:
        ours = Mortise(program, degree, 'straight' if kind == 'straight' else 'curved', file.name)
        if kind == 'own':
            sphere = (Sphere(Pnt(0, 0, 0), 2) - Sphere(Pnt(0, 0, 0), 1)) * Box(Pnt(0, 0, 0), Pnt(3, 3, 3))
            mesh = Mesh(OCCGeometry(sphere).GenerateMesh(maxh=0.25))
            mesh.Curve(degree)
        else:
            mesh = mesh_from(file.name)
    keep = curve(mesh, degree) if kind == 'curved' else None
    space = VectorH1(mesh, order=degree)
    if kind != 'own':
        assert (mesh.ne, space.ndof) == (ours.cells, ours.dofs), (mesh.ne, space.ndof, ours.cells, ours.dofs)
    mine, peer = [], []
    for _ in range(runs + 1):  # the first is not counted
        mine.append(ours.seconds())
        peer.append(ngsolve_seconds(space))
    ours.close()
    parts = numpy.array(mine[1:])
    totals, peer = parts.sum(axis=1), numpy.array(peer[1:])
    a, b = numpy.median(totals), numpy.median(peer)
    p, m, c = numpy.median(parts, axis=0)
    per_cell = (1e6 * a / ours.cells, 1e6 * b / mesh.ne)
    print(f'| {kind} | {degree} | {ours.cells} / {mesh.ne} | {ours.dofs} / {space.ndof} | {p:.3f} + {m:.3f} + {c:.3f} '
          f'| {a:.3f} ({totals.min():.3f}) | {b:.3f} ({peer.min():.3f}) '
          f'| {per_cell[0]:.0f} / {per_cell[1]:.0f} | {per_cell[0] / per_cell[1]:.2f} |', flush=True)


def main():
    program, runs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 7
    SetNumThreads(1)
    print('| cells | p | cells, Mortise / NGSolve | dofs | pattern + matrix + cells | Mortise: median (least) '
          '| NGSolve | us per cell | ratio |\n|---|---|---|---|---|---|---|---|---|')
    for kind in ('straight', 'curved', 'own'):
        for degree in DEGREES:
            compare(program, degree, kind, runs)


if __name__ == '__main__':
    main()
