"""Closed forms with elliptic functions: pendulum, spherical pendulum, free rigid body, top. mpmath, 40 digits.

Run: python elliptic.py. Sources: Landau and Lifshitz, Mechanics, sections 11, 14, 35, 37; Whittaker, Analytical Dynamics, sections 44, 71-73.
"""
from mpmath import acos, asin, cos, cosh, ellipfun, ellipk, mp, mpf, pi, polyroots, sin, sqrt, tanh, degrees, radians, quad, atan2

mp.dps = 40
g = mpf("9.81")


def show(name, t, value):
    print(f"{name}({t}) = {mp.nstr(value, 18)}")


def pendulum(l, amplitude):
    """phi = 2 asin(k sn(K - w t)), k = sin(a/2), released from rest at amplitude a; period 4 K/w."""
    w, k = sqrt(g / l), sin(amplitude / 2)
    K = ellipk(k**2)
    print(f"# pendulum l = {l}, amplitude {mp.nstr(degrees(amplitude), 6)} deg: period {mp.nstr(4 * K / w, 18)}, ratio to small {mp.nstr(2 * K / pi, 18)}")
    for t in ("0.5", "1", "2.5", "5", "10"):
        show("phi", t, 2 * asin(k * ellipfun("sn", K - w * mpf(t), k**2)))
    for j in (1, 2, 3):
        print(f"# zero {j} at {mp.nstr((2 * j - 1) * K / w, 18)}")


def rotating_pendulum(l, rate):
    """phi'(0) = rate > 2 w, phi(0) = 0: phi = 2 am(rate t/2, k), k = 2 w/rate, so sin(phi/2) = sn, phi' = rate dn."""
    w = sqrt(g / l)
    k = 2 * w / rate
    K = ellipk(k**2)
    print(f"# rotating pendulum: time of a turn {mp.nstr(4 * K / rate, 18)}")
    for t in ("0.5", "1", "2", "4"):
        u = rate * mpf(t) / 2
        turns = mp.floor((u + K) / (2 * K))
        am = asin(ellipfun("sn", u - 2 * K * turns, k**2)) + pi * turns
        show("phi", t, 2 * am)
        show("phi'", t, rate * ellipfun("dn", u, k**2))


def spherical():
    """u = cos theta (downwards): u'^2 = 2 (w^2 u + E)(1 - u^2) - h^2; u = u2 - (u2 - u1) cn-free form u1 + (u2 - u1) sn^2."""
    l = mpf("0.8")
    th1, th2 = pi / 3, pi / 6
    w2 = g / l
    u1, u2 = cos(th1), cos(th2)
    h2 = 2 * w2 * (u2 - u1) / (1 / sin(th2) ** 2 - 1 / sin(th1) ** 2)
    # third root: -2 w2 u^3 - 2 E u^2 + 2 w2 u + 2 E - h2 = 0 has the sum of products of pairs equal to -1
    u3 = -(1 + u1 * u2) / (u1 + u2)
    k2 = (u2 - u1) / (u2 - u3)
    p = sqrt(w2 * (u2 - u3) / 2)
    K = ellipk(k2)
    print(f"# spherical pendulum: theta returns with the period {mp.nstr(2 * K / p, 18)}")
    for t in ("0.25", "0.5", "1", "2", "5", "10"):
        # starts at u1: sn measured from u2 backwards by K
        u = u2 - (u2 - u1) * ellipfun("sn", K - p * mpf(t), k2) ** 2
        show("theta", t, acos(u))


def free_body():
    """Landau and Lifshitz (37.10): I1 < I2 < I3, M^2 > 2 E I2."""
    I1, I2, I3 = mpf(1), mpf(2), mpf(3)
    p0, r0 = mpf(1), mpf(1)
    M2 = (I1 * p0) ** 2 + (I3 * r0) ** 2
    E2 = I1 * p0**2 + I3 * r0**2
    assert M2 > E2 * I2
    k2 = (I2 - I1) * (E2 * I3 - M2) / ((I3 - I2) * (M2 - E2 * I1))
    n = sqrt((I3 - I2) * (M2 - E2 * I1) / (I1 * I2 * I3))
    q0 = sqrt((E2 * I3 - M2) / (I2 * (I3 - I2)))
    M = sqrt(M2)
    print(f"# free body: period of the angular velocity {mp.nstr(4 * ellipk(k2) / n, 18)}, k2 = {mp.nstr(k2, 12)}, M = {mp.nstr(M, 18)}")
    def omega(t):
        u = n * t
        return p0 * ellipfun("cn", u, k2), q0 * ellipfun("sn", u, k2), r0 * ellipfun("dn", u, k2)
    for t in ("0.5", "1", "2", "5", "10"):
        t_ = mpf(t)
        p, q, r = omega(t_)
        show("omega_x", t, p)
        show("omega_y", t, q)
        show("omega_z", t, r)
        show("theta", t, acos(I3 * r / M))
        rate = lambda s: M * (I1 * omega(s)[0] ** 2 + I2 * omega(s)[1] ** 2) / ((I1 * omega(s)[0]) ** 2 + (I2 * omega(s)[1]) ** 2)
        show("psi", t, quad(rate, [i * t_ / 20 for i in range(21)]))


def cuspidal_top():
    """Lagrange's top started at rest in psi and theta: nutation between theta_0 and theta_1, u = cos theta between u1 < u0.

    A u'^2 = (1 - u^2) 2 m g l (u0 - u) - (C nu)^2 (u0 - u)^2/A, so the other turning point solves 1 - u^2 = 2 lam (u0 - u), lam = (C nu)^2/(4 A m g l)."""
    m, l, A, C = mpf("0.3"), mpf("0.04"), mpf("7e-4"), mpf("2.5e-4")
    nu = mpf(150)
    u0 = cos(radians(40))
    lam = (C * nu) ** 2 / (4 * A * m * g * l)
    u1 = lam - sqrt(lam**2 - 2 * lam * u0 + 1)
    print(f"# top with cusps, nu = 150: largest theta {mp.nstr(acos(u1), 18)}")
    u3 = lam + sqrt(lam**2 - 2 * lam * u0 + 1)
    k2 = (u0 - u1) / (u3 - u1)
    p = sqrt(m * g * l / (2 * A) * (u3 - u1))
    K = ellipk(k2)
    print(f"# period of nutation {mp.nstr(2 * K / p, 18)}")
    for t in ("0.1", "0.5", "1", "2"):
        show("theta", t, acos(u1 + (u0 - u1) * ellipfun("sn", K + p * mpf(t), k2) ** 2))


pendulum(mpf(1), radians(60))
pendulum(mpf(1), radians(170))
rotating_pendulum(mpf(1), mpf(7))
spherical()
free_body()
cuspidal_top()
