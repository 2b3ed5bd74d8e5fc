#!/usr/bin/env python3
"""Spence's rigid flat punch with friction on a half plane: stick zone c/a, friction of a half, dissipation. Needs numpy.

Plane strain, half-width 1, P = 1, both tractions constant on graded elements: int p(s)/(x - s) ds = pi b q where the punch presses, int q(s)/(x - s) ds = -pi b p where it
sticks, |x| < c, and |q| = mu p beside it, with b = (1 - 2 nu)/(2 - 2 nu) (integrated once; Johnson, Contact Mechanics, sections 2.8 and 3.7). c is where q is continuous. Lines
without coupling leave q out of the first equation: c/a is then that of K'(c)/K(c) = b/mu, which checks the rest. The answer of tests/field/rigid_punch_sticks_inside.prm
is the last line of mu = 0.5, nu = 0."""
import math

import numpy as np


def elliptic(k):
    """Complete elliptic integral of the first kind."""
    a, b = 1., math.sqrt(1 - k * k)
    for _ in range(40):
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / 2 / a


def logarithmic(d):
    """Antiderivative of log |d|."""
    return np.where(d == 0, 0, d * np.log(np.abs(np.where(d == 0, 1, d))) - d)


def solve(c, mu, nu, n, coupled):
    """q - mu p in the last element that sticks; friction of both halves; constant of the settlement; displacements, p, q, centres and widths of elements."""
    n_stick = n // 3
    s = np.linspace(0, 1, n - n_stick + 1)
    s = np.where(s < .5, .5 * (2 * s)**2.5, 1 - .5 * (2 - 2 * s)**4)
    x = np.concatenate([c * (1 - (1 - np.linspace(0, 1, n_stick + 1))**2.5), (c + (1 - c) * s)[1:]])
    a, b = x[:-1], x[1:]
    at, width = (a + b) / 2, b - a
    beta = (1 - 2 * nu) / (2 - 2 * nu)
    near, mirrored = [logarithmic(at[:, None] - u) - logarithmic(at[:, None] - v) for u, v in ((a, b), (-b, -a))]
    up_to = math.pi * beta * (np.tril(np.ones((n, n)), -1) + .5 * np.eye(n)) * width  # int_0^x
    matrix, right = np.zeros((2 * n + 1, 2 * n + 1)), np.zeros(2 * n + 1)
    matrix[:n, :n], matrix[:n, 2 * n] = -(near + mirrored), -1
    if coupled:
        matrix[:n, n:2 * n] = up_to
    matrix[2 * n, :n], right[2 * n] = 2 * width, 1
    by_p, by_q = -up_to, -(near - mirrored)
    for i in range(n):
        if i < n_stick:
            matrix[n + i, :n], matrix[n + i, n:2 * n] = by_p[i], by_q[i]
        else:
            matrix[n + i, n + i], matrix[n + i, i] = 1, -mu
    result = np.linalg.solve(matrix, right)
    p, q = result[:n], result[n:2 * n]
    settlement = result[2 * n] - (math.pi * beta * (q * width).sum() if coupled else 0)
    return q[n_stick - 1] - mu * p[n_stick - 1], 2 * (q * width).sum(), settlement, by_p @ p + by_q @ q, p, q, at, width


def stick_zone(mu, nu, n, coupled):
    trials = np.linspace(.05, .995, 40)
    jumps = [solve(c, mu, nu, 60, coupled)[0] for c in trials]
    k = next(i for i in range(len(trials) - 1) if jumps[i] * jumps[i + 1] < 0)
    low, high = trials[k], trials[k + 1]
    at_low, at_high = [solve(c, mu, nu, n, coupled)[0] for c in (low, high)]
    for _ in range(14):
        middle = (low + high) / 2
        jump = solve(middle, mu, nu, n, coupled)[0]
        if jump * at_low > 0:
            low, at_low = middle, jump
        else:
            high, at_high = middle, jump
    return low - at_low * (high - low) / (at_high - at_low)


print("| mu | nu | coupled | elements | c/a | K'/K | friction of a half over P/2 | constant of the settlement | dissipated |")
print("|---|---|---|---|---|---|---|---|---|")
for mu, nu, coupled in ((.5, 0., False), (.3, .3, False), (.3, .3, True), (.5, 0., True)):
    for n in (90, 180, 360):
        c = stick_zone(mu, nu, n, coupled)
        _, friction, settlement, u, p, _, at, width = solve(c, mu, nu, n, coupled)
        dissipated = 2 * (mu * p * np.abs(u) * width)[at > c].sum()
        print("| %g | %g | %s | %d | %.5f | %.5f | %.6f | %.6f | %.7f |" % (mu, nu, "yes" if coupled else "no", n, c, elliptic(math.sqrt(1 - c * c)) / elliptic(c), friction, settlement, dissipated))
