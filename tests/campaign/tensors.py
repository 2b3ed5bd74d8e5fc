"""Stresses of constant displacement gradients: the laws as doc and headers give them, by their strain energies."""
import math


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def transposed(a):
    return [[a[j][i] for j in range(3)] for i in range(3)]


def determinant(a):
    return (a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
            a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]))


def inverse(a):
    d = determinant(a)
    return [[(a[(j + 1) % 3][(i + 1) % 3] * a[(j + 2) % 3][(i + 2) % 3] - a[(j + 1) % 3][(i + 2) % 3] * a[(j + 2) % 3][(i + 1) % 3]) / d
             for j in range(3)] for i in range(3)]


def axes(angles):
    """The rotation about x, then y, then z, in degrees."""
    result = [[float(i == j) for j in range(3)] for i in range(3)]
    for d, angle in enumerate(angles):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        a, b = (d + 1) % 3, (d + 2) % 3
        turn = [[float(i == j) for j in range(3)] for i in range(3)]
        turn[a][a], turn[a][b], turn[b][a], turn[b][b] = c, -s, s, c
        result = product(turn, result)
    return result


def eigenvalues(a):
    """Of a symmetric matrix, by Jacobi's rotations."""
    a = [row[:] for row in a]
    for _ in range(60):
        p, q = max(((0, 1), (0, 2), (1, 2)), key=lambda k: abs(a[k[0]][k[1]]))
        if abs(a[p][q]) <= 1e-17 * (a[p][p] + a[q][q]):
            break
        angle = 0.5 * math.atan2(2. * a[p][q], a[q][q] - a[p][p])
        c, s = math.cos(angle), math.sin(angle)
        turn = [[float(i == j) for j in range(3)] for i in range(3)]
        turn[p][p], turn[p][q], turn[q][p], turn[q][q] = c, s, -s, c
        a = product(product(transposed(turn), a), turn)
    return [a[i][i] for i in range(3)]


def energy(law, H):
    """The strain energy of a law of finite strain."""
    name, lam, mu = law
    F = [[H[i][j] + (i == j) for j in range(3)] for i in range(3)]
    C, J = product(transposed(F), F), determinant(F)
    trace = sum(C[i][i] for i in range(3))
    kappa = lam + 2. / 3. * mu
    volume = kappa / 2. * ((J * J - 1.) / 2. - math.log(J))
    if name == "neo-Hookean":
        return mu / 2. * (trace - 3. - 2. * math.log(J)) + lam / 2. * math.log(J) ** 2
    if name == "St. Venant-Kirchhoff":
        E = [[(C[i][j] - (i == j)) / 2. for j in range(3)] for i in range(3)]
        return lam / 2. * sum(E[i][i] for i in range(3)) ** 2 + mu * sum(e * e for row in E for e in row)
    if name == "Mooney-Rivlin":
        second = (trace * trace - sum(C[i][j] * C[j][i] for i in range(3) for j in range(3))) / 2.
        return 0.3 * mu * (trace * J ** (-2. / 3.) - 3.) + 0.2 * mu * (second * J ** (-4. / 3.) - 3.) + volume
    stretches = [math.sqrt(e) for e in eigenvalues(C)]
    if name == "Ogden":
        return volume + sum(m / a * (sum((l * J ** (-1. / 3.)) ** a for l in stretches) - 3.) for m, a in ((0.8 * mu, 1.5), (-0.4 * mu, -2.)))
    logarithms = [math.log(l) for l in stretches]
    return lam / 2. * sum(logarithms) ** 2 + mu * sum(l * l for l in logarithms)


def nominal(law, H):
    """The first Piola-Kirchhoff stress: the derivative of the energy, of fourth order in the step."""
    h, P = 1e-3, [[0.] * 3 for _ in range(3)]
    scaled = (law[0], law[1] / law[2], 1.)
    for i in range(3):
        for j in range(3):
            def at(step):
                changed = [row[:] for row in H]
                changed[i][j] += step
                return energy(scaled, changed)
            P[i][j] = law[2] * (45. * (at(h) - at(-h)) - 9. * (at(2 * h) - at(-2 * h)) + at(3 * h) - at(-3 * h)) / (60. * h)
    return P


def orthotropic(law, strain):
    _, E, G, nu, own = law
    e = product(product(transposed(own), strain), own)
    # nu_xy, nu_yz, nu_zx; nu_ij / E_i = nu_ji / E_j
    S = [[1. / E[0], -nu[0] / E[0], -nu[2] / E[2]], [-nu[0] / E[0], 1. / E[1], -nu[1] / E[1]], [-nu[2] / E[2], -nu[1] / E[1], 1. / E[2]]]
    D = inverse(S)
    s = [[0.] * 3 for _ in range(3)]
    for i in range(3):
        s[i][i] = sum(D[i][j] * e[j][j] for j in range(3))
        j = (i + 1) % 3  # G_xy, G_yz, G_zx
        s[i][j] = s[j][i] = 2. * G[i] * e[i][j]
    return product(product(own, s), transposed(own))


def law_of(law, rotation):
    """Stress by displacement gradient in axes that are rotated against those of the scene."""
    def stress(H):
        if law[0] in ("linear elastic", "J2 plasticity", "orthotropic"):
            e = [[(H[i][j] + H[j][i]) / 2. for j in range(3)] for i in range(3)]
            if law[0] == "orthotropic":
                there = product(product(rotation, e), transposed(rotation))
                return product(product(transposed(rotation), orthotropic(law, there)), rotation)
            trace = e[0][0] + e[1][1] + e[2][2]
            return [[law[1] * trace * (i == j) + 2. * law[2] * e[i][j] for j in range(3)] for i in range(3)]
        return nominal(law, H)
    return stress


def cross_column(stress, plane, traction):
    """H with the given columns along the plane and the third one such that its traction is as given, by Newton's method."""
    H = [plane[d] + [0.] for d in range(3)]

    def residual():
        P = stress(H)
        return [P[d][2] - traction[d] for d in range(3)]
    slope, h = [[0.] * 3 for _ in range(3)], 1e-5
    for iteration in range(20):
        r = residual()
        for d in range(3 if iteration < 2 else 0):
            H[d][2] += h
            up = residual()
            H[d][2] -= 2. * h
            down = residual()
            H[d][2] += h
            for e in range(3):
                slope[e][d] = (up[e] - down[e]) / (2. * h)
        back = inverse(slope)
        step = [sum(back[d][e] * r[e] for e in range(3)) for d in range(3)]
        for d in range(3):
            H[d][2] -= step[d]
        if max(abs(s) for s in step) < 1e-13:
            break
    return H
