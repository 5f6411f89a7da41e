"""Right answers of courses, from equations reduced by hand; nothing comes from strutt. `python courses.py` prints them for a few variants.

The data are those of the tables beside the courses (gallery/courses), read here again, with the formulas of the course for n = 3.
"""
import csv
import math
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

G = 9.81
COURSES = Path(__file__).resolve().parents[4] / "gallery" / "courses"
n = 3


def rows(course, table):
    lines = [l for l in open(COURSES / course / table) if not l.startswith("#")]
    num = lambda v: float(v) if v not in ("", None) else 0.0
    return {int(r["variant"]): {k: (v if k in ("q2", "flags") else num(v)) for k, v in r.items() if k} for r in csv.DictReader(lines)}


def motion(f, y0, end, events=()):
    return solve_ivp(f, (0, end), y0, method="DOP853", rtol=1e-13, atol=1e-14, dense_output=True, events=events)


def extreme(value, end, switches=()):
    """Greatest value on [0, end] and its place."""
    grid = np.unique(np.concatenate([np.linspace(0, end, 4001), [s for s in switches if 0 < s < end]]))
    values = [value(t) for t in grid]
    i = int(np.argmax(values))
    best = (values[i], grid[i])
    for a, b in ((max(i - 1, 0), i), (i, min(i + 1, len(grid) - 1))):
        if a < b:
            found = minimize_scalar(lambda t: -value(t), bounds=(grid[a], grid[b]), method="bounded", options={"xatol": 1e-13})
            best = max(best, (-found.fun, found.x))
    return best


def yoke(N, load, table, course):
    """(J0 + J1 cos^2 phi) phi'' - J1 sin phi cos phi phi'^2 = M0 and load reduced to the flywheel."""
    p = rows(course, table)[N]
    r1, R1, R4, r4, rho4 = 0.06, 0.36, 0.24, 0.08, 0.12
    tau, k, I1 = 0.24 * (1 + 0.01 * N), p["kr"] * (1 + 0.01 * N), p["I1r"] + 0.1 * n
    pulley = p["I1r"] < 1.9
    R3, m3, m4, m2 = (p["R3"], p["m3"], p["m4"], p["m2"]) if pulley else (R1, 0.0, p["m3"], p["m2"])
    M0, i, A = abs(p["M0"]), R1 / R3, (R4 + r4) / R4
    J0, J1 = I1 + m3 * R1 * R1 / 2, (m2 + m4 * (1 + rho4**2 / R4**2)) * r1 * r1
    share = p["amplitude"] / A

    def force(v):
        if load == "viscous":
            return -(1 + 0.01 * N) * (p["mu1r"] + p["mu2r"] / r1**2) * share**2 * v
        F0 = (p["Fr"] + p["Mr"] / r1) * share
        return -F0 * np.sign(v) if load == "dry" else (F0 if v <= 0 else 0.0)

    def eps(phi, w):
        c, s = math.cos(phi), math.sin(phi)
        Q = i * M0 - i * i * k * w - (m2 + m4) * G * r1 * c + force(A * r1 * c * w) * A * r1 * c
        return (Q + J1 * s * c * w * w) / (J0 + J1 * c * c)

    # pieces between dead centres, where dry loads jump
    t, state, pieces = 0.0, [p["phi1_0"], 2 * math.pi / tau], []
    while t < tau:
        dead = lambda t, y: math.cos(y[0])
        dead.terminal = True
        sol = solve_ivp(lambda t, y: [y[1], eps(*y)], (t, tau), state, method="DOP853", rtol=1e-13, atol=1e-14, dense_output=True, events=dead)
        pieces.append((t, sol.t[-1], sol.sol))
        t, state = sol.t[-1], list(sol.y[:, -1])
        if t < tau:
            state[0] += 1e-13  # leave the dead centre
    at = lambda t: next(s for a, b, s in pieces if t <= b)(t)
    ends = [b for _, b, _ in pieces]
    w_max, w_min = extreme(lambda t: at(t)[1], tau, ends)[0], -extreme(lambda t: -at(t)[1], tau, ends)[0]
    e, te = extreme(lambda t: abs(eps(*at(t))), tau, ends)
    phi, w = at(te)
    acc = eps(phi, w)
    S = (abs(M0) - i * k * w - m3 * R3 * R3 / 2 * i * acc) / R3
    # the pin lifts the yoke and the roller, turns the roller, drives the rod
    a2 = r1 * (math.cos(phi) * acc - math.sin(phi) * w * w)
    pin = (m2 + m4 * (1 + rho4**2 / R4**2)) * a2 + (m2 + m4) * G - A * force(A * r1 * math.cos(phi) * w)
    end = at(tau)
    return dict(phi=end[0], w=end[1], w_max=w_max, w_min=w_min, delta=2 * (w_max - w_min) / (w_max + w_min), eps=e, t_eps=te, S=S, N_E=pin)


def rotor(N):
    """I omega' = M0 - k1 omega - k2 omega^2: hyperbolic tangent; reactions from the balance of moments about A."""
    p = rows("rotor", "table13.csv")[N]
    m1, m2 = p["m1r"] * (1 + 0.01 * N), p["m2r"] * (1 + 0.01 * N)
    a, b, c = p["ar"] + 0.001 * n, p["br"] + 0.001 * N, p["cr"] + 0.001 * n
    M0, k1, k2 = 100 * p["M0r"] * (1 + 0.01 * n), p["k1r"] + 0.01 * N, 0.01 * p["k2r"] * (1 + 0.01 * N)
    e1, beta, al = p["O1C1r"] * (1 + 0.01 * N) * 1e-3, 0.68, p["alpha"]
    R1, R2 = p["R1"], p["R2"]
    Ixz = m1 * e1 * math.sin(beta) * a + m2 * R2**2 / 4 * math.sin(al) * math.cos(al)
    Iyz = -m1 * e1 * math.cos(beta) * a
    Izz = m1 * (R1**2 / 2 + e1**2) + m2 * R2**2 / 4 * (1 + math.cos(al) ** 2)
    root = math.sqrt(k1 * k1 + 4 * k2 * M0)
    ws, wu = (root - k1) / (2 * k2), (-root - k1) / (2 * k2)
    q = (p["omega0"] - ws) / (p["omega0"] - wu)

    def w(t):
        r = q * math.exp(-root * t / Izz)
        return (ws - wu * r) / (1 - r)

    def reactions(t):
        o = w(t)
        e = (M0 - k1 * o - k2 * o * o) / Izz
        XB, YB = -(Iyz * e + Ixz * o * o) / b, (Ixz * e - Iyz * o * o) / b
        # the mass centre: wheel 1 off the axis
        x, y = m1 * e1 * math.sin(beta), -m1 * e1 * math.cos(beta)
        return -x * o * o - y * e - XB, -y * o * o + x * e - YB, XB, YB, e

    tau, m = p["tau"], m1 + m2
    XA, YA, XB, YB, _ = reactions(tau)
    size = lambda i: extreme(lambda t: math.hypot(reactions(t)[i], reactions(t)[i + 1]), tau)[0]
    return dict(I_xz=Ixz, I_yz=Iyz, I_zz=Izz, x_C=1e3 * m1 * e1 * math.sin(beta) / m, y_C=-1e3 * m1 * e1 * math.cos(beta) / m, w_s=ws, w=w(tau),
                eps=reactions(0)[4], X_A=XA, Y_A=YA, X_B=XB, Y_B=YB, R_A=size(0), R_B=size(2))


def thread(N):
    """Card D7: m_x x'' and the pendulum of varying length."""
    p = rows("thread-pendulum", "table14.csv")[N]
    old = dict(r2=0.114, rho2=0.12, R3=0.15, r3=0.1, rho3=0.1)
    for key, value in old.items():
        p[key] = p[key] or value
    m1, m2, m3, m4 = 100 + n, p["m2r"] + n, p["m3r"] + N, 100 + N
    R2, r2, R3, r3, l0, al = p["R2r"] + 0.01 * N, p["r2"], p["R3"], p["r3"], p["l0"], math.pi / 3
    lam = (R2 - r2) / r2
    mx = m1 * lam**2 + m2 * (1 + p["rho2"] ** 2 / r2**2) + m3 * p["rho3"] ** 2 / R3**2 + m4 * r3**2 / R3**2
    M = G * r2 * (m4 * math.sin(al) * r3 / R3 - m1 * lam)
    v = p["dq2_0"] * (1 if p["is_length"] else r2)

    def acc(s):
        phi, x, w, u = s
        l = l0 - lam * x
        a = (m1 * G * lam * (1 - math.cos(phi)) - m1 * lam * l * w * w) / mx
        return [w, u, (2 * lam * u * w - G * math.sin(phi)) / l, a]

    tau = 2.4 * (1 + 0.01 * N)
    sol = motion(lambda t, s: acc(s), [p["q1_0"], 0, p["dq1_0"], v], tau)
    at = sol.sol

    def forces(t):
        s = at(t)
        phi, x, w, u = s
        a = acc(s)[3]
        S1 = m1 * (G * math.cos(phi) + (l0 - lam * x) * w * w + lam * a)
        S4 = m4 * (G * math.sin(al) - a * r3 / R3)
        # roller about its centre: m2 rho2^2 phi2'' with x = -r2 phi2 (clockwise positive turn moves it to the right)
        SCH = (S4 * r3 - m3 * p["rho3"] ** 2 * a / R3) / R3
        F = m2 * a - SCH + 0.0
        return S1, S4, F - horizontal(S1)

    def horizontal(S1):
        # the thread leaves the rim along the rail and pulls the roller with S1 towards the ring
        return S1

    grid = np.linspace(0, tau, 20001)
    phis = [at(t)[0] for t in grid]
    roots = [0.0] if p["q1_0"] == 0 else []
    for a, b in zip(range(len(grid) - 1), range(1, len(grid))):
        if phis[a] * phis[b] < 0:
            roots.append(brentq(lambda t: at(t)[0], grid[a], grid[b], xtol=1e-14))
    t0 = roots[1]
    end = at(tau)
    return dict(M=M, m_x=mx, t_0=t0, S1_0=forces(t0)[0], phi=end[0], x=end[1], S1=extreme(lambda t: forces(t)[0], tau)[0],
                S4=extreme(lambda t: forces(t)[1], tau)[0], F_P=extreme(lambda t: abs(forces(t)[2]), tau)[0])


def manipulator(N):
    """Card D3: closure differentiated, moments by virtual power."""
    p = rows("manipulator", "table8.csv")[N]
    r1, r2, r3 = p["r1r"] + 0.01 * n, p["r2r"] + 0.01 * N, p["r3r"] + 0.01 * N
    v, tau, m = math.pi / N, 0.24 * N, 10 + N
    start = [0.5, 5.7, 5.1] if p["example"] else [p["phi1r"], p["phi2r"], p["phi3r"]]
    q0 = np.array(start) + 0.01 * N
    w = math.pi / tau
    vy = lambda t: v * math.sin(w * t)

    def matrix(q):
        # A = D - r3 e3 - r2 e2 - 2... : bars from D back to O, to B, to A; C on the horizontal guide
        s, c = np.sin(q), np.cos(q)
        ax = np.array([3 * r1 * s[0], r2 * s[1], r3 * s[2]])
        ay = -np.array([3 * r1 * c[0], r2 * c[1], r3 * c[2]])
        cy = -np.array([r1 * c[0], r2 * c[1], r3 * c[2]])
        return np.array([ax, ay, cy])

    rates = lambda t, q: np.linalg.solve(matrix(q), [0, vy(t), 0])
    sol = motion(lambda t, q: rates(t, q), q0, tau)
    t = tau / 3
    q = sol.sol(t)
    o = rates(t, q)
    vC = np.array([r1 * math.sin(q[0]), r2 * math.sin(q[1]), r3 * math.sin(q[2])]) @ o
    # virtual power with the guide at C: M_B (d1 - d2) + M_D d3 = F dy_A for all d with dy_C = 0; x_A free as well
    F = m * (G + v * w * math.cos(w * t))
    Jx, Jy, Jc = matrix(q)
    # unknowns M_B, M_D, Y_C
    lhs = np.array([[1, 0, Jc[0]], [-1, 0, Jc[1]], [0, 1, Jc[2]]])
    MB, MD, YC = np.linalg.solve(lhs, F * Jy)
    return dict(w1=o[0], w2=o[1], w3=o[2], v_C=vC, M_B=MB, M_D=MD, N_B=MB * (o[0] - o[1]), N_D=MD * o[2], A=m * G * 0.48)


def slider_crank(N):
    """Card P1: J(phi) from the transfer functions of the closure, psi = c R^2/J, traces over one turn by steps of Hill's and Mathieu's equation."""
    p = rows("slider-crank-spring", "variants.csv")[N]
    w, Rd, R = p["omega1 [rad/s]"], p["R_d [m]"], p["R [m]"]
    l1, l2, s1, s2, c = 0.032, 0.142, 0.015, 0.064, 7800.0
    m1, m2, m3, md, J1, J2 = 1.12, 0.26, 2.1, 0.8, 1.6e-4, 9.5e-6

    def J(phi):
        sin, cos = math.sin(phi), math.cos(phi)
        sb = -l1 / l2 * sin  # of the rod
        U21 = -l1 * cos / (l2 * math.sqrt(1 - sb * sb))
        U31 = -l1 * sin - l2 * sb * U21
        x, y = -l1 * sin - s2 * sb * U21, l1 * cos + s2 * math.sqrt(1 - sb * sb) * U21
        return J1 + m1 * s1**2 + md * Rd**2 + m2 * (x * x + y * y) + J2 * U21**2 + m3 * U31**2

    top = extreme(J, math.pi)[0]
    low, high = c * R * R / top, c * R * R / min(J(0), J(math.pi))
    d, e = 2 * (high + low) / w**2, (high - low) / w**2

    def trace(psi):
        sol = motion(lambda t, y: [y[1], -psi(t) * y[0], y[3], -psi(t) * y[2]], [1, 0, 0, 1], 2 * math.pi / w).y
        return sol[0, -1] + sol[3, -1]

    M, H = trace(lambda t: w * w / 4 * (d - 2 * e * math.cos(w * t))), trace(lambda t: c * R * R / J(w * t))
    return dict(f_0=R * math.sqrt(c / J(0)) / (2 * math.pi), J_0=J(0), mu=2 * e / d, d=d, e=e, v_1=int(e * e > (1 - d) ** 2), tr_M=M,
                v_2=int(abs(M) > 2), tr_H=H, v_3=int(abs(H) > 2))


if __name__ == "__main__":
    made = [("scotch-yoke", lambda N: yoke(N, "viscous", "table10.csv", "scotch-yoke")),
            ("scotch-yoke-dry", lambda N: yoke(N, "dry", "table11.csv", "scotch-yoke-dry")),
            ("scotch-yoke-oneway", lambda N: yoke(N, "oneway", "table12.csv", "scotch-yoke-oneway")),
            ("rotor", rotor), ("thread-pendulum", thread), ("manipulator", manipulator), ("slider-crank-spring", slider_crank)]
    import sys
    for name, make in made:
        if len(sys.argv) > 1 and sys.argv[1] != name:
            continue
        print("##", name)
        for N in map(int, sys.argv[2].split(",")) if len(sys.argv) > 2 else (1, 11, 17, 30):
            for key, value in make(N).items():
                print(f"variants[{N}].answers.{key} = {value:.12g}")
