"""A press fit at finite strain on an octant: exact solutions, meshes and measures of errors, shared by the scripts *_fit.py.

Two hollow balls, radii 1 to 1.6 and 1.5 to 2 before deformation, E = 10, nu = 0.3; nothing else acts, the planes x = 0, y = 0, z = 0 are planes of symmetry, there is no friction. The meshes
overlap by 0.1 and have n cells along an edge of the inner and n + 1 of the outer ball, so that they never match.

Laws: `log`: mu/2 (I1 - 3 - 2 ln J) + lambda/2 ln^2 J (the interface ends at the radius 1.568411194 under the pressure 0.2864386684); `isochoric`, that of CalculiX: mu/2 (J^(-2/3) I1 - 3) +
kappa/2 (J - 1)^2. Both exact answers are found by shooting from the free surfaces.

Errors, all relative: error: root of the integral of |u - u_exact|^2 over both undeformed bodies, beside that of |u_exact|^2; error_pressure: the mean pressure, from the force on the inner
ball's planes of symmetry over pi c^2/4; error_pressure_max: the largest of pressures at points of the interface, which is not the same in all programs (doc/measurements/deformed_contact_peers.md)."""
import argparse
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

import spheres

YOUNG, POISSON = 10., 0.3
MU, LAMBDA, BULK = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 3 / (1 - 2 * POISSON)
INNER, OUTER = (1., 1.6), (1.5, 2.)


def principal(law, a, t):
    """First Piola-Kirchhoff stresses along and across the radius, of the stretches a and t."""
    j = a * t * t
    if law == "log":
        return tuple(MU * (s - 1 / s) + LAMBDA * np.log(j) / s for s in (a, t))
    return tuple(MU * j**(-2 / 3) * (s - (a * a + 2 * t * t) / 3 / s) + BULK * (j - 1) * j / s for s in (a, t))


class Exact:
    """Radius c of the interface and pressure p on it."""

    def __init__(self, law="log"):
        def slope(r, y):
            t, d = y[0] / r, 1e-30
            radial, across = principal(law, y[1], t)
            stiff, coupled = principal(law, y[1] + 1j * d, t)[0].imag / d, principal(law, y[1], t + 1j * d)[0].imag / d
            return [y[1], (2 * (across - radial) - coupled * (y[1] - t)) / r / stiff]

        def shoot(start, end, radius):
            t = radius / start
            free = brentq(lambda a: principal(law, a, t)[0], t**-2 / 2, t**-2 * 2 + 1, xtol=1e-14)
            return solve_ivp(slope, (start, end), [radius, free], rtol=1e-12, atol=1e-13, dense_output=True)

        def both(radii):
            return shoot(*INNER, radii[0]), shoot(*OUTER[::-1], radii[1])

        def mismatch(radii):
            ends = [(s.y[0, -1], principal(law, s.y[1, -1], s.y[0, -1] / r)[0] * (r / s.y[0, -1])**2) for s, r in zip(both(radii), (INNER[1], OUTER[0]))]
            return np.subtract(*ends)

        self.solutions = both(fsolve(mismatch, [0.96, 2.05], xtol=1e-13))
        self.c = self.solutions[0].y[0, -1]
        self.p = -principal(law, self.solutions[0].y[1, -1], self.c / INNER[1])[0] * (INNER[1] / self.c)**2

    def displacement(self, body, r):
        """The radial one."""
        r = np.asarray(r)
        return self.solutions[body].sol(np.clip(r.ravel(), *(INNER, OUTER)[body]))[0].reshape(r.shape) - r

    def pressure_error(self, forces):
        return abs(np.mean(np.abs(forces)) / (self.p * math.pi * self.c**2 / 4) - 1)


def shells(n, m, order, nodes):
    """Points and cells of both balls, m = (layers of the inner, of the outer one), from the mesh of spheres.py."""
    result = []
    for count, layers, (start, end) in ((n, m[0], INNER), (n + 1, m[1], OUTER)):
        points, cells = spheres.mesh(count, layers, order, nodes)
        r = np.linalg.norm(points, axis=1)[:, None]
        points = points / r * (start + (end - start) * (r - 1))
        points[abs(points) < 1e-12] = 0
        result.append((points, cells))
    return result


def side_cells(n, m):
    """The cells on the outside of the inner ball, on the inside of the outer one."""
    return np.arange(m[0] - 1, 3 * n * n * m[0], m[0]), spheres.inner_faces(n + 1, m[1])


def error(exact, bodies, displacements, nodes, kind="q"):
    """That of hexahedra: bodies as of `shells`, displacements at their points."""
    g, w = np.polynomial.legendre.leggauss(round(len(nodes)**(1 / 3)) + 3)
    g, w = (g + 1) / 2, w / 2
    values, slopes = spheres.basis(np.asarray(nodes, float), kind, np.array([(a, b, c) for a in g for b in g for c in g]))
    wrong, whole = 0., 0.
    for body, ((points, cells), u) in enumerate(zip(bodies, displacements)):
        x = np.einsum("qn,eni->eqi", values, points[cells])
        weight = np.einsum("a,b,c->abc", w, w, w).ravel() * np.linalg.det(np.einsum("eni,qnj->eqij", points[cells], slopes))
        r = np.linalg.norm(x, axis=-1)
        right = (exact.displacement(body, r) / r)[..., None] * x
        wrong += (weight * ((np.einsum("qn,eni->eqi", values, u[cells]) - right)**2).sum(axis=-1)).sum()
        whole += (weight * (right**2).sum(axis=-1)).sum()
    return math.sqrt(wrong / whole)


def child_times(usage, wall, start_up=0.):
    """As spheres.Clock, of another process."""
    cpu = usage.ru_utime + usage.ru_stime
    return dict(cpu=round(cpu, 3), cpu_solve=round(cpu - start_up, 3), wall_solve=round(wall, 3), memory_MB=round(usage.ru_maxrss / 1024))


def arguments(**more):
    """The common options; more: those of one program, with their defaults."""
    parser = argparse.ArgumentParser()
    for name, default in dict(dict(p=2, n=2, layers="1,1"), **more).items():
        if isinstance(default, bool):
            parser.add_argument("--" + name, action="store_true")
        elif isinstance(default, list):
            parser.add_argument("--" + name, action="append", default=default)
        else:
            parser.add_argument("--" + name, type=type(default), default=default)
    o = parser.parse_args()
    o.m = tuple(int(k) for k in o.layers.split(","))
    return o
