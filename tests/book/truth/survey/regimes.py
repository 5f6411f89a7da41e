"""Truths of survey-regimes.md: Newton's method on the map of a period with variational equations, places of rest by mpmath.

No line of strutt is used. `python regimes.py` prints section, claim and value. Needs numpy, scipy, sympy, mpmath.
"""

import numpy as np, mpmath as mp, sympy as sp
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.linalg import expm
from math import *

g = 9.81


def ode(f, y0, a, b=None, **k):
    if b is None:
        a, b = 0.0, a
    return solve_ivp(f, (a, b), y0, method="DOP853", rtol=1e-13, atol=1e-15, **k).y[:, -1]


# Meissner: x''+(d +- e)x, d=1.2,e=.5, period 2pi/w, w=1.7: first half d+e
def meissner(d=1.2, e=0.5, w=1.7):
    def P(k2, h):
        k = sqrt(k2)
        return np.array([[cos(k * h), sin(k * h) / k], [-k * sin(k * h), cos(k * h)]])

    h = pi / w
    M = P(d - e, h) @ P(d + e, h)
    return np.trace(M)


MT = meissner()
MTm = sorted(abs(r) for r in np.roots([1, -MT, 1]))


# shooting
def shoot(f, y, T, n=8):
    y = np.array(y, float)
    for _ in range(n):

        def ext(t, z):
            yy = z[:2]
            A = f(t, yy, True)
            return np.r_[f(t, yy), (A @ z[2:].reshape(2, 2)).ravel()]

        z = ode(ext, np.r_[y, 1, 0, 0, 1], T)
        Phi = z[2:].reshape(2, 2)
        y = y - np.linalg.solve(Phi - np.eye(2), z[:2] - y)
    return y, np.linalg.eigvals(Phi)


def duf(t, y, J=False):
    if J:
        return np.array([[0, 1], [-1 - 3 * 0.8 * y[0] ** 2, -0.2]])
    return np.array([y[1], -0.2 * y[1] - y[0] - 0.8 * y[0] ** 3 + 1.5 * cos(1.4 * t)])


DU, DM = shoot(duf, [2.0, 0], 2 * pi / 1.4)


def vdp(t, y, J=False):
    if J:
        return np.array([[0, 1], [-1 - 2 * 0.4 * y[0] * y[1], 0.4 * (1 - y[0] ** 2)]])
    return np.array([y[1], 0.4 * (1 - y[0] ** 2) * y[1] - y[0] + 1.2 * cos(1.1 * t)])


VD, VM = shoot(vdp, [-1.0, 2.0], 2 * pi / 1.1, 12)


# Rayleigh mu=3 period
def rayl(mu=3.0):
    f = lambda t, y: [y[1], mu * (y[1] - y[1] ** 3 / 3) - y[0]]
    y = [0, 2.0]
    ev = lambda t, y: y[0]
    ev.direction = 1
    y = ode(f, y, 60.0)
    r = solve_ivp(f, (0, 30), y, method="DOP853", rtol=1e-13, atol=1e-15, events=ev)
    t = r.t_events[0]
    return t[-1] - t[-2]


RT = rayl()


# swing monodromy: pendulum with l(t)=l0(1+e cos wt): (l^2 th')' + g l th=0
def swing(e=0.1, w=None, l0=1.0, c=0.05):
    w = w or 2 * sqrt(g / l0)
    l = lambda t: l0 * (1 + e * cos(w * t))
    ld = lambda t: -l0 * e * w * sin(w * t)
    f = lambda t, y: [y[1], -(2 * ld(t) / l(t)) * y[1] - c / l(t) ** 2 * y[1] - g / l(t) * y[0]]
    T = 2 * pi / w
    M = np.array([ode(f, v, T) for v in ([1, 0], [0, 1])]).T
    return np.linalg.eigvals(M)


SW = sorted(abs(swing()))


# Den Hartog Coulomb: m=1,k=1 (wn=1), F=1, Ff=.3, r=.6
def denh(Ff=0.3, r=0.6):
    # full closed form for no-stop motion: amplitude
    Q = 1 / (1 - r * r)
    H = sin(pi / r) / (r * (1 + cos(pi / r)))
    return sqrt(Q * Q - (Ff * H) ** 2)


DH = denh()


# press: J phi'' = M0 - k w - R(phi), R=40(1+sin phi)^2
def press(J=1.5, M0=95.0, k=2.0, R=20.0):
    # dw/dphi = (M0 - k w - R(1+sin)^2)/(J w)
    f = lambda p, y: [(M0 - k * y[0] - R * (1 + sin(p)) ** 2) / (J * y[0]), 1 / y[0]]
    w = 35.0
    for _ in range(60):
        w = ode(f, [w, 0], 2 * pi)[0]
    h = 1e-5
    for _ in range(4):
        a = ode(f, [w, 0], 2 * pi)[0]
        b = ode(f, [w + h, 0], 2 * pi)[0]
        c = ode(f, [w - h, 0], 2 * pi)[0]
        d = (b - c) / 2 / h
        w -= (a - w) / (d - 1)
    mu_ = exp(-k / J * ode(f, [w, 0], 2 * pi)[1])  # Liouville: product with 1
    return w, ode(f, [w, 0], 2 * pi)[1], mu_


PR = press()
# porter governor
m, M, l, J = 0.6, 3.0, 0.25, 0.05


def porter(w):
    c = (m + M) * g / (m * l * w * w)
    return acos(c), w * sqrt(m * (1 - c * c) / (m + 2 * M * (1 - c * c)))


def porter_free(w):
    a = porter(w)[0]
    J0 = J + 2 * m * l * l * sin(a) ** 2
    p = J0 * w
    V = lambda x: mp.mpf(p) ** 2 / (2 * (J + 2 * m * l * l * mp.sin(x) ** 2)) - 2 * (m + M) * g * l * mp.cos(x)
    return sqrt(float(mp.diff(V, a, 2)) / (2 * m * l * l + 4 * M * l * l * sin(a) ** 2))


# governor masses: T = 2*1/2 m l^2 a'^2 + 1/2 M (2 l sin a a')^2
# magnets
def mag():
    P = [(0.3 * cos(2 * pi * i / 3 + 0.2), 0.3 * sin(2 * pi * i / 3 + 0.2)) for i in range(3)]
    V = lambda x, y: 2 * (x * x + y * y) - sum(0.05 / mp.sqrt((x - a) ** 2 + (y - b) ** 2 + mp.mpf("0.05") ** 2) for a, b in P)
    gr = lambda x, y: (mp.diff(V, (x, y), (1, 0)), mp.diff(V, (x, y), (0, 1)))
    s = mp.findroot(gr, (mp.mpf("0.288"), mp.mpf("0.0585")))
    H = np.array(
        [
            [mp.diff(V, (s[0], s[1]), (2, 0)), mp.diff(V, (s[0], s[1]), (1, 1))],
            [mp.diff(V, (s[0], s[1]), (1, 1)), mp.diff(V, (s[0], s[1]), (0, 2))],
        ],
        float,
    )
    return float(s[0]), float(s[1]), np.sqrt(np.linalg.eigvalsh(H) / 0.2)


mp.mp.dps = 25
MG = mag()


# von Mises truss: half span b=1,h=.3,k=1000 each, load P down at apex: apex height y
def mises(P=6.0):
    L0 = sqrt(1.09)
    F = lambda y: 2 * 1000 * (sqrt(1 + y * y) - L0) * y / sqrt(1 + y * y) + P
    ys = np.linspace(-0.6, 0.6, 2401)
    return [brentq(F, a, b, xtol=1e-16) for a, b in zip(ys, ys[1:]) if F(a) * F(b) < 0]


VMi = mises()


# chain of 3 masses on 4 rods .6 between (0,0),(1.6,-.2): unknown angles; forces
def chain():
    m = [1.0, 2.0, 1.5]
    L = mp.mpf("0.6")

    def f(H, V):  # tension horizontal H const, vertical in rod i: V - sum
        x = y = mp.mpf(0)
        v = V
        out = []
        for i in range(4):
            T = mp.sqrt(H * H + v * v)
            x += L * H / T
            y += -L * v / T
            out.append((x, y, T))
            if i < 3:
                v = v - m[i] * g
        return out

    s = mp.findroot(lambda H, V: [f(H, V)[-1][0] - mp.mpf("1.6"), f(H, V)[-1][1] + mp.mpf("0.2")], (8.0, 20.0))
    return [tuple(map(float, o)) for o in f(s[0], s[1])]


CH = chain()


# gyrocompass
def gyroc(A=0.02, C=0.035, s=2000.0, O=7.292115e-5, lat=radians(55)):
    c = O * cos(lat)
    return sqrt((C * (s + c) * c - A * c * c) / A)


# falling body in a rotating frame
def fall(t, h=100.0, O=0.05, lat=radians(40)):
    # axes lab: x east,y north,z up ; omega=(0,O cos,O sin); uniform g field in frame -z ; plus centrifugal about lab origin
    W = np.array([[0, -O * sin(lat), O * cos(lat)], [O * sin(lat), 0, 0], [-O * cos(lat), 0, 0]])
    A = np.zeros((7, 7))
    A[:3, 3:6] = np.eye(3)
    A[3:6, :3] = -W @ W
    A[3:6, 3:6] = -2 * W
    A[5, 6] = -g
    return expm(A * t) @ np.array([0, 0, h, 0, 0, 0, 1])


# charged particle: B(x)=B0(1+x/L)
def charge(t):
    f = lambda t, y: [y[2], y[3], 2 * (0.8 * (1 + y[0] / 0.5) * y[3]), 2 * (-0.8 * (1 + y[0] / 0.5) * y[2] + 0.3)]
    return ode(f, [0, 0, 0.1, 0], t)


QC = charge(10.0)


# dumbbell libration in circular orbit: th''+3 O^2 sin th cos th =0 amplitude a -> T
def dumb(a=radians(60), O=0.5):
    return 4 * float(mp.ellipk(sin(a) ** 2)) / (sqrt(3) * O)


# Kovalevskaya - integrals only. gimbals
def gimb():
    t = sp.symbols("t")
    a, b = [sp.Function(n)(t) for n in "ab"]
    # outer gimbal angle a about z, inner b about x, rotor spin c (cyclic): rotor axis y of inner. gravity none; torque none; mass imbalance: weight at inner along y: m g l sin b with z vertical
    Jo, Ixx, Iyy, Izz, A, C, ml = [sp.Rational(v) for v in ("0.01", "0.003", "0.004", "0.0035", "0.006", "0.01", "0.05")]
    ad, bd = a.diff(t), b.diff(t)
    # inner frame rates: wx=b', wy=a' sin b, wz=a' cos b  (Rz(a)Rx(b))
    wx, wy, wz = bd, ad * sp.sin(b), ad * sp.cos(b)
    H = sp.Rational(3)  # C*(c'+wy)=H conserved
    T = Jo * ad**2 / 2 + (Ixx * wx**2 + Iyy * wy**2 + Izz * wz**2) / 2 + A * (wx**2 + wz**2) / 2
    L = T + H * wy - ml * sp.Rational(981, 100) * sp.sin(b)  # Routhian (linear gyroscopic term)
    ax, bx, av, bv, B = sp.symbols("ax bx av bv B")
    eq = [sp.diff(L.diff(q.diff(t)), t) - L.diff(q) for q in (a, b)]
    eq = [e.doit().subs({a.diff(t, 2): ax, b.diff(t, 2): bx}).subs({ad: av, bd: bv}).subs({b: B}) for e in eq]
    s = sp.solve(eq, [ax, bx])
    F = sp.lambdify((B, av, bv), [s[ax], s[bx]])
    return lambda T: ode(lambda t, y: [y[2], y[3], *F(y[1], y[2], y[3])], [0, 0.3, 0.4, 0], T)


GM = gimb()(1.5)


def engine():
    r, l = 0.1, 0.3

    def kin(f):
        ps = asin(r * sin(f) / l)
        dp = r * cos(f) / (l * cos(ps))
        ddp = (-r * sin(f) / l + sin(ps) * dp * dp) / cos(ps)
        ds = -r * sin(f) - l * sin(ps) * dp
        dds = -r * cos(f) - l * (cos(ps) * dp * dp + sin(ps) * ddp)
        c = 0.12
        gx = -r * sin(f) - c * sin(ps) * dp
        gy = r * cos(f) - c * cos(ps) * dp
        hx = -r * cos(f) - c * (cos(ps) * dp * dp + sin(ps) * ddp)
        hy = -r * sin(f) - c * (-sin(ps) * dp * dp + cos(ps) * ddp)
        J = 0.6 + 2 * (gx * gx + gy * gy) + 0.02 * dp * dp + 3 * ds * ds
        dJ = 2 * (2 * (gx * hx + gy * hy) + 0.02 * dp * ddp + 3 * ds * dds)
        return ds, J, dJ

    def R(f, y):
        w = y[0]
        ds, J, dJ = kin(f)
        return [(-900 * (1 + sin(f)) * ds - 1.5 * w - 0.5 * dJ * w * w) / (J * w), 1 / w]

    P = lambda w: ode(R, [w, 0], 2 * pi)
    w = 30.0
    for _ in range(10):
        h = 1e-4
        a = P(w)[0]
        d = (P(w + h)[0] - P(w - h)[0]) / 2 / h
        w -= (a - w) / (d - 1)

    # multiplier by the variational integral: d ln(dw)/dphi
    def Rv(f, y):
        w = y[0]
        ds, J, dJ = kin(f)
        F = -900 * (1 + sin(f)) * ds
        return [R(f, y)[0], (-F / w**2 - 0.5 * dJ) / J]

    return w, P(w)[1], exp(ode(Rv, [w, 0], 2 * pi)[1])


EN = engine()


# section, claim, value
TABLE = [
    ("Meissner's equation", "in the text", lambda: MT),
    ("Meissner's equation", "multipliers.0.re", lambda: MT / 2),
    ("Duffing's oscillator, forced", "start.x", lambda: DU[0]),
    ("Duffing's oscillator, forced", "start.x'", lambda: DU[1]),
    ("Duffing's oscillator, forced", "multipliers.0.abs", lambda: abs(DM[0])),
    ("Duffing's oscillator, forced", "multipliers.1.abs", lambda: abs(DM[1])),
    ("Van der Pol's oscillator, entrained", "start.x", lambda: VD[0]),
    ("Van der Pol's oscillator, entrained", "start.x'", lambda: VD[1]),
    ("Van der Pol's oscillator, entrained", "multipliers.0.abs", lambda: max(abs(VM))),
    ("Van der Pol's oscillator, entrained", "multipliers.1.abs", lambda: min(abs(VM))),
    ("Rayleigh's oscillator", "in the text", lambda: RT),
    ("Rayleigh's oscillator", "period", lambda: RT),
    ("A child on a swing", "multipliers.0.abs", lambda: SW[1]),
    ("A child on a swing", "multipliers.1.abs", lambda: SW[0]),
    ("Forced oscillation with dry friction", "greatest x", lambda: DH),
    ("Forced oscillation with dry friction", "least x", lambda: -DH),
    ("A press over a turn", "period", lambda: PR[1]),
    ("A press over a turn", "f'(0)", lambda: PR[0]),
    ("A press over a turn", "multipliers.1.abs", lambda: PR[2]),
    ("Porter's governor", "equilibria[1].coordinates.a", lambda: -porter(18.0)[0]),
    ("Porter's governor", "equilibria[3].coordinates.a", lambda: porter(18.0)[0]),
    ("Porter's governor", "modes[1].omega", lambda: porter(18.0)[1]),
    ("Porter's governor", "modes[2].omega", lambda: porter_free(18.0)),
    ("A magnetic pendulum", "x", lambda: MG[0]),
    ("A magnetic pendulum", "y", lambda: MG[1]),
    ("A magnetic pendulum", "modes[1].omega", lambda: MG[2][0]),
    ("A magnetic pendulum", "modes[2].omega", lambda: MG[2][1]),
    ("A truss that snaps through", "equilibria[1].coordinates.y", lambda: VMi[0]),
    ("A truss that snaps through", "equilibria[2].coordinates.y", lambda: VMi[1]),
    ("A truss that snaps through", "equilibria[3].coordinates.y", lambda: VMi[2]),
    ("A hanging chain of four rods", "x1", lambda: CH[0][0]),
    ("A hanging chain of four rods", "y1", lambda: CH[0][1]),
    ("A hanging chain of four rods", "x2", lambda: CH[1][0]),
    ("A hanging chain of four rods", "y3", lambda: CH[2][1]),
    ("A hanging chain of four rods", "force(r1)", lambda: CH[0][2]),
    ("A hanging chain of four rods", "force(r4)", lambda: CH[3][2]),
    ("A gyrocompass", "modes[1].omega", lambda: gyroc()),
    ("A fall in a turning room", "x(4)", lambda: fall(4.0)[0]),
    ("A fall in a turning room", "y(4)", lambda: fall(4.0)[1]),
    ("A fall in a turning room", "z(4)", lambda: fall(4.0)[2]),
    ("A charge in crossed fields", "x(10)", lambda: QC[0]),
    ("A charge in crossed fields", "y(10)", lambda: QC[1]),
    ("A charge in crossed fields", "y'(10)", lambda: QC[3]),
    ("Libration of a dumbbell", "event 2", lambda: dumb()),
    ("Libration of a dumbbell", "th(@{repr(dumb())})", lambda: repr(dumb())),
    ("Libration of a dumbbell", "th(@{repr(dumb())})", lambda: pi / 3),
    ("A gyroscope in gimbals", "a(1.5)", lambda: GM[0]),
    ("A gyroscope in gimbals", "b(1.5)", lambda: GM[1]),
    ("A gyroscope in gimbals", "a'(1.5)", lambda: GM[2]),
    ("A gyroscope in gimbals", "b'(1.5)", lambda: GM[3]),
    ("An engine against a viscous load", "period", lambda: EN[1]),
    ("An engine against a viscous load", "f'(0)", lambda: EN[0]),
    ("An engine against a viscous load", "multipliers.1.abs", lambda: EN[2]),
]

if __name__ == "__main__":
    for section, claim, value in TABLE:
        print(f"{section} / {claim} = {value()}")
