"""Boundaries of tongues of Mathieu's equation x'' + 2h x' + (d - 2e cos 2t) x = 0, by their definitions.

h = 0: scipy.special.mathieu_a, mathieu_b. h > 0: det M = exp(-2 h pi), the multiplier on the boundary of the principal tongue is -1: tr M = -(1 + det M); M from DOP853 over one period with
tolerances of 3e-14. The tip of the tongue is the least e for which max over d of -tr M - (1 + det M) is 0.
"""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar
from scipy.special import mathieu_a, mathieu_b
H = 0.1
def trace(d, e, h):
    f = lambda t, z: [z[1], -2*h*z[1] - (d - 2*e*np.cos(2*t))*z[0], z[3], -2*h*z[3] - (d - 2*e*np.cos(2*t))*z[2]]
    z = solve_ivp(f, (0, np.pi), [1, 0, 0, 1], method="DOP853", rtol=3e-14, atol=3e-14).y[:, -1]
    return z[0] + z[3]
def excess(d, e):
    return -trace(d, e, H) - 1 - np.exp(-2*H*np.pi)
if __name__ == "__main__":
    for q in (0.5, 1.5, 2.0):
        print("q", q, [("a0", repr(float(mathieu_a(0, q))))] + [(c + str(n), repr(float(f(n, q)))) for n in (1, 2, 3) for c, f in (("b", mathieu_b), ("a", mathieu_a))])
    for e in (0.5, 1.0):
        top = minimize_scalar(lambda d: -excess(d, e), bounds=(0.3, 2.0), method="bounded", options={"xatol": 1e-9}).x
        print("e", e, repr(brentq(excess, top - 2*e, top, args=(e,), xtol=1e-14)), repr(brentq(excess, top, top + 2*e, args=(e,), xtol=1e-14)))
    def height(e):
        return -minimize_scalar(lambda d: -excess(d, e), bounds=(0.8, 1.2), method="bounded", options={"xatol": 1e-10}).fun
    e = brentq(height, 0.19, 0.21, xtol=1e-13)
    print("tip", repr(e), minimize_scalar(lambda d: -excess(d, e), bounds=(0.8, 1.2), method="bounded", options={"xatol": 1e-10}).x)
