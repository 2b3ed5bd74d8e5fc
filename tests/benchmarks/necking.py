#!/usr/bin/env python3
"""The necking bar of tests/field/bar_necks.prm by a program of another kind: axisymmetric, with assembled matrices, differences for tangents.

    necking.py [--cells 16] [--steps 35] [--flow additive|multiplicative]

Radius 6.413, length 53.334, its middle thinner by 1.8 % (linear taper), lengthened by 14; E = 206.9, nu = 0.29, yield stress 0.45 + 0.265 (1 - exp(-16.93 a)) + 0.12924 a (Simo 1988), Hencky's law.
Additive: a plastic strain is subtracted from ln U (Miehe, Apel, Lambrecht 2002), as Mortise does. Multiplicative: an increment f carries the elastic left stretch along, f b_e f^T, and the radial return
is taken in the logarithms of its principal values (Simo 1992); the two differ where directions turn while the bar flows. Quadrilaterals of eight nodes with four points each, which do not lock;
--cells of them along the radius, two and a half times as many along the half bar. Prints the half elongation, the change of the radius in the middle, the force and the largest equivalent plastic strain."""
import argparse

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

parser = argparse.ArgumentParser()
parser.add_argument("--cells", type=int, default=16)
parser.add_argument("--steps", type=int, default=35)
parser.add_argument("--flow", choices=("additive", "multiplicative"), default="additive")
o = parser.parse_args()
YOUNG, POISSON, RADIUS, HALF, PULLED = 206.9, 0.29, 6.413, 26.667, 7
MU, KAPPA = YOUNG / 2 / (1 + POISSON), YOUNG / 3 / (1 - 2 * POISSON)
UNIT = np.array([1., 1, 0, 1])  # symmetric tensors are (rr, zz, rz, tt), F is (rr, rz, zr, zz, tt)


def in_plane(t):
    """The 2 x 2 part of a symmetric tensor."""
    return np.stack([np.stack([t[..., 0], t[..., 2]], -1), np.stack([t[..., 2], t[..., 1]], -1)], -2)


def symmetric(plane, tt):
    return np.stack([plane[..., 0, 0], plane[..., 1, 1], plane[..., 0, 1], tt], -1)


def gradient_in_plane(F):
    return np.stack([F[..., :2], F[..., 2:4]], -2)


def transposed(a):
    return np.swapaxes(a, -1, -2)


def eigensystem(a):
    """Eigenvalues (... x 2) and eigenvectors (columns of ... x 2 x 2) of symmetric 2 x 2 matrices."""
    angle = np.arctan2(2 * a[..., 0, 1], a[..., 0, 0] - a[..., 1, 1]) / 2
    half, mean = np.hypot((a[..., 0, 0] - a[..., 1, 1]) / 2, a[..., 0, 1]), (a[..., 0, 0] + a[..., 1, 1]) / 2
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([mean + half, mean - half], -1), np.stack([np.stack([c, -s], -1), np.stack([s, c], -1)], -2)


def of_eigenvalues(axes, values):
    return np.einsum("...ij,...j,...kj->...ik", axes, values, axes)


def radial_return(strain, alpha):
    """Kirchhoff stress of a trial elastic strain, the plastic strain that flows and the new alpha."""
    volume = strain @ UNIT
    deviator = 2 * MU * (strain - volume[..., None] / 3 * UNIT)
    mises = np.sqrt(1.5 * (deviator**2 @ np.array([1, 1, 2, 1])))
    flow = np.zeros_like(mises)
    for _ in range(30):
        a = alpha + flow
        y, slope = 0.45 + 0.265 * (1 - np.exp(-16.93 * a)) + 0.12924 * a, 0.265 * 16.93 * np.exp(-16.93 * a) + 0.12924
        flow = np.maximum(flow + (mises - 3 * MU * flow - y) / (3 * MU + slope), 0)
    flown = flow[..., None] * 1.5 * deviator / np.maximum(mises, 1e-300)[..., None]
    return KAPPA * volume[..., None] * UNIT + deviator - 2 * MU * flown, flown, alpha + flow


def additive(F, _, plastic, alpha):
    """Nominal stress (5 numbers), plastic strain and alpha at F."""
    full = gradient_in_plane(F)
    values, axes = eigensystem(transposed(full) @ full)
    strain = symmetric(of_eigenvalues(axes, np.log(values) / 2), np.log(F[..., 4]))
    T, flown, alpha = radial_return(strain - plastic, alpha)
    a, b = values[..., 0], values[..., 1]
    apart = abs(a - b) > 1e-7 * a
    mixed = np.where(apart, np.log(a / b) / np.where(apart, a - b, 1), 2 / (a + b))
    by_strain = np.stack([np.stack([1 / a, mixed], -1), np.stack([mixed, 1 / b], -1)], -2)  # 2 dln U/dC along the axes
    P = full @ axes @ (transposed(axes) @ in_plane(T) @ axes * by_strain) @ transposed(axes)
    return np.concatenate([P.reshape(P.shape[:-2] + (4,)), (T[..., 3] / F[..., 4])[..., None]], -1), plastic + flown, alpha


def multiplicative(F, old, b, alpha):
    """Nominal stress (5 numbers), elastic left stretch and alpha at F after the state (old, b, alpha)."""
    full = gradient_in_plane(F)
    f = full @ np.linalg.inv(gradient_in_plane(old))
    values, axes = eigensystem(f @ in_plane(b) @ transposed(f))
    tt = b[..., 3] * (F[..., 4] / old[..., 4])**2
    strain = symmetric(of_eigenvalues(axes, np.log(values) / 2), np.log(tt) / 2)
    tau, flown, alpha = radial_return(strain, alpha)
    values, axes = eigensystem(in_plane(strain - flown))
    P = in_plane(tau) @ transposed(np.linalg.inv(full))
    return (np.concatenate([P.reshape(P.shape[:-2] + (4,)), (tau[..., 3] / F[..., 4])[..., None]], -1),
            symmetric(of_eigenvalues(axes, np.exp(2 * values)), np.exp(2 * (strain - flown)[..., 3])), alpha)


stress = additive if o.flow == "additive" else multiplicative
CORNERS = np.array([(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)])


def shapes(s, t):
    """The eight functions of a square [-1, 1]^2 and their derivatives."""
    v, d = np.zeros(8), np.zeros((8, 2))
    for k, (a, b) in enumerate(CORNERS - 1):
        if a and b:
            v[k] = (1 + a * s) * (1 + b * t) * (a * s + b * t - 1) / 4
            d[k] = a * (1 + b * t) * (2 * a * s + b * t) / 4, b * (1 + a * s) * (a * s + 2 * b * t) / 4
        elif b:
            v[k], d[k] = (1 - s * s) * (1 + b * t) / 2, (-s * (1 + b * t), b * (1 - s * s) / 2)
        else:
            v[k], d[k] = (1 + a * s) * (1 - t * t) / 2, (a * (1 - t * t) / 2, -t * (1 + a * s))
    return v, d


number, x = {}, []
along = 5 * o.cells // 2
for j in range(2 * along + 1):
    for i in range(2 * o.cells + 1):
        if i % 2 == 0 or j % 2 == 0:
            number[i, j] = len(x)
            z = HALF * (0.35 * j / (2 * along) + 0.65 * (j / (2 * along))**3)
            x.append((i / (2 * o.cells) * RADIUS * (0.982 + 0.018 * z / HALF), z))
x = np.array(x)
cells = np.array([[number[2 * i + a, 2 * j + b] for a, b in CORNERS] for j in range(along) for i in range(o.cells)])
g = 1 / np.sqrt(3)
value, gradient = map(np.array, zip(*(shapes(s, t) for t in (-g, g) for s in (-g, g))))
jacobian = np.einsum("qkd,cki->cqid", gradient, x[cells])
radius = np.einsum("qk,ck->cq", value, x[cells][..., 0])
weight = np.linalg.det(jacobian) * radius * 2 * np.pi
slope = np.einsum("qkd,cqdi->cqki", gradient, np.linalg.inv(jacobian))
B = np.zeros(weight.shape + (5, 16))  # F of the displacements of a cell
B[..., 0, 0::2], B[..., 1, 0::2] = slope[..., 0], slope[..., 1]
B[..., 2, 1::2], B[..., 3, 1::2] = slope[..., 0], slope[..., 1]
B[..., 4, 0::2] = value[None] / radius[..., None]

dofs = np.stack([2 * cells, 2 * cells + 1], -1).reshape(len(cells), 16)
end, middle = abs(x[:, 1] - HALF) < 1e-9, int(np.argmax(x[:, 0] * (x[:, 1] < 1e-9)))
held = np.stack([x[:, 0] < 1e-9, (x[:, 1] < 1e-9) | end], -1)
free = np.flatnonzero(~held.ravel())
identity = np.array([1., 0, 0, 1, 1])
u, increment = np.zeros(2 * len(x)), np.zeros(2 * len(x))
old, alpha = np.broadcast_to(identity, weight.shape + (5,)), np.zeros(weight.shape)
history = np.broadcast_to(0 * UNIT if o.flow == "additive" else UNIT, weight.shape + (4,))
for step in range(1, o.steps + 1):
    begin = u
    u = u + increment
    if step <= 2:
        u[1::2] = PULLED * step / o.steps * x[:, 1] / HALF
    u[2 * np.flatnonzero(end) + 1] = PULLED * step / o.steps
    for iteration in range(30):
        F = identity + np.einsum("cqij,cj->cqi", B, u[dofs])
        P, new_history, new_alpha = stress(F, old, history, alpha)
        force = np.zeros(len(u))
        np.add.at(force, dofs, np.einsum("cq,cqij,cqi->cj", weight, B, P))
        if not np.isfinite(force).all() or np.abs(force[free]).max() < 1e-9:
            break
        C = np.empty(weight.shape + (5, 5))
        for k, d in enumerate(1e-6 * np.eye(5)):
            C[..., k] = (stress(F + d, old, history, alpha)[0] - stress(F - d, old, history, alpha)[0]) / 2e-6
        K = np.einsum("cq,cqia,cqij,cqjb->cab", weight, B, C, B, optimize=True)
        K = coo_matrix((K.ravel(), (np.repeat(dofs, 16, 1).ravel(), np.tile(dofs, (1, 16)).ravel())), shape=(len(u),) * 2).tocsc()
        u[free] -= splu(K[free][:, free]).solve(force[free])
    if not np.abs(force[free]).max() < 1e-9:
        raise SystemExit("no equilibrium at a half elongation of %g; more steps may find one" % (PULLED * step / o.steps))
    increment, old, history, alpha = u - begin, F, new_history, new_alpha
    if PULLED * step % o.steps == 0:
        print("%g  radius %.6f  force %.6f  alpha %.4f" % (PULLED * step / o.steps, u[2 * middle], force[2 * np.flatnonzero(end) + 1].sum(), alpha.max()), flush=True)
