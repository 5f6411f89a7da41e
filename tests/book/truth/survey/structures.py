"""Truths of survey-structures.md: three-moment equation, a stiffness method, transcendental equations of bending waves.

No line of strutt is used. `python structures.py` prints section, claim and value. Needs numpy, scipy, sympy, mpmath.
"""

import numpy as np, mpmath as mp
from math import *

mp.mp.dps = 30


def elem(EA, EI, L, m=0.0):
    K = np.zeros((6, 6))
    a = EA / L
    b = EI / L**3
    K[np.ix_([0, 3], [0, 3])] = a * np.array([[1, -1], [-1, 1]])
    K[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] = b * np.array(
        [[12, 6 * L, -12, 6 * L], [6 * L, 4 * L * L, -6 * L, 2 * L * L], [-12, -6 * L, 12, -6 * L], [6 * L, 2 * L * L, -6 * L, 4 * L * L]]
    )
    M = np.zeros((6, 6))
    mm = m * L
    M[np.ix_([0, 3], [0, 3])] = mm / 6 * np.array([[2, 1], [1, 2]])
    M[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] = (
        mm
        / 420
        * np.array(
            [
                [156, 22 * L, 54, -13 * L],
                [22 * L, 4 * L * L, 13 * L, -3 * L * L],
                [54, 13 * L, 156, -22 * L],
                [-13 * L, -3 * L * L, -22 * L, 4 * L * L],
            ]
        )
    )
    return K, M


def rot(c, s):
    R = np.eye(6)
    R[0:2, 0:2] = R[3:5, 3:5] = [[c, s], [-s, c]]
    return R


class FE:
    def __init__(s, nodes):
        s.x = nodes
        s.n = 3 * len(nodes)
        s.K = np.zeros((s.n, s.n))
        s.M = np.zeros((s.n, s.n))
        s.F = np.zeros(s.n)
        s.el = []

    def rod(s, i, j, EA, EI, m=0.0, q=(0, 0)):
        (x1, y1), (x2, y2) = s.x[i], s.x[j]
        L = hypot(x2 - x1, y2 - y1)
        R = rot((x2 - x1) / L, (y2 - y1) / L)
        k, m_ = elem(EA, EI, L, m)
        d = [3 * i, 3 * i + 1, 3 * i + 2, 3 * j, 3 * j + 1, 3 * j + 2]
        s.K[np.ix_(d, d)] += R.T @ k @ R
        s.M[np.ix_(d, d)] += R.T @ m_ @ R
        ql = R[:2, :2] @ np.array(q, float)
        f = np.array([ql[0] * L / 2, ql[1] * L / 2, ql[1] * L * L / 12, ql[0] * L / 2, ql[1] * L / 2, -ql[1] * L * L / 12])
        s.F[d] += R.T @ f
        s.el.append((d, R, k, f))

    def solve(s, fix):
        fr = [i for i in range(s.n) if i not in fix]
        u = np.zeros(s.n)
        u[fr] = np.linalg.solve(s.K[np.ix_(fr, fr)], s.F[fr])
        s.u = u
        s.r = s.K @ u - s.F
        return s

    def end(s, e):
        d, R, k, f = s.el[e]
        return k @ (R @ s.u[d]) - f


# gable frame: nodes 0(0,0) 1(0,4) 2(3,5.5) 3(6,4) 4(6,0)
def gable():
    f = FE([(0, 0), (0, 4), (3, 5.5), (6, 4), (6, 0)])
    EA, EI = 600e6, 20e6
    f.rod(0, 1, EA, EI, q=(1500, 0))
    f.rod(1, 2, EA, EI, q=(0, -3000))
    f.rod(2, 3, EA, EI, q=(0, -3000))
    f.rod(3, 4, EA, EI)
    f.F[3 * 2] += 5000.0
    return f.solve([0, 1, 2, 12, 13])  # 4 pinned


GB = gable()


# gable modes with consistent mass, one element a rod
def gmodes():
    f = FE([(0, 0), (0, 4), (3, 5.5), (6, 4), (6, 0)])
    EA, EI = 600e6, 20e6
    for i in range(4):
        f.rod(i, i + 1, EA, EI, m=80.0)
    fr = [i for i in range(15) if i not in (0, 1, 2, 12, 13)]
    from scipy.linalg import eigh

    return np.sqrt(eigh(f.K[np.ix_(fr, fr)], f.M[np.ix_(fr, fr)], eigvals_only=True))


# three spans 4,5,3 ; q=2k on span 1; P=10k at 1 m from C in span 3. M_B,M_C negative hogging: three moment
def three():
    l1, l2, l3 = 4.0, 5.0, 3.0
    q = 2e3
    P = 10e3
    a = 1.0
    b = 2.0
    # M1 l1+2M_B(l1+l2)+M_C l2 = -q l1^3/4 ; M_B l2+2 M_C(l2+l3) = -P a b (l3+b)/l3
    A = np.array([[2 * (l1 + l2), l2], [l2, 2 * (l2 + l3)]])
    MB, MC = np.linalg.solve(A, [-q * l1**3 / 4, -P * a * b * (l3 + b) / l3])
    RA = q * l1 / 2 + MB / l1
    RB = q * l1 / 2 - MB / l1 + (MC - MB) / l2
    RC = (MB - MC) / l2 + P * b / l3 - MC / l3
    RD = P * a / l3 + MC / l3
    return MB, MC, RA, RB, RC, RD


TS = three()


# braced square with two diagonals, redundant: side 2, EA=1e7 sides, 1.4e7 diag; nodes A(0,0) B(2,0) C(2,2) D(0,2); A pin, B roller y; load at C (8k,-5k)
def truss():
    P = np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])
    bars = [(0, 1, 1e7), (1, 2, 1e7), (2, 3, 1e7), (3, 0, 1e7), (0, 2, 1.4e7), (1, 3, 1.4e7)]
    K = np.zeros((8, 8))
    B = []
    for i, j, EA in bars:
        d = P[j] - P[i]
        L = np.hypot(*d)
        v = np.zeros(8)
        v[2 * i : 2 * i + 2] = -d / L
        v[2 * j : 2 * j + 2] = d / L
        B.append((v, EA / L))
        K += EA / L * np.outer(v, v)
    F = np.zeros(8)
    F[4] = 8e3
    F[5] = -5e3
    fr = [2, 4, 5, 6, 7]
    u = np.zeros(8)
    u[fr] = np.linalg.solve(K[np.ix_(fr, fr)], F[fr])
    return [k * (v @ u) for v, k in B], u


TR = truss()
# continuum
ch, sh, co, si = mp.cosh, mp.sinh, mp.cos, mp.sin


# cantilever with tip mass m1=.4 (beam mass 1), tip inertia .02, tip spring 30, EI=100, l=1
def tipdet(lam):
    EI = mp.mpf(100)
    w2 = lam**4 * EI
    # w = A(ch-co)+B(sh-si) ; at 1: EI w''' = -w2*m1*w + k w ... shear: EI w''' = (k - m1 w2) w ; EI w'' = J w2 w'
    z = lam
    W = [ch(z) - co(z), sh(z) - si(z)]
    W1 = [z * (sh(z) + si(z)), z * (ch(z) - co(z))]
    W2 = [z**2 * (ch(z) + co(z)), z**2 * (sh(z) + si(z))]
    W3 = [z**3 * (sh(z) - si(z)), z**3 * (ch(z) + co(z))]
    r = [[EI * W3[i] - (30 - mp.mpf("0.4") * w2) * W[i] for i in (0, 1)], [EI * W2[i] - mp.mpf("0.02") * w2 * W1[i] for i in (0, 1)]]
    return r[0][0] * r[1][1] - r[0][1] * r[1][0]


def roots(f, a, b, n=400):
    xs = [a + (b - a) * mp.mpf(i) / n for i in range(n + 1)]
    out = []
    p = f(xs[0])
    for i in range(n):
        q = f(xs[i + 1])
        if p * q < 0:
            out.append(mp.findroot(f, (xs[i], xs[i + 1]), solver="anderson", tol=1e-40, verify=False))
        p = q
    return out


TIP = [float(l**2 * 10) for l in roots(tipdet, mp.mpf("0.1"), mp.mpf(9))[:3]]


# two unequal spans pinned 1 and 1.4 : EI=50 mu=2
def two(lam):
    f = lambda L: co(lam * L) / si(lam * L) - ch(lam * L) / sh(lam * L)
    return (f(mp.mpf(1)) + f(mp.mpf("1.4"))) * si(lam) * si(lam * mp.mpf("1.4"))


TW = [float(l**2 * 5) for l in roots(two, mp.mpf("0.5"), mp.mpf(9))[:4]]


# beam pinned-pinned l=2 with central spring ks: symmetric modes: EI w'''(mid) half:
def springy(lam, ks=5000.0, EI=100.0, a=1.0):
    # half beam: w= A sin+B sinh ; w'(a)=0 ; 2*EI w'''(a) = ks w(a) (shear jump).
    z = lam * a
    # A cos z + B ch z=0 -> A=ch z, B=-co z
    w = ch(z) * si(z) - co(z) * sh(z)
    w3 = lam**3 * (-ch(z) * co(z) - co(z) * ch(z))
    return 2 * EI * w3 - ks * w


SPR = [float(l**2 * mp.sqrt(100 / mp.mpf(3))) for l in roots(springy, mp.mpf("0.3"), mp.mpf(7))[:2]]


# cantilever forced at mid: response at tip, EI=1000, mu=2, l=1, F at 0.5 : use Green's via matching
def forced(w, EI=1000.0, mu=2.0, F=10.0):
    lam = mp.sqrt(mp.sqrt(mu * w * w / EI))
    h = mp.mpf("0.5")
    # left: A(ch-co)+B(sh-si) ; right = left + C*(sh(x-h)-si(x-h)) where EI*lam^3*2*C = jump of w''' *EI = F*(+)
    # EI w'''' - mu w^2 w = F delta -> jump w''' = F/EI ; (sh-si)''' at 0 = lam^3*(1+1)
    C = F / (EI * 2 * lam**3)
    z = lam
    d2 = lambda x, t: None
    W2 = [lam**2 * (ch(z) + co(z)), lam**2 * (sh(z) + si(z))]
    W3 = [lam**3 * (sh(z) - si(z)), lam**3 * (ch(z) + co(z))]
    y = lam * h
    p2 = C * lam**2 * (sh(y) + si(y))
    p3 = C * lam**3 * (ch(y) + co(y))
    A, B = mp.lu_solve(mp.matrix([[W2[0], W2[1]], [W3[0], W3[1]]]), mp.matrix([-p2, -p3]))
    return float(A * (ch(z) - co(z)) + B * (sh(z) - si(z)) + C * (sh(y) - si(y)))


# elastic cantilever carrying an inverted pendulum / motor with unbalance: see section
# a frame with springs, a hinge, an inclined support, loads within the rods
def mixed():
    from scipy.linalg import eigh

    X = [(0, 0), (0, 3), (4, 3), (6, 1)]
    n = 13  # extra dof 12: rotation of BC end at C
    K = np.zeros((n, n))
    M = np.zeros((n, n))
    F = np.zeros(n)
    rods = [
        (0, 1, 80e6, 2e6, 30.0, [0, 1, 2, 3, 4, 5]),
        (1, 2, 90e6, 3e6, 40.0, [3, 4, 5, 6, 7, 12]),
        (2, 3, 70e6, 2e6, 25.0, [6, 7, 8, 9, 10, 11]),
    ]
    for i, j, EA, EI, m, d in rods:
        dx = X[j][0] - X[i][0]
        dy = X[j][1] - X[i][1]
        L = hypot(dx, dy)
        R = rot(dx / L, dy / L)
        k, mm = elem(EA, EI, L, m)
        K[np.ix_(d, d)] += R.T @ k @ R
        M[np.ix_(d, d)] += R.T @ mm @ R

        def N(s):
            z = s / L
            return np.array(
                [
                    [1 - z, 0, 0, z, 0, 0],
                    [0, 1 - 3 * z * z + 2 * z**3, L * (z - 2 * z * z + z**3), 0, 3 * z * z - 2 * z**3, L * (z**3 - z * z)],
                ]
            )

        def dN(s):
            z = s / L
            return np.array([0, (-6 * z + 6 * z * z) / L, 1 - 4 * z + 3 * z * z, 0, (6 * z - 6 * z * z) / L, 3 * z * z - 2 * z])

        if (i, j) == (1, 2):
            F[d] += R.T @ N(1.5).T @ (R[:2, :2] @ np.array([3e3, -7e3]))
        if (i, j) == (2, 3):
            F[d] += R.T @ dN(1.0) * 2e3
            xs, ws = np.polynomial.legendre.leggauss(8)
            for x, w in zip(xs, ws):
                s = L * (x + 1) / 2
                q = np.array([1e3 * (1 - s / L), -1e3 - 2e3 * s / L])
                F[d] += R.T @ N(s).T @ (R[:2, :2] @ q) * w * L / 2
    K[2, 2] += 30e3
    K[6, 6] += 200e3
    M[3, 3] += 50
    M[4, 4] += 50
    M[5, 5] += 4
    M[9, 9] += 20
    M[10, 10] += 20
    # D: local y at 30deg held: dir (-sin30,cos30)
    T = np.eye(n)
    c, s = cos(pi / 6), sin(pi / 6)
    T[9:11, 9:11] = [[c, -s], [s, c]]
    K2 = T.T @ K @ T
    M2 = T.T @ M @ T
    F2 = T.T @ F
    fr = [i for i in range(n) if i not in (0, 1, 10, 11)]
    u = np.zeros(n)
    u[fr] = np.linalg.solve(K2[np.ix_(fr, fr)], F2[fr])
    u = T @ u
    r = K @ u - F

    return u, r, np.sqrt(eigh(K2[np.ix_(fr, fr)], M2[np.ix_(fr, fr)], eigvals_only=True))


MX = mixed()


# section, claim, value
TABLE = [
    ("A beam over three spans", "reactions.A.y", lambda: TS[2]),
    ("A beam over three spans", "reactions.B.y", lambda: TS[3]),
    ("A beam over three spans", "reactions.C.y", lambda: TS[4]),
    ("A beam over three spans", "reactions.D.y", lambda: TS[5]),
    ("A beam over three spans", "rods.BC.M[1]", lambda: TS[0]),
    ("Gerber's beam", "nodes.H.y", lambda: 1500 * 27 / 3 / 2e6),
    ("A gable frame in the wind", "nodes.C.x", lambda: GB.u[6]),
    ("A gable frame in the wind", "nodes.C.y", lambda: GB.u[7]),
    ("A gable frame in the wind", "nodes.C.turn", lambda: GB.u[8]),
    ("A gable frame in the wind", "reactions.A.x", lambda: GB.r[0]),
    ("A gable frame in the wind", "reactions.A.turn", lambda: GB.r[2]),
    ("A gable frame in the wind", "reactions.E.x", lambda: GB.r[12]),
    ("A gable frame in the wind", "reactions.E.y", lambda: GB.r[13]),
    ("A gable frame in the wind", "rods.BC.M[1]", lambda: -GB.end(1)[2]),
    ("A gable frame in the wind", "rods.BC.N[1]", lambda: -GB.end(1)[0]),
    ("A gable frame in the wind", "modes[1].omega", lambda: gmodes()[0]),
    ("A gable frame in the wind", "modes[2].omega", lambda: gmodes()[1]),
    ("A gable frame in the wind", "modes[3].omega", lambda: gmodes()[2]),
    ("A braced square with two diagonals", "forces.AB", lambda: TR[0][0]),
    ("A braced square with two diagonals", "forces.BC", lambda: TR[0][1]),
    ("A braced square with two diagonals", "forces.AC", lambda: TR[0][4]),
    ("A braced square with two diagonals", "forces.BD", lambda: TR[0][5]),
    ("A braced square with two diagonals", "nodes.C.x", lambda: TR[1][4]),
    ("A braced square with two diagonals", "nodes.C.y", lambda: TR[1][5]),
    ("A cantilever with a heavy block and a spring at its tip", "continuum[1]", lambda: TIP[0]),
    ("A cantilever with a heavy block and a spring at its tip", "continuum[2]", lambda: TIP[1]),
    ("A cantilever with a heavy block and a spring at its tip", "continuum[3]", lambda: TIP[2]),
    ("A cantilever with a heavy block and a spring at its tip", "modes[1].omega", lambda: TIP[0]),
    ("A cantilever with a heavy block and a spring at its tip", "modes[3].omega", lambda: TIP[2]),
    ("Two unequal spans", "continuum[1]", lambda: TW[0]),
    ("Two unequal spans", "continuum[2]", lambda: TW[1]),
    ("Two unequal spans", "continuum[4]", lambda: TW[3]),
    ("Two unequal spans", "modes[2].omega", lambda: TW[1]),
    ("Two unequal spans", "modes[4].omega", lambda: TW[3]),
    ("A beam with a spring under its middle", "continuum[1]", lambda: SPR[0]),
    ("A beam with a spring under its middle", "continuum[2]", lambda: pi**2 * sqrt(100 / 3)),
    ("A beam with a spring under its middle", "continuum[3]", lambda: SPR[1]),
    ("A beam with a spring under its middle", "modes[3].omega", lambda: SPR[1]),
    ("A cantilever shaken in its middle", "at_frequency.outputs.w.amplitude", lambda: abs(forced(50.0))),
    ("A cantilever shaken in its middle", "at_frequency.outputs.w.amplitude", lambda: abs(forced(200.0))),
    ("A frame with springs, a hinge, an inclined support", "nodes.B.x", lambda: MX[0][3]),
    ("A frame with springs, a hinge, an inclined support", "nodes.B.turn", lambda: MX[0][5]),
    ("A frame with springs, a hinge, an inclined support", "nodes.C.y", lambda: MX[0][7]),
    ("A frame with springs, a hinge, an inclined support", "nodes.C.turn", lambda: MX[0][8]),
    ("A frame with springs, a hinge, an inclined support", "reactions.A.x", lambda: MX[1][0]),
    ("A frame with springs, a hinge, an inclined support", "reactions.A.y", lambda: MX[1][1]),
    ("A frame with springs, a hinge, an inclined support", "reactions.D.x", lambda: MX[1][9]),
    ("A frame with springs, a hinge, an inclined support", "reactions.D.turn", lambda: MX[1][11]),
    ("A frame with springs, a hinge, an inclined support", "springs.C.x", lambda: -200e3 * MX[0][6]),
    ("A frame with springs, a hinge, an inclined support", "modes[1].omega", lambda: MX[2][0]),
    ("A frame with springs, a hinge, an inclined support", "modes[2].omega", lambda: MX[2][1]),
    ("A frame with springs, a hinge, an inclined support", "modes[4].omega", lambda: MX[2][3]),
    ("A frame with springs, a hinge, an inclined support", "modes[5].omega", lambda: MX[2][4]),
]

if __name__ == "__main__":
    for section, claim, value in TABLE:
        print(f"{section} / {claim} = {value()}")
