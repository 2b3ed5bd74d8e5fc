"""Two nonlinear scenes on an octant of a thick sphere: exact solutions, meshes and the measure of the error, shared by the scripts *_spheres.py.

Radii 1 and 2 before deformation; the planes x = 0, y = 0, z = 0 are planes of symmetry. No units.

- `balloon`: incompressible neo-Hookean body, mu = 1, finite strain. The inner surface is moved to the radius 2 (u = x there), the outer one is free. Exact: r^3 = R^3 + 7; the pressure
  on the inner surface is mu [2/l + 1/(2 l^4)] taken from l = 2 to l = 15^(1/3)/2, 0.8069266031. Codes that cannot be incompressible have the bulk modulus KAPPA = 1e4 unless named
  otherwise; a bulk modulus kappa alone leaves an error of 0.47/kappa.
- `hill`: small strain, J2 plasticity without hardening, E = 1000, nu = 0.3, Y = 1, pressure on the inner surface for which the plastic zone ends at c = 1.5 (Hill). With m radial
  layers of cells, m even, c is a face between cells, so that the solution is smooth in each cell; with m odd it is not.
  Exact: sigma_r = -(2 Y c^3/3) (1/r^3 - 1/8) outside and -p + 2 Y ln r inside; u = r [(1 - 2 nu) sigma_r + (1 - nu) Y c^3/r^3]/E inside, by integration of the elastic change of volume.

Error: root of the integral of |grad u - grad u_exact|^2 over the undeformed body, divided by that of |grad u_exact|^2.

Meshes: three patches of n x n cells on the sphere (equal angles), m layers in the radius, 3 n^2 m cells whose nodes lie on spheres."""
import json
import math
import resource
import time

import numpy as np

INNER, OUTER, GROWN, MU, KAPPA = 1., 2., 2., 1., 1e4
YOUNG, POISSON, YIELD, FRONT = 1000., 0.3, 1., 1.5
OUTER_GROWN = (OUTER**3 + GROWN**3 - INNER**3)**(1 / 3)
PRESSURE = {"balloon": MU * sum(s * (2 / l + 1 / (2 * l**4)) for s, l in ((1, OUTER_GROWN / OUTER), (-1, GROWN / INNER))),
            "hill": 2 * YIELD * math.log(FRONT / INNER) + 2 / 3 * YIELD * (1 - (FRONT / OUTER)**3)}


def radial(problem, r):
    """Radial displacement and its derivative at the undeformed radius r."""
    if problem == "balloon":
        grown = (r**3 + GROWN**3 - INNER**3)**(1 / 3)
        return grown - r, r**2 / grown**2 - 1
    cube = YIELD * FRONT**3 / YOUNG
    inside = -PRESSURE["hill"] + 2 * YIELD * np.log(r / INNER)
    k = (1 - 2 * POISSON) / YOUNG
    plastic = k * r * inside + (1 - POISSON) * cube / r**2, k * (inside + 2 * YIELD) - 2 * (1 - POISSON) * cube / r**3
    a, b = k * 2 * YIELD * FRONT**3 / 3 / OUTER**3, (1 + POISSON) * cube / 3
    elastic = a * r + b / r**2, a - 2 * b / r**3
    return tuple(np.where(r < FRONT, p, e) for p, e in zip(plastic, elastic))


def exact_gradient(problem, x):
    """du_i/dX_j at points x (... x 3)."""
    r = np.linalg.norm(x, axis=-1)
    u, slope = radial(problem, r)
    n = x / r[..., None]
    return (u / r)[..., None, None] * np.eye(3) + (slope - u / r)[..., None, None] * n[..., :, None] * n[..., None, :]


def lattice(order):
    """Nodes of a hexahedron of the given degree as integers 0..order, x fastest."""
    return np.array([(i, j, k) for k in range(order + 1) for j in range(order + 1) for i in range(order + 1)])


CORNERS = 2 * np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
MIDDLES = np.array([(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)])
HEX20 = np.concatenate([CORNERS, MIDDLES])  # the order of Abaqus, nodes as integers 0..2


class Points:
    """Points by number; those that are the same to 1e-8 have one."""

    def __init__(self):
        self.index, self.points = {}, []

    def number(self, p):
        key = tuple(np.round(np.array(p) * 1e8).astype(int))
        if key not in self.index:
            self.index[key] = len(self.points)
            self.points.append(p)
        return self.index[key]


def mesh(n, m, order, nodes=None):
    """Points and cells (each with its nodes in the order of `nodes`, integers 0..order, by default all of `lattice`)."""
    nodes = lattice(order) if nodes is None else nodes
    points, cells = Points(), []
    for patch in range(3):
        for i, j, k in np.ndindex(n, n, m):
            s, t = (np.tan(math.pi / 4 * (a + nodes[:, c] / order) / n) for c, a in ((0, i), (1, j)))
            direction = np.stack([s, t, 1 + 0 * s], axis=-1) / np.sqrt(1 + s**2 + t**2)[:, None]
            radius = INNER + (OUTER - INNER) * (k + nodes[:, 2] / order) / m
            x = np.roll(direction * radius[:, None], patch, axis=1)
            cells.append([points.number(p) for p in x])
    return np.array(points.points), np.array(cells)


def inner_faces(n, m):
    """Numbers of the cells whose bottom (third coordinate 0) lies on the inner surface."""
    return np.arange(0, 3 * n * n * m, m)


def basis(nodes, kind, xi):
    """Values (q x k) and slopes (q x k x 3) at xi in [0, 1]^3 of the functions that are 1 at one of the nodes (reals in [0, 1]^3), kind: `q` (degree in each coordinate), `serendipity`, `p` (tetrahedra)."""
    count = len(nodes)
    degree = {"q": lambda: round(count**(1 / 3)) - 1, "serendipity": lambda: 2, "p": lambda: {4: 1, 10: 2}[count]}[kind]()
    powers = lattice(degree)
    if kind == "serendipity":
        powers = powers[(powers * (powers > 1)).sum(axis=1) <= 2]
    elif kind == "p":
        powers = powers[powers.sum(axis=1) <= degree]
    legendre = [np.polynomial.legendre.Legendre.basis(k) for k in range(degree + 1)]

    def values(at, derived=None):
        result = np.ones((len(at), len(powers)))
        for c in range(3):
            table = np.stack([(f.deriv() if c == derived else f)(2 * at[:, c] - 1) * (2 if c == derived else 1) for f in legendre], axis=-1)
            result *= table[:, powers[:, c]]
        return result

    inverse = np.linalg.inv(values(nodes))
    return values(xi) @ inverse, np.stack([values(xi, c) @ inverse for c in range(3)], axis=-1)


def pressure_forces(points, cells, nodes, kind="q"):
    """Forces at all points that do the work of the pressure of `hill` on the bottoms (third coordinate 0) of the given cells."""
    g, w = np.polynomial.legendre.leggauss(round(len(nodes)**(1 / 3)) + 3)
    g, w = (g + 1) / 2, w / 2
    values, slopes = basis(np.asarray(nodes, float), kind, np.array([(a, b, 0.) for a in g for b in g]))
    tangents = np.einsum("eni,qnj->eqij", points[cells], slopes)
    normal = np.cross(tangents[..., 0], tangents[..., 1])  # into the body
    forces = np.zeros_like(points)
    np.add.at(forces, cells, PRESSURE["hill"] * np.einsum("q,eqi,qn->eni", np.outer(w, w).ravel(), normal, values))
    return forces


def error(problem, points, displacements, nodes, kind="q"):
    """The error of hexahedra with the given points and displacements (cells x nodes x 3)."""
    g, w = np.polynomial.legendre.leggauss(round(len(nodes)**(1 / 3)) + 4)
    g, w = (g + 1) / 2, w / 2
    xi = np.array([(a, b, c) for a in g for b in g for c in g])
    weights = np.array([a * b * c for a in w for b in w for c in w])
    values, slopes = basis(np.asarray(nodes, float), kind, xi)
    wrong, whole = 0., 0.
    for x, u in zip(points, displacements):
        jacobian = np.einsum("ni,qnj->qij", x, slopes)
        gradient = np.einsum("ni,qnj,qjk->qik", u, slopes, np.linalg.inv(jacobian))
        exact = exact_gradient(problem, values @ x)
        weight = weights * np.linalg.det(jacobian)
        wrong += np.einsum("q,qij->", weight, (gradient - exact)**2)
        whole += np.einsum("q,qij->", weight, exact**2)
    return math.sqrt(wrong / whole)


def pressure_of(force):
    """Mean pressure on the deformed inner surface of the balloon from the radial force on a coordinate plane's projection, pi r^2/4."""
    return abs(force) / (math.pi * GROWN**2 / 4)


class Clock:
    """Seconds of the processor and of the wall from here on; `report` prints the JSON line of a run. cpu: with start-up and imports; cpu_solve: without; both without the error's evaluation."""

    def __init__(self):
        self.cpu, self.wall = time.process_time(), time.perf_counter()

    def stop(self):
        now = time.process_time()
        return dict(cpu=round(now, 3), cpu_solve=round(now - self.cpu, 3), wall_solve=round(time.perf_counter() - self.wall, 3),
                    memory_MB=round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024))


def report(**values):
    print(json.dumps({k: float("%.5g" % v) if isinstance(v, float) else v for k, v in values.items()}), flush=True)
