"""Averaged theory of an unbalance and of a pendulum on an elastic foundation, by its closed form, and the motions beside it.

V(W) = sum over the directions of b W A^2/2, A = s W^2/sqrt((c - M W^2)^2 + b^2 W^2), s the static moment of what turns (m e, m l). Balance: k (idle - W) = V(W).
Folds: extremes of idle(W) = W + V(W)/k; for the pendulum the mass enters s and M, and a fold over m is V = k (idle - W), V' = -k.
"""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar, fsolve

def v(w, s, mass, directions, b):
    return sum(b * w / 2 * (s * w * w) ** 2 / ((c - mass * w * w) ** 2 + (b * w) ** 2) for c in directions)

# gallery/limited-motor
motor = lambda w: v(w, 0.5 * 0.04, 10.5, [4200.0], 12.0)
idle = lambda w: w + motor(w) / 0.05
up = minimize_scalar(lambda w: -idle(w), bounds=(19, 20.5), method="bounded", options={"xatol": 1e-13})
down = minimize_scalar(idle, bounds=(20.5, 22), method="bounded", options={"xatol": 1e-13})
print("motor folds", repr(-up.fun), up.x, repr(down.fun), down.x)
balance = lambda w, o=22.0: idle(w) - o
print("motor at 22", [repr(brentq(balance, a, b, xtol=1e-14)) for a, b in ((15, up.x), (up.x, down.x), (down.x, 25))])
print("V(19.5), V(20), V(30)", [repr(float(motor(w))) for w in (19.5, 20.0, 30.0)])

# gallery/pendulum-on-shaft, card P3
K, L, B, C = 1e-4, 0.05, 25.0, [4e5, 1e5]
pend = lambda w, m: v(w, m * L, 10 + m, C, B)
off = lambda w, m: K * (300 - w) - pend(w, m)
def roots(m):
    g = np.linspace(60, 299.9, 200001)
    s = off(g, m)
    return [brentq(off, g[i], g[i + 1], args=(m,), xtol=1e-13) for i in range(len(g) - 1) if s[i] * s[i + 1] < 0]
for m in (0.01, 0.03):
    print("pendulum", m, roots(m))
def fold(w0, m0):
    d = 1e-4
    f = lambda z: [off(z[0], z[1]) * 1e4, (off(z[0] + d, z[1]) - off(z[0] - d, z[1])) / (2 * d) * 1e4]
    return fsolve(f, [w0, m0], xtol=1e-13)
for w0, m0 in ((200, 0.005), (100, 0.02)):
    print("fold", [repr(float(z)) for z in fold(w0, m0)])

# motions of the motor from the start of the file (18 rad/s), 60 s; the mean speed over the last fifth
def motion(o):
    M, me, J, c, b, k = 10.5, 0.02, 0.02 + 0.5 * 0.04**2, 4200.0, 12.0, 0.05
    def f(t, z):
        x, p, u, w = z
        s, q = np.sin(p), np.cos(p)
        # (M + m) x'' - me (p'' sin p + p'^2 cos p) + b x' + c x = 0, (J + m e^2) p'' - me x'' sin p = k (o - p')
        return [u, w, *np.linalg.solve([[M, -me * s], [-me * s, J]], [me * w * w * q - b * u - c * x, k * (o - w)])]
    z = solve_ivp(f, (0, 60), [0, 0, 0, 18.0], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=[48, 60]).y
    return (z[1, 1] - z[1, 0]) / 12
for o in (18.0, 22.0, 30.0):
    print("motion", o, repr(float(motion(o))), [brentq(balance, a, b, args=(o,), xtol=1e-13) for a, b in ((10, up.x), (up.x, down.x), (down.x, 60)) if (idle(a) - o) * (idle(b) - o) < 0])
