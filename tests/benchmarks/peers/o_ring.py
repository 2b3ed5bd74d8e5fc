"""An O-ring squeezed by 30 %, prm/o_ring.prm but for that, for other programs: meshes and measures, shared by the scripts *_o_ring.py.

A quarter of the upper half of a torus (radius 4, section of radius 1, incompressible neo-Hookean, mu = 1) below a plate (radii 2.5 and 5.5, 0.3 thick, E = 1000, nu = 0.3), whose top goes down by 0.3
in five equal steps. The planes x = 0, y = 0, z = 0 are planes of symmetry; there is no friction; the slave is the skin of the ring.

error: the largest deviation of the force on the plate from REFERENCE, over the five steps, beside the last force.

Hexahedra: half discs of 6 n^2 cells, each quarter of a square and two parts around it, times m along the ring."""
import numpy as np

import spheres

RADIUS, SECTION, PLATE, MU, STIFF, POISSON, SQUEEZE = 4., 1., (2.5, 5.5, 0.3), 1., 1000., 0.3, 0.3
TIMES = [0.2, 0.4, 0.6, 0.8, 1.0]
REFERENCE = [0.8640, 2.1102, 3.7210, 5.7745, 8.4180]


def half_disc():
    """Parts of the section, as (map of [0, 1]^2 into a quarter, whether its second coordinate ends at the skin, which quarter)."""
    side, corner = 0.5, 0.4
    arc = lambda angle: np.array([np.cos(angle), np.sin(angle)])  # noqa: E731

    def square(a, b):
        return np.array([side * a * (1 - b) + corner * a * b, side * b * (1 - a) + corner * a * b])

    def right(a, b):
        return (1 - b) * np.array([side * (1 - a) + corner * a, corner * a]) + b * arc(np.pi / 4 * a)

    def top(a, b):
        return right(a, b)[::-1]

    return [(part, skin, mirror) for mirror in (1, -1) for part, skin in ((square, False), (right, True), (top, True))]


def collect(blocks, nodes, order):
    """Points and cells of blocks (counts, map of [0, 1]^3), each with its nodes, offsets 0..order; cells are turned over where their map is."""
    points, cells = spheres.Points(), []
    for counts, place in blocks:
        e, c = 1e-4, np.array([0.5, 0.5, 0.5])
        slope = np.array([np.array(place(*(c + d))) - place(*(c - d)) for d in e * np.eye(3)])
        turned = np.linalg.det(slope) < 0
        offsets = nodes[:, [1, 0, 2]] if turned else nodes
        cells += [[points.number(place(*((np.array(k) + s / order) / counts))) for s in offsets] for k in np.ndindex(*counts)]
    return np.array(points.points), np.array(cells)


def bodies(n, m, plate, order, nodes):
    """Points and cells of ring and plate, and the numbers of the cells whose last coordinate ends on the skin of the ring; plate: its counts along the radius and the ring, as "6,4"."""
    across, along = (int(k) for k in plate.split(","))
    blocks, skin, count = [], [], 0
    for part, outside, mirror in half_disc():
        def place(a, b, c, part=part, mirror=mirror):
            x, z = part(a, c)
            x, angle = RADIUS + SECTION * mirror * x, np.pi / 2 * b
            return x * np.cos(angle), x * np.sin(angle), SECTION * z

        blocks.append(((n, m, n), place))
        if outside:
            skin += range(count + n - 1, count + n * m * n, n)
        count += n * m * n

    def flat(a, b, c):
        r, angle = PLATE[0] + (PLATE[1] - PLATE[0]) * a, np.pi / 2 * b
        return r * np.cos(angle), r * np.sin(angle), SECTION + PLATE[2] * c

    return collect(blocks, nodes, order), collect([((across, along, 1), flat)], nodes, order), np.array(skin)


def heights(finer):
    """Of the top of the plate over its start, for each of TIMES those of `finer` equal steps."""
    return [[-SQUEEZE * (time - TIMES[0] * (1 - s / finer)) for s in range(1, finer + 1)] for time in TIMES]


def measures(forces):
    """forces: on the quarter of the plate, by step."""
    forces = np.abs(np.array(forces))
    result = dict(steps_done=len(forces), forces=forces.round(6).tolist())
    if len(forces) == len(TIMES):
        result["error"] = float(abs(forces - REFERENCE).max() / REFERENCE[-1])
    return result
