#!/usr/bin/env python3
"""CalculiX on the corner of prm/fichera.prm: calculix_fichera.py [--most UNKNOWNS] [--elements C3D8,C3D20] [--longest SECONDS]

The cube (-1,1)^3 without the octant x, y, z > 0 as 7 n^3 equal cubes, refined uniformly, of 8 nodes (C3D8) or 20 (C3D20), both fully integrated. Solution, body
force, tractions on the three inner squares and values on the six outer sides as in the scene. CalculiX has no loads that vary within an element: they are
integrated here with its shape functions and given as forces on the nodes. Each mesh is solved with the direct solver (SPOOLES) and with both iterative ones, which
stop at a residual of 0.5 percent of the mean load, not to be changed, so that their errors are larger; "fastest" marks the quickest one within 2 percent of the
smallest error on that mesh. A solver is left out from where it would take longer than the given seconds (as the square of the unknowns, once it takes one); when
only ITERATIVE SCALING is left, whose error may be twice as large, the series ends. One thread. Seconds: wall time of the process ccx, reading its input and writing
the displacements included, making the mesh and the loads not; seconds_ccx: the time that it prints itself. Displacements are read back with seven digits, which
changes the errors here in their seventh digit. error_energy: energy norm of the difference over that of the solution. Goes up to the given number of free unknowns.
Prints a JSON line per solve; needs numpy and Debian's calculix-ccx."""
import argparse
import itertools
import json
import os
import re
import subprocess
import tempfile
import time

import numpy as np

YOUNG, POISSON = 10., 0.3
MU, LAME = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
AMPLITUDES, POWER = np.array((0.1, 0.05, -0.07)), 0.6
SOLVERS = ("SPOOLES", "ITERATIVE SCALING", "ITERATIVE CHOLESKY")
CORNERS = np.array([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)])  # in halves of an edge, as CalculiX orders them
MIDDLES = np.array([(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)])
NODES = {"C3D8": CORNERS, "C3D20": np.concatenate([CORNERS, MIDDLES])}
SIZES = (1, 2, 3, 4, 6, 8, 10, 12, 16, 20, 24, 32, 48, 64)
POINTS = 6  # of Gauss in each direction


def exact(x):
    return np.sum(x * x, axis=-1, keepdims=True)**(POWER / 2) * AMPLITUDES


def exact_gradient(x):
    return POWER * np.sum(x * x, axis=-1)[..., None, None]**(POWER / 2 - 1) * AMPLITUDES[:, None] * x[..., None, :]


def force(x):
    r2 = np.sum(x * x, axis=-1, keepdims=True)
    along = np.sum(AMPLITUDES * x, axis=-1, keepdims=True)
    return -POWER * r2**(POWER / 2 - 1) * (MU * (POWER + 1) * AMPLITUDES + (LAME + MU) * (AMPLITUDES + (POWER - 2) * along / r2 * x))


def stress(gradient):
    return MU * (gradient + np.swapaxes(gradient, -1, -2)) + LAME * np.trace(gradient, axis1=-2, axis2=-1)[..., None, None] * np.eye(3)


def energy(gradient):
    return np.sum(stress(gradient) * gradient, axis=(-1, -2))


def shapes(nodes, points):
    """Shape functions (point, node) and their gradients (point, node, direction) on the unit cube."""
    degree = 2 if len(nodes) > 8 else 1
    powers = np.array([p for p in itertools.product(range(degree + 1), repeat=3) if p.count(2) < 2])
    coefficients = np.linalg.inv(np.prod((nodes / 2)[:, None, :]**powers, axis=2))
    gradients = []
    for d in range(3):
        lower = powers - np.eye(3, dtype=int)[d] * (powers[:, d] > 0)[:, None]
        gradients.append(powers[:, d] * np.prod(points[:, None, :]**lower, axis=2) @ coefficients)
    return np.prod(points[:, None, :]**powers, axis=2) @ coefficients, np.stack(gradients, axis=2)


def gauss(dim, n):
    x, w = np.polynomial.legendre.leggauss(n)
    return np.array(list(itertools.product((x + 1) / 2, repeat=dim))), np.prod(list(itertools.product(w / 2, repeat=dim)), axis=1)


def towards_zero(dim, n):
    """Points and weights on the unit cube or square for what behaves as a power (a multiple of 0.2) of the distance from 0: one pyramid with its apex there for each
    side away from it, the fifth root of the height is the variable."""
    points, weights = [], []
    for root, w in zip(*gauss(1, 4 * n)):
        height = root[0]**5
        for side, v in zip(*gauss(dim - 1, 2 * n)):
            for d in range(dim):
                points.append(height * np.insert(side, d, 1.))
                weights.append(w * v * height**(dim - 1) * 5 * root[0]**4)
    return np.array(points), np.array(weights)


def rules(cubes, dim):
    """Numbers of cubes, and points and weights in them, the cubes at the corner one by one."""
    at_corner = np.all((cubes == -1) | (cubes == 0), axis=1)
    others = np.flatnonzero(~at_corner)
    for some in np.array_split(others, len(others) // 1000 + 1):
        yield some, *gauss(dim, POINTS)
    points, weights = towards_zero(dim, POINTS)
    for cube in np.flatnonzero(at_corner):
        yield np.array([cube]), np.where(cubes[cube] < 0, 1 - points, points) if dim == 3 else points, weights


class Mesh:
    def __init__(self, element, n):
        self.n, self.reference = n, NODES[element]
        self.cubes = np.array([c for c in itertools.product(range(-n, n), repeat=3) if min(c) < 0])  # lower corners, in edges
        places = 2 * self.cubes[:, None, :] + self.reference + 2 * n
        size = 4 * n + 1
        used, numbers = np.unique(places @ np.array((size * size, size, 1)), return_inverse=True)
        self.cells = numbers.reshape(len(self.cubes), -1)
        halves = np.stack(np.unravel_index(used, (size, ) * 3), axis=1) - 2 * n
        self.points = halves / (2. * n)
        self.outside = np.any(np.abs(halves) == 2 * n, axis=1)

    def add(self, loads, cells, values):  # of each node of these cells
        for d in range(3):
            loads[:, d] += np.bincount(self.cells[cells].ravel(), values[..., d].ravel(), len(loads))

    def loads(self):
        """Of the body force and the tractions on the inner squares, by the shape functions."""
        loads = np.zeros_like(self.points)
        for cells, points, weights in rules(self.cubes, 3):
            x = (self.cubes[cells, None, :] + points) / self.n
            self.add(loads, cells, np.einsum("qn,eqd->end", weights[:, None] * shapes(self.reference, points)[0] / self.n**3, force(x), optimize=True))
        for d in range(3):
            others = [c for c in range(3) if c != d]
            inner = np.flatnonzero((self.cubes[:, d] == -1) & np.all(self.cubes[:, others] >= 0, axis=1))
            for cells, points, weights in rules(self.cubes[np.ix_(inner, others)], 2):
                points = np.insert(points, d, 1., axis=1)
                x = (self.cubes[inner[cells], None, :] + points) / self.n
                traction = stress(exact_gradient(x))[..., d]
                self.add(loads, inner[cells], np.einsum("qn,eqd->end", weights[:, None] * shapes(self.reference, points)[0] / self.n**2, traction, optimize=True))
        return loads

    def error(self, solution):
        off = total = 0.
        for cells, points, weights in rules(self.cubes, 3):
            gradient = exact_gradient((self.cubes[cells, None, :] + points) / self.n)
            computed = np.einsum("end,qnc->eqdc", solution[self.cells[cells]], shapes(self.reference, points)[1] * self.n, optimize=True)
            off += np.sum(energy(computed - gradient) @ weights)
            total += np.sum(energy(gradient) @ weights)
        return np.sqrt(off / total)


def write(name, element, mesh, solver):
    """The input; CalculiX reads no more than 20 characters of a number, so 14 digits."""
    with open(name, "w", encoding="ascii") as f:
        f.write("*NODE, NSET=ALL\n")
        f.writelines("%d,%.13e,%.13e,%.13e\n" % (i + 1, *x) for i, x in enumerate(mesh.points.tolist()))
        f.write(f"*ELEMENT, TYPE={element}, ELSET=CUBES\n")
        for i, cell in enumerate((mesh.cells + 1).tolist()):
            numbers = [str(i + 1), *map(str, cell)]
            f.write(",".join(numbers[:11]) + (",\n" + ",".join(numbers[11:]) if len(numbers) > 11 else "") + "\n")
        f.write(f"*MATERIAL, NAME=M\n*ELASTIC\n{YOUNG},{POISSON}\n*SOLID SECTION, ELSET=CUBES, MATERIAL=M\n*STEP\n*STATIC, SOLVER={solver}\n*BOUNDARY\n")
        for i, u in zip(np.flatnonzero(mesh.outside).tolist(), exact(mesh.points[mesh.outside]).tolist()):
            f.writelines("%d,%d,%d,%.13e\n" % (i + 1, d + 1, d + 1, u[d]) for d in range(3))
        f.write("*CLOAD\n")
        for i, load in zip(np.flatnonzero(~mesh.outside).tolist(), mesh.loads()[~mesh.outside].tolist()):
            f.writelines("%d,%d,%.13e\n" % (i + 1, d + 1, load[d]) for d in range(3))
        f.write("*NODE PRINT, NSET=ALL\nU\n*END STEP\n")


def solve(element, mesh, solver):
    """The solution, seconds of the process, seconds by CalculiX itself."""
    with tempfile.TemporaryDirectory() as folder:
        write(os.path.join(folder, "fichera.inp"), element, mesh, solver)
        start = time.perf_counter()
        run = subprocess.run(["ccx", "-i", "fichera"], cwd=folder, env=dict(os.environ, OMP_NUM_THREADS="1"), stdout=subprocess.PIPE, text=True, check=True)
        seconds = time.perf_counter() - start
        values = np.loadtxt(os.path.join(folder, "fichera.dat"), skiprows=3)
    assert len(values) == len(mesh.points)
    return values[:, 1:], seconds, float(re.search(r"Total CalculiX Time:\s*(\S+)", run.stdout)[1])


def series(element, most, longest):
    last = {solver: (0., 1) for solver in SOLVERS}
    for n in SIZES:
        mesh = Mesh(element, n)
        unknowns = 3 * int(np.sum(~mesh.outside))
        if unknowns > most:
            break
        solvers = [solver for solver, (seconds, before) in last.items() if seconds < 1 or seconds * (unknowns / before)**2 < longest]
        if not set(solvers) - {"ITERATIVE SCALING"}:
            break
        lines = []
        for solver in solvers:
            solution, seconds, by_itself = solve(element, mesh, solver)
            last[solver] = seconds, unknowns
            lines.append({"kind": "uniform", "element": element, "n": n, "elements": len(mesh.cells), "dofs": unknowns, "error_energy": mesh.error(solution),
                          "seconds": seconds, "seconds_ccx": by_itself, "solver": solver})
        smallest = min(line["error_energy"] for line in lines)
        fastest = min((line for line in lines if line["error_energy"] < 1.02 * smallest), key=lambda line: line["seconds"])
        for line in lines:
            print(json.dumps({**line, "fastest": line is fastest}), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", type=int, default=200000)
    parser.add_argument("--elements", default="C3D8,C3D20")
    parser.add_argument("--longest", type=float, default=120)
    arguments = parser.parse_args()
    for element in arguments.elements.split(","):
        series(element, arguments.most, arguments.longest)


if __name__ == "__main__":
    main()
