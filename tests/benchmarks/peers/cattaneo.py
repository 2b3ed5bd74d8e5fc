"""Partial slip of Cattaneo and Mindlin: the scene, its meshes and the measure of the error, shared by kratos_cattaneo.py, calculix_cattaneo.py and mortise_cattaneo.py.

The scene. Two bodies, E = 200, nu = 0.3, small strain, friction coefficient 0.3. No units.

- Lower body: the box |x| <= 3, y in the range below, -3 <= z <= 0. Upper body: |x| <= 3, same y, gap(x, y) <= z <= 3, its nodes at (x, y, z + gap (1 - z / 3))
  with gap = x^2 / 200 (line) or (x^2 + y^2) / 200 (point): a cylinder or sphere of radius R = 100 on a plane, or two of radius 200. R is large and the loads are small
  to keep slopes below 2e-3 within the contact, so that the half-space formulas apply; the linear elastic problem depends on P R alone. To
  first order the same is a pair of flat boxes with the offset gap(x, y).
- `line`: 0 <= y <= 0.02, u_y = 0 everywhere on y = 0 and y = 0.02 (plane strain, one cell). `point`: 0 <= y <= 3, u_y = 0 on y = 0 (half of the bodies).
- z = -3: u = 0. z = 3: u = (s, 0, -d). The other sides are free. First d grows in equal steps from 0 to its full value while s = 0, then s grows in equal steps
  with d held. d and s are chosen so that the forces are close to the nominal ones:
      line:  d = 2.3235e-4, s = 6.15e-5: P = 0.01 per unit of y, a = 0.107640, c/a = 0.632456
      point: d = 2.187e-4, s = 3.8e-5: P = 0.005 (all of the patch, both halves), a = 0.150554, c/a = 0.736806
  with Q = 0.6 * 0.3 * P. By the symmetry of the two bodies the tangential load does not change the pressure.

Formulas, with 1 / E* = 2 (1 - nu^2) / E and P, Q as measured in the run itself (reactions, or forces at the contact nodes), which depends least on the far field:
  line:  a^2 = 4 P R / (pi E*), p0 = 2 P / (pi a), c / a = (1 - Q / (mu P))^(1/2)
  point: a^3 = 3 P R / (4 E*), p0 = 3 P / (2 pi a^2), c / a = (1 - Q / (mu P))^(1/3)
  tau = mu p0 [sqrt(1 - (r/a)^2) - (c/a) sqrt(1 - (r/c)^2)], the second root only for r < c.
Mindlin's answer for the point neglects the slip across the load and is not exact for nu /= 0.

Meshes: products of three grids. n cells over |x| <= B (B = 0.15 for the line, 0.2 for the point, where y <= B has n / 2), outside of it and in depth from the size
2 B / n upwards by a constant ratio close to 1.3 (line) or 1.5 (point). The slave is the lower body with n cells, the master the upper one with round(5 n / 6) to the next even number, so the meshes
do not match. `cattaneo.py --scene line|point --n 48 --order 1|2 PREFIX` writes PREFIX_lower.msh and PREFIX_upper.msh for gmsh (write_msh names the surfaces).

doc/measurements/friction_peers.jsonl holds runs of all three programs, one core each, on a machine with other work on it: compare `cpu`, not `seconds`. Of repeated runs the quicker stands. Figures
of runs that did not converge are left out there.
"""
import argparse
import math

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

YOUNG, POISSON, FRICTION, RADIUS, EXTENT, THICKNESS = 200., 0.3, 0.3, 100., 3., 0.02
E_STAR = YOUNG / 2 / (1 - POISSON**2)
PATCH = {"line": 0.15, "point": 0.2}
RATIO = {"line": 1.3, "point": 1.5}
ACTIVE = 1e-3  # of the largest pressure, below which a node counts as open
SLIDING = 0.99  # of the bound, above which a node counts as slipping
SHIFT = {"line": (2.3235e-4, 6.15e-5), "point": (2.187e-4, 3.8e-5)}  # d and s at full load


def gap(scene, x, y):
    return (x * x + (y * y if scene == "point" else 0)) / 2 / RADIUS


def graded(h, start, end, ratio):
    """Points from start to end (both included), the first step about h, then growing by a constant ratio close to the given one."""
    length = end - start
    m = max(1, round(math.log(1 + length * (ratio - 1) / h) / math.log(ratio)))
    low, high = 1 + 1e-9, 10.
    for _ in range(200):
        q = (low + high) / 2
        low, high = (q, high) if h * (q**m - 1) / (q - 1) < length else (low, q)
    steps = q**np.arange(m)
    return start + length * np.concatenate([[0], np.cumsum(steps) / steps.sum()])


def grids(scene, n):
    b = PATCH[scene]
    ratio = RATIO[scene]
    out = graded(2 * b / n, b, EXTENT, ratio)[1:]
    x = np.concatenate([-out[::-1], np.linspace(-b, b, n + 1), out])
    y = np.array([0., THICKNESS]) if scene == "line" else np.concatenate([np.linspace(0, b, n // 2 + 1), out])
    return x, y, graded(2 * b / n, 0, EXTENT, ratio)


def body(scene, n, order, upper):
    """Points (k x 3), cells (8 or 20 points each in the order of Abaqus), and faces of the contact as (cell, number of the face as Abaqus counts: 1 bottom, 2 top)."""
    def halved(g):
        return g if order == 1 else np.sort(np.concatenate([g, (g[1:] + g[:-1]) / 2]))

    x, y, z = (halved(g) for g in grids(scene, n))
    if not upper:
        z = -z[::-1]
    shape = tuple(len(g) for g in (x, y, z))
    points = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    if upper:
        points[:, 2] += gap(scene, points[:, 0], points[:, 1]) * (1 - points[:, 2] / EXTENT)
    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    middles = [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]
    places = np.array(corners if order == 1 else corners + middles) * order // 2
    first = np.stack(np.meshgrid(*[np.arange(0, s - 1, order) for s in shape], indexing="ij"), axis=-1).reshape(-1, 1, 3)
    cells = np.ravel_multi_index(tuple(np.moveaxis(first + places, -1, 0)), shape)
    at_contact = first[:, 0, 2] == (0 if upper else shape[2] - 1 - order)
    used, cells = np.unique(cells, return_inverse=True)
    return points[used], cells.reshape(-1, len(places)), np.where(at_contact)[0]


def master_cells(n):
    return 2 * round(5 * n / 12)


def scene_mesh(scene, n, order):
    """Both bodies in one list of points: points, cells, number of lower points, number of lower cells, contact cells below and above."""
    p1, c1, f1 = body(scene, n, order, False)
    p2, c2, f2 = body(scene, master_cells(n), order, True)
    return np.concatenate([p1, p2]), np.concatenate([c1, c2 + len(p1)]), len(p1), len(c1), f1, f2 + len(c1)


def steps(scene, normal, tangential):
    """(d, s) at the end of each step."""
    d, s = SHIFT[scene]
    return [(d * (k + 1) / normal, 0.) for k in range(normal)] + [(d, s * (k + 1) / tangential) for k in range(tangential)]


def shapes(order, xi):
    """Values (q x k) and derivatives (q x k x 3) of the 8 or 20 functions of a hexahedron in the order of Abaqus at points xi (q x 3) of [-1, 1]^3."""
    corner = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)], float)
    f = 1 + xi[:, None] * corner
    value = f.prod(axis=-1) / 8
    slope = np.stack([corner[:, k] * np.delete(f, k, 2).prod(axis=-1) / 8 for k in range(3)], axis=-1)
    if order == 1:
        return value, slope
    middle = np.array([(0, -1, -1), (1, 0, -1), (0, 1, -1), (-1, 0, -1), (0, -1, 1), (1, 0, 1), (0, 1, 1), (-1, 0, 1), (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
    factor = np.where(middle == 0, 1 - xi[:, None]**2, 1 + xi[:, None] * middle)
    change = np.where(middle == 0, -2 * xi[:, None], middle + 0 * factor)
    value_m = factor.prod(axis=-1) / 4
    slope_m = np.stack([change[..., k] * np.delete(factor, k, 2).prod(axis=-1) / 4 for k in range(3)], axis=-1)
    for k, c in enumerate(corner):
        near = [m for m, place in enumerate(middle) if abs(place - c).sum() == 1]
        value[:, k] -= value_m[:, near].sum(axis=1) / 2
        slope[:, k] -= slope_m[:, near].sum(axis=1) / 2
    return np.concatenate([value, value_m], axis=1), np.concatenate([slope, slope_m], axis=1)


def gauss(m):
    g, w = np.polynomial.legendre.leggauss(m)
    return np.array([(a, b, c) for a in g for b in g for c in g]), np.array([a * b * c for a in w for b in w for c in w])


def tractions(points, cells, displacements, nodes, integration):
    """Traction (rows of 3), and the resultant of all, on the lower body at `nodes` of its contact face, from the internal forces of the displacements in the cells below that face.

    cells: those that touch the face, with their top on it. integration: points in each direction that the stiffness of the code has. The force at a node divided by
    the integral of its function (8 nodes), or forces times the inverse of the face's mass matrix (20 nodes): for contact with dual multipliers these are the multipliers."""
    order = 1 if cells.shape[1] == 8 else 2
    xi, w = gauss(integration)
    _, slope = shapes(order, xi)
    jacobian = np.einsum("eni,qnj->eqij", points[cells], slope)
    gradients = np.einsum("qnj,eqjk->eqnk", slope, np.linalg.inv(jacobian))
    g = np.einsum("eni,eqnk->eqik", displacements[cells], gradients)
    strain = (g + np.swapaxes(g, -1, -2)) / 2
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 2 / (1 + POISSON)
    stress = 2 * shear * strain + lame * np.trace(strain, axis1=-2, axis2=-1)[..., None, None] * np.eye(3)
    local = np.einsum("q,eq,eqik,eqnk->eni", w, np.linalg.det(jacobian), stress, gradients)
    forces = np.zeros_like(points)
    np.add.at(forces, cells, local)
    place = np.full(len(points), -1)
    place[nodes] = np.arange(len(nodes))
    top = [4, 5, 6, 7] + ([12, 13, 14, 15] if order == 2 else [])
    p2, w2 = np.polynomial.legendre.leggauss(3)
    value, slope = shapes(order, np.array([(a, b, 1.) for a in p2 for b in p2]))
    value, slope = value[:, top], slope[:, top, :2]
    weight = np.outer(w2, w2).ravel() * np.linalg.det(np.einsum("eni,qnj->eqij", points[cells[:, top]][..., :2], slope))
    index = place[cells[:, top]]
    if order == 1:
        size = np.zeros(len(nodes))
        np.add.at(size, index, np.einsum("eq,qn->en", weight, value))
        return forces[nodes] / size[:, None], forces[nodes].sum(axis=0)
    mass = np.einsum("eq,qn,qm->enm", weight, value, value)
    rows, columns = np.broadcast_arrays(index[:, :, None], index[:, None, :])
    matrix = scipy.sparse.csc_matrix((mass.ravel(), (rows.ravel(), columns.ravel())), shape=(len(nodes), len(nodes)))
    return scipy.sparse.linalg.splu(matrix).solve(forces[nodes]), forces[nodes].sum(axis=0)


def hertz(scene, P, Q):
    """Contact radius, largest pressure and stick radius by the formulas."""
    if scene == "line":
        a = math.sqrt(4 * P * RADIUS / math.pi / E_STAR)
        return a, 2 * P / math.pi / a, a * math.sqrt(max(0., 1 - Q / FRICTION / P))
    a = (3 * P * RADIUS / 4 / E_STAR)**(1 / 3)
    return a, 3 * P / 2 / math.pi / a**2, a * max(0., 1 - Q / FRICTION / P)**(1 / 3)


def root(r, a):
    return np.sqrt(np.maximum(0, 1 - (r / a)**2)) if a > 0 else 0 * r


def contact_faces(cells, nodes):
    """Nodes of the top faces of cells (4 or 8 each), as places in `nodes`."""
    place = np.full(cells.max() + 1, -1)
    place[nodes] = np.arange(len(nodes))
    return place[cells[:, [4, 5, 6, 7] + ([12, 13, 14, 15] if cells.shape[1] == 20 else [])]]


def evaluate(scene, points, faces, traction, P, Q, slips=None):
    """Figures of one run from the traction (rows of 3, on the lower body) at the nodes `points` of the lower body's contact face, whose faces have the nodes `faces`.

    P, Q: normal and tangential force of the whole patch, per unit of y for the line. slips: where nodes slip; without it where the shear exceeds SLIDING times the bound.
    a, c from nodes: mean of the last node inside and the first outside on y = 0 at both ends, so known to half the distance of nodes; a, c from moments of pressure
    and shear. Errors in L2 over the whole contact face, of values interpolated by the functions of the faces, relative to the formula's norm."""
    pressure, shear = -traction[:, 2], traction[:, :2].copy()
    if scene == "line":
        shear[:, 1] = 0  # nodes on y = 0 and its opposite are held in y, which leaves the reaction there
    else:
        shear[abs(points[:, 1]) < 1e-9, 1] = 0
    shear *= np.sign(shear[:, 0].sum()) or 1
    a, p0, c = hertz(scene, P, Q)
    active = pressure > ACTIVE * p0
    stick = active & (np.hypot(shear[:, 0], shear[:, 1]) <= SLIDING * FRICTION * pressure if slips is None else ~slips)
    row = np.where(abs(points[:, 1]) < 1e-9)[0]
    row = row[np.argsort(points[row, 0])]

    def radius(inside):
        k, x = np.where(inside[row])[0], points[row, 0]
        return float((x[k[-1]] + x[k[-1] + 1] - x[k[0]] - x[k[0] - 1]) / 4) if len(k) else 0.

    parts, (g, w) = 6, np.polynomial.legendre.leggauss(2)
    g, w = np.concatenate([(2 * k + 1 + g) / parts - 1 for k in range(parts)]), np.tile(w / parts, parts)
    xi = np.array([(i, j, 1.) for i in g for j in g])
    places = [4, 5, 6, 7] + ([12, 13, 14, 15] if faces.shape[1] == 8 else [])
    value, slope = (f[:, places] for f in shapes(1 if faces.shape[1] == 4 else 2, xi))
    near = faces[(abs(points[faces]).min(axis=1)[:, :2] < 2 * PATCH[scene]).all(axis=1)]
    at = np.einsum("qn,eni->eqi", value, points[near])
    weight = np.outer(w, w).ravel() * abs(np.linalg.det(np.einsum("eni,qnj->eqij", points[near][..., :2], slope[..., :2])))
    weight *= 1 / THICKNESS if scene == "line" else 2
    p, tx, ty = (np.einsum("qn,en->eq", value, f[near]) for f in (pressure, shear[:, 0], shear[:, 1]))
    r = abs(at[..., 0]) if scene == "line" else np.hypot(at[..., 0], at[..., 1])
    p_exact = p0 * root(r, a)
    t_exact = FRICTION * (p_exact - p0 * c / a * root(r, c))

    def norm(*f):
        return math.sqrt(sum((weight * q * q).sum() for q in f))

    force, moment, force_t, moment_t = ((weight * f).sum() for f in (p, p * r**2, tx, tx * r**2))
    share, power = (1 / 4, 4) if scene == "line" else (2 / 5, 5)
    result = dict(P=P, Q=Q, load=Q / FRICTION / P, a=a, p0=p0, a_nodes=radius(active), a_moment=math.sqrt(max(0., moment / (force or 1) / share)), error_pressure=norm(p - p_exact) / norm(p_exact),
                  force_from_pressure=force / P, p_max=pressure.max() / p0, spacing=float(np.diff(points[row, 0]).min()), nodes_active=int(active.sum()))
    if Q > 0:
        result.update(c_over_a=c / a, c_over_a_nodes=radius(stick) / (radius(active) or 1), c_over_a_moment=max(0., 1 - moment_t / (FRICTION * (moment or 1)))**(1 / power), error_shear=norm(tx - t_exact, ty) / norm(t_exact),
                      force_from_shear=force_t / Q, shear_max=np.hypot(shear[:, 0], shear[:, 1]).max() / FRICTION / p0, shear_max_exact=float(root(c, a)), nodes_stick=int(stick.sum()))
    return {k: v if isinstance(v, int) else float("%.6g" % v) for k, v in result.items()}


def write_msh(name, scene, n, order, upper):
    """One body as a mesh of gmsh 2.2, with the physical volume `body` and surfaces `far` (z = 3 or -3), `contact`, `y0`, `y1` (largest y) and `sides` (x = 3 or -3)."""
    points, cells, _ = body(scene, n, order, upper)
    quads = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (0, 4, 7, 3), (1, 2, 6, 5)]
    edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    edge = {frozenset(e): 8 + k for k, e in enumerate(edges)}
    order_of_gmsh = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]
    cell_nodes = list(range(8)) + ([edge[frozenset(e)] for e in order_of_gmsh] if order == 2 else [])
    y_end = THICKNESS if scene == "line" else EXTENT
    names = ("far", "contact", "y0", "y1", "sides")
    rows = []
    for c in cells:
        rows.append((5 if order == 1 else 17, 6, c[cell_nodes]))
        for q in quads:
            f = points[c[list(q)]]
            distance = (abs(f[:, 2]) - EXTENT, f[:, 2] - (gap(scene, f[:, 0], f[:, 1]) if upper else 0), f[:, 1], f[:, 1] - y_end, abs(f[:, 0]) - EXTENT)
            tag = next((k + 1 for k, values in enumerate(distance) if abs(values).max() < 1e-9), None)
            if tag:
                middles = [edge[frozenset((q[k], q[(k + 1) % 4]))] for k in range(4)] if order == 2 else []
                rows.append((3 if order == 1 else 16, tag, c[list(q) + middles]))
    with open(name, "w", encoding="utf-8") as f:
        f.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n")
        f.writelines('2 %d "%s"\n' % (k + 1, label) for k, label in enumerate(names))
        f.write('3 6 "body"\n$EndPhysicalNames\n$Nodes\n%d\n' % len(points))
        f.writelines("%d %.15g %.15g %.15g\n" % (k + 1, *p) for k, p in enumerate(points))
        f.write("$EndNodes\n$Elements\n%d\n" % len(rows))
        f.writelines("%d %d 2 %d %d %s\n" % (k + 1, kind, tag, tag, " ".join(str(i + 1) for i in nodes)) for k, (kind, tag, nodes) in enumerate(rows))
        f.write("$EndElements\n")


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("prefix")
    parser.add_argument("--scene", choices=("line", "point"), default="line")
    parser.add_argument("--n", type=int, default=24)
    parser.add_argument("--order", type=int, choices=(1, 2), default=1)
    o = parser.parse_args()
    write_msh(o.prefix + "_lower.msh", o.scene, o.n, o.order, False)
    write_msh(o.prefix + "_upper.msh", o.scene, master_cells(o.n), o.order, True)
