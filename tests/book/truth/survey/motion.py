"""Truths of survey-motion.md: closed forms, and equations of motion written by hand or by sympy, integrated by DOP853 at 1e-13.

No line of strutt is used. `python motion.py` prints section, claim and value. Needs numpy, scipy, sympy, mpmath.
"""

import numpy as np, mpmath as mp, sympy as sp
from scipy.integrate import solve_ivp
from math import *

g = 9.81


def ode(f, y0, t, **k):
    r = solve_ivp(f, (0, t), y0, method="DOP853", rtol=1e-13, atol=1e-15, **k)
    return r.y[:, -1]


# compound Atwood
R1, R2, J1, J2, m1, M, m2, m3 = 0.15, 0.1, 0.02, 0.006, 5, 0.8, 2, 1.2
# unknown a1(alpha1), a2, T1,T2,TL,TR
Am = np.array(
    [
        [m1 * R1, 0, 1, 0, 0, 0],
        [M * R1, 0, 0, -1, 1, 1],
        [J1, 0, -R1, R1, 0, 0],
        [0, J2, 0, 0, -R2, R2],
        [m2 * R1, -m2 * R2, 0, 0, -1, 0],
        [m3 * R1, m3 * R2, 0, 0, 0, -1],
    ],
    float,
)
bm = np.array([m1 * g, -M * g, 0, 0, -m2 * g, -m3 * g])
At = np.linalg.solve(Am, bm)


# differential windlass: R=.12,r=.09, pulley rp=.105 Jp=.004 mp+load=60 ; drum J=.3 ; crank torque 8 - ...
def windlass():
    R, r, rp, Jp, m, Jd, Mc = 0.12, 0.09, 0.105, 0.004, 60.0, 0.3, 12.0
    v = (R - r) / 2
    w = (R + r) / 2 / rp
    a = (Mc - m * g * v) / (Jd + m * v * v + Jp * w * w)
    # tensions: A (radius R) B (radius r): A+B=m(g+v a); rp(A-B)=Jp*w*a in sense
    s = m * (g + v * a)
    d = Jp * w * a / rp
    return a, (s + d) / 2, (s - d) / 2


WL = windlass()


# maxwell wheel moved
def maxw(t, m=0.5, J=3e-4, r=0.005, A=0.01, w=20):
    h2 = lambda t: -A * w * w * sin(w * t)
    k = m / (m * r + J / r)
    phi = k * (g * t * t / 2 + A * sin(w * t) - A * w * t)
    T = J / r * k * (g + h2(t))
    return phi, T


# capstan
mu = 0.25
e = exp(mu * pi)


def caps(m1, m2):
    return (m1 - m2 * e) * g / (m1 + m2 * e)


# bowling with backspin on a plane
def bowl(v0=4.0, w0=-30.0, mu=0.2, R=0.11):
    # v' = -mu g ; w' = 5 mu g/(2R)
    t = (v0 - R * w0) / (mu * g * 3.5)
    v = v0 - mu * g * t
    x = v0 * t - mu * g * t * t / 2
    return t, v, x


# cylinder on sliding wedge: wedge M, cylinder m,R (disc), slope a
def wedge(M=6.0, m=2.0, a=radians(25)):
    # X'' wedge, s'' down slope relative ; disc k=1/2
    A = np.array([[M + m, m * cos(a)], [m * cos(a), 1.5 * m]])
    return np.linalg.solve(A, [0, m * g * sin(a)])


WD = wedge()


# disc rolling inside rolling ring : ring M,R rolls on ground, disc m, r inside, line of centres angle b from down
def nest():
    t = sp.symbols("t")
    M, m, R, r, G = sp.Rational(3), sp.Rational(2), sp.Rational(1, 2), sp.Rational(1, 8), sp.Rational(981, 100)
    f = sp.Function("f")(t)
    b = sp.Function("b")(t)  # f ring angle (ccw), centre X=-R f
    X = -R * f
    x = X + (R - r) * sp.sin(b)
    y = R - (R - r) * sp.cos(b)
    # contact: ring point velocity relative to ring centre at contact: R f' ; disc: r*w ; velocities of centre rel: (R-r) b'
    w = (R * f.diff(t) - (R - r) * b.diff(t)) / r
    T = M * X.diff(t) ** 2 / 2 + M * R**2 * f.diff(t) ** 2 / 2 + m * (x.diff(t) ** 2 + y.diff(t) ** 2) / 2 + m * r**2 / 4 * w**2
    L = T - m * G * y
    eqs = [sp.diff(L.diff(q.diff(t)), t) - L.diff(q) for q in (f, b)]
    fd, bd, fv, bv, B = sp.symbols("fd bd fv bv B")
    sub = {f.diff(t, 2): fd, b.diff(t, 2): bd}
    e = [q.doit().subs(sub).subs({f.diff(t): fv, b.diff(t): bv}).subs({b: B}) for q in eqs]
    s = sp.solve(e, [fd, bd])
    F = sp.lambdify((B, fv, bv), [s[fd], s[bd]])
    rhs = lambda t, y: [y[2], y[3], *F(y[1], y[2], y[3])]
    return lambda T: ode(rhs, [0, 1.2, 0, 0], T)


NS = nest()(2.0)


# Chaplygin sleigh
def sleigh(t, V=2.0, a=0.3, k2=0.5, t0=-2.0):
    k = sqrt(k2)
    tau = t0 + a * V / k2 * t
    th = k / a * (2 * atan(tanh(tau / 2)) - 2 * atan(tanh(t0 / 2)))
    return V * tanh(tau), V / k / cosh(tau), th


# skate
def skate(t, al=radians(10), w=1.5):
    c = g * sin(al) / (2 * w * w)
    return c * sin(w * t) ** 2, c * (w * t - sin(2 * w * t) / 2)


# turntable ball
def table(t, Om=3.0, v0=(0.2, 0.0), p0=(0.3, 0.0)):
    # v' = (2/7) Om z x (v) -> for hollow/solid: solid 2/7
    k = 2 / 7 * Om
    vx, vy = v0
    # v' = k*(-vy,vx)
    return p0[0] + (vx * sin(k * t) - vy * (1 - cos(k * t))) / k, p0[1] + (vy * sin(k * t) + vx * (1 - cos(k * t))) / k


# rolling coin
def coin():
    th, ps, ph, thd, psd, phd, tdd, pdd, fdd, R, m, G = sp.symbols("th ps ph thd psd phd tdd pdd fdd R m G")
    Om = sp.Matrix([thd, psd * sp.sin(th), psd * sp.cos(th)])
    w = sp.Matrix([thd, psd * sp.sin(th), phd + psd * sp.cos(th)])
    dt = lambda v: v.applyfunc(lambda e: e.diff(th) * thd + e.diff(thd) * tdd + e.diff(psd) * pdd + e.diff(phd) * fdd) + Om.cross(v)
    r = sp.Matrix([0, R, 0])
    v = w.cross(r)
    a = dt(v)
    I = sp.diag(m * R**2 / 4, m * R**2 / 4, m * R**2 / 2)
    H = I * w
    up = sp.Matrix([0, sp.sin(th), sp.cos(th)])
    eq = dt(H) + r.cross(m * a) + r.cross(m * G * up)
    s = sp.solve(list(eq), [tdd, pdd, fdd], dict=True)[0]
    F = sp.lambdify(
        (th, thd, psd, phd), [s[q].subs({R: sp.Rational(1, 10), m: sp.Rational(1, 2), G: sp.Rational(981, 100)}) for q in (tdd, pdd, fdd)]
    )

    def rhs(t, y):
        th, ps, ph, x, Y, thd, psd, phd = y
        R = 0.1
        w3 = phd + psd * cos(th)
        return [
            thd,
            psd,
            phd,
            R * (thd * sin(th) * sin(ps) - w3 * cos(ps)),
            R * (-thd * sin(th) * cos(ps) - w3 * sin(ps)),
            *F(th, thd, psd, phd),
        ]

    return lambda T: ode(rhs, [1.2, 0, 0, 0, 0, 0.3, 0.5, -12.0], T)


CO = coin()(2.0)


# tube with wall friction: r'' = w^2 r - 2 mu w r'
def tube(t, w=5.0, mu=0.3, r0=0.1):
    a = w * (-mu + sqrt(mu * mu + 1))
    b = w * (-mu - sqrt(mu * mu + 1))
    A = -b * r0 / (a - b)
    B = a * r0 / (a - b)
    return A * exp(a * t) + B * exp(b * t), A * a * exp(a * t) + B * b * exp(b * t)


# crane: trolley driven, hoist l(t)=3-0.4t, trolley s''=.5 for 2 s.. smooth: s=0.25 t^2
def crane(T):
    f = lambda t, y: [y[1], (-g * sin(y[0]) - 0.5 * cos(y[0]) - 2 * (-0.4) * y[1]) / (3 - 0.4 * t)]
    y = ode(f, [0, 0], T)
    l = 3 - 0.4 * T
    # tension: m(l q'^2 + g cos q - s'' sin q - l'')
    return y[0], y[1], 80 * (l * y[1] ** 2 + g * cos(y[0]) - 0.5 * sin(y[0]))


CR = crane(4.0)


# double pendulum with joint damping, physical
def dp():
    t = sp.symbols("t")
    a = sp.Function("a")(t)
    b = sp.Function("b")(t)
    l, c1, c2, m1, m2, I1, I2, d1, d2 = [sp.Rational(v) for v in ("0.4", "0.2", "0.15", "1.5", "0.8", "0.03", "0.01", "0.02", "0.015")]
    G = sp.Rational(981, 100)
    x1, y1 = c1 * sp.sin(a), -c1 * sp.cos(a)
    x2, y2 = l * sp.sin(a) + c2 * sp.sin(b), -l * sp.cos(a) - c2 * sp.cos(b)
    T = (
        m1 * (x1.diff(t) ** 2 + y1.diff(t) ** 2) / 2
        + m2 * (x2.diff(t) ** 2 + y2.diff(t) ** 2) / 2
        + I1 * a.diff(t) ** 2 / 2
        + I2 * b.diff(t) ** 2 / 2
    )
    L = T - G * (m1 * y1 + m2 * y2)
    Phi = d1 * a.diff(t) ** 2 / 2 + d2 * (b.diff(t) - a.diff(t)) ** 2 / 2
    A, B, av, bv, ad, bd = sp.symbols("A B av bv ad bd")
    eq = [sp.diff(L.diff(q.diff(t)), t) - L.diff(q) + Phi.diff(q.diff(t)) for q in (a, b)]
    eq = [e.doit().subs({a.diff(t, 2): ad, b.diff(t, 2): bd}).subs({a.diff(t): av, b.diff(t): bv}).subs({a: A, b: B}) for e in eq]
    s = sp.solve(eq, [ad, bd])
    F = sp.lambdify((A, B, av, bv), [s[ad], s[bd]])
    return lambda T: ode(lambda t, y: [y[2], y[3], *F(*y)], [2.0, -1.0, 0, 0], T)


DP = dp()(2.0)


# two masses on a belt
def belt():
    m = (1.0, 1.5)
    k = (60.0, 90.0, 40.0)
    v = 0.2
    Fs = (5.0, 6.0)
    Fk = (3.0, 4.0)  # k0 wall-1, k1 1-2, k2 2-wall
    spr = lambda x: (-k[0] * x[0] - k[1] * (x[0] - x[1]), -k[2] * x[1] - k[1] * (x[1] - x[0]))
    st = ["slip", "slip"]
    y = np.array([0, 0, 0.0, 0.0])
    t = 0
    ev = []
    st = ["stick", "stick"]
    y = np.array([0, 0, v, v])
    T = 8.0
    sg = [1, 1]
    while t < T:

        def f(t, y):
            s = spr(y[:2])
            a = [0, 0]
            for i in (0, 1):
                a[i] = 0 if st[i] == "stick" else (s[i] + sg[i] * Fk[i]) / m[i]
            return [y[2], y[3], a[0], a[1]]

        es = []
        for i in (0, 1):
            if st[i] == "stick":
                fn = lambda t, y, i=i: Fs[i] - abs(spr(y[:2])[i])
            else:
                fn = lambda t, y, i=i, s=sg[i]: s * (v - y[2 + i])
            fn.terminal = True
            fn.direction = -1
            es.append(fn)
        r = solve_ivp(f, (t, T), y, method="DOP853", rtol=1e-13, atol=1e-15, events=es)
        t = r.t[-1]
        y = r.y[:, -1]
        if r.status == 0:
            break
        for i in (0, 1):
            if len(r.t_events[i]):
                ev.append(t)
                if st[i] == "stick":
                    st[i] = "slip"
                    sg[i] = 1 if spr(y[:2])[i] < 0 else -1
                else:
                    y[2 + i] = v
                    s = spr(y[:2])[i]
                    if abs(s) <= Fs[i]:
                        st[i] = "stick"
                    else:
                        sg[i] = -sg[i]
    return y, ev


BT, BE = belt()


def cord():
    L0 = np.hypot(1, 0.2)

    def f(t, y):
        r = y[:2]
        v = y[2:]
        L = np.hypot(*r)
        u = r / L
        N = 3 + 50 * (L - L0) + 4 * (v @ u) - 2 * t
        W = np.array([[np.cos(2 * t), -np.sin(2 * t)], [np.sin(2 * t), np.cos(2 * t)]]) @ [1, 0.5]
        F = -N * u - 0.5 * np.hypot(*v) * v + W + np.array([0, -2 * g])
        return np.r_[v, F / 2]

    y = ode(f, [1, 0.2, 0, 0], 2.0)
    return list(y) + [3 + 50 * (np.hypot(y[0], y[1]) - L0)]


CD = cord()


# prescribed lengths and moving guides
def boom(t):
    L = lambda t: mp.mpf("1.4") + mp.mpf(".2") * mp.sin(mp.mpf(".9") * t)
    reach = lambda q: mp.sqrt((mp.cos(q) - mp.mpf(".3")) ** 2 + (mp.sin(q) + mp.mpf(".8")) ** 2)
    a = lambda t: mp.findroot(lambda q: reach(q) - L(t), 0.6)
    with mp.workdps(30):
        t = mp.mpf(t)
        q = a(t)
        return q, mp.diff(a, t), -(305 * mp.diff(a, t, 2) + 100 * mp.mpf("9.81") * mp.mpf("1.5") * mp.cos(q)) / mp.diff(reach, q)


def hoist(T):
    y = ode(lambda t, y: [y[1], (-g * sin(y[0]) + 0.6 * y[1]) / (2 - 0.3 * t)], [0.3, 0], T)
    return y[0], y[1], 3 * ((2 - 0.3 * T) * y[1] ** 2 + g * cos(y[0]))


HO = hoist(2.0)


def wire_rates(t, x, v):
    c, s = cos(2 * t), sin(2 * t)
    h = 0.6 * x * c
    k = 0.6 * c * v * v - 2.4 * x * v * s - 1.2 * x * x * c
    a = (-20 * x - h * (2 * g + 2 * k)) / (2 + 2 * h * h)
    return a, 2 * (h * a + k) + 2 * g


def wire(T):
    y = ode(lambda t, y: [y[1], wire_rates(t, *y)[0]], [1, 0], T)
    return y[0], y[1], wire_rates(T, *y)[1]


WI = wire(2.0)


def groove(T):
    y = ode(lambda t, y: [y[1], (1.5 * cos(t)) ** 2 * y[0]], [1, 0], T)
    return y[0], 2 * (2 * 1.5 * cos(T) * y[1] - 1.5 * sin(T) * y[0])


GR = groove(2.0)


# section, claim, value
TABLE = [
    ("A double Atwood machine with heavy pulleys", "a1(0.2)", lambda: At[0]),
    ("A double Atwood machine with heavy pulleys", "a2(0.2)", lambda: At[1]),
    ("A double Atwood machine with heavy pulleys", "Ta(0.2)", lambda: At[2]),
    ("A double Atwood machine with heavy pulleys", "Tb(0.2)", lambda: At[3]),
    ("A double Atwood machine with heavy pulleys", "Tc(0.2)", lambda: At[4]),
    ("A double Atwood machine with heavy pulleys", "Td(0.2)", lambda: At[5]),
    ("A double Atwood machine with heavy pulleys", "y3(0.5)", lambda: (At[0] * R1 + At[1] * R2) / 8),
    ("A differential windlass", "acc(1)", lambda: WL[0]),
    ("A differential windlass", "A(1)", lambda: WL[1]),
    ("A differential windlass", "B(1)", lambda: WL[2]),
    ("A differential windlass", "y(1)", lambda: WL[0] * 0.015 / 2),
    ("Maxwell's wheel on a moving hand", "f(1)", lambda: maxw(1.0)[0]),
    ("Maxwell's wheel on a moving hand", "T(1)", lambda: maxw(1.0)[1]),
    ("Maxwell's wheel on a moving hand", "T(0.45)", lambda: maxw(0.45)[1]),
    ("A rope around a fixed post", "a(0.5)", lambda: caps(5, 1)),
    ("A rope around a fixed post", "S2(0.5)", lambda: -(g + caps(5, 1))),
    ("A rope around a fixed post", "s(1)", lambda: caps(5, 1) / 2),
    ("A rope around a fixed post", "F(0.5)", lambda: (g + caps(5, 1)) * (e - 1)),
    ("A bowling ball with backspin", "event 1", lambda: bowl()[0]),
    ("A bowling ball with backspin", "v(2)", lambda: bowl()[1]),
    ("A bowling ball with backspin", "f'(2)", lambda: bowl()[1] / 0.11),
    ("A bowling ball with backspin", "x(2)", lambda: bowl()[2] + bowl()[1] * (2 - bowl()[0])),
    ("A cylinder on a wedge that slides", "aX(0.5)", lambda: WD[0]),
    ("A cylinder on a wedge that slides", "as(0.5)", lambda: WD[1]),
    ("A cylinder on a wedge that slides", "f(1)", lambda: -WD[1] / 2 / 0.1),
    ("A cylinder on a wedge that slides", "T(0.5)", lambda: -WD[1]),
    ("A roller inside a ring that rolls", "F(2)", lambda: NS[0]),
    ("A roller inside a ring that rolls", "b(2)", lambda: NS[1]),
    ("A roller inside a ring that rolls", "F'(2)", lambda: NS[2]),
    ("A roller inside a ring that rolls", "b'(2)", lambda: NS[3]),
    ("Chaplygin's sleigh", "th(3)", lambda: sleigh(3.0)[2]),
    ("Chaplygin's sleigh", "th'(3)", lambda: sleigh(3.0)[1]),
    ("Chaplygin's sleigh", "th(5)", lambda: sleigh(5.0)[2]),
    ("A rolling coin", "th(2)", lambda: CO[0]),
    ("A rolling coin", "ps(2)", lambda: CO[1]),
    ("A rolling coin", "ph(2)", lambda: CO[2]),
    ("A rolling coin", "x(2)", lambda: CO[3]),
    ("A rolling coin", "y(2)", lambda: CO[4]),
    ("A tube that rubs", "r(0.5)", lambda: tube(0.5)[0]),
    ("A tube that rubs", "r(1)", lambda: tube(1.0)[0]),
    ("A tube that rubs", "N(1)", lambda: 2 * 0.2 * 5 * tube(1.0)[1]),
    ("A crane that hoists and drives", "q(4)", lambda: CR[0]),
    ("A crane that hoists and drives", "q'(4)", lambda: CR[1]),
    ("A crane that hoists and drives", "S(4)", lambda: CR[2]),
    ("Two masses on a belt", "in the text", lambda: len(BE)),
    ("Two masses on a belt", "event 1", lambda: BE[0]),
    ("Two masses on a belt", "event 2", lambda: BE[1]),
    ("Two masses on a belt", "event 3", lambda: BE[2]),
    ("Two masses on a belt", "event 6", lambda: BE[5]),
    ("Two masses on a belt", "x(8)", lambda: BT[0]),
    ("Two masses on a belt", "y(8)", lambda: BT[1]),
    ("Two masses on a belt", "y'(8)", lambda: BT[3]),
    ("Two rods with rubbing joints", "a(2)", lambda: DP[0]),
    ("Two rods with rubbing joints", "b(2)", lambda: DP[1]),
    ("Two rods with rubbing joints", "b'(2)", lambda: DP[3]),
    ("A load on an elastic cord", "x(2)", lambda: CD[0]),
    ("A load on an elastic cord", "y(2)", lambda: CD[1]),
    ("A load on an elastic cord", "y'(2)", lambda: CD[3]),
    ("A load on an elastic cord", "S(2)", lambda: CD[4]),
    ("A boom lifted by a cylinder", "a(1)", lambda: boom(1)[0]),
    ("A boom lifted by a cylinder", "a'(1)", lambda: boom(1)[1]),
    ("A boom lifted by a cylinder", "F(1)", lambda: boom(1)[2]),
    ("A boom lifted by a cylinder", "F(2)", lambda: boom(2)[2]),
    ("A pendulum on a rope that is drawn in", "q(2)", lambda: HO[0]),
    ("A pendulum on a rope that is drawn in", "q'(2)", lambda: HO[1]),
    ("A pendulum on a rope that is drawn in", "S(2)", lambda: HO[2]),
    ("A bead on a wire that flaps", "x(2)", lambda: WI[0]),
    ("A bead on a wire that flaps", "x'(2)", lambda: WI[1]),
    ("A bead on a wire that flaps", "N(2)", lambda: WI[2]),
    ("A block in a groove that swings to and fro", "r(2)", lambda: GR[0]),
    ("A block in a groove that swings to and fro", "N(2)", lambda: GR[1]),
]

if __name__ == "__main__":
    for section, claim, value in TABLE:
        print(f"{section} / {claim} = {value()}")
