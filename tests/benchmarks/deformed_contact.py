#!/usr/bin/env python3
"""A sketch in two dimensions of mortar contact on the deformed configuration, for degrees 1 to 4: what the tangent may leave out, and what a body that slides far feels of the meshes.

    pip install numpy scipy jax
    deformed_contact.py press [--degrees 1 2 3 4] [--depths 0.05 0.2 0.35] [--ratios 1] [--tangents full frozen force sym] [--form gap|normal] [--study]
    deformed_contact.py slide|ripple|edge [--degrees ...] [--form ...]

Plane strain, neo-Hookean, structured quadrilaterals of degree p; exact segments of pairs at the present positions; integrals on the slave's undeformed curve; dual multipliers, Bernstein polynomials on
faces that are covered in part; Newton's method with active sets, tangents by automatic differentiation, direct solves.

form normal: forces lambda_i n_i with averaged normals of the slave's nodes, gaps n_i . int psi_i (x_m - x_s) (Popp, Gee, Wall 2009). form gap: forces lambda_i dg_i/du of the gaps int psi_i alpha, alpha the distance
along the slave's interpolated normal (Hiermeier, Wall, Popp 2018), whose tangent is symmetric.
tangents: full; frozen: none of the derivatives of n, D and M; force: those of the forces at fixed multipliers beside frozen gaps; sym: the same, symmetrised.

press: an arc on a block in four steps; iterations of each, last contraction, largest pressure over E* = 1 / sum (1 - nu^2)/E, and with --study the least eigenvalue of the tangent relative to that of the bulk
on displacements that keep the active gaps, and iterations of conjugate gradients, preconditioned by the bulk's, to 1e-3. slide: periodic blocks of 7 on 11 faces slide by five periods. ripple: the arc slides
over its master's faces. edge: a flat block slides over the end of the lower one."""
import argparse
import math

import jax
import jax.numpy as jnp
import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh
from scipy.sparse import bmat, coo_matrix, csr_matrix
from scipy.sparse.linalg import splu

jax.config.update("jax_enable_x64", True)


def lobatto(p):
    """Nodes on [0, 1]."""
    inner = legendre.Legendre.basis(p).deriv().roots() if p > 1 else []
    return (np.concatenate([[-1.], np.sort(np.real(inner)), [1.]]) + 1) / 2


def gauss(n):
    x, w = legendre.leggauss(n)
    return (x + 1) / 2, w / 2


class Basis:
    """Lagrange polynomials as coefficients of monomials."""

    def __init__(self, p):
        self.p, self.nodes = p, lobatto(p)
        self.c = np.linalg.inv(np.vander(self.nodes, increasing=True))  # c[k, i]: of x^k in function i

    def values(self, x):
        return jnp.stack([x**k for k in range(self.p + 1)], -1) @ self.c

    def slopes(self, x):
        return jnp.stack([k * x**max(k - 1, 0) for k in range(self.p + 1)], -1) @ self.c


class Block:
    """Cells nx x ny; place(s, t) for s, t in [0, 1]."""

    def __init__(self, p, nx, ny, place, E, nu):
        self.b, self.nx, self.ny = Basis(p), nx, ny
        s = np.concatenate([(k + self.b.nodes[:-1]) / nx for k in range(nx)] + [[1.]])
        t = np.concatenate([(k + self.b.nodes[:-1]) / ny for k in range(ny)] + [[1.]])
        self.X = np.array([place(a, c) for c in t for a in s], float)
        w = nx * p + 1
        self.grid = np.arange(w * (ny * p + 1)).reshape(ny * p + 1, w)
        self.cells = np.array([self.grid[j * p:(j + 1) * p + 1, i * p:(i + 1) * p + 1].ravel() for j in range(ny) for i in range(nx)])
        q, wq = gauss(p + 2)
        v, d = np.array(self.b.values(q)), np.array(self.b.slopes(q))
        gx = np.einsum("bj,ai->baji", v, d).reshape(len(q)**2, -1)
        gy = np.einsum("bj,ai->baji", d, v).reshape(len(q)**2, -1)
        G = np.stack([gx, gy], -1)
        J = np.einsum("qkd,cki->cqid", G, self.X[self.cells])
        self.w = np.linalg.det(J) * np.einsum("b,a->ba", wq, wq).ravel()
        self.G = np.einsum("qkd,cqdi->cqki", G, np.linalg.inv(J))
        mu, lam = E / 2 / (1 + nu), E * nu / (1 + nu) / (1 - 2 * nu)
        self.star = E / (1 - nu**2)

        def energy(u, G, w):
            F = jnp.eye(2) + jnp.einsum("ka,qki->qai", u, G)
            C = jnp.einsum("qai,qai->q", F, F)
            lnJ = jnp.log(F[:, 0, 0] * F[:, 1, 1] - F[:, 0, 1] * F[:, 1, 0])
            return jnp.sum(w * (mu / 2 * (C - 2 - 2 * lnJ) + lam / 2 * lnJ**2))
        self.force = jax.jit(jax.vmap(jax.grad(energy)))
        self.stiff = jax.jit(jax.vmap(jax.hessian(energy)))

    def evaluate(self, u, tangent):
        """Internal forces (N x 2) and tangent of u (N x 2)."""
        ue = u[self.cells]
        f = np.zeros_like(u)
        np.add.at(f, self.cells, np.array(self.force(ue, self.G, self.w)))
        if not tangent:
            return f, None
        K = np.array(self.stiff(ue, self.G, self.w))
        n = self.cells.shape[1] * 2
        K = K.reshape(len(self.cells), n, n)
        d = (2 * self.cells[:, :, None] + np.arange(2)).reshape(len(self.cells), n)
        return f, csr_matrix(coo_matrix((K.ravel(), (np.repeat(d, n, 1).ravel(), np.tile(d, (1, n)).ravel())), shape=(2 * len(u),) * 2))


class Interface:
    """Between the ordered curves of a slave (outward normal (t_y, -t_x)) and a master; period: of both, or None."""

    def __init__(self, slave, master, X_slave, period=None, slave_period=None):
        self.s, self.m, self.period, self.slave_period = slave, master, period, slave_period
        self.ns = (len(X_slave) - 1) // slave.p
        q, w = gauss(slave.p + 3)
        v, d = np.array(slave.values(q)), np.array(slave.slopes(q))
        faces = self.faces(self.ns, slave.p)
        self.sf, self.sfn = jnp.asarray(faces), faces
        self.dual, self.X = [], X_slave  # psi = phi . dual
        self.w = np.zeros(len(X_slave))
        for f in faces:
            J = np.linalg.norm(d @ X_slave[f], axis=1)
            mass = np.einsum("q,qi,qj->ij", w * J, v, v)
            self.dual.append(np.linalg.solve(mass, np.diag(mass.sum(1))))
            self.w[f] += mass.sum(1)
        self.dual = np.array(self.dual)
        k = np.arange(slave.p + 1)
        comb = np.array([math.comb(slave.p, i) for i in k])
        x = slave.nodes[:, None]
        self.bernstein = comb * x**k * (1 - x)**(slave.p - k)  # at the nodes

    @staticmethod
    def faces(n, p):
        return np.arange(n)[:, None] * p + np.arange(p + 1)

    def normals(self, xs):
        """Averaged unit normals at the slave's nodes."""
        t = jnp.einsum("ak,ekd->ead", self.s.slopes(self.s.nodes), xs[self.sf])
        N = jnp.stack([t[..., 1], -t[..., 0]], -1)
        N = N / jnp.linalg.norm(N, axis=-1, keepdims=True)
        total = jnp.zeros_like(xs).at[self.sf].add(N)
        if self.slave_period:
            both = total[0] + total[-1]
            total = total.at[0].set(both).at[-1].set(both)
        return total / jnp.linalg.norm(total, axis=-1, keepdims=True)

    def at(self, x, n, e, xi):
        """Point and normal on slave faces e at xi."""
        phi = self.s.values(xi)
        nodes = self.sf[e]
        normal = jnp.einsum("...k,...kd->...d", phi, n[nodes])
        normal = normal / jnp.linalg.norm(normal, axis=-1, keepdims=True)
        return jnp.einsum("...k,...kd->...d", phi, x[nodes]), normal

    def crossing(self, x, n, e, xi, y):
        """(y - x_s) x n."""
        p, normal = self.at(x, n, e, xi)
        r = y - p
        return r[..., 0] * normal[..., 1] - r[..., 1] * normal[..., 0]

    def newton_end(self, x, n, e, xi, y, steps):
        slope = jax.grad(lambda z, e, y: self.crossing(x, n, e, z, y))
        for _ in range(steps):
            c = self.crossing(x, n, e, xi, y)
            d = jax.vmap(slope)(xi, e, y)
            xi = xi - c / d
        return xi

    def newton_partner(self, xm, mf, eta, p, normal, shift, steps):
        nodes = mf
        for _ in range(steps):
            y = jnp.einsum("...k,...kd->...d", self.m.values(eta), xm[nodes]) + shift
            t = jnp.einsum("...k,...kd->...d", self.m.slopes(eta), xm[nodes])
            r = y - p
            eta = eta - (r[..., 0] * normal[..., 1] - r[..., 1] * normal[..., 0]) / (t[..., 0] * normal[..., 1] - t[..., 1] * normal[..., 0])
        return eta

    def pair(self, xs, xm):
        """The segments of the present positions: slave face, master face, shift of a period, ends with the master's vertices that make them (-1: the face's own)."""
        xs, xm = np.array(xs), np.array(xm)
        n = np.array(self.normals(xs))
        nm = (len(xm) - 1) // self.m.p
        mf = self.faces(nm, self.m.p)
        vertices = xm[::self.m.p]
        copies = [0.] if not self.period else np.arange(-8, 9) * self.period
        rows = []
        for e in range(self.ns):
            a, b = xs[e * self.s.p], xs[(e + 1) * self.s.p]
            cuts = []
            for shift in copies:
                for v, y in enumerate(vertices):
                    if self.period and v == nm:
                        continue
                    y = y + np.array([shift, 0.])
                    xi = float(np.dot(y - a, b - a) / np.dot(b - a, b - a))
                    if not -0.3 < xi < 1.3:
                        continue
                    for _ in range(40):
                        c = self.crossing_np(xs, n, e, xi, y)
                        h = 1e-7
                        d = (self.crossing_np(xs, n, e, xi + h, y) - self.crossing_np(xs, n, e, xi - h, y)) / (2 * h)
                        step = c / d
                        xi -= step
                        if abs(step) < 1e-14:
                            break
                    if 1e-10 < xi < 1 - 1e-10:
                        cuts.append((xi, v, shift))
            cuts.sort()
            marks = [(0., -1, 0.)] + cuts + [(1., -1, 0.)]
            for left, right in zip(marks, marks[1:]):
                if right[0] - left[0] < 1e-12:
                    continue
                middle = (left[0] + right[0]) / 2
                phi = np.array(self.values_np(self.s, middle))
                p = phi @ xs[self.sfn[e]]
                normal = phi @ n[self.sfn[e]]
                found = None
                for shift in copies:
                    for f in range(nm):
                        va, vb = vertices[f] + [shift, 0], vertices[f + 1] + [shift, 0]
                        ca = (va - p)[0] * normal[1] - (va - p)[1] * normal[0]
                        cb = (vb - p)[0] * normal[1] - (vb - p)[1] * normal[0]
                        if ca * cb <= 0:
                            found = f, shift
                if found is None:
                    continue
                rows.append((e, found[0], found[1], left[0], left[1], left[2], right[0], right[1], right[2]))
        R = list(zip(*rows))
        covered = np.zeros(self.ns)
        np.add.at(covered, np.array(R[0]), np.array(R[6]) - np.array(R[3]))
        return dict(e=np.array(R[0]), f=np.array(R[1]), shift=np.array(R[2], float), a=np.array(R[3]), av=np.array(R[4]), ash=np.array(R[5], float),
                    b=np.array(R[6]), bv=np.array(R[7]), bsh=np.array(R[8], float), mf=mf, partly=(covered < 1 - 1e-9))

    @staticmethod
    def values_np(basis, x):
        return np.array([x**k for k in range(basis.p + 1)]) @ basis.c

    def crossing_np(self, xs, n, e, xi, y):
        phi = self.values_np(self.s, xi)
        r = y - phi @ xs[self.sfn[e]]
        normal = phi @ n[self.sfn[e]]
        return r[0] * normal[1] - r[1] * normal[0]

    def integrals(self, S, xs, xm, lin_s=None, lin_m=None):
        """By slave node: int psi (x_m - x_s), int psi alpha; n_i. lin: positions in the first where they are not those of the geometry."""
        xs, xm = jnp.asarray(xs), jnp.asarray(xm)
        S = {k: jnp.asarray(v) for k, v in S.items()}
        lin_s = xs if lin_s is None else lin_s
        lin_m = xm if lin_m is None else lin_m
        n = self.normals(xs)
        zeta, wq = gauss(max(self.s.p, self.m.p) + 3)
        vert = xm[::self.m.p]

        def end(xi0, v, sh, e):
            y = vert[jnp.maximum(v, 0)] + jnp.stack([sh, 0 * sh], -1)
            moved = self.newton_end(xs, n, e, xi0, y, 2)
            return jnp.where(v >= 0, moved, xi0)
        a, b = end(S["a"], S["av"], S["ash"], S["e"]), end(S["b"], S["bv"], S["bsh"], S["e"])
        xi = a[:, None] + (b - a)[:, None] * zeta
        e = jnp.broadcast_to(S["e"][:, None], xi.shape)
        p, normal = self.at(xs, n, e, xi)
        nodes = S["mf"][S["f"]][:, None, :]
        shift = jnp.stack([S["shift"], 0 * S["shift"]], -1)[:, None, :]
        eta = self.newton_partner(xm, nodes, 0.5 + 0 * xi, p, normal, shift, 7)
        phi_m = self.m.values(eta)
        y = jnp.einsum("sqk,sqkd->sqd", phi_m, xm[nodes]) + shift
        alpha = jnp.einsum("sqd,sqd->sq", y - p, normal)
        psi = jnp.einsum("sqk,ski->sqi", self.s.values(xi), jnp.where(S["partly"][:, None, None], jnp.asarray(self.bernstein), jnp.asarray(self.dual))[S["e"]])
        J = jnp.linalg.norm(jnp.einsum("sqk,skd->sqd", self.s.slopes(xi), jnp.asarray(self.X)[self.sf][S["e"]]), axis=-1)
        weight = (b - a)[:, None] * wq * J
        jump = jnp.einsum("sqk,sqkd->sqd", phi_m, lin_m[nodes]) + shift - jnp.einsum("sqk,skd->sqd", self.s.values(xi), lin_s[self.sf][S["e"]])
        vector = jnp.zeros((len(self.X), 2)).at[self.sf[S["e"]]].add(jnp.einsum("sq,sqi,sqd->sid", weight, psi, jump))
        scalar = jnp.zeros(len(self.X)).at[self.sf[S["e"]]].add(jnp.einsum("sq,sqi,sq->si", weight, psi, alpha))
        return vector, scalar, n


class Scene:
    """Upper block (slave below) on a lower one."""

    def __init__(self, lower, upper, form, period=None, slave_period=None):
        self.lower, self.upper, self.form, self.period = lower, upper, form, slave_period
        self.N = 2 * (len(lower.X) + len(upper.X))
        self.master, self.slave = lower.grid[-1], upper.grid[0]
        self.offset = len(lower.X)
        self.I = Interface(upper.b, lower.b, upper.X[self.slave], period, slave_period)
        self.ns = len(self.slave) - (1 if slave_period else 0)
        self.w = self.merge(self.I.w)
        nodes = np.concatenate([self.slave + self.offset, self.master])
        self.dofs = (2 * nodes[:, None] + np.arange(2)).ravel()
        self.X = np.concatenate([lower.X, upper.X])
        n_seg = self.I.ns + len(self.master) + 8
        self.n_seg = n_seg

        def split(z):
            z = z.reshape(-1, 2)
            return z[:len(self.slave)], z[len(self.slave):]

        def gaps(z, S):
            vector, scalar, n = self.I.integrals(S, *split(z))
            g = jnp.einsum("id,id->i", vector, n) if form == "normal" else scalar
            if slave_period:
                if form == "normal":
                    total = vector.at[0].add(vector[-1])
                    g = jnp.einsum("id,id->i", total, n)
                return g.at[0].set(g[0] if form == "normal" else g[0] + g[-1])[:-1]
            return g

        def work(z, lin, lam, S):
            if slave_period:
                lam = jnp.concatenate([lam, lam[:1]])
            if form == "normal":
                vector, _, n = self.I.integrals(S, *split(z), *split(lin))
                return jnp.einsum("i,id,id->", lam, vector, n)
            return jnp.dot(lam, self.I.integrals(S, *split(lin))[1])
        def covered_weights(z, S):
            xs, xm = split(z)
            # positions of the master, all one, less those of the slave, all zero, without periods
            return self.I.integrals(S, xs, xm, 0 * xs, 1 + 0 * xm)[0][:, 1]
        self.covered_weights = jax.jit(covered_weights)
        force = jax.grad(work, 1)
        self.gaps = jax.jit(gaps)
        self.rows = jax.jit(jax.jacfwd(gaps))
        self.F = jax.jit(lambda z, lam, S: force(z, z, lam, S))
        self.dF = jax.jit(jax.jacfwd(lambda z, lam, S: force(z, z, lam, S)))
        self.columns = jax.jit(jax.jacfwd(lambda lam, z, S: force(z, z, lam, S)))

    def merge(self, v):
        v = np.array(v)
        if self.period:
            v[0] += v[-1]
            v = v[:-1]
        return v

    def slip(self, z, S, z_old, S_old):
        """(M - M_old) x_m / w at the present positions, old partners at their old places: tangential parts."""
        now = self.partners(z, S, z)
        before = self.partners(z_old, S_old, z)
        n = np.array(self.I.normals(z.reshape(-1, 2)[:len(self.slave)]))
        s = now - before
        if self.period:
            s[0] += s[-1]
            s, n = s[:-1], n[:-1]
        s = s / self.w[:, None]
        t = np.stack([-n[:, 1], n[:, 0]], -1)
        return (s * t).sum(1)

    def covered(self, z, S):
        """int psi over what is covered, by slave node."""
        if not S["partly"].any():
            return self.w
        return self.merge(self.covered_weights(z, S))

    def partners(self, z, S, at):
        """int psi x_m of the pairs at z, whose master's points are where `at` has them."""
        k = len(self.slave)
        split = lambda v: (v.reshape(-1, 2)[:k], v.reshape(-1, 2)[k:])
        zero = jnp.zeros((k, 2))
        return np.array(self.I.integrals(S, *split(z), zero, split(at)[1])[0])

    def pairs(self, z):
        xs, xm = z.reshape(-1, 2)[:len(self.slave)], z.reshape(-1, 2)[len(self.slave):]
        S = self.I.pair(xs, xm)
        n = len(S["e"])
        assert n <= self.n_seg, (n, self.n_seg)
        fill = dict(e=0, f=0, shift=0., a=0., av=-1, ash=0., b=0., bv=-1, bsh=0.)
        for k, v in fill.items():
            S[k] = np.concatenate([S[k], np.full(self.n_seg - n, v, S[k].dtype)])
        return S

    def internal(self, u, tangent=True):
        n = self.offset
        fl, Kl = self.lower.evaluate(u[:2 * n].reshape(-1, 2), tangent)
        fu, Ku = self.upper.evaluate(u[2 * n:].reshape(-1, 2), tangent)
        return np.concatenate([fl.ravel(), fu.ravel()]), (bmat([[Kl, None], [None, Ku]]).tocsr() if tangent else None)

    def solve(self, u, lam, T, given, tangent, study=None):
        """Newton's method with active sets from u, lam; T: see motions(); `given`: displacements of prescribed components, which the tangent lifts. Returns u, lam and sizes of residuals."""
        tolerance, most, c = 1e-10, 60, 20 * self.lower.star

        def spread(A):
            B = np.zeros((A.shape[0], self.N))
            np.add.at(B, (slice(None), self.dofs), A)
            return B
        history = []
        for _ in range(most):
            z = (self.X.ravel() + u)[self.dofs]
            S = self.pairs(z)
            w = self.covered(z, S)
            apart = w < o.least * self.w
            w = np.where(apart, self.w, w)
            g = np.array(self.gaps(z, S)) / w
            active = (lam - c * g > 0) & ~apart
            f, K = self.internal(u)
            R = f.copy()
            np.add.at(R, self.dofs, -np.array(self.F(z, lam, S)))
            jump = np.where(self.prescribed, given - u, 0.)
            closed, still_pressed = np.abs(g[active]).max(initial=0.), np.abs(lam[~active]).max(initial=0.) / max(np.abs(lam).max(), 1e-12)
            history.append(max(np.abs(T.T @ R).max() / max(np.abs(f).max(), 1e-12), closed, still_pressed, np.abs(jump).max()))
            if history[-1] < tolerance or not history[-1] < 1e8:
                break
            columns = spread(np.array(self.columns(lam, z, S)).T)
            rows = (spread(np.array(self.rows(z, S))) if tangent == "full" else columns) / w[:, None]
            A = K
            if tangent != "frozen":
                D = np.array(self.dF(z, lam, S))
                D = (D + D.T) / 2 if tangent == "sym" else D
                n = len(self.dofs)
                A = K - csr_matrix(coo_matrix((D.ravel(), (np.repeat(self.dofs, n), np.tile(self.dofs, n))), shape=(self.N,) * 2))
            on, off = np.flatnonzero(active), np.flatnonzero(~active)
            A_free, C, G = T.T @ A @ T, csr_matrix(columns @ T), csr_matrix(rows[on] @ T)
            n = A_free.shape[0]
            M = bmat([[A_free, -C[on].T], [G, None]]).tocsc() if len(on) else A_free.tocsc()
            forces = -(T.T @ R) - C[off].T @ lam[off] - T.T @ (A @ jump)
            x = splu(M).solve(np.concatenate([forces, -g[on] - rows[on] @ jump]))
            if study is not None:
                study(T.T @ K @ T, A_free, G)
            u, lam = u + T @ x[:n] + jump, lam.copy()
            lam[on] += x[n:]
            lam[off] = 0
        return u, lam, history


def arc(s, t):
    """A block of height 0.7 with a round lower side of radius 1.2."""
    x = 1.2 * (s - 0.5)
    return x, (1.2 - math.sqrt(1.44 - x**2)) * (1 - t) + 0.7 * t


def press(o):
    """An arc is pressed on a block in four steps: iterations of each, last contraction, pmax / E*."""
    def run(p, n, ratio, tangent, form, depth, steps=4):
        lower = Block(p, 2 * n, n, lambda s, t: (2.4 * (s - 0.5), t - 1), 1., 0.3)
        upper = Block(p, n + n // 2, n // 2, arc, ratio, 0.3)
        scene = Scene(lower, upper, form)
        top, bottom = upper.grid[-1] + scene.offset, lower.grid[0]
        T = motions(scene, [], np.concatenate([top, bottom]))
        u, lam = np.zeros(scene.N), np.zeros(scene.ns)
        given = np.zeros(scene.N)
        counts, last, seen = [], 0, []
        star = 1 / ((1 - 0.09) / 1. + (1 - 0.09) / ratio)
        for k in range(1, steps + 1):
            given[2 * top + 1] = -depth * k / steps
            study = (lambda *matrices: seen.append(spectrum(*matrices))) if o.study and k == steps else None
            try:
                u, lam, h = scene.solve(u, lam, T, given, tangent, study=study)
            except RuntimeError:  # a singular matrix, or a projection that finds nothing
                counts.append("-")
                break
            counts.append(len(h) - 1 if h[-1] < 1e-10 else "-")
            if h[-1] >= 1e-10:
                break
            if len(h) > 3 and h[-3] > 0:
                last = h[-2] / h[-3]
        return counts, last, np.abs(lam).max() / star, seen
    for p in o.degrees:
        for depth in o.depths:
            for ratio in o.ratios:
                for tangent in o.tangents:
                    counts, last, pm, seen = run(p, o.n if p < 3 else max(2, o.n // 2), ratio, tangent, o.form, depth)
                    print(f"p {p} depth {depth:g} ratio {ratio:g} {o.form} {tangent:7s} iterations {counts} contraction {last:.1e} pmax/E* {pm:.3f}", *(f"least {a:.3g} cg {b}" for a, b in seen[-1:]), flush=True)


def spectrum(K, A, G):
    """Least eigenvalue of the symmetric part of A relative to K where G vanishes, and conjugate gradients with K there to 1e-3."""
    G, K, A = G.toarray(), K.toarray(), A.toarray()
    A = (A + A.T) / 2
    q = np.linalg.qr(G.T, mode="complete")[0][:, G.shape[0]:]
    e = eigh(q.T @ A @ q, q.T @ K @ q, eigvals_only=True)
    # iterations by the spectrum: conjugate gradients on diag(e)
    r = np.ones(len(e)) / math.sqrt(len(e))
    d, square, it = r.copy(), 1., 0
    while square > 1e-6 and it < 200:
        a = square / (d @ (e * d))
        r = r - a * e * d
        new = r @ r
        d, square, it = r + new / square * d, new, it + 1
    return e.min(), it


def motions(scene, wrapped, prescribed):
    """Matrix from free components to all: blocks in `wrapped` have their right edge where their left one is, nodes in `prescribed` are held."""
    scene.prescribed = np.zeros(scene.N, bool)
    for node in prescribed:
        scene.prescribed[2 * node:2 * node + 2] = True
    source = np.arange(scene.N)
    for block, offset in wrapped:
        for left, right in zip(block.grid[:, 0] + offset, block.grid[:, -1] + offset):
            source[2 * right:2 * right + 2] = [2 * left, 2 * left + 1]
    number = np.full(scene.N, -1)
    free = np.flatnonzero((source == np.arange(scene.N)) & ~scene.prescribed)
    number[free] = np.arange(len(free))
    rows = np.flatnonzero(number[source] >= 0)
    return csr_matrix((np.ones(len(rows)), (rows, number[source[rows]])), shape=(scene.N, len(free)))


def slide(o):
    """Periodic blocks of 11 below 7 faces, pressed by 10 % of their heights and slid by five periods: pressure, slip."""
    for p in o.degrees:
        lower = Block(p, 11, 2, lambda s, t: (s, 0.5 * (t - 1)), 1., 0.3)
        upper = Block(p, 7, 2, lambda s, t: (s, 0.5 * t), 3., 0.2)
        scene = Scene(lower, upper, o.form, 1., 1.)
        top, bottom = upper.grid[-1] + scene.offset, lower.grid[0]
        T = motions(scene, [(lower, 0), (upper, scene.offset)], np.concatenate([top, bottom]))
        u, lam = np.zeros(scene.N), np.zeros(scene.ns)
        worst, slips, counts, old = 0, 0, [], None
        steps = 60
        for k in range(steps + 1):
            given = np.zeros(scene.N)
            given[2 * top] = 5.03 * k / steps
            given[2 * top + 1] = -0.1
            if k:
                u[2 * (upper.grid.ravel() + scene.offset)] += 5.03 / steps
            u, lam, h = scene.solve(u, lam, T, given, o.tangents[0])
            counts.append(len(h) - 1 if h[-1] < 1e-10 else "-")
            z = (scene.X.ravel() + u)[scene.dofs]
            S = scene.pairs(z)
            worst = max(worst, np.ptp(lam) / lam.mean())
            if old is not None:
                slips = max(slips, np.abs(scene.slip(z, S, *old) - 5.03 / steps).max())
            old = z, S
        print(f"p {p} {o.form} {o.tangents[0]}: pressure differs by {worst:.1e} of its mean {lam.mean():.6f}, slip by {slips:.1e}; iterations {max(map(str, counts))} at most", flush=True)


def ripple(o):
    """An arc that is pressed on a long block and slid over 20 of its faces: force over its mean."""
    for p in o.degrees:
        for depth in o.depths:
            n = o.n
            lower = Block(p, 10 * n // 2, n, lambda s, t: (4 * (s - 0.5), t - 1), 1., 0.3)
            upper = Block(p, 7 * n // 8, n // 2, arc, 1., 0.3)
            scene = Scene(lower, upper, o.form, 4.)
            top, bottom = upper.grid[-1] + scene.offset, lower.grid[0]
            T = motions(scene, [(lower, 0)], np.concatenate([top, bottom]))
            u, lam = np.zeros(scene.N), np.zeros(scene.ns)
            face = 4 / (10 * n // 2)
            forces, counts, active = [], [], set()
            for k in range(-3, 41):
                given = np.zeros(scene.N)
                given[2 * top + 1] = -depth * min(1, (k + 4) / 4)
                move = face * 0.1234 if k > 0 else 0.
                given[2 * top] = max(k, 0) * face * 0.1234
                if k > 0:
                    u[2 * (upper.grid.ravel() + scene.offset)] += move
                u, lam, h = scene.solve(u, lam, T, given, o.tangents[0])
                counts.append(len(h) - 1 if h[-1] < 1e-10 else "-")
                if k >= 0:
                    f, _ = scene.internal(u, False)
                    forces.append((f[2 * top].sum(), f[2 * top + 1].sum()))
                    active.add(int((lam > 0).sum()))
            F = np.array(forces)
            print(f"p {p} n {n} depth {depth:g} {o.form} {o.tangents[0]}: normal force {-F[:, 1].mean():.6f}, ripple {np.ptp(F[:, 1]) / abs(F[:, 1].mean()):.2e}, tangential {np.abs(F[:, 0]).max() / abs(F[:, 1].mean()):.2e}; active {sorted(active)}; "
                  f"iterations {counts}", flush=True)


def edge(o):
    """A flat block that slides over the end of the lower one by three of its faces: the force, and its largest second difference over its mean change."""
    for p in o.degrees:
        n = o.n
        lower = Block(p, 11 * n // 8, n // 2, lambda s, t: (2 * (s - 1), t - 1), 1., 0.3)
        upper = Block(p, n, n // 2, lambda s, t: (1.2 * (s - 1) - 0.013, 0.7 * t), 3., 0.3)
        scene = Scene(lower, upper, o.form)
        top, bottom = upper.grid[-1] + scene.offset, lower.grid[0]
        T = motions(scene, [], np.concatenate([top, bottom]))
        u, lam = np.zeros(scene.N), np.zeros(scene.ns)
        face, forces, counts = 1.2 / n, [], []
        for k in range(-1, 40):
            given = np.zeros(scene.N)
            given[2 * top + 1] = -0.04 * (k + 2) / 2 if k < 1 else -0.04
            given[2 * top] = max(k, 0) * face * 0.0731
            if k > 0:
                u[2 * (upper.grid.ravel() + scene.offset)] += face * 0.0731
            u, lam, h = scene.solve(u, lam, T, given, o.tangents[0])
            counts.append(len(h) - 1 if h[-1] < 1e-10 else "-")
            if h[-1] >= 1e-10:
                break
            if k >= 0:
                f, _ = scene.internal(u, False)
                forces.append(-f[2 * top + 1].sum())
        F = np.array(forces)
        second = np.abs(np.diff(F, 2)).max() / F.mean() if len(F) > 2 else np.nan
        print(f"p {p} n {n} {o.form} {o.tangents[0]}: force {F[0]:.6f} to {F[-1]:.6f}, largest second difference {second:.1e} of it; iterations {counts}", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("case", choices=("press", "slide", "ripple", "edge"))
    parser.add_argument("--degrees", type=int, nargs="+", default=[1, 2, 3, 4])
    parser.add_argument("--depths", type=float, nargs="+", default=[0.05, 0.2, 0.35])
    parser.add_argument("--ratios", type=float, nargs="+", default=[1.])
    parser.add_argument("--tangents", nargs="+", default=["full", "frozen", "force", "sym"])
    parser.add_argument("--form", choices=("gap", "normal"), default="gap")
    parser.add_argument("--n", type=int, default=8)
    parser.add_argument("--study", action="store_true")
    parser.add_argument("--least", type=float, default=1e-7, help="covered part of a multiplier below which it is zero")
    o = parser.parse_args()
    {"press": press, "slide": slide, "ripple": ripple, "edge": edge}[o.case](o)
