"""True values of the chapter transient.md, 50 digits: `python transient.py`.

One degree of freedom: constants from the textbook formula. Several: exponential of the joint matrix of state and load by mpmath's Taylor
method. Neither shares anything with strutt, which uses divided differences of the exponential and, in machine numbers, Jacobi and Padé.
"""
from mpmath import atan2, cos, exp, expm, inf, matrix, mp, mpc, mpf, pi, sin, sqrt

mp.dps = 50


def show(key, value):
    print(f"{key} = {mp.nstr(value, 18)}")


class One:
    """q'' + 2 n q' + k2 q = h sin(p (t - origin) + delta) from the state (q0, v0) at t0."""

    def __init__(self, n, k2, h, p, q0, v0, t0=0, origin=0, delta=0):
        self.n, self.k2, self.h, self.p, self.t0, self.origin, self.delta = map(mpf, (n, k2, h, p, t0, origin, delta))
        n, k2 = self.n, self.k2
        self.D = self.h / sqrt((k2 - self.p**2) ** 2 + 4 * n**2 * self.p**2)
        self.epsilon = atan2(2 * n * self.p, k2 - self.p**2)
        f, w = self.part(self.t0)
        A, B = mpf(q0) - f, mpf(v0) - w
        d = n * n - k2
        if abs(d) < mpf(10) ** -40:
            self.C1, self.C2 = A, B + n * A
            self.free = lambda x: (exp(-n * x) * (self.C1 + self.C2 * x), exp(-n * x) * (self.C2 - n * (self.C1 + self.C2 * x)))
        elif d > 0:
            r1, r2 = -n + sqrt(d), -n - sqrt(d)
            self.C1 = (B - r2 * A) / (r1 - r2)
            self.C2 = A - self.C1
            self.free = lambda x: (self.C1 * exp(r1 * x) + self.C2 * exp(r2 * x), self.C1 * r1 * exp(r1 * x) + self.C2 * r2 * exp(r2 * x))
        else:
            k1 = sqrt(-d)
            self.C1, self.C2 = A, (B + n * A) / k1
            C1, C2 = self.C1, self.C2
            self.free = lambda x: (
                exp(-n * x) * (C1 * cos(k1 * x) + C2 * sin(k1 * x)),
                exp(-n * x) * ((C2 * k1 - n * C1) * cos(k1 * x) - (C1 * k1 + n * C2) * sin(k1 * x)),
            )

    def part(self, t):
        angle = self.p * (t - self.origin) + self.delta - self.epsilon
        return self.D * sin(angle), self.D * self.p * cos(angle)

    def at(self, t):
        f, w = self.part(mpf(t))
        q, v = self.free(mpf(t) - self.t0)
        return q + f, v + w


def card(mu, restart):
    print(f"\n# card 00, mu = {mu}, {'restarts' if restart else 'keeps'}")
    a, b, c, p = mpf("0.72"), 4 * mpf(mu) * mpf("0.09"), mpf(72), mpf(15)
    n, k2 = b / (2 * a), c / a
    ts = 4 * 2 * pi / p + 3 / n
    q0, v0 = mpf(0), mpf("1.23")
    for phase, H in enumerate([12, 24, 0]):
        t0 = phase * ts
        one = One(n, k2, H / a, p, q0, v0, t0, t0 if restart else 0)
        if phase == 0:
            show("phase 1 n", n)
            show("phase 1 D", one.D)
            show("phase 1 epsilon", one.epsilon)
        show(f"phase {phase + 1} start", t0)
        show(f"phase {phase + 1} C1", one.C1)
        show(f"phase {phase + 1} C2", one.C2)
        q0, v0 = one.at(t0 + ts)
        show(f"phi({mp.nstr(t0 + ts, 18)})", q0)
        show(f"phi'({mp.nstr(t0 + ts, 18)})", v0)


def joint(M, B, C, loads, start, times):
    """(q, q') by the exponential of the joint matrix; loads: (vector, kind, rate) with kind 'sin', 'cos', '1', 't', 't sin', 'exp'."""
    n = M.rows
    blocks = []
    for vector, kind, w in loads:
        if kind in ("sin", "cos"):
            blocks.append((vector, matrix([[0, w], [-w, 0]]), matrix([0, 1]), 0 if kind == "sin" else 1))
        elif kind == "1":
            blocks.append((vector, matrix([[0]]), matrix([1]), 0))
        elif kind == "t":
            blocks.append((vector, matrix([[0, 1], [0, 0]]), matrix([0, 1]), 0))
        elif kind == "exp":
            blocks.append((vector, matrix([[w]]), matrix([1]), 0))
    size = 2 * n + sum(b[1].rows for b in blocks)
    A, z = matrix(size, size), matrix(size, 1)
    Mi = M**-1
    K, D = Mi * C, Mi * B
    for i in range(n):
        A[i, n + i] = 1
        for j in range(n):
            A[n + i, j], A[n + i, n + j] = -K[i, j], -D[i, j]
        z[i], z[n + i] = start[i], start[n + i]
    at = 2 * n
    for vector, block, first, which in blocks:
        f = Mi * matrix(vector)
        for i in range(n):
            A[n + i, at + which] += f[i]
        for i in range(block.rows):
            z[at + i] = first[i]
            for j in range(block.rows):
                A[at + i, at + j] = block[i, j]
        at += block.rows
    return [(t, expm(A * mpf(t), method="taylor") * z) for t in times]


def table(title, names, rows):
    print(f"\n# {title}")
    for t, z in rows:
        for i, name in enumerate(names):
            show(f"{name}({t})", z[i])


for mu in ("40", "4", "20", "39.9", "40.1", "160"):
    card(mu, False)
card("40", True)
for mu in ("39.9999999", "40.0000001"):
    card(mu, False)

print("\n# k = 3, h = 2 sin(p t) from q = 0.1, v = 0; p near and at k, no damping")
for p in ("2.999", "2.999999999", "3"):
    one = joint(matrix([[1]]), matrix([[0]]), matrix([[9]]), [([2], "sin", mpf(p))], [mpf("0.1"), 0], ["1", "10", "50"])
    table(f"p = {p}", ["x", "x'"], one)

M, C = matrix([[2, 0], [0, 1]]), matrix([[300, -100], [-100, 100]])
start = [mpf("0.01"), 0, 0, mpf("0.3")]
# k2 = 50, 200: the second frequency is 10 sqrt 2
table("two masses, resonance at 10 sqrt 2", ["x", "y"], joint(M, 0 * M, C, [([10, 0], "sin", 10 * sqrt(2)), ([0, 5], "1", 0)], start, ["0.5", "3", "20"]))
table("two masses, damper at the first", ["x", "y", "x'", "y'"], joint(M, matrix([[4, 0], [0, 0]]), C, [([10, 0], "sin", 10 * sqrt(2)), ([0, 5], "1", 0)], start, ["0.5", "3", "20"]))
table("two masses, ramp and decaying load", ["x", "y"], joint(M, matrix([[4, 0], [0, 0]]), C, [([10, 0], "t", 0), ([0, 5], "exp", mpf(-2))], start, ["0.5", "3"]))
# gyroscope: B = [[0, g], [-g, 0]] and equal springs
table("gyroscopic", ["x", "y"], joint(matrix([[1, 0], [0, 1]]), matrix([[0, 6], [-6, 0]]), matrix([[16, 0], [0, 16]]), [([3, 0], "cos", mpf(2)), ([0, 3], "sin", mpf(2))], [mpf("0.1"), 0, 0, 0], ["1", "7"]))
# resonance of the gyroscopic system: w^2 + 6 w - 16 = 0 -> w = 2 (forward or backward)
