"""Coulomb friction with dual multipliers in two dimensions: which algebra.

Plane strain, small strain, tensor-product cells of degree p, two bodies. The problem of a load step is condensed on the
multipliers: u = K^+ (f - B^T lambda) + R alpha, jump B u. A linear solve is one solve with given sets. Usage:
    friction_sketch.py [algebra] [krylovs] [budgets] [guesses] [onsets]
"""
import sys
import numpy as np
import scipy.linalg as la
import scipy.sparse as sp
import scipy.sparse.linalg as sla
from numpy.polynomial import legendre as leg


def lobatto(p):
    c = np.zeros(p + 1); c[p] = 1
    return np.r_[-1, np.sort(leg.legroots(leg.legder(c)).real), 1]


def lagrange(nodes, x):
    """Values and derivatives, [node, point]."""
    n = len(nodes)
    coef = np.linalg.inv(np.vander(nodes, n, increasing=True))
    pw = np.array([x ** k for k in range(n)])
    dp = np.array([k * x ** (k - 1) if k else 0 * x for k in range(n)])
    return coef.T @ pw, coef.T @ dp


class Body:
    """Grid xs by ys of cells (parameters), map 'flat' or 'polar' (first parameter an angle, periodic; second a radius)."""

    def __init__(self, nx, ny, p, x, y, E, nu, polar=False):
        self.p, self.nx, self.polar = p, nx, polar
        self.xs, ys = np.linspace(*x, nx + 1), np.linspace(*y, ny + 1)
        gl, nX, nY = lobatto(p), nx * p + (not polar), ny * p + 1
        line = lambda a: np.r_[(a[:-1, None] + np.diff(a)[:, None] * (gl[:-1] + 1) / 2).ravel(), a[-1]]
        X, Y = line(self.xs)[:nX], line(ys)
        self.nX, self.n = nX, nX * nY
        self.par = np.array([np.tile(X, nY), np.repeat(Y, nX)]).T
        self.xy = self.point(self.par)
        q, qw = leg.leggauss(p + 2 if polar else p + 1)
        N, dN = lagrange(gl, q)
        I, J, self.cells = [], [], []
        for j in range(ny):
            for i in range(nx):
                a, b = (i * p + np.arange(p + 1)) % nX, j * p + np.arange(p + 1)
                self.cells.append((b[:, None] * nX + a[None, :]).ravel())
        self.Ke = []
        lam, G = E * nu / (1 + nu) / (1 - 2 * nu), E / 2 / (1 + nu)
        D = np.array([[lam + 2 * G, lam, 0], [lam, lam + 2 * G, 0], [0, 0, G]])
        d0 = np.einsum('bs,ar->basr', N, dN).reshape((p + 1) ** 2, -1)
        d1 = np.einsum('bs,ar->basr', dN, N).reshape((p + 1) ** 2, -1)
        ww = np.outer(qw, qw).ravel()
        for j in range(ny):
            hx, hy = self.xs[1] - self.xs[0], ys[1] - ys[0]
            for i in range(nx if polar else 1):
                th = np.tile(self.xs[i] + hx * (q + 1) / 2, len(q))
                r = np.repeat(ys[j] + hy * (q + 1) / 2, len(q))
                g0, g1 = d0 * 2 / hx, d1 * 2 / hy
                if polar:
                    gx = g1 * np.cos(th) - g0 * np.sin(th) / r
                    gy = g1 * np.sin(th) + g0 * np.cos(th) / r
                    w = ww * r * hx * hy / 4
                else:
                    gx, gy, w = g0, g1, ww * hx * hy / 4
                Bm = np.zeros((3, 2 * len(gx), len(w)))
                Bm[0, ::2], Bm[1, 1::2], Bm[2, ::2], Bm[2, 1::2] = gx, gy, gy, gx
                ke = np.einsum('kaq,kl,lbq,q->ab', Bm, D, Bm, w, optimize=True)
                self.Ke += [ke] * (1 if polar else nx)

    def point(self, par):
        if self.polar:
            return np.array([par[:, 1] * np.cos(par[:, 0]), par[:, 1] * np.sin(par[:, 0])]).T
        return par

    def stiffness(self, factor=None):
        I, J, V = [], [], []
        for c, (nodes, ke) in enumerate(zip(self.cells, self.Ke)):
            d = (2 * nodes[:, None] + np.arange(2)).ravel()
            I.append(np.repeat(d, len(d))); J.append(np.tile(d, len(d)))
            V.append(ke.ravel() * (1 if factor is None else factor[c]))
        return sp.csr_matrix((np.concatenate(V), (np.concatenate(I), np.concatenate(J))), (2 * self.n, 2 * self.n))

    def edge(self, top):
        return np.arange(self.nX) + (self.n - self.nX if top else 0)

    def edge_load(self, top, t):
        """Load of a traction t(par) -> [2, points] on an edge of constant second parameter."""
        gl, (q, w) = lobatto(self.p), leg.leggauss(self.p + 3)
        N, f, e = lagrange(gl, q)[0], np.zeros(2 * self.n), self.edge(top)
        rad = self.par[e[0], 1] if self.polar else 1
        for i in range(self.nx):
            h = self.xs[i + 1] - self.xs[i]
            tq = t(self.xs[i] + h * (q + 1) / 2)
            nd = e[(i * self.p + np.arange(self.p + 1)) % self.nX]
            for c in range(2):
                np.add.at(f, 2 * nd + c, N @ (tq[c] * w) * h / 2 * rad)
        return f


def mortar(s, m, s_top, m_top, radius=1.):
    """Dual D (weights) and M[slave node, master node] on exact segments."""
    gs, gm = lobatto(s.p), lobatto(m.p)
    q, qw = leg.leggauss(s.p + m.p + 1)
    N, _ = lagrange(gs, q)
    A = np.diag(N @ qw) @ np.linalg.inv((N * qw) @ N.T)
    w, M = np.zeros(s.nX), np.zeros((s.nX, m.nX))
    for i in range(s.nx):
        a, b = s.xs[i], s.xs[i + 1]
        si = (i * s.p + np.arange(s.p + 1)) % s.nX
        w[si] += N @ qw * (b - a) / 2 * radius
        cuts = np.unique(np.r_[a, b, m.xs[(m.xs > a + 1e-12) & (m.xs < b - 1e-12)]])
        for l, r in zip(cuts[:-1], cuts[1:]):
            x = l + (r - l) * (q + 1) / 2
            k = np.searchsorted(m.xs, (l + r) / 2) - 1
            psi = A @ lagrange(gs, 2 * (x - a) / (b - a) - 1)[0]
            ph = lagrange(gm, 2 * (x - m.xs[k]) / (m.xs[k + 1] - m.xs[k]) - 1)[0]
            mi = (k * m.p + np.arange(m.p + 1)) % m.nX
            M[np.ix_(si, mi)] += (psi * qw) @ ph.T * (r - l) / 2 * radius
    return w, M


class Scene:
    """Condensed problem. rows 0..m-1: normal, m..2m-1: tangential. loads: list of (phase, parameter)."""

    def __init__(self, name, slave, master, s_top, m_top, fixed, merged=(), rigid=None, radius=1., g0=0., springs=None):
        self.name, self.slave, self.master = name, slave, master
        w, M = mortar(slave, master, s_top, m_top, radius)
        self.w, m, off = w, len(w), 2 * slave.n
        self.m, ndof = m, off + 2 * master.n
        es, em = slave.edge(s_top), master.edge(m_top)
        if slave.polar:
            th = slave.par[es, 0]
            n = np.array([np.cos(th), np.sin(th)]).T * (1 if s_top else -1)
        else:
            n = np.tile([0., 1. if s_top else -1.], (m, 1))
        t = np.array([-n[:, 1], n[:, 0]]).T
        B = sp.lil_matrix((2 * m, ndof))
        for k, d in enumerate((n, t)):
            for i in range(m):
                for c in range(2):
                    B[k * m + i, 2 * es[i] + c] += w[i] * d[i, c]
                    for j in np.nonzero(np.abs(M[i]) > 1e-15)[0]:
                        B[k * m + i, off + 2 * em[j] + c] -= M[i, j] * d[i, c]
        Tm = sp.identity(ndof, format='lil')
        for first, group in merged:
            for d in group:
                if d != first:
                    Tm[d, d] = 0; Tm[d, first] = 1
        self.off, self.ndof = off, ndof
        keep = self.kept = np.unique(Tm.tocoo().col)
        self.T = Tm.tocsr()[:, keep]
        self.pos = -np.ones(ndof, int); self.pos[keep] = np.arange(len(keep))
        self.full = lambda fs=None, fm=None: self.T.T @ sp.block_diag((slave.stiffness(fs), master.stiffness(fm))).tocsr() @ self.T
        self.K, self.B = self.full(), (B.tocsr() @ self.T).tocsr()
        self.fixed = self.pos[np.array(fixed)]
        self.free = np.setdiff1d(np.arange(len(keep)), self.fixed)
        nd = len(keep)
        self.R = np.zeros((nd, 0)) if rigid is None else np.linalg.qr(rigid(self)[keep])[0]
        hold = np.zeros(0, int)
        if self.R.shape[1]:  # statically determinate hold
            _, _, pv = la.qr(self.R.T, pivoting=True)
            hold = pv[:self.R.shape[1]]
        self.inner = np.setdiff1d(self.free, hold)
        self.lu = sla.splu(self.K[self.inner][:, self.inner].tocsc())
        X = self.lu.solve(self.B[:, self.inner].T.toarray())
        self.S = self.B[:, self.inner] @ X
        self.S = (self.S + self.S.T) / 2
        self.BR = self.B @ self.R
        dg = self.K.diagonal(); dg = np.where(np.isin(np.arange(nd), self.free), 1 / dg, 0)
        Cd = (self.B.multiply(self.B) @ dg)
        self.c = np.r_[w, w] / Cd
        self.g0 = np.broadcast_to(g0, m).copy()
        self.spring = springs

    def load(self, f, uD=None):
        """Free jump and resultant of a load (full vector over kept dofs) and prescribed values on the fixed dofs."""
        u = np.zeros(len(f))
        if uD is not None:
            u[self.fixed] = uD
        self.rhs, self.BD = (f - self.K @ u)[self.inner], self.B @ u
        u[self.inner] = self.lu.solve(self.rhs)
        return self.B @ u, self.R.T @ f

    def solve(self, st, tau, jold, load, mu, F=None):
        """One linear solve. st: 0 open, 1 stick, 2 slip. F given: Tresca; else full Coulomb."""
        m, (bf, r) = self.m, load
        cl, sk, sl = st > 0, np.nonzero(st == 1)[0], np.nonzero(st == 2)[0]
        rows = np.r_[np.nonzero(cl)[0], m + sk]
        E = np.zeros((2 * m, len(rows))); E[rows, np.arange(len(rows))] = 1
        e0 = np.zeros(2 * m)
        if F is None:
            col = np.searchsorted(np.nonzero(cl)[0], sl)
            E[m + sl, col] = (mu * tau)[sl]
        else:
            e0[m + sl] = (tau * F)[sl]
        target = np.r_[self.w * self.g0, jold][rows]
        k = self.BR.shape[1]
        A = np.block([[self.S[rows] @ E, -self.BR[rows]], [self.BR.T @ E, np.zeros((k, k))]])
        rhs = np.r_[bf[rows] - self.S[rows] @ e0 - target, r - self.BR.T @ e0]
        sc = np.r_[1 / np.sqrt(self.S.diagonal()[rows]), np.ones(k) / max(1e-300, np.abs(self.BR).max() / np.sqrt(self.S.diagonal().max()) if k else 1)]
        lu = la.lu_factor(A * sc[:, None] * sc[None, :])
        if len(A) == 0 or np.abs(np.diag(lu[0])).min() < 1e-11 * np.abs(np.diag(lu[0])).max():
            raise np.linalg.LinAlgError('no hold')
        y = sc * la.lu_solve(lu, sc * rhs)
        lam = E @ y[:len(rows)] + e0
        return lam, bf - self.S @ lam + self.BR @ y[len(rows):]

    def held(self, st):
        """Whether closed and sticking rows hold the rigid motions (to 1e-3: rotations in contact of curved faces)."""
        if not self.BR.shape[1]:
            return True
        A = self.BR[np.r_[np.nonzero(st > 0)[0], self.m + np.nonzero(st == 1)[0]]]
        s = la.svdvals(A) if len(A) >= A.shape[1] else [1, 0]
        return s[-1] > 1e-3 * s[0]

    def sets(self, lam, j, jold, mu, old=None, rule='ncp', cs=1.):
        m, c = self.m, self.c * cs
        pn = lam[:m] - c[:m] * (self.g0 - j[:m] / self.w)
        t = lam[m:] + c[m:] * (j[m:] - jold) / self.w
        big = np.abs(lam[:m]).max()
        cl, bound = pn > 1e-12 * big, mu * np.maximum(pn, 0)
        slip = np.abs(t) > bound * (1 + 1e-9) + 1e-12 * big
        st, tau = np.where(cl, np.where(slip, 2, 1), 0), np.sign(t)
        if old is not None:
            so, to = old
            s = (j[m:] - jold)
            # a slipping node stays slipping unless its slip is against its direction (equality belongs to slip)
            keep = (so == 2) & cl & (s * to >= -1e-12 * np.abs(s).max())
            st[keep], tau[keep] = 2, to[keep]
            if rule == 'once':
                st[(so == 2) & cl & ~keep] = 1
        tau[st != 2] = 0
        return st, tau


def run_step(sc, load, mu, jold, guess, alg, rule='ncp', maxit=60, cs=1.):
    """guess: (st, tau, lam, j). Returns dict with solves, contraction, cycle."""
    st, tau, lam, _ = guess
    m = sc.m
    F, seen, corr, hist = mu * np.maximum(lam[:m], 0), {}, [], []
    out = dict(n=0, cyc=0, hold=0, slides=0, rho=np.nan, ratio2=np.nan)
    while out['n'] < maxit:
        try:
            lam, j = sc.solve(st, tau, jold, load, mu, None if alg == 'newton' else F)
        except (np.linalg.LinAlgError, ValueError):
            out['hold'] = 1
            break
        out['n'] += 1
        st2, tau2 = sc.sets(lam, j, jold, mu, (st, tau), rule, cs)
        if not sc.held(st2):
            # all that holds a motion would slip: of those that stick the one least beyond its bound stays; where the sets rest
            # with that one beyond its bound, the body slides
            t = np.abs(lam[m:] + sc.c[m:] * (j[m:] - jold) / sc.w) / np.maximum(mu * lam[:m], 1e-300)
            can = (st2 == 2) & (lam[:m] > 0)
            can = can & (st == 1) if (can & (st == 1)).any() else can
            if not can.any():
                out['hold'] = 1
                break
            i = np.argmin(np.where(can, t, np.inf))
            st2[i], tau2[i], out['slides'] = 1, 0, 1
            if np.array_equal(st, st2) and np.array_equal(tau, tau2):
                out['hold'] = 1
                break
        same = np.array_equal(st, st2) and np.array_equal(tau, tau2)
        Fn = mu * np.maximum(lam[:m], 0)
        if alg == 'newton':
            if same:
                break
            key = (st2.tobytes(), tau2.tobytes())
            if key in seen:
                out['cyc'], out['hold'] = out['n'] - seen[key], out['slides'] * (rule == 'once')
                break
            seen[key] = out['n']
        else:
            sl = st2 == 2
            corr.append(np.abs((Fn - F)[sl]).max() / max(lam[:m].max(), 1e-300) if sl.any() else 0.)
            if same and corr[-1] < 1e-10 * max(mu, 1e-3):
                break
            Fnew = Fn
            if alg == 'anderson':
                if not same:
                    hist = []
                hist = (hist + [(F[sl].copy(), (Fn - F)[sl].copy())])[-6:] if same or not hist else hist
                if same and len(hist) > 1:
                    dX = np.array([hist[k + 1][0] - hist[k][0] for k in range(len(hist) - 1)]).T
                    dG = np.array([hist[k + 1][1] - hist[k][1] for k in range(len(hist) - 1)]).T
                    gam = np.linalg.lstsq(dG, hist[-1][1], rcond=1e-12)[0]
                    Fnew = Fn.copy()
                    Fnew[sl] = np.maximum(0, F[sl] + hist[-1][1] - (dX + dG) @ gam)
                elif not same:
                    hist = []
            F = Fnew
        st, tau = st2, tau2
    else:
        out['fail'] = 1
    if len(corr) > 2:
        out['rho'] = corr[-1] / corr[-2] if corr[-2] > 0 else 0
    if len(corr) > 1:
        out['ratio2'] = corr[1] / corr[0] if corr[0] > 0 else 0
    ok = not (out['cyc'] or out['hold'] or out.get('fail'))
    out.update(ok=ok, st=st, tau=tau, lam=lam, j=j if out['n'] else guess[3])
    return out


def contraction(sc, st, tau, mu):
    """Spectral radius of F -> mu lambda_n(F) at fixed sets (the fixed point's rate, and the unsymmetry's size)."""
    sl = np.nonzero(st == 2)[0]
    if not len(sl) or not sc.held(st):
        return 0.
    m, z = sc.m, (np.zeros(2 * sc.m), np.zeros(sc.BR.shape[1]))
    P = np.zeros((len(sl), len(sl))); g = sc.g0; sc.g0 = 0 * g
    try:
        for k, i in enumerate(sl):
            F = np.zeros(m); F[i] = 1
            P[:, k] = mu * sc.solve(st, tau, np.zeros(m), z, mu, F)[0][sl]
    except np.linalg.LinAlgError:
        return np.nan
    finally:
        sc.g0 = g
    return np.abs(np.linalg.eigvals(P)).max()


def run(sc, path, mu, alg, first='last', rule='ncp', cs=1., robust=True):
    """path: list of (phase, parameter, load). A failed step is redone with Newton and stick first so that the run goes on."""
    m = sc.m
    st, tau = np.ones(m, int), np.zeros(m)
    x, prev, jold, res, lold = None, None, np.zeros(m), [], None
    for ph, l, load in path:
        big = x['lam'] if x else np.ones(2 * m)
        g = (st, tau, big, x['j'] if x else None)
        if x and first == 'stick':
            g = (np.where(st > 0, 1, 0), 0 * tau, big, x['j'])
        if x and first == 'extra' and prev and lold[0] == ph and prev[2] == ph:
            a = (l - lold[1]) / (lold[1] - prev[3])
            lam, j = x['lam'] + a * (x['lam'] - prev[0]), x['j'] + a * (x['j'] - prev[1])
            s2 = sc.sets(lam, j, jold, mu, None, 'ncp', cs)
            g = (s2[0], s2[1], lam, j)
        o = run_step(sc, load, mu, jold, g, alg, rule, cs=cs)
        o['good'] = o['ok']
        if not o['ok'] and not o['hold']:
            for r in ('once', 'ncp'):
                for g2 in ((np.where(st > 0, 1, 0), 0 * tau, big, None), (np.ones(m, int), 0 * tau, big, None)):
                    if not o['ok']:
                        o2 = run_step(sc, load, mu, jold, g2, 'newton', r, 200)
                        if o2['ok']:
                            o.update({k: o2[k] for k in ('st', 'tau', 'lam', 'j', 'ok')})
        o['phase'], o['l'] = ph, l
        res.append(o)
        if not o['ok']:
            break
        o['open'], o['stick'], o['slip'] = [(o['st'] == k).sum() for k in range(3)]
        if x:
            prev = (x['lam'], x['j'], lold[0], lold[1])
        x, lold, st, tau = o, (ph, l), o['st'], o['tau']
        jold = np.where(st > 0, o['j'][m:], o['j'][m:])
    return res


def rings(p, lev, load):
    """Inner ring 1..2 (E 1000, nu .3) held inside, outer 2..3 (E 500, nu .25), interference .01; slave: the inner ring."""
    nt = 12 * 2 ** lev
    s = Body(2 * nt // p, max(2, 2 * 2 ** lev // p), p, (0, 2 * np.pi), (1., 2.), 1000., .3, True)
    m = Body(3 * nt // p, max(2, 3 * 2 ** lev // p), p, (0.001, 2 * np.pi + .001), (2., 3.), 500., .25, True)
    off = 2 * s.n
    fixed = (2 * s.edge(False)[:, None] + np.arange(2)).ravel()

    def rigid(sc):
        R = np.zeros((sc.ndof, 3))
        R[off::2, 0], R[off + 1::2, 1] = 1, 1
        R[off::2, 2], R[off + 1::2, 2] = -m.xy[:, 1], m.xy[:, 0]
        return R
    sc = Scene('rings', s, m, True, False, fixed, rigid=rigid, radius=2., g0=-.01)
    E0 = np.ones(sc.m)
    lam, _ = sc.solve(E0, 0 * E0, 0 * E0, sc.load(np.zeros(sc.K.shape[0])), 1.)
    T = 2 * np.pi * 4 * (lam[:sc.m] @ sc.w) / sc.w.sum()  # T* / mu
    tang = lambda th: np.array([-np.sin(th), np.cos(th)])
    pull = lambda th: np.array([np.cos(th), np.sin(th)])
    if load == 'torque':  # torque T* l / mu by uniform shear of the outer surface
        f = m.edge_load(True, lambda th: tang(th) * T / (2 * np.pi * 9))
    else:  # shear and half as much pull on a patch of the outer surface; l = 1: the torque T*
        f = m.edge_load(True, lambda th: (tang(th) + .5 * pull(th)) * T / 9 * np.maximum(0, np.cos(th)) ** 4 / (.375 * np.pi))
    f = np.r_[np.zeros(off), f]
    return sc, lambda l: sc.load(sc.T.T @ (l * f))


def blocks(p, lev, kind, E=(1., 1.), nu=(.3, .3)):
    """Upper block (slave) on a held lower one. 'hertz': parabolic gap, rigid top driven by forces; 'shear': flat, top driven."""
    k = 8 * 2 ** lev
    if kind == 'hertz':
        s = Body(2 * k // p, max(1, k // p), p, (-1, 1), (0, 1), E[0], nu[0])
        m = Body(3 * k // p, max(1, 3 * k // (2 * p)), p, (-1, 1), (-1, 0), E[1], nu[1])
    else:
        s = Body(2 * k // p, max(1, k // p), p, (-.5, .5), (0, .5), E[0], nu[0])
        m = Body(3 * k // p, max(1, 3 * k // (2 * p)), p, (-1.013, 1.013), (-1, 0), E[1], nu[1])
    off, te = 2 * s.n, s.edge(True)
    bottom = off + (2 * m.edge(False)[:, None] + np.arange(2)).ravel()
    if kind == 'hertz':
        merged = [(2 * te[0], 2 * te), (2 * te[0] + 1, 2 * te + 1)]

        def rigid(sc):
            R = np.zeros((sc.ndof, 2))
            R[:off:2, 0], R[1:off:2, 1] = 1, 1
            return R
        sc = Scene('hertz', s, m, False, True, bottom, merged, rigid, g0=s.par[s.edge(False), 0] ** 2 / 2)
        fx, fy = np.zeros(sc.ndof), np.zeros(sc.ndof)
        fx[2 * te[0]], fy[2 * te[0] + 1] = 1, -1
        Es = 1 / sum((1 - n * n) / e for n, e in zip(nu, E))
        P = np.pi * Es * .4 ** 2 / 4
        return sc, lambda N, Q: sc.load(sc.T.T @ (P * (N * fy + Q * fx)))
    fixed = np.r_[(2 * te[:, None] + np.arange(2)).ravel(), bottom]
    sc = Scene('shear', s, m, False, True, fixed)

    def load(dy, dx):
        u = np.zeros(sc.ndof); u[2 * te], u[2 * te + 1] = dx, -dy
        return sc.load(np.zeros(sc.K.shape[0]), (u[sc.kept])[sc.fixed])
    return sc, load


def paths(name, p, lev, mu):
    """Scene and its path of load steps."""
    if name in ('torque', 'patch'):
        sc, ld = rings(p, lev, name)
        ls = [0, .5, .9, .99, .999, 1.01] if name == 'torque' else [0, .2, .3, .4, .5, .6, .7, .8, .9]
        return sc, [('load', l, ld(l * mu)) for l in ls]
    if name.startswith('hertz'):
        sc, ld = blocks(p, lev, 'hertz', *(((1., 1.), (.3, .3)) if name == 'hertz' else ((1., 20.), (0., .3))))
        path = [('press', l, ld(l, 0)) for l in (.25, .5, .75, 1.)]
        path += [('shear', l, ld(1, l * mu)) for l in (.15, .3, .45, .6)]
        return sc, path + [('back', l, ld(1, (.6 - l) * mu)) for l in (.3, .6, .9, 1.2)]
    sc, ld = blocks(p, lev, 'shear', *(((1., 1.), (.3, .3)) if name == 'shear' else ((1., 20.), (0., .3))))
    d = .01
    return sc, [('press', 1, ld(d, 0))] + [('shear', l, ld(d, l * mu * d)) for l in (.5, 1, 1.5, 2, 3, 4, 6, 8)]


def gmres(apply, b, tols, maxit=200):
    """Iterations of GMRES without restart to each of tols (right preconditioning is in apply)."""
    Q, H, beta, its = [b / la.norm(b)], np.zeros((maxit + 1, maxit)), la.norm(b), {}
    for k in range(maxit):
        v = apply(Q[k])
        for _ in range(2):
            h = np.array([q @ v for q in Q]); v = v - np.array(Q).T @ h; H[:k + 1, k] += h
        H[k + 1, k] = la.norm(v)
        Q.append(v / max(H[k + 1, k], 1e-300))
        e = np.zeros(k + 2); e[0] = 1
        y = np.linalg.lstsq(H[:k + 2, :k + 1], e, rcond=None)[0]
        r = la.norm(e - H[:k + 2, :k + 1] @ y)
        for t in tols:
            if r < t and t not in its:
                its[t] = k + 1
        if len(its) == len(tols):
            break
    return [its.get(t, maxit) for t in tols]


def krylov(sc, st, tau, mu):
    """Iterations to 1e-3 and 1e-10 at given sets: exact K: Coulomb; perturbed K: Tresca; Coulomb; Coulomb with the unsymmetric C."""
    rng, m, f = np.random.default_rng(1), sc.m, sc.inner
    rows = np.r_[np.nonzero(st > 0)[0], m + np.nonzero(st == 1)[0]]
    W = sp.diags(1 / np.sqrt(sc.S.diagonal()))
    Bs = (W @ sc.B)[:, f].tocsr()
    B = Bs[rows]
    X = sp.lil_matrix((2 * m, 2 * m))
    for i in np.nonzero(st == 2)[0]:
        X[m + i, i] = mu * tau[i] * np.sqrt(sc.S[m + i, m + i] / sc.S[i, i])
    Bf = ((sp.identity(2 * m) + X).T @ Bs).tocsr()[rows]
    K, out = sc.K[f][:, f], []
    pert = lambda b: np.exp(np.log(1.5) * rng.uniform(-1, 1, len(b.cells)))
    Kp = sc.full(pert(sc.slave), pert(sc.master))[f][:, f]
    for A, left, cols in ((K, B, Bf), (Kp, B, B), (Kp, B, Bf), (Kp, Bf, Bf)):
        P = sla.splu(sp.bmat([[A, left.T], [B, None]]).tocsc())
        M = sp.bmat([[K, cols.T], [B, None]]).tocsr()
        b = np.r_[rng.standard_normal(len(f)), np.zeros(len(rows))]
        out.append(gmres(lambda x: M @ P.solve(x), b, (1e-3, 1e-10)))
    return out


def inexact(sc, path_loads, mu, alg, eta):
    """Total iterations of GMRES (perturbed K) of each step, warm started; eta: reduction of a solve before the sets rest."""
    rng, m, f = np.random.default_rng(1), sc.m, sc.inner
    pert = lambda b: np.exp(np.log(1.5) * rng.uniform(-1, 1, len(b.cells)))
    Kp, K = sc.full(pert(sc.slave), pert(sc.master))[f][:, f], sc.K[f][:, f]
    sg = np.sqrt(sc.S.diagonal())
    Bs = (sp.diags(1 / sg) @ sc.B)[:, f].tocsr()
    st, tau, u, lam, jold, out = np.ones(m, int), np.zeros(m), np.zeros(len(f)), np.zeros(2 * m), np.zeros(m), []
    for ld in path_loads:
        ld()
        total, solves, F, scale, rest = 0, 0, mu * np.maximum(lam[:m], 0), la.norm(sc.rhs) + la.norm(K @ u), False
        while total < 500:
            cl, sl = np.nonzero(st > 0)[0], np.nonzero(st == 2)[0]
            rows = np.r_[cl, m + np.nonzero(st == 1)[0]]
            E, lam0 = sp.lil_matrix((2 * m, len(rows))), np.zeros(2 * m)
            E[rows, np.arange(len(rows))] = 1
            if alg == 'newton':
                for i in sl:
                    E[m + i, np.searchsorted(cl, i)] = mu * tau[i] * sg[m + i] / sg[i]
            else:
                lam0[m + sl] = tau[sl] * F[sl]
            Bf, B = (E.tocsr().T @ Bs), Bs[rows]
            y = (lam * sg)[rows]
            target = ((np.r_[sc.w * sc.g0, jold] - sc.BD) / sg)[rows]
            r = np.r_[sc.rhs - K @ u - Bf.T @ y - Bs.T @ (lam0 * sg), target - B @ u]
            first = la.norm(r)
            tol = max(1e-10 * scale, (0 if rest and alg == 'newton' else eta) * first)
            if first > tol:
                P = sla.splu(sp.bmat([[Kp, B.T], [B, None]]).tocsc())
                M = sp.bmat([[K, Bf.T], [B, None]]).tocsr()
                its = []
                x = np.zeros(len(r))
                g, _ = sla.gmres(sla.LinearOperator(M.shape, lambda v: M @ P.solve(v)), r, rtol=tol / first, restart=200, callback=its.append, callback_type='pr_norm')
                x = P.solve(g)
                total, solves = total + len(its), solves + 1
                u, y = u + x[:len(f)], y + x[len(f):]
            lam = (E @ y) / sg + lam0
            j = sc.B[:, f] @ u + sc.BD
            s2 = sc.sets(lam, j, jold, mu, (st, tau), 'once')
            rest = np.array_equal(s2[0], st) and np.array_equal(s2[1], tau)
            Fn = mu * np.maximum(lam[:m], 0)
            done = rest and first * (tol / first if first > tol else 1) <= 1.01e-10 * scale and (alg == 'newton' or np.abs((Fn - F)[sl]).max(initial=0) < 1e-9 * mu * lam[:m].max())
            F, (st, tau) = Fn, s2
            if done:
                break
        out.append((total, solves))
        jold = j[m:]
    return out


MU = (.1, .3, .5, 1., 2.)
NAMES = ('torque', 'patch', 'hertz', 'hertzd', 'shear', 'sheard')
LONG = dict(torque='(a) rings, torque', patch='(d) rings, patch', hertz='(b) Cattaneo, equal', hertzd='(b) Cattaneo, 1 : 20', shear='(c) block, equal', sheard='(c) block, 1 : 20')


def count(r):
    """Largest and mean number of solves in a step, letters: c cycle, s slides (no hold), n over 60."""
    n = [o['n'] for o in r if not o['hold']]
    bad = ''.join('s' if o['hold'] else 'c' if o['cyc'] else 'n' for o in r if not o['good'])
    return '%d (%.1f)%s' % (max(n), np.mean(n), ' ' + bad if bad else '')


def algebra():
    print('| scene, mu | fixed point | Anderson | Newton | rho | last contraction | second/first | most slip of closed |\n|---|---|---|---|---|---|---|---|')
    for name in NAMES:
        for mu in MU:
            sc, path = paths(name, 2, 1, mu)
            r = [run(sc, path, mu, a, 'extra', 'once') for a in ('fixed', 'anderson', 'newton')]
            o = max((q for q in r[2] if q['ok']), key=lambda q: q['slip'])
            rho = max([contraction(sc, q['st'], q['tau'], mu) for q in r[2] if q['ok']])
            worst = lambda key: np.nanmax([q[key] for q in r[0] if not q['hold']] + [0])
            print('| %s, %g | %s | %s | %s | %.2f | %.2f | %.1f | %d of %d |' % (LONG[name], mu, *map(count, r), rho, worst('rho'), worst('ratio2'), o['slip'], sc.m - o['open']), flush=True)


def krylovs():
    print('| scene | p | slave nodes | ' + ' | '.join('mu %g: Newton; slip; rho; exact K; perturbed: Tresca, Coulomb, unsymmetric C' % mu for mu in (.3, 1., 2.)) + ' |\n|---|---|---|---|---|---|')
    for name in ('patch', 'hertzd', 'shear', 'sheard'):
        for p, lev in ((1, 1), (2, 0), (2, 1), (2, 2), (2, 3), (3, 1)):
            row = []
            for mu in (.3, 1., 2.):
                sc, path = paths(name, p, lev, mu)
                r = run(sc, path, mu, 'newton', 'extra', 'once')
                o = max((q for q in r if q['ok']), key=lambda q: q['slip'])
                k = krylov(sc, o['st'], o['tau'], mu)
                row.append('%s; %d/%d; %.2f; %s' % (count(r), o['slip'], sc.m - o['open'], contraction(sc, o['st'], o['tau'], mu), ', '.join('%d-%d' % tuple(x) for x in k)))
            print('| %s | %d | %d | %s |' % (LONG[name], p, sc.m, ' | '.join(row)), flush=True)


def guesses():
    cases = [(paths(n, p, 1, mu), mu) for n in NAMES for mu in MU for p in (1, 2, 3)]
    print('| way | first guess | turning node | scale of c | steps | solves a step, mean, largest | cycles | over 60 |\n|---|---|---|---|---|---|---|---|')
    for alg in ('newton', 'anderson'):
        for first, rule, cs in [(f, r, 1.) for r in ('ncp', 'once') for f in ('last', 'extra', 'stick')] + [('extra', 'once', .01), ('extra', 'once', 100.)]:
            q = [o for (sc, path), mu in cases for o in run(sc, path, mu, alg, first, rule, cs) if not o['hold'] and (alg == 'newton' or mu <= .5)]
            n = [o['n'] for o in q]
            print('| %s | %s | %s | %g | %d | %.2f, %d | %d | %d |' % (alg, first, rule, cs, len(n), np.mean(n), max(n), sum(o['cyc'] > 0 for o in q), sum(o.get('fail', 0) for o in q)), flush=True)


WAYS = [('newton', 1e-1), ('newton', 1e-3), ('newton', 1e-10), ('fixed', 1e-1), ('fixed', 1e-2), ('fixed', 1e-3)]


def budgets():
    print('| scene, mu | ' + ' | '.join('%s, %g' % x for x in WAYS) + ' |\n|---|---|---|---|---|---|---|')
    for name in ('shear', 'sheard'):
        for mu in (.1, .3, 1., 2.):
            sc, ld = blocks(2, 1, 'shear', *(((1., 1.), (.3, .3)) if name == 'shear' else ((1., 20.), (0., .3))))
            steps = [lambda l=l: ld(.01, l * mu * .01) for l in (0, .5, 1, 1.5, 2, 3, 4, 6, 8)]
            o = [inexact(sc, steps, mu, a, e) for a, e in WAYS]
            print('| %s, %g | %s |' % (LONG[name], mu, ' | '.join('%d, %d (%d)' % (sum(t for t, _ in x), max(t for t, _ in x), max(n for _, n in x)) for x in o)), flush=True)


def onsets():
    print('| scene, mu | ' + ' | '.join('%d steps: load; most solves below, above' % k for k in (1, 10, 40)) + ' |\n|---|---|---|---|')
    for name in ('hertz', 'hertzd', 'torque', 'patch'):
        for mu in MU:
            print('| %s, %g | %s |' % (LONG[name], mu, ' | '.join('%.7f; %d, %d' % (x, *n) for x, n in (onset(name, mu, steps=k) for k in (1, 10, 40)))), flush=True)


def onset(name, mu, p=2, lev=1, steps=1, tol=1e-7):
    """Load at which the body slides, by bisection, each trial in so many steps; most solves below and above it."""
    if name in ('torque', 'patch'):
        sc, ld = rings(p, lev, name)
        base, at = [('press', 0, ld(0.))], lambda l: ld(l * mu)
    else:
        sc, ld = blocks(p, lev, 'hertz', *(((1., 1.), (.3, .3)) if name == 'hertz' else ((1., 20.), (0., .3))))
        base, at = [('press', 1, ld(1., 0.))], lambda l: ld(1., l * mu)
    lo, hi, n = .1, 3., [0, 0]
    while hi - lo > tol:
        l = (lo + hi) / 2
        r = run(sc, base + [('load', l * k / steps, at(l * k / steps)) for k in range(1, steps + 1)], mu, 'newton', 'extra', 'once')
        bad = not r[-1]['ok']
        n[bad] = max(n[bad], max(o['n'] for o in r[1:]))
        lo, hi = (lo, l) if bad else (l, hi)
    return hi, n


if __name__ == '__main__':
    import warnings
    warnings.simplefilter('ignore')
    for table in sys.argv[1:] or ('algebra', 'krylovs', 'budgets', 'guesses', 'onsets'):
        print('\n' + table)
        globals()[table]()
