"""Equations of motion of the gallery, derived by hand from Newton's laws or taken from the cards; nothing comes from strutt.

Every machine is a function that returns rows (name, t, value) and events (number, t).
"""
from gmpy2 import cos, exp, mpfr, sin, sqrt

import gmpy2
from integrate import Path, num

G = num("9.81")
PI = gmpy2.const_pi()


class Table:
    def __init__(self, title):
        self.title, self.rows, self.events, self.notes = title, [], [], []

    def add(self, t, **values):
        for name, value in values.items():
            self.rows.append((name, t, value))


# ---- card P3 ------------------------------------------------------------------------------------------------------

def pendulum_on_shaft(m, e="0", times=(1, 5, 10, 15, 20, 30), phi_rate="0"):
    """M x'' + m l phi'' cos phi = ..., solved for the accelerations by hand (Schur complement)."""
    M_h, M_r, m, l, e = num(8), num(2), num(m), num("0.05"), num(e)
    cx, cy, b, k = num("4e5"), num("1e5"), num(25), num("1e-4")
    M = M_h + M_r + m

    def run_up(running):
        def f(t, s):
            x, y, p, vx, vy, w = s
            omega = 30 * t if running else num(300)
            domega = num(30) if running else num(0)
            psi = 15 * t * t if running else 1500 + 300 * (t - 10)
            sp, cp = gmpy2.sin_cos(p)
            fx = m * l * w * w * sp - cx * x - b * vx
            fy = -m * l * w * w * cp - cy * y - b * vy
            if e:
                ss, cs = gmpy2.sin_cos(psi)
                fx += M_r * e * (omega**2 * cs + domega * ss)
                fy += M_r * e * (omega**2 * ss - domega * cs)
            fp = k * (omega - w) - m * G * l * sp
            a = (fp - m * l / M * (cp * fx + sp * fy)) / (m * l * l * (1 - m / M))
            return [vx, vy, w, (fx - m * l * cp * a) / M, (fy - m * l * sp * a) / M, a]
        return f

    table = Table(f"pendulum-on-shaft m = {float(m)} kg, e = {float(e)} m, phi'(0) = {phi_rate}")
    path = Path(run_up(True), 0, [num(0)] * 5 + [num(phi_rate)], "0.01")
    for t in times:
        if path.t < 10 and t > 10:
            path.to(10)
        if path.t == 10:
            path.f = run_up(False)
        x, y, p, vx, vy, w = path.to(t)
        table.add(t, x=x, y=y, phi=p, omega_p=w)
    return table


# ---- card 00 ------------------------------------------------------------------------------------------------------

def oscillator(restart, mu="40"):
    """Closed form of a q'' + b q' + c q = H sin(p t + delta) on each phase; critical, over- and underdamped."""
    a, c, p = num("0.72"), num(72), num(15)
    b, H0 = 4 * num(mu) * num("0.09"), num(12)
    n = b / (2 * a)
    t_s = 4 * 2 * PI / p + 3 / n
    table = Table(f"oscillator mu = {mu}, " + ("phase restarted (published)" if restart else "phase kept"))

    def phase(t0, q0, v0, H):
        start = t0 if restart else num(0)
        u, w = c - a * p * p, b * p              # particular solution S sin + K cos of the angle p (t - start)
        d = u * u + w * w
        S, K = H * u / d, -H * w / d
        def part(t):
            s, k = sin(p * (t - start)), cos(p * (t - start))
            return S * s + K * k, p * (S * k - K * s)
        f0, df0 = part(t0)
        A, B = q0 - f0, v0 - df0
        disc = n * n - c / a
        def q(t):
            x = t - t0
            f, df = part(t)
            if abs(disc) < mpfr("1e-30"):
                C1, C2 = A, B + n * A
                ex = exp(-n * x)
                return ex * (C1 + C2 * x) + f, ex * (C2 - n * (C1 + C2 * x)) + df
            if disc > 0:
                r1, r2 = -n + sqrt(disc), -n - sqrt(disc)
                C1 = (B - r2 * A) / (r1 - r2)
                C2 = A - C1
                return C1 * exp(r1 * x) + C2 * exp(r2 * x) + f, C1 * r1 * exp(r1 * x) + C2 * r2 * exp(r2 * x) + df
            k1 = sqrt(-disc)
            C1, C2 = A, (B + n * A) / k1
            ex, sn, cs = exp(-n * x), sin(k1 * x), cos(k1 * x)
            return ex * (C1 * cs + C2 * sn) + f, ex * ((C2 * k1 - n * C1) * cs - (C1 * k1 + n * C2) * sn) + df
        return q, A, B + n * A

    q, C1, C2 = phase(num(0), num(0), num("1.23"), H0)
    table.notes.append(f"t* = {t_s:.18g}; phase 1 C1 = {C1:.15g}, C2 = {C2:.15g}")
    times = [num("0.1"), num("0.5"), num(1), t_s, num("2.5"), num(3), num("3.5"), 2 * t_s, num("4.2"), num("4.5"), num(5), num(10)]
    for t in sorted(times):
        if t > t_s and not hasattr(table, "two"):
            table.two = True
            q, C1, C2 = phase(t_s, *q(t_s), 2 * H0)
            table.notes.append(f"phase 2 C1 = {C1:.15g}, C2 = {C2:.15g}")
        if t > 2 * t_s and not hasattr(table, "three"):
            table.three = True
            q, C1, C2 = phase(2 * t_s, *q(2 * t_s), num(0))
            table.notes.append(f"phase 3 C1 = {C1:.15g}, C2 = {C2:.15g}")
        x, v = q(t)
        table.add(t, phi=x, **{"phi'": v})
    table.events = [(1, t_s), (2, 2 * t_s)]
    q, _, _ = phase(num(0), num(0), num("1.23"), H0)
    q, _, _ = phase(t_s, *q(t_s), 2 * H0)
    top = max((abs(q(t_s * (1 + num(i) / 4000))[0]), i) for i in range(4001))[1]
    a_, b_ = t_s * (1 + num(top - 1) / 4000), t_s * (1 + num(top + 1) / 4000)
    for _ in range(120):                                # bisection on the rate
        m_ = (a_ + b_) / 2
        a_, b_ = (m_, b_) if q(m_)[1] * q(a_)[1] > 0 else (a_, m_)
    table.notes.append(f"largest |phi| on phase 2: phi = {q(a_)[0]:.15g} at t = {a_:.15g}")
    return table


# ---- card D2 ------------------------------------------------------------------------------------------------------

def blade_particle(mu):
    """Linear equations in t1 = omega t; integrated, since c = 156 makes them stiff but harmless in 48 digits."""
    m, w, r0, y0 = num("1.37e-6"), num(500), num("0.47"), num("0.03")
    s, k = gmpy2.sin_cos(15 * PI / 180)
    c = num(mu) / (m * w)
    f = lambda t, q: [q[2], q[3], -c * q[2] - r0 + q[0] - 2 * s * q[3], -c * q[3] + s * s * q[1] + 2 * s * q[2]]
    normal = lambda q: m * w * w * k * (s * q[1] + 2 * q[2])
    table = Table(f"blade-particle mu = {mu}")
    start = [num(0), y0, 100 / w, -30 / w]
    path = Path(f, 0, start, "0.001")
    for t in ("0.00001", "0.0001", "0.0004912", "0.001", "0.00147"):
        q = path.to(num(t) * w)
        table.add(t, x=q[0], y=q[1], **{"x'": q[2] * w, "y'": q[3] * w}, N=normal(q),
                  F_e=m * w * w * sqrt((r0 - q[0]) ** 2 + (s * q[1]) ** 2), F_c=2 * m * w * w * sqrt(q[2] ** 2 + (s * q[3]) ** 2))
    path = Path(f, 0, start, "0.001")
    if path.until(lambda t, q: q[2], "0.735"):
        table.notes.append(f"largest x at t1 = {path.t:.17g}, t = {path.t / w:.17g}: x = {path.y[0]:.17g}")
    path = Path(f, 0, start, "0.001")
    if path.until(lambda t, q: normal(q), "0.735"):
        table.notes.append(f"N changes sign at t1 = {path.t:.17g}, t = {path.t / w:.17g}: x = {path.y[0]:.17g}, y = {path.y[1]:.17g}")
    return table


# ---- cards D5, D5a, D5b -------------------------------------------------------------------------------------------

def scotch_yoke(load, end="0.2568"):
    """(J phi')' - J_phi phi'^2/2 = Q with J = J0 + J1 cos^2 phi; load(v5, mode) on the rod; switches where cos phi = 0."""
    J0, J1 = num("2.299608"), num("0.126")
    r1, up = num("0.06"), num("0.32") / num("0.24")
    F0 = {"viscous": 0, "dry": num(475), "oneway": num(950)}[load]

    def force(p, w, going_up):
        v5 = r1 * cos(p) * w * up
        if load == "viscous":
            return -309 * v5
        if load == "dry":
            return -F0 if going_up else F0
        return num(0) if going_up else F0

    def rhs(going_up):
        def f(t, q):
            p, w = q
            s, c = gmpy2.sin_cos(p)
            Q = 108 - num("3.424") * w - 31 * G * r1 * c + force(p, w, going_up) * r1 * up * c
            return [w, (Q + J1 * s * c * w * w) / (J0 + J1 * c * c)]
        return f

    def outputs(q, going_up):
        p, w = q
        eps = rhs(going_up)(0, q)[1]
        s, c = gmpy2.sin_cos(p)
        w3 = -4 * w
        I3 = num("7.71") * num("0.09") ** 2 / 2
        S = (I3 * (-4 * eps) - (num(-27) - num("0.214") * w3)) / num("0.09")
        N = 35 * r1 * (c * eps - s * w * w) + 31 * G - force(p, w, going_up) * up
        return {"phi1": p, "omega1": w, "eps1": eps, "S": S, "N": N}

    table = Table("scotch-yoke " + load)
    going_up = True                                   # cos(1.57) > 0
    path = Path(rhs(going_up), 0, [num("1.57"), num("24.5")], "0.001")
    table.add("0", **outputs(path.y, going_up))
    count = 0
    for t in ("0.01", "0.05", "0.1", "0.12", "0.15", "0.2", "0.25", end):
        while load != "viscous" and path.until(lambda _, q: cos(q[0]), t):
            count += 1
            table.events.append((count, path.t))
            before = outputs(path.y, going_up)["eps1"]
            going_up = not going_up
            after = outputs(path.y, going_up)["eps1"]
            table.notes.append(f"switch {count} at {path.t:.17g}: eps1 {before:.15g} -> {after:.15g}, omega1 = {path.y[1]:.17g}")
            path = Path(rhs(going_up), path.t, path.y, "0.0005")
            path.advance(path.t + num("1e-9"))        # leave the root
        path.to(t)
        table.add(t, **outputs(path.y, going_up))
    table.notes.append("smallest omega1 stays far from zero: no sticking (dead centres are passed at speed)")
    if load == "viscous":
        best = None
        path = Path(rhs(True), 0, [num("1.57"), num("24.5")], "0.001")
        slope = lambda t, q: (rhs(True)(t, [q[0] + q[1] * num("1e-12"), q[1] + rhs(True)(t, q)[1] * num("1e-12")])[1]
                              - rhs(True)(t, [q[0] - q[1] * num("1e-12"), q[1] - rhs(True)(t, q)[1] * num("1e-12")])[1])
        while path.until(slope, end):
            o = outputs(path.y, True)
            table.notes.append(f"extremum of eps1 at t = {path.t:.14g}: eps1 = {o['eps1']:.17g}, S = {o['S']:.17g}")
            path = Path(rhs(True), path.t, path.y, "0.0005")
            path.advance(path.t + num("1e-6"))
    return table


# ---- card D6 ------------------------------------------------------------------------------------------------------

def rotor():
    """I eps = M0 - k1 w - k2 w^2 by separation of variables: w = w1 + d/(K exp(d k2 t/I) - 1) with the roots w1 > 0 > w2, d = w1 - w2."""
    M0, k1, k2 = num(1950), num("1.57"), num("0.039")
    m1, m2, m3 = num(47), num(57), num(37)
    R1, R2, R3, e1, e3 = num("0.17"), num("0.2"), num("0.15"), num("4e-4"), num("3e-4")
    al, be, a, b, c = num("0.019"), num("0.68"), num("0.133"), num("0.267"), num("0.093")
    Ixz = m1 * e1 * sin(be) * a + m2 * R2**2 / 4 * sin(al) * cos(al)
    Iyz = -m1 * e1 * cos(be) * a - m3 * e3 * c
    Izz = m1 * (R1**2 / 2 + e1**2) + m2 * R2**2 / 4 * (1 + cos(al) ** 2) + m3 * (R3**2 / 2 + e3**2)
    mass = m1 + m2 + m3
    xC, yC = m1 * e1 * sin(be) / mass, (m3 * e3 - m1 * e1 * cos(be)) / mass
    root = sqrt(k1**2 + 4 * k2 * M0)
    w1, w2 = (-k1 + root) / (2 * k2), (-k1 - root) / (2 * k2)
    d = w1 - w2
    K = (600 - w2) / (600 - w1)                        # (w - w2)/(w - w1) = K exp(d k2 t/I)
    table = Table("rotor")
    table.notes.append(f"I_xz = {Ixz:.17g}, I_yz = {Iyz:.17g}, I_zz = {Izz:.17g}, x_C = {xC:.17g}, y_C = {yC:.17g}, steady speed {w1:.17g}")
    from gmpy2 import log
    for t in ("0", "0.04", "0.08", "0.16", "0.24", "0.36", "0.48"):
        E = K * exp(d * k2 * num(t) / Izz)
        w = (w1 * E - w2) / (E - 1)
        # psi = integral of w = w1 t + (I/k2) ln((1 - 1/E)/(1 - 1/K))
        psi = w1 * num(t) + Izz / k2 * log((1 - 1 / E) / (1 - 1 / K))
        eps = (M0 - k1 * w - k2 * w * w) / Izz
        XB, YB = -(Iyz * eps + Ixz * w * w) / b, (Ixz * eps - Iyz * w * w) / b
        XA, YA = -mass * (xC * w * w + yC * eps) - XB, mass * (xC * eps - yC * w * w) - YB
        table.add(t, psi=psi, omega=w, eps=eps, X_A=XA, Y_A=YA, X_B=XB, Y_B=YB, R_A=sqrt(XA**2 + YA**2), R_B=sqrt(XB**2 + YB**2))
    return table


# ---- card D7 ------------------------------------------------------------------------------------------------------

def thread_pendulum(equilibrium_moment=True):
    """Newton for every body: load 1 in polar axes, roller about its contact point, pulley about its axis, load 4 along the incline."""
    m1, m2, m3, m4 = num(103), num(63), num(27), num(107)
    l0, R2, r2, rho2, R3, r3, rho3 = num("1.31"), num("0.27"), num("0.114"), num("0.12"), num("0.15"), num("0.1"), num("0.1")
    al = PI / 3
    lam = (R2 - r2) / r2
    M = G * r2 * (m4 * sin(al) * r3 / R3 - m1 * lam)
    mx = m1 * lam**2 + m2 * (1 + rho2**2 / r2**2) + m3 * rho3**2 / R3**2 + m4 * r3**2 / R3**2

    def f(t, q):
        p, x, w, v = q
        l = l0 - lam * x
        s, c = gmpy2.sin_cos(p)
        # S1 = m1 (g c + l w^2 + lam a);  contact point: m2 (r2^2 + rho2^2)/r2 a = S3 r2 - S1 (R2 - r2) - M
        # S3 = S4 r3/R3 - m3 rho3^2 a/R3^2;  S4 = m4 (g sin al - a r3/R3)
        a = (m4 * G * sin(al) * r3 / R3 - lam * m1 * (G * c + l * w * w) - M / r2) / mx
        return [w, v, (-G * s + 2 * lam * v * w) / l, a]

    def outputs(q):
        p, x, w, v = q
        e, a = f(0, q)[2:]
        l = l0 - lam * x
        S1 = m1 * (G * cos(p) + l * w * w + lam * a)
        S4 = m4 * (G * sin(al) - a * r3 / R3)
        S3 = (S4 * r3 - m3 * rho3**2 * a / R3) / R3
        F = m2 * a - S3 - S1
        # second way: moments about the centre C, counter-clockwise: -m2 rho2^2 a/r2 = M + S1 R2 + F r2
        second = (-m2 * rho2**2 * a / r2 - M - S1 * R2) / r2
        assert abs(F - second) < 1e-20, (F, second)
        return {"phi": p, "x": x, "phi'": w, "x'": v, "eps": e, "S1": S1, "S4": S4, "S3": S3, "F": F, "f": abs(F) / (m2 * G)}

    table = Table("thread-pendulum")
    table.notes.append(f"M = {M:.17g}, m_x = {mx:.17g}, lambda = {lam:.17g}")
    start = [num(0), num(0), num("0.75"), num(0)]
    path = Path(f, 0, start, "0.05")
    table.add("0", **outputs(start))
    for t in ("0.25", "0.5", "1", "1.5", "2", "2.568"):
        table.add(t, **outputs(path.to(t)))
    path = Path(f, 0, start, "0.05")
    path.advance(num("0.01"))
    path.until(lambda t, q: q[0], "2.568")
    o = outputs(path.y)
    table.notes.append(f"first return t = {path.t:.17g}: x = {o['x']:.17g}, S1 = {o['S1']:.17g}, S4 = {o['S4']:.17g}, f = {o['f']:.17g}")
    return table


# ---- pendulums ----------------------------------------------------------------------------------------------------

def double_pendulum(p1=None, p2=None, times=("0.25", "0.5", "1", "2", "3", "5", "10")):
    """m = 1, l = 1: x1'' and x2'' eliminated by hand (2 x 2 system)."""
    def f(t, q):
        a, b, u, v = q
        s, c = gmpy2.sin_cos(a - b)
        # 2 A + c B = -s v^2 - 2 g sin a;  c A + B = s u^2 - g sin b
        P, Q = -s * v * v - 2 * G * sin(a), s * u * u - G * sin(b)
        d = 2 - c * c
        return [u, v, (P - c * Q) / d, (2 * Q - c * P) / d]
    start = [PI / 2 if p1 is None else num(p1), PI / 2 if p2 is None else num(p2), num(0), num(0)]
    path = Path(f, 0, start, "0.05")
    table = Table("double-pendulum")
    for t in times:
        q = path.to(t)
        table.add(t, phi1=q[0], phi2=q[1], **{"phi1'": q[2], "phi2'": q[3]})
    a, b, u, v = path.y
    E = u * u + v * v / 2 + u * v * cos(a - b) - 2 * G * cos(a) - G * cos(b)
    table.notes.append(f"energy at the end {E:.5g} (zero at the start, when both angles are 90 deg)")
    return table


def n_pendulum(n=10, times=("0.1", "0.5", "1", "2")):
    """sum_j (n + 1 - max(i, j)) l^2 (phi_j'' cos(phi_i - phi_j) + phi_j'^2 sin(phi_i - phi_j)) + (n + 1 - i) g l sin phi_i = 0, m = 1."""
    l = num("0.1")
    def f(t, q):
        p, w = q[:n], q[n:]
        s, c = zip(*(gmpy2.sin_cos(a) for a in p))
        A = [[(n - max(i, j)) * (c[i] * c[j] + s[i] * s[j]) for j in range(n)] for i in range(n)]
        r = [-(n - i) * G / l * s[i] - sum((n - max(i, j)) * w[j] ** 2 * (s[i] * c[j] - c[i] * s[j]) for j in range(n)) for i in range(n)]
        for i in range(n):                              # Gauss; A is positive definite
            for k in range(i + 1, n):
                q_ = A[k][i] / A[i][i]
                if q_:
                    A[k] = [x - q_ * y for x, y in zip(A[k], A[i])]
                    r[k] -= q_ * r[i]
        for i in reversed(range(n)):
            r[i] = (r[i] - sum(A[i][j] * r[j] for j in range(i + 1, n))) / A[i][i]
        return list(w) + r
    path = Path(f, 0, [PI / 6] * n + [num(0)] * n, "0.01")
    table = Table(f"n-pendulum n = {n}")
    for t in times:
        q = path.to(t)
        table.add(t, **{f"phi_{i}": q[i - 1] for i in sorted({1, 2, n // 2, n}) if i <= n})
    return table


def spherical_pendulum():
    """theta'' = h^2 cos/sin^3 - (g/l) sin, psi' = h/sin^2; cosine of theta also by Jacobi's sn, in elliptic.py."""
    l = num("0.8")
    th1, th2 = PI / 3, PI / 6
    h = sqrt(2 * G / l * (cos(th2) - cos(th1)) / (1 / sin(th2) ** 2 - 1 / sin(th1) ** 2))
    def f(t, q):
        s, c = gmpy2.sin_cos(q[0])
        return [q[2], h / s**2, h * h * c / s**3 - G / l * s]
    path = Path(f, 0, [th1, num(0), num(0)], "0.02")
    table = Table("spherical-pendulum")
    table.notes.append(f"H = {h:.17g}")
    for t in ("0.25", "0.5", "1", "2", "5", "10"):
        q = path.to(t)
        s, c = gmpy2.sin_cos(q[0])
        sp, cp = gmpy2.sin_cos(q[1])
        table.add(t, theta=q[0], psi=q[1], **{"theta'": q[2], "psi'": h / s**2}, x_A=-l * s * sp, y_A=l * s * cp, z_A=-l * c)
    path = Path(f, 0, [th1, num(0), num(0)], "0.02")
    path.advance(num("0.01"))
    path.until(lambda t, q: q[2], "10")
    table.notes.append(f"first smallest angle at t = {path.t:.17g}, theta = {path.y[0]:.17g} (30 deg = {th2:.17g}), psi there = {path.y[1]:.17g}")
    return table


def top(psi_rate=None):
    """Momenta p_psi, p_phi kept; A theta'' = A psi'^2 s c - p_phi psi' s + m g l s, psi' = (p_psi - p_phi c)/(A s^2)."""
    m, l, A, C, nu, th0 = num("0.3"), num("0.04"), num("7e-4"), num("2.5e-4"), num(150), 40 * PI / 180
    s0, c0 = gmpy2.sin_cos(th0)
    Omega = (C * nu - sqrt((C * nu) ** 2 - 4 * A * m * G * l * c0)) / (2 * A * c0)
    psi0 = Omega if psi_rate is None else num(psi_rate)
    phi0 = nu - Omega * c0                              # the file's start; with psi' set to something else nu changes too
    p_phi = C * (phi0 + psi0 * c0)
    p_psi = A * s0**2 * psi0 + p_phi * c0
    def f(t, q):
        th, u, psi, phi = q
        s, c = gmpy2.sin_cos(th)
        dpsi = (p_psi - p_phi * c) / (A * s * s)
        return [u, dpsi**2 * s * c - p_phi * dpsi * s / A + m * G * l * s / A, dpsi, p_phi / C - dpsi * c]
    path = Path(f, 0, [th0, num(0), num(0), num(0)], "0.01")
    table = Table("top, " + ("regular precession" if psi_rate is None else f"psi'(0) = {psi_rate}"))
    table.notes.append(f"Omega = {Omega:.17g}, phi'(0) = {phi0:.17g}, p_psi = {p_psi:.17g}, p_phi = {p_phi:.17g}")
    for t in ("0.1", "0.5", "1", "2"):
        q = path.to(t)
        table.add(t, theta=q[0], psi=q[2], phi=q[3], **{"theta'": q[1]})
    if psi_rate is not None:
        path = Path(f, 0, [th0, num(0), num(0), num(0)], "0.01")
        path.advance(num("0.001"))
        path.until(lambda t, q: q[1], "2")
        table.notes.append(f"first largest theta at t = {path.t:.17g}: theta = {path.y[0]:.17g}")
    return table


ALL = [
    lambda: pendulum_on_shaft("0.02"),
    lambda: pendulum_on_shaft("0.01"),
    lambda: pendulum_on_shaft("0.02", "1e-4", (1, 5, 10, 12)),
    lambda: oscillator(False),
    lambda: oscillator(True),
    lambda: oscillator(False, "4"),
    lambda: oscillator(False, "20"),
    lambda: oscillator(False, "39.9"),
    lambda: oscillator(False, "40.1"),
    lambda: oscillator(False, "160"),
    lambda: blade_particle("0.107"),
    lambda: blade_particle("2.14012e-4"),
    lambda: scotch_yoke("viscous"),
    lambda: scotch_yoke("dry"),
    lambda: scotch_yoke("oneway"),
    rotor,
    thread_pendulum,
    double_pendulum,
    n_pendulum,
    spherical_pendulum,
    top,
    lambda: top("0"),
]
