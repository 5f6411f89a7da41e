"""Truths of survey-linear.md: matrices written by hand; eigenvalues by mpmath, forced oscillations by one complex solution.

No line of strutt is used. `python linear.py` prints section, claim and value. Needs numpy, scipy, sympy, mpmath.
"""

import numpy as np, mpmath as mp
from scipy.linalg import expm
from math import *

g = 9.81
mp.mp.dps = 30


def eigs(M, B, C):
    "eigenvalues with 30 digits: companion"
    M, B, C = [mp.matrix(np.array(X, float).tolist()) for X in (M, B, C)]
    n = M.rows
    Mi = M**-1
    A = mp.zeros(2 * n)
    for i in range(n):
        A[i, n + i] = 1
    K = -(Mi * C)
    D = -(Mi * B)
    for i in range(n):
        for j in range(n):
            A[n + i, j] = K[i, j]
            A[n + i, n + j] = D[i, j]
    return mp.eig(A, left=False, right=False)


def om(M, B, C):
    e = [l for l in eigs(M, B, C) if l.imag > 0]
    e.sort(key=abs)
    return [float(abs(l)) for l in e], [float(-l.real / abs(l)) for l in e]


def resp(M, B, C, F, w):
    return np.linalg.solve(np.array(C) - w * w * np.array(M) + 1j * w * np.array(B), F)


# half car: m=600,J=900,a=1.2,b=1.5; k 20k,22k; c 1500,1700; wheels 40; kt 180k
def car():
    m, J, a, b, kf, kr, cf, cr, mw, kt = 600.0, 900.0, 1.2, 1.5, 20e3, 22e3, 1500.0, 1700.0, 40.0, 180e3
    r1 = np.array([1, a, -1, 0.0])
    r2 = np.array([1, -b, 0, -1.0])
    w1 = np.array([0, 0, 1, 0.0])
    w2 = np.array([0, 0, 0, 1.0])
    o = np.outer
    return (
        np.diag([m, J, mw, mw]),
        cf * o(r1, r1) + cr * o(r2, r2),
        kf * o(r1, r1) + kr * o(r2, r2) + kt * (o(w1, w1) + o(w2, w2)),
        w1,
        w2,
        kt,
    )


M_, B_, C_, w1, w2, kt = car()
CW, CZ = om(M_, B_, C_)


def carresp(w, v=20.0, A=0.01):
    ph = w * 2.7 / v
    # z1=A sin wt, z2 = A sin(wt-ph); complex amplitude of sin
    return resp(M_, B_, C_, kt * A * (w1 + w2 * np.exp(-1j * ph)), w)


# absorber Den Hartog mu=.1 f=1/(1+mu)
mu = 0.1
f = 1 / (1 + mu)
# fixed points: r^4 - 2 r^2 (1+f^2+mu f^2)/(2+mu) + 2 f^2/(2+mu)=0
bq = (1 + f * f * (1 + mu)) / (2 + mu)
PQ = [sqrt(bq - sqrt(bq * bq - 2 * f * f / (2 + mu))), sqrt(bq + sqrt(bq * bq - 2 * f * f / (2 + mu)))]


# gear branch: J0 (motor) -k1- gear A(r=.05,JA) meshes B(r=.1,JB) -k2- J1 ; and C(r=.08,JC) -k3- J2
def branch():
    J0, JA, JB, JC, J1, J2, k1, k2, k3 = 0.02, 0.003, 0.01, 0.006, 0.4, 0.15, 3000.0, 8000.0, 5000.0
    M = np.diag([J0, JA + JB / 4 + JC * 25 / 64, J1, J2])
    C = np.zeros((4, 4))
    for v, k in (([1, -1, 0, 0], k1), ([0, 0.5, 1, 0], k2), ([0, 0.625, 0, 1], k3)):
        C += k * np.outer(v, v)
    Mm = mp.matrix(M.tolist())
    Cm = mp.matrix(C.tolist())
    e = sorted(float(x.real) for x in mp.eig(Mm**-1 * Cm, left=False, right=False))
    return [sqrt(x) for x in e[1:]]


BR = branch()


# rotor: m=12, A=.15,C=.2, l1=.2 (bearing at z=-.2), l2=.35 ; kx=2e6, ky=1.2e6 each
def rotor(W):
    m, A, Cz = 12.0, 0.15, 0.2
    za, zb = -0.2, 0.35
    kx, ky = 2e6, 1.2e6
    # coords x,y,a,b : point (0,0,z): dx = z*b, dy = -z*a
    M = np.diag([m, m, A, A])
    G = np.zeros((4, 4))
    G[2, 3] = Cz * W
    G[3, 2] = -Cz * W
    K = np.zeros((4, 4))
    for z in (za, zb):
        v = np.array([1, 0, 0, z])
        u = np.array([0, 1, -z, 0])
        K += kx * np.outer(v, v) + ky * np.outer(u, u)
    return M, G, K


RO = om(*rotor(400.0))[0]


def unb(W, e=2e-4):
    M, G, K = rotor(W)
    m = 12.0
    F = m * e * W * W * np.array([1, -1j, 0, 0])  # x: cos, y: sin ; in e^{iWt} convention
    return resp(M, G, K, F, W)


# internal damping k=1e5 m=10 be=30 bi=20
w0 = sqrt(1e5 / 10)
Wth = w0 * (1 + 30 / 20)


def intern(W):
    # s^2+(be+bi)/m s + k/m - i W bi/m
    r = np.roots([1, 5.0, 1e4 - 1j * W * 2.0])
    return sorted(r, key=lambda z: z.real)


# ziegler
ZP = 3.5 - sqrt(2)


def zieg(P, d=0.0):
    M = [[3, 1], [1, 1]]
    C = [[2 - P, P - 1], [-1, 1]]
    B = [[2 * d, -d], [-d, d]]
    return eigs(M, B, C)


# exact for d: Routh on quartic
import sympy as sp


def ziegler_threshold(d):
    s, P = sp.symbols("s P")
    d = sp.nsimplify(d)
    Mx = sp.Matrix([[3 * s**2 + 2 * d * s + 2 - P, s**2 - d * s + P - 1], [s**2 - d * s - 1, s**2 + d * s + 1]])
    p = sp.Poly(sp.expand(Mx.det()), s).all_coeffs()
    a4, a3, a2, a1, a0 = p
    return min(float(r) for r in sp.Poly(sp.expand(a3 * a2 * a1 - a4 * a1**2 - a3**2 * a0), P).nroots(n=20) if r.is_real and r > 0)


ZD = ziegler_threshold("0.1")


# building 5 storeys: m=2e4 each, k=3e7; alpha=.2 beta=.002
def bld():
    m, k = 2e4, 3e7
    n = 5
    K = np.zeros((n, n))
    for i in range(n):
        K[i, i] += k
        if i + 1 < n:
            K[i, i] += k
            K[i, i + 1] -= k
            K[i + 1, i] -= k
    M = m * np.eye(n)
    return M, 0.2 * M + 0.002 * K, K


def bld_om(j):
    return 2 * sqrt(3e7 / 2e4) * sin((2 * j - 1) * pi / 22)


def bldresp(w):
    M, B, K = bld()
    return resp(M, B, K, -M @ np.ones(5) * 1.0, w)  # ground acc 1*sin


# ring
def ring(j):
    return sqrt((500 + 2 * 800 * (1 - cos(2 * pi * j / 6))) / 2)


# elastic Atwood: two equal masses 4kg on springs k over pulley J r
def eatw():
    m, J, r, k = 4.0, 0.05, 0.12, 6000.0
    M = np.diag([m, m, J])
    C = np.zeros((3, 3))
    for v in ([1, 0, r], [0, 1, -r]):
        C += k * np.outer(v, v)
    e = sorted(float(x.real) for x in mp.eig(mp.matrix(M.tolist()) ** -1 * mp.matrix(C.tolist()), left=False, right=False))
    return [sqrt(x) for x in e[1:]]


EA = eatw()


# caster
def caster(V=3.0, m=5.0, J=0.06, c=0.08, e=0.1, k=4000.0):
    return sorted(np.roots([m * (e - c) ** 2 + J, (e - c) * m * V, k * e * e, k * e * V]), key=lambda z: (abs(z.imag), z.real))


# drive train transient: J1=2,J2=5,k=300,b=4, torque ramp 30*min(t,1)/1 on 1, load -6 w2 (viscous)
def drive(T):
    A = np.zeros((6, 6))  # states q1,q2,w1,w2,u(torque),c(slope)
    A[0, 2] = A[1, 3] = 1
    A[2] = [-150, 150, -2, 2, 0.5, 0]
    A[3] = [60, -60, 0.8, -0.8 - 1.2, 0, 0]
    A[4, 5] = 1
    x = expm(A * min(T, 1.0)) @ np.array([0, 0, 0, 0, 0, 30.0])
    if T > 1:
        A[4, 5] = 0
        x = expm(A * (T - 1)) @ x
    return x


def casterm(t, V=3.0, m=5.0, J=0.06, c=0.08, e=0.1, k=4000.0):
    # y'=e p'+V p ; y''=e p''+V p' ; (e-c)m(y''-c p'')+e k y+J p''=0
    A = np.array([[0, V, e], [0, 0, 1], [-e * k, 0, -(e - c) * m * V]], float)
    A[2] /= m * (e - c) ** 2 + J
    return expm(A * t) @ np.array([0, 1e-6, -V * 1e-6 / e])


def _fbm():
    import mpmath as mp
    from linkages import circ, G

    f_ = mp.mpf
    mp.mp.dps = 30

    def geo(f):
        A = (f_(".4") * mp.cos(f), f_(".4") * mp.sin(f))
        D = (f_(".7"), f_(0))
        B = circ(A, f_(".6"), D, f_(".5"), -1)
        return A, B, mp.atan2(B[1] - A[1], B[0] - A[0]), mp.atan2(B[1], B[0] - f_(".7"))

    o = lambda P, x, y, a: (P[0] + x * mp.cos(a) - y * mp.sin(a), P[1] + x * mp.sin(a) + y * mp.cos(a))

    def cs(f):
        A, B, p, q = geo(f)
        return [o((0, 0), f_(".2"), f_(".03"), f), o(A, f_(".3"), -f_(".1"), p), o((f_(".7"), 0), f_(".25"), 0, q)]

    m = [1, 2, f_("1.5")]
    I = [f_(".02"), f_(".05"), f_(".03")]
    V = lambda f: sum(m[i] * G * cs(f)[i][1] for i in range(3)) + 2 * (geo(f)[3] + f_("1.6")) ** 2
    fe = mp.findroot(lambda f: mp.diff(V, f), -1.2)
    d = lambda F, f: mp.diff(F, f)
    Mm = (
        sum(m[i] * (d(lambda s: cs(s)[i][0], fe) ** 2 + d(lambda s: cs(s)[i][1], fe) ** 2) for i in range(3))
        + I[0]
        + I[1] * d(lambda s: geo(s)[2], fe) ** 2
        + I[2] * d(lambda s: geo(s)[3], fe) ** 2
    )
    b = f_(".3") * (d(lambda s: geo(s)[2], fe) - 1) ** 2
    K = mp.diff(V, fe, 2)
    X = f_(".2") / (K - 36 * Mm + 6j * b)
    return [
        float(v)
        for v in (
            fe,
            mp.sqrt(K / Mm),
            b / 2 / mp.sqrt(K * Mm),
            abs(X),
            abs(X * d(lambda s: geo(s)[3], fe)),
            abs(X * d(lambda s: geo(s)[1][0], fe)),
        )
    ]


FBM = _fbm()


# section, claim, value
TABLE = [
    ("Half a car on a wavy road", "modes[1].omega", lambda: CW[0]),
    ("Half a car on a wavy road", "modes[2].omega", lambda: CW[1]),
    ("Half a car on a wavy road", "modes[3].omega", lambda: CW[2]),
    ("Half a car on a wavy road", "modes[4].omega", lambda: CW[3]),
    ("Half a car on a wavy road", "modes[1].damping_ratio", lambda: CZ[0]),
    ("Half a car on a wavy road", "modes[4].damping_ratio", lambda: CZ[3]),
    ("Half a car on a wavy road", "at_frequency.outputs.y.amplitude", lambda: abs(carresp(10.0)[0])),
    ("Half a car on a wavy road", "at_frequency.outputs.p.amplitude", lambda: abs(carresp(10.0)[1])),
    ("Half a car on a wavy road", "at_frequency.outputs.d.amplitude", lambda: abs(carresp(10.0)[3])),
    ("Half a car on a wavy road", "at_frequency.outputs.y.phase", lambda: np.angle(carresp(10.0)[0])),
    ("Half a car on a wavy road", "at_frequency.outputs.tyre.amplitude", lambda: abs(180e3 * (carresp(10.0)[2] - 0.01))),
    ("Half a car on a wavy road", "at_frequency.outputs.seat.amplitude", lambda: 100 * abs(carresp(10.0)[0])),
    ("Half a car on a wavy road", "at_frequency.outputs.y.amplitude", lambda: abs(carresp(63.0)[0])),
    ("Half a car on a wavy road", "at_frequency.outputs.p.amplitude", lambda: abs(carresp(63.0)[1])),
    ("Half a car on a wavy road", "at_frequency.outputs.u.amplitude", lambda: abs(carresp(63.0)[2])),
    ("Den Hartog's absorber", 'response set w="@{repr(10*PQ[0])} rad/s"', lambda: repr(10 * PQ[0])),
    ("Den Hartog's absorber", "at_frequency.outputs.x.amplitude", lambda: 0.03 * sqrt(21)),
    ("Den Hartog's absorber", 'response set w="@{repr(10*PQ[1])} rad/s" set b="0.07 N s/m"', lambda: repr(10 * PQ[1])),
    ("Den Hartog's absorber", "at_frequency.outputs.x.amplitude", lambda: 0.03 * sqrt(21)),
    ("Den Hartog's absorber", 'response set w="@{repr(10*PQ[1])} rad/s" set b="1 N s/m"', lambda: repr(10 * PQ[1])),
    ("Den Hartog's absorber", "at_frequency.outputs.x.amplitude", lambda: 0.03 * sqrt(21)),
    ("A shaft with two geared branches", "modes[2].omega", lambda: BR[0]),
    ("A shaft with two geared branches", "modes[3].omega", lambda: BR[1]),
    ("A shaft with two geared branches", "modes[4].omega", lambda: BR[2]),
    ("A rotor in unequal bearings", "modes[1].omega", lambda: RO[0]),
    ("A rotor in unequal bearings", "modes[2].omega", lambda: RO[1]),
    ("A rotor in unequal bearings", "modes[3].omega", lambda: RO[2]),
    ("A rotor in unequal bearings", "modes[4].omega", lambda: RO[3]),
    ("A rotor in unequal bearings", "at_frequency.outputs.x.amplitude", lambda: abs(unb(400.0)[0])),
    ("A rotor in unequal bearings", "at_frequency.outputs.y.amplitude", lambda: abs(unb(400.0)[1])),
    ("A rotor in unequal bearings", "at_frequency.outputs.a.amplitude", lambda: abs(unb(400.0)[2])),
    ("A rotor in unequal bearings", "at_frequency.outputs.b.amplitude", lambda: abs(unb(400.0)[3])),
    ("Internal damping makes a shaft unstable", "modes[1].omega_d", lambda: abs(intern(300.0)[1].imag)),
    ("Internal damping makes a shaft unstable", "modes[1].root[1]", lambda: intern(300.0)[1].real),
    ("Ziegler's column under a follower force", "tracks.unstable_from", lambda: ZP),
    ("Ziegler's column under a follower force", "tracks.unstable_from", lambda: ZD),
    ("Five storeys", "modes[1].omega", lambda: bld_om(1)),
    ("Five storeys", "modes[3].omega", lambda: bld_om(3)),
    ("Five storeys", "modes[5].omega", lambda: bld_om(5)),
    ("Five storeys", "modes[1].damping_ratio", lambda: 0.1 / bld_om(1) + 0.001 * bld_om(1)),
    ("Five storeys", "modes[5].damping_ratio", lambda: 0.1 / bld_om(5) + 0.001 * bld_om(5)),
    ("Five storeys", "at_frequency.outputs.x1.amplitude", lambda: abs(bldresp(25.0)[0])),
    ("Five storeys", "at_frequency.outputs.x5.amplitude", lambda: abs(bldresp(25.0)[4])),
    ("Five storeys", "at_frequency.outputs.base.amplitude", lambda: 3e7 * abs(bldresp(25.0)[0])),
    ("Five storeys", "at_frequency.outputs.top.amplitude", lambda: abs(1 - 625 * bldresp(25.0)[4])),
    ("Six masses on a ring", "modes[1].omega", lambda: ring(0)),
    ("Six masses on a ring", "modes[2].omega", lambda: ring(1)),
    ("Six masses on a ring", "modes[3].omega", lambda: ring(1)),
    ("Six masses on a ring", "modes[4].omega", lambda: ring(2)),
    ("Six masses on a ring", "modes[5].omega", lambda: ring(2)),
    ("Six masses on a ring", "modes[6].omega", lambda: ring(3)),
    ("Two loads over a pulley on elastic ropes", "modes[2].omega", lambda: EA[0]),
    ("Two loads over a pulley on elastic ropes", "modes[3].omega", lambda: EA[1]),
    ("A caster that shimmies", "p(0.3)", lambda: casterm(0.3)[1]),
    ("A caster that shimmies", "y(0.5)", lambda: casterm(0.5)[0]),
    ("A drive started by a ramp", "a(0.7)", lambda: drive(0.7)[0]),
    ("A drive started by a ramp", "a(3)", lambda: drive(3.0)[0]),
    ("A drive started by a ramp", "b'(3)", lambda: drive(3.0)[3]),
    ("A four-bar that hangs", "f", lambda: FBM[0]),
    ("A four-bar that hangs", "modes[1].omega", lambda: FBM[1]),
    ("A four-bar that hangs", "modes[1].damping_ratio", lambda: FBM[2]),
    ("A four-bar that hangs", "at_frequency.outputs.f.amplitude", lambda: FBM[3]),
    ("A four-bar that hangs", "at_frequency.outputs.q.amplitude", lambda: FBM[4]),
    ("A four-bar that hangs", "at_frequency.outputs.u.amplitude", lambda: FBM[5]),
]

if __name__ == "__main__":
    for section, claim, value in TABLE:
        print(f"{section} / {claim} = {value()}")
