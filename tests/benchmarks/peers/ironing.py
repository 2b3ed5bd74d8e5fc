"""Ironing with friction, prm/ironing.prm, for other programs: meshes and measures, shared by the scripts *_ironing.py.

A block (4 x 0.125 x 1, E = 1, nu = 0.32, held below) and a die, a quarter of a tube (radii 0.3 and 0.6, E = 10, nu = 0.32), which lies on it at x = 1. The inside of the die goes down by
0.15 in five steps and then along the block by 2 in twenty; mu = 0.3, plane strain in a slice; the slave is the outside of the die. There is no exact answer; the force along the block should be
0.3 of that across it where all slips, but for the part of the pressure along it before and behind the die.

forces: of the die on what holds it, per slice, along and across, at t = 1, 1.5 and 2. Over the last fifteen steps: ratio, the mean of those forces; ratio_off, the largest deviation of a ratio
from it; ripple, the largest deviation of the force across from its mean."""
import numpy as np

import spheres

WIDTH, MU, POISSON, SOFT, STIFF = 0.125, 0.3, 0.32, 1., 10.
TIMES = [0.2 * k for k in range(1, 6)] + [1 + 0.05 * k for k in range(1, 21)]


def motion(t):
    return np.array([2. * max(t - 1, 0), 0, -0.15 * min(t, 1)])


def grid(counts, nodes, order, place):
    points = spheres.Points()
    cells = [[points.number(place(*((np.array(c) + s / order) / counts))) for s in nodes] for c in np.ndindex(*counts)]
    return np.array(points.points), np.array(cells)


def bodies(scale, order, nodes):
    """Points and cells of block and die, 32 x 1 x 6 and 12 x 1 x 2 times scale (but across), third coordinates upwards and inwards."""
    block = grid((32 * scale, 1, 6 * scale), nodes, order, lambda a, b, c: (4 * a, WIDTH * b, c - 1))

    def tube(a, b, c):
        angle, r = np.pi * (-0.75 + 0.5 * a), 0.6 - 0.3 * c
        return 1 + r * np.cos(angle), WIDTH * b, 0.6 + r * np.sin(angle)

    return block, grid((12 * scale, 1, 2 * scale), nodes, order, tube)


def measures(times, forces):
    """forces: steps x (along, across) on the die."""
    times, forces = np.array(times), np.abs(np.array(forces))
    result = dict(end=float(times[-1]), forces={"%g" % t: forces[np.argmin(abs(times - t))].round(6).tolist() for t in (1, 1.5, 2) if abs(times - t).min() < 1e-6})
    late = forces[times > 1.2501]
    if len(late):
        ratio = late[:, 0] / late[:, 1]
        result.update(ratio=ratio.mean(), ratio_off=abs(ratio - ratio.mean()).max(), ripple=abs(late[:, 1] / late[:, 1].mean() - 1).max())
    return result
