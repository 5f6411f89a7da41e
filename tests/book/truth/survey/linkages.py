"""Truths of survey-linkages.md: intersections of circles, closed forms, Newton and Euler; mpmath, 40 digits.

No line of strutt is used. `python linkages.py` prints section, claim and value. Needs numpy, scipy, sympy, mpmath.
"""

import mpmath as mp, numpy as np
from mpmath import mpf, sin, cos, sqrt, pi, atan2, asin, acos, atan, tan

mp.mp.dps = 40


def circ(P, r1, Q, r2, side):
    "intersection of circles; side=+1: left of P->Q"
    dx, dy = Q[0] - P[0], Q[1] - P[1]
    d2 = dx * dx + dy * dy
    d = sqrt(d2)
    a = (r1 * r1 - r2 * r2 + d2) / (2 * d)
    h = sqrt(r1 * r1 - a * a) * side
    return (P[0] + a * dx / d - h * dy / d, P[1] + a * dy / d + h * dx / d)


D = lambda f, x, n=1: mp.diff(f, mpf(x), n)


# Watt
def watt(a):
    A = (mpf("0.5") * cos(a), mpf("0.5") * sin(a))
    O2 = (mpf(1), mpf("0.2"))
    B = circ(A, mpf("0.2"), O2, mpf("0.5"), 1)
    return A, B


def watt_M(a):
    A, B = watt(a)
    return ((A[0] + B[0]) / 2, (A[1] + B[1]) / 2)


def watt_b(a):
    A, B = watt(a)
    return atan2(B[1] - A[1], B[0] - A[0])


# Whitworth: crank r=0.1 about O(0,0), slotted arm about Q(0,-0.06); arm length .2 ; rod .5 to ram on y = -0.06
def wh_th(f):
    return atan2(mpf("0.1") * sin(f) + mpf("0.06"), mpf("0.1") * cos(f))


def wh_s(f):
    th = wh_th(f)
    x = -mpf("0.15") * cos(th)
    y = -mpf("0.15") * sin(th)  # arm tail, opposite
    return x + sqrt(mpf("0.5") ** 2 - y * y)


# Jansen
Ja = {
    k: mpf(v) / 100
    for k, v in dict(
        a="38", b="41.5", c="39.3", d="40.1", e="55.8", f="39.4", g="36.7", h="65.7", i="49", j="50", k="61.9", l="7.8", m="15"
    ).items()
}


def jansen(th):
    J = Ja
    Z = (J["a"], J["l"])
    O = (mpf(0), mpf(0))
    X = (Z[0] + J["m"] * cos(th), Z[1] + J["m"] * sin(th))
    Y = circ(X, J["j"], O, J["b"], -1)
    if Y[1] < 0:
        Y = circ(X, J["j"], O, J["b"], 1)
    W = max((circ(O, J["d"], Y, J["e"], s) for s in (1, -1)), key=lambda p: -p[0])
    V = min((circ(X, J["k"], O, J["c"], s) for s in (1, -1)), key=lambda p: p[1])
    U = min((circ(W, J["f"], V, J["g"], s) for s in (1, -1)), key=lambda p: p[0])
    T = min((circ(U, J["h"], V, J["i"], s) for s in (1, -1)), key=lambda p: p[1])
    return dict(X=X, Y=Y, W=W, V=V, U=U, T=T)


ang = lambda P, Q: atan2(Q[1] - P[1], Q[0] - P[0])


# Peaucellier: O(0,0), C(0.2,0), crank CA .2 ; arms .5 ; rhomb .2
def peau(f):
    A = (mpf("0.2") + mpf("0.2") * cos(f), mpf("0.2") * sin(f))
    d = sqrt(A[0] ** 2 + A[1] ** 2)
    x = (mpf("0.5") ** 2 - mpf("0.2") ** 2) / d
    return (x * A[0] / d, x * A[1] / d)


# cardan
be = pi / 6


# Hooke: numeric from the geometric condition itself
def _cond(a, b):
    P = mp.matrix([0, cos(a), sin(a)])
    q = mp.matrix([0, -sin(b), cos(b)])
    Q = mp.matrix([cos(be) * q[0] - sin(be) * q[1], sin(be) * q[0] + cos(be) * q[1], q[2]])
    return P[0] * Q[0] + P[1] * Q[1] + P[2] * Q[2]


def CB(a):
    # sin a cos b = cos be cos a sin b
    n = mp.floor((a + pi / 2) / pi)
    b = atan2(sin(a), cos(be) * cos(a))
    b = b + 2 * pi * mp.nint((a - b) / (2 * pi))
    assert abs(_cond(a, b)) < mpf(10) ** -30
    return b


def CK(a):
    return cos(be) / (cos(be) ** 2 * cos(a) ** 2 + sin(a) ** 2)


E0 = (2 + 3 * CK(mpf("0.1")) ** 2) * 25


def Ct(x):
    return mp.quad(lambda a: sqrt((2 + 3 * CK(a) ** 2) / E0), mp.linspace(mpf("0.1"), x, 9))


CT = Ct(pi / 2)
CA1 = mp.findroot(lambda x: Ct(x) - 1, mpf(5.1))
# planar serial arm: q list of functions of t (absolute angle sums of relative), L, c, m, I
G = mpf("9.81")


def arm_tau(qs, L, C, M, I, t):
    n = len(L)
    ab = lambda i, t: sum(qs[k](t) for k in range(i + 1))

    def joint(i, t):
        return (sum(L[k] * cos(ab(k, t)) for k in range(i)), sum(L[k] * sin(ab(k, t)) for k in range(i)))

    def com(i, t):
        x, y = joint(i, t)
        return (x + C[i] * cos(ab(i, t)), y + C[i] * sin(ab(i, t)))

    acc = [(D(lambda s, i=i: com(i, s)[0], t, 2), D(lambda s, i=i: com(i, s)[1], t, 2)) for i in range(n)]
    al = [D(lambda s, i=i: ab(i, s), t, 2) for i in range(n)]
    out = []
    for i in range(n):
        p = joint(i, t)
        out.append(
            sum(
                (com(j, t)[0] - p[0]) * M[j] * (acc[j][1] + G) - (com(j, t)[1] - p[1]) * M[j] * acc[j][0] + I[j] * al[j]
                for j in range(i, n)
            )
        )
    F = (sum(M[j] * acc[j][0] for j in range(n)), sum(M[j] * (acc[j][1] + G) for j in range(n)))
    return out, F


a3q = [lambda t: mpf("0.4") + mpf("0.5") * sin(2 * t), lambda t: mpf("0.8") * cos(t) - mpf("0.3"), lambda t: mpf("0.2") * t**2]


def a3(t):
    return arm_tau(
        a3q,
        [mpf("0.7"), mpf("0.5"), mpf("0.3")],
        [mpf("0.3"), mpf("0.25"), mpf("0.1")],
        [mpf(5), mpf(3), mpf("1.5")],
        [mpf("0.2"), mpf("0.08"), mpf("0.02")],
        mpf(t),
    )


# spatial arm: q1 about z, q2,q3 about -> axis y pitched ; Rz(q1) Ry(q2) , link2 along x ; elbow Ry(q3)
def rz(a):
    return mp.matrix([[cos(a), -sin(a), 0], [sin(a), cos(a), 0], [0, 0, 1]])


def ry(a):
    return mp.matrix([[cos(a), 0, sin(a)], [0, 1, 0], [-sin(a), 0, cos(a)]])


def rx(a):
    return mp.matrix([[1, 0, 0], [0, cos(a), -sin(a)], [0, sin(a), cos(a)]])


def cross(a, b):
    return mp.matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def sp(t):
    t = mpf(t)
    q = lambda t: (mpf("0.6") * sin(t), mpf("0.3") - mpf("0.4") * cos(2 * t), mpf("0.9") * sin(mpf("1.5") * t))

    def fk(t):
        a, b, c = q(t)
        R1 = rz(a)
        R2 = R1 * ry(b)
        R3 = R2 * ry(c)
        p2 = R1 * mp.matrix([mpf("0.1"), 0, mpf("0.5")])
        p3 = p2 + R2 * mp.matrix([mpf("0.6"), 0, 0])
        return R1, R2, R3, p2, p3

    def coms(t):
        R1, R2, R3, p2, p3 = fk(t)
        return [
            R1 * mp.matrix([mpf("0.02"), mpf("0.03"), mpf("0.2")]),
            p2 + R2 * mp.matrix([mpf("0.3"), mpf("0.05"), 0]),
            p3 + R3 * mp.matrix([mpf("0.2"), 0, mpf("0.04")]),
        ]

    m = [mpf(8), mpf(4), mpf(2)]
    I = [
        mp.diag([mpf("0.1"), mpf("0.12"), mpf("0.07")]),
        mp.diag([mpf("0.02"), mpf("0.13"), mpf("0.14")]),
        mp.matrix([[mpf("0.01"), -mpf("0.003"), 0], [-mpf("0.003"), mpf("0.05"), 0], [0, 0, mpf("0.05")]]),
    ]

    def H(t):
        R = fk(t)[:3]
        dq = [D(lambda s, k=k: q(s)[k], t) for k in range(3)]
        w = [R[0] * mp.matrix([0, 0, dq[0]])]
        w.append(w[0] + R[1] * mp.matrix([0, dq[1], 0]))
        w.append(w[1] + R[2] * mp.matrix([0, dq[2], 0]))
        return [R[k] * I[k] * R[k].T * w[k] for k in range(3)]

    def vd(f, n):
        return [mp.matrix([mp.diff(lambda s, k=k, i=i: f(s)[k][i], t, n) for i in range(3)]) for k in range(3)]

    acc = vd(coms, 2)
    Hd = vd(H, 1)
    c = coms(t)
    R1, R2, R3, p2, p3 = fk(t)
    P = [mp.matrix([0, 0, 0]), p2, p3]
    ax = [mp.matrix([0, 0, 1]), R2 * mp.matrix([0, 1, 0]), R3 * mp.matrix([0, 1, 0])]
    g = mp.matrix([0, 0, -G])
    out = []
    for i in range(3):
        s = mp.matrix([0, 0, 0])
        for j in range(i, 3):
            s += cross(c[j] - P[i], m[j] * (acc[j] - g)) + Hd[j]
        out.append(dot(ax[i], s))
    M1 = mp.matrix([0, 0, 0])
    for j in range(3):
        M1 += cross(c[j], m[j] * (acc[j] - g)) + Hd[j]
    F = mp.matrix([0, 0, 0])
    for j in range(3):
        F += m[j] * (acc[j] - g)
    return out, F, M1


# slider crank with gas
sc = dict(r=mpf("0.04"), l=mpf("0.14"), w=mpf(150))


def sc_state(t):
    r, l, w = sc["r"], sc["l"], sc["w"]
    f = w * t
    ps = asin(r * sin(f) / l)
    return f, ps


def scp(t):
    f, ps = sc_state(t)
    r, l = sc["r"], sc["l"]
    return r * cos(f) + l * cos(ps)


def scg(t):
    f, ps = sc_state(t)
    r = sc["r"]
    l = sc["l"]
    c = mpf("0.045")
    return (r * cos(f) + c * cos(ps), r * sin(f) - c * sin(ps))


def sc_all(t):
    t = mpf(t)
    r, l = sc["r"], sc["l"]
    f, ps = sc_state(t)
    mp_, mr, mc = mpf("0.5"), mpf("0.6"), mpf("1.2")
    ec = mpf("0.01")
    Ir = mpf("0.0018")
    ap = D(scp, t, 2)
    ag = (D(lambda s: scg(s)[0], t, 2), D(lambda s: scg(s)[1], t, 2))
    alr = -D(lambda s: sc_state(s)[1], t, 2)
    s = scp(t)
    gas = -3000 * (mpf(1) + cos(f)) ** 2 if sin(f) > 0 else mpf(0)
    # piston: X_B (on piston from rod) + gas = m ap ; guide N ; rod: forces from piston -X_B,-Y_B at B; from crank XA,YA at A
    XB = mp_ * ap - gas
    A = (r * cos(f), r * sin(f))
    g_ = scg(t)
    B = (s, mpf(0))
    XA = mr * ag[0] + XB
    # Y: YA - YB = mr ag_y ; moment about A: (B-A)x(-XB,-YB) = (G-A) x mr ag + Ir alr
    bx, by = B[0] - A[0], B[1] - A[1]
    gx, gy = g_[0] - A[0], g_[1] - A[1]
    rhs = gx * mr * ag[1] - gy * mr * ag[0] + Ir * alr
    YB = (-rhs + by * XB) / bx  # bx*(-YB) - by*(-XB) = rhs
    YA = mr * ag[1] + YB
    N = -YB * 0  # piston y: YB + N = 0
    N = -YB
    aC = (-ec * sc["w"] ** 2 * cos(f) * (-1), -ec * sc["w"] ** 2 * sin(f) * (-1))  # counterweight centre at -ec
    XO = mc * aC[0] + XA
    YO = mc * aC[1] + YA
    M = A[0] * YA - A[1] * XA  # crank: M + A x (-XA,-YA) = 0
    return dict(M=M, XO=XO, YO=YO, N=N, XB=XB)


# four bar shaking
def fb(f):
    a, b, c, d = mpf("0.12"), mpf("0.35"), mpf("0.28"), mpf("0.4")
    A = (a * cos(f), a * sin(f))
    B = circ(A, b, (d, mpf(0)), c, 1)
    return A, B, atan2(B[1] - A[1], B[0] - A[0]), atan2(B[1], B[0] - d)


def fbc(f):
    A, B, p, q = fb(f)
    o = lambda P, x, y, an: (P[0] + x * cos(an) - y * sin(an), P[1] + x * sin(an) + y * cos(an))
    return [
        o((mpf(0), mpf(0)), mpf("0.05"), mpf("0.01"), f),
        o(A, mpf("0.15"), mpf("0.04"), p),
        o((mpf("0.4"), mpf(0)), mpf("0.1"), -mpf("0.02"), q),
    ]


def fb_all(f, w=mpf(20)):
    f = mpf(f)
    m = [mpf("0.5"), mpf("1.1"), mpf("0.9")]
    I = [mpf("0.001"), mpf("0.012"), mpf("0.007")]
    a = [(w * w * D(lambda x, i=i: fbc(x)[i][0], f, 2), w * w * D(lambda x, i=i: fbc(x)[i][1], f, 2)) for i in range(3)]
    v = [(w * D(lambda x, i=i: fbc(x)[i][0], f), w * D(lambda x, i=i: fbc(x)[i][1], f)) for i in range(3)]
    om = [w, w * D(lambda x: fb(x)[2], f), w * D(lambda x: fb(x)[3], f)]
    al = [mpf(0), w * w * D(lambda x: fb(x)[2], f, 2), w * w * D(lambda x: fb(x)[3], f, 2)]
    M = sum(m[i] * (a[i][0] * v[i][0] + a[i][1] * v[i][1]) + I[i] * om[i] * al[i] for i in range(3)) / w
    c = fbc(f)
    FX = sum(m[i] * a[i][0] for i in range(3))
    FY = sum(m[i] * a[i][1] for i in range(3))
    MO = sum(m[i] * (c[i][0] * a[i][1] - c[i][1] * a[i][0]) + I[i] * al[i] for i in range(3))
    return dict(M=M, FX=FX, FY=FY, MO=MO)


# five-bar parallel robot: feet (-.1,0),(.1,0), uppers .3, lowers .35; end at P(t)
def fiveb(t):
    t = mpf(t)
    P = lambda t: (mpf("0.08") * cos(3 * t), mpf("0.4") + mpf("0.05") * sin(3 * t))
    lf = lambda t: circ((-mpf("0.1"), mpf(0)), mpf("0.3"), P(t), mpf("0.35"), 1)
    rf = lambda t: circ((mpf("0.1"), mpf(0)), mpf("0.3"), P(t), mpf("0.35"), -1)
    q1 = lambda t: atan2(lf(t)[1], lf(t)[0] + mpf("0.1"))
    q2 = lambda t: atan2(rf(t)[1], rf(t)[0] - mpf("0.1"))
    mP = mpf("1.5")
    aP = (D(lambda s: P(s)[0], t, 2), D(lambda s: P(s)[1], t, 2))
    F = (mP * aP[0], mP * (aP[1] + G))
    # lower links massless -> axial forces; uppers inertia J=.02 with mass centre at .12, m=.8
    E1, E2 = lf(t), rf(t)
    p = P(t)
    u1 = ((p[0] - E1[0]) / mpf("0.35"), (p[1] - E1[1]) / mpf("0.35"))
    u2 = ((p[0] - E2[0]) / mpf("0.35"), (p[1] - E2[1]) / mpf("0.35"))
    S = mp.lu_solve(mp.matrix([[u1[0], u2[0]], [u1[1], u2[1]]]), mp.matrix([F[0], F[1]]))  # pushes along u
    out = []
    for q, E, u, s, x0 in ((q1, E1, u1, S[0], -mpf("0.1")), (q2, E2, u2, S[1], mpf("0.1"))):
        J = mpf("0.02") + mpf("0.8") * mpf("0.12") ** 2
        out.append(J * D(q, t, 2) + mpf("0.8") * G * mpf("0.12") * cos(q(t)) + ((E[0] - x0) * u[1] - E[1] * u[0]) * s)
    return out, q1(t), q2(t), S


# cam: s=0.5h(1-cos3f), driven w=12
def cam(t):
    f = 12 * mpf(t)
    h = mpf("0.01")
    s = lambda f: h * (1 - cos(3 * f)) / 2
    N = mpf("0.4") * (144 * D(s, f, 2) + G) + 2000 * s(f) + 150
    return N, N * D(s, f)


# Wolfrom: sun .02 planet .03 ring1 .08 fixed, planet2 .025, ring2 .075 ; carrier radius .05
wo = {}
ws = mpf(1)
wc = ws * mpf("0.02") / (mpf("0.02") + mpf("0.08"))  # carrier/sun
wp = wc * (1 - mpf("0.08") / mpf("0.03"))
w2 = wc + (wp - wc) * mpf("0.025") / mpf("0.075")
Jr = (
    mpf("1e-4")
    + (2 * mpf("0.3") * mpf("0.05") ** 2 * 0 + mpf("0.3") * mpf("0.05") ** 2 + mpf("4e-4")) * wc**2
    + mpf("2e-4") * wp**2
    + mpf("5e-3") * w2**2
)
wa = (mpf("0.5") - (mpf(4)) * w2) / Jr


# tangential forces
def wolf():
    aS, aC, aP, a2 = wa, wa * wc, wa * wp, wa * w2
    # gear forces sign: force positive turns second wheel positively.
    # sun: .5 - ... J_s aS = .5 + T_sun ; force on planet T1 acts: sun torque = +-r1*F ; external gear: F turns planet + , sun also + (same direction torque)
    F1 = (mpf("1e-4") * aS - mpf("0.5")) / mpf("0.02")  # sun-planet, both torques + for external
    # ring2: load 4 against: J2 a2 = -4*... + r F3 (planet2 -> ring2, internal; second is ring2)
    F3 = (mpf("5e-3") * a2 + 4) / mpf("0.075")
    # planet: J aP = r1p F1 + r_p F2x - .025 F3 ; ring1 second? [planet, ring1 fixed]
    return F1, F3


# scissor
def sciss(t):
    t = mpf(t)
    l = mpf("0.6")
    y = lambda t: mpf("0.3") + mpf("0.1") * (1 - cos(t))
    q = lambda t: asin(y(t) / (2 * l))
    # bar A from (0,0) length 2l at angle q; bar B from slider at (2l cos q,0) to (0,y). platform at y, mass 40 ; bars massless
    # cylinder from ground P(0,0)... to K on bar B at distance .8 from slider
    K = lambda t: (2 * l * cos(q(t)) - mpf("0.8") * cos(q(t)), mpf("0.8") * sin(q(t)))
    Ld = lambda t: sqrt((K(t)[0] - mpf("0.1")) ** 2 + (K(t)[1] + mpf("0.2")) ** 2)
    F = 40 * (D(y, t, 2) + G) * D(y, t) / D(Ld, t)
    return F, y(t), Ld(t)


def rssr(a, g=1.3):
    f = mp.mpf
    return mp.findroot(
        lambda b: (f(".05") * cos(a) - f(".3")) ** 2
        + (f(".05") * sin(a) - f(".1") - f(".2") * cos(b)) ** 2
        + (f(".05") - f(".2") * sin(b)) ** 2
        - f(".09"),
        g,
    )


# a body on three turning frames
def frames3(t):
    A = rz(mpf("1.5") * t + mpf("0.2") * t * t)
    o = A * mp.matrix([mpf("0.3"), 0, mpf("0.2")])
    Y = A * rx(mpf("0.7") * sin(t)) * ry(mpf("0.2") * t)
    B = Y * rz(mpf("0.5") * cos(2 * t)) * ry(3 * sin(t))
    return o, Y, B


ARM = mp.matrix(
    [[mpf("0.05"), -mpf("0.006"), -mpf("0.003")], [-mpf("0.006"), mpf("0.07"), mpf("0.004")], [-mpf("0.003"), mpf("0.004"), mpf("0.04")]]
)


def vector_rate(F, t, n):
    return mp.matrix([mp.diff(lambda s, i=i: F(s)[i], t, n) for i in range(3)])


def arm_momentum(t):
    R = frames3(t)[2]
    Rd = mp.matrix(3, 3)
    for i in range(3):
        for j in range(3):
            Rd[i, j] = mp.diff(lambda s: frames3(s)[2][i, j], t)
    W = Rd * R.T
    w = mp.matrix([W[2, 1], W[0, 2], W[1, 0]])
    return R * ARM * R.T * w


def arm_support(t):
    t = mpf(t)
    o, Y, B = frames3(t)
    c = lambda s: frames3(s)[0] + frames3(s)[2] * mp.matrix([mpf("0.1"), mpf("0.05"), -mpf("0.02")])
    p = lambda s: frames3(s)[0] + frames3(s)[2] * mp.matrix([mpf("0.2"), mpf("0.1"), 0])
    F = mpf("1.7") * (vector_rate(c, t, 2) + mp.matrix([0, 0, G]))
    M = vector_rate(arm_momentum, t, 1) + cross(c(t) - p(t), F)
    return list(Y.T * F) + list(Y.T * M) + [vector_rate(p, t, 1)[0], vector_rate(p, t, 2)[2]]


SUPPORT = arm_support("0.8")


def S3(i):
    return SUPPORT[i]


# a four-bar with weight, spring, damper, driven by a law
law = lambda t: 2 * pi * (t / 2 - sin(pi * t) / (2 * pi))


def inv_centres(f):
    o = lambda P, x, y, an: (P[0] + x * cos(an) - y * sin(an), P[1] + x * sin(an) + y * cos(an))
    A, B, p, q = fb(f)
    return [
        o((mpf(0), mpf(0)), mpf("0.06"), mpf(0), f),
        o(A, mpf("0.15"), mpf("0.04"), p),
        o((mpf("0.4"), mpf(0)), mpf("0.1"), -mpf("0.02"), q),
    ]


inv_m = [mpf(1), mpf("1.1"), mpf("0.9")]
inv_I = [mpf("0.01"), mpf("0.012"), mpf("0.007")]
inv_J = (
    lambda f: sum(inv_m[i] * (D(lambda s: inv_centres(s)[i][0], f) ** 2 + D(lambda s: inv_centres(s)[i][1], f) ** 2) for i in range(3))
    + inv_I[0]
    + inv_I[1] * D(lambda s: fb(s)[2], f) ** 2
    + inv_I[2] * D(lambda s: fb(s)[3], f) ** 2
)
inv_V = lambda f: sum(inv_m[i] * G * inv_centres(f)[i][1] for i in range(3)) + mpf("1.5") * (fb(f)[3] - mpf("1.7")) ** 2
inv_b = lambda f: mpf("0.05") * (D(lambda s: fb(s)[3] - fb(s)[2], f)) ** 2


def INV(t):
    t = mpf(t)
    f = law(t)
    w = D(law, t)
    return inv_J(f) * D(law, t, 2) + D(inv_J, f) * w * w / 2 + D(inv_V, f) + inv_b(f) * w


# trapezoidal rule: exponentially accurate, the integrand is periodic in t and smooth
INVW = sum(inv_b(law(mpf(2) * k / 300)) * D(law, mpf(2) * k / 300) ** 2 for k in range(300)) * mpf(2) / 300


# section, claim, value
TABLE = [
    ("Watt's linkage", "b(0.2)", lambda: watt_b(mpf("0.2"))),
    ("Watt's linkage", "db/da(0.2)", lambda: D(watt_b, "0.2")),
    ("Watt's linkage", "d2b/da2(0.2)", lambda: D(watt_b, "0.2", 2)),
    ("Watt's linkage", "xM(0.3)", lambda: watt_M(mpf("0.3"))[0]),
    ("Watt's linkage", "yM(0.3)", lambda: watt_M(mpf("0.3"))[1]),
    ("Watt's linkage", "axM(0.3)", lambda: 9 * D(lambda a: watt_M(a)[0], "0.3", 2)),
    ("Watt's linkage", "b(0.4)", lambda: watt_b(mpf("0.4"))),
    ("Whitworth's quick return", "th(1)", lambda: wh_th(mpf(1))),
    ("Whitworth's quick return", "th(4)", lambda: wh_th(mpf(4)) + 2 * pi),
    ("Whitworth's quick return", "th(7)", lambda: wh_th(mpf(7)) + 2 * pi),
    ("Whitworth's quick return", "s(2)", lambda: wh_s(mpf(2))),
    ("Whitworth's quick return", "v(2)", lambda: 10 * D(wh_s, 2)),
    ("Whitworth's quick return", "acc(2)", lambda: 100 * D(wh_s, 2, 2)),
    ("Whitworth's quick return", "v(5)", lambda: 10 * D(wh_s, 5)),
    ("Whitworth's quick return", "acc(5)", lambda: 100 * D(wh_s, 5, 2)),
    ("Whitworth's quick return", "acc(6)", lambda: 100 * D(wh_s, 6, 2)),
    ("Peaucellier's inversor", "Y(0.8)", lambda: mpf("0.525") * tan(mpf("0.4"))),
    ("Peaucellier's inversor", "VY(0.6)", lambda: mpf("0.525") / cos(mpf("0.3")) ** 2),
    ("Peaucellier's inversor", "AY(0.6)", lambda: 4 * mpf("0.525") * tan(mpf("0.3")) / cos(mpf("0.3")) ** 2 / 2),
    ("Jansen's leg", "x(0.3)", lambda: jansen(mpf("0.3"))["T"][0]),
    ("Jansen's leg", "y(0.3)", lambda: jansen(mpf("0.3"))["T"][1]),
    ("Jansen's leg", "x(2.3)", lambda: jansen(mpf("2.3"))["T"][0]),
    ("Jansen's leg", "y(4.3)", lambda: jansen(mpf("4.3"))["T"][1]),
    ("Jansen's leg", "vx(3.3)", lambda: D(lambda t: jansen(t)["T"][0], "3.3")),
    ("Jansen's leg", "ay(5.3)", lambda: D(lambda t: jansen(t)["T"][1], "5.3", 2)),
    ("Hooke's joint", "b(0)", lambda: CB(mpf("0.1"))),
    ("Hooke's joint", "k(0)", lambda: D(CB, "0.1")),
    ("Hooke's joint", "event 1", lambda: CT),
    ("Hooke's joint", "a(1)", lambda: CA1),
    ("Hooke's joint", "b(1)", lambda: CB(CA1)),
    ("An arm of three links in a plane", "M1(0.7)", lambda: a3("0.7")[0][0]),
    ("An arm of three links in a plane", "M2(0.7)", lambda: a3("0.7")[0][1]),
    ("An arm of three links in a plane", "M3(0.7)", lambda: a3("0.7")[0][2]),
    ("An arm of three links in a plane", "M1(1.9)", lambda: a3("1.9")[0][0]),
    ("An arm of three links in a plane", "X(1.9)", lambda: a3("1.9")[1][0]),
    ("An arm of three links in a plane", "Y(1.9)", lambda: a3("1.9")[1][1]),
    ("An arm in space", "M1(0.8)", lambda: sp("0.8")[0][0]),
    ("An arm in space", "M2(0.8)", lambda: sp("0.8")[0][1]),
    ("An arm in space", "M3(0.8)", lambda: sp("0.8")[0][2]),
    ("An arm in space", "X(1.7)", lambda: sp("1.7")[1][0]),
    ("An arm in space", "Z(1.7)", lambda: sp("1.7")[1][2]),
    ("An arm in space", "MX(1.7)", lambda: sp("1.7")[2][0]),
    ("An arm in space", "MY(1.7)", lambda: sp("1.7")[2][1]),
    ("An engine with gas force", "M(0.005)", lambda: sc_all("0.005")["M"]),
    ("An engine with gas force", "XO(0.005)", lambda: sc_all("0.005")["XO"]),
    ("An engine with gas force", "YO(0.005)", lambda: sc_all("0.005")["YO"]),
    ("An engine with gas force", "N(0.005)", lambda: sc_all("0.005")["N"]),
    ("An engine with gas force", "XB(0.005)", lambda: sc_all("0.005")["XB"]),
    ("An engine with gas force", "M(0.035)", lambda: sc_all("0.035")["M"]),
    ("An engine with gas force", "YO(0.035)", lambda: sc_all("0.035")["YO"]),
    ("An engine with gas force", "N(0.035)", lambda: sc_all("0.035")["N"]),
    ("An engine with gas force", "event 1", lambda: pi / 150),
    ("Shaking forces of a four-bar", "M(0.1)", lambda: fb_all("2.5")["M"]),
    ("Shaking forces of a four-bar", "FX(0.1)", lambda: fb_all("2.5")["FX"]),
    ("Shaking forces of a four-bar", "FY(0.1)", lambda: fb_all("2.5")["FY"]),
    ("Shaking forces of a four-bar", "MO(0.1)", lambda: fb_all("2.5")["MO"]),
    ("Shaking forces of a four-bar", "M(0.25)", lambda: fb_all("5.5")["M"]),
    ("Shaking forces of a four-bar", "MO(0.35)", lambda: fb_all("7.5")["MO"]),
    ("A parallel robot", "q1(0.3)", lambda: fiveb("0.3")[1]),
    ("A parallel robot", "q2(0.3)", lambda: fiveb("0.3")[2]),
    ("A parallel robot", "M1(0.3)", lambda: fiveb("0.3")[0][0]),
    ("A parallel robot", "M2(0.3)", lambda: fiveb("0.3")[0][1]),
    ("A parallel robot", "M1(1.3)", lambda: fiveb("1.3")[0][0]),
    ("A parallel robot", "S1(1.3)", lambda: -fiveb("1.3")[3][0]),
    ("A cam with a sprung follower", "M(0.1)", lambda: cam("0.1")[1]),
    ("A cam with a sprung follower", "N(0.1)", lambda: cam("0.1")[0]),
    ("A cam with a sprung follower", "M(0.73)", lambda: cam("0.73")[1]),
    ("Wolfrom's planetary gear", "as(0)", lambda: wa),
    ("Wolfrom's planetary gear", "s(2)", lambda: 2 * wa),
    ("Wolfrom's planetary gear", "ratio(2)", lambda: w2),
    ("Wolfrom's planetary gear", "c(2)", lambda: 2 * wa * wc),
    ("Wolfrom's planetary gear", "F1(1)", lambda: wolf()[0]),
    ("Wolfrom's planetary gear", "F3(1)", lambda: wolf()[1]),
    ("A scissor lift and its cylinder", "F(1)", lambda: sciss(1)[0]),
    ("A scissor lift and its cylinder", "L(1)", lambda: sciss(1)[2]),
    ("A scissor lift and its cylinder", "F(2.5)", lambda: sciss("2.5")[0]),
    ("A body on three turning frames", "X(0.8)", lambda: S3(0)),
    ("A body on three turning frames", "Y(0.8)", lambda: S3(1)),
    ("A body on three turning frames", "Z(0.8)", lambda: S3(2)),
    ("A body on three turning frames", "MX(0.8)", lambda: S3(3)),
    ("A body on three turning frames", "MY(0.8)", lambda: S3(4)),
    ("A body on three turning frames", "MZ(0.8)", lambda: S3(5)),
    ("A body on three turning frames", "vx(0.8)", lambda: S3(6)),
    ("A body on three turning frames", "az(0.8)", lambda: S3(7)),
    ("A linkage in space", "b(0)", lambda: rssr(mpf(0))),
    ("A linkage in space", "b'(0.4)", lambda: 2 * D(rssr, "0.4")),
    ("A linkage in space", "b''(0.4)", lambda: 4 * D(rssr, "0.4", 2)),
    ("A linkage in space", "b(0.8)", lambda: rssr(mpf("0.8"))),
    ("A linkage in space", "b''(0.8)", lambda: 4 * D(rssr, "0.8", 2)),
    ("A four-bar driven through a smooth turn", "work.M", lambda: INVW),
    ("A four-bar driven through a smooth turn", "M(0.7)", lambda: INV("0.7")),
    ("A four-bar driven through a smooth turn", "M(1.3)", lambda: INV("1.3")),
]

if __name__ == "__main__":
    for section, claim, value in TABLE:
        print(f"{section} / {claim} = {value()}")
