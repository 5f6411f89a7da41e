"""Integration in many digits: Gragg's method with extrapolation (Bulirsch and Stoer).

Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, section II.9.
It shares nothing with strutt (no Taylor series, no symbolic derivation), which is what makes its numbers worth comparing with.
The right-hand side is `f(t, y) -> list`, all numbers gmpy2.mpfr at the precision of the context.
"""
import gmpy2
from gmpy2 import mpfr

BITS = 160  # 48 digits
gmpy2.get_context().precision = BITS
COLUMNS = 14  # extrapolation columns: order 28
TOLERANCE = mpfr("1e-30")


def num(text):
    """An exact decimal as a number of the working precision."""
    return mpfr(str(text))


def midpoint(f, t, y, f0, step, n):
    h = step / n
    before, now = y, [a + h * b for a, b in zip(y, f0)]
    for i in range(1, n):
        slope = f(t + i * h, now)
        before, now = now, [a + 2 * h * b for a, b in zip(before, slope)]
    slope = f(t + step, now)
    return [(a + b + h * c) / 2 for a, b, c in zip(before, now, slope)]


def extrapolate(f, t, y, step):
    """One step; returns the state and the error relative to the tolerance."""
    f0 = f(t, y)
    row = []
    for k in range(COLUMNS):
        n = 2 * (k + 1)
        new = [midpoint(f, t, y, f0, step, n)]
        for j in range(1, k + 1):
            q = mpfr(n) ** 2 / mpfr(2 * (k + 1 - j)) ** 2 - 1
            new.append([a + (a - b) / q for a, b in zip(new[j - 1], row[j - 1])])
        row = new
    error = max(abs(a - b) / (abs(c) + abs(d) + mpfr("1e-3")) for a, b, c, d in zip(row[-1], row[-2], y, row[-1]))
    return row[-1], error / TOLERANCE


class Path:
    """A solution that moves forward in time; `to(t)` steps exactly to t."""

    def __init__(self, f, t, y, step):
        self.f, self.t, self.y, self.step = f, num(t), list(y), num(step)

    def advance(self, end):
        """One accepted step, not beyond `end`."""
        while True:
            last = self.t + self.step >= end
            step = end - self.t if last else self.step
            y, error = extrapolate(self.f, self.t, self.y, step)
            order = 2 * COLUMNS - 1
            factor = mpfr("0.9") * (error + mpfr("1e-40")) ** (-mpfr(1) / order)
            factor = min(max(factor, mpfr("0.2")), mpfr(3))
            if error <= 1:
                self.t, self.y = (end if last else self.t + step), y
                if not last or factor < 1:
                    self.step = step * factor
                return
            self.step = step * factor

    def to(self, end):
        end = num(end)
        while self.t < end:
            self.advance(end)
        return self.y

    def until(self, guard, end):
        """Steps to the first sign change of guard(t, y) before `end`; True when found (then self stands on it)."""
        end = num(end)
        g0 = guard(self.t, self.y)
        while self.t < end:
            t0, y0 = self.t, self.y
            self.advance(end)
            g1 = guard(self.t, self.y)
            if g0 != 0 and g0 * g1 < 0:
                self.locate(guard, t0, y0, g0, self.t, g1)
                return True
            g0 = g1
        return False

    def locate(self, guard, t0, y0, g0, t1, g1):
        """Regula falsi (Illinois) on the time, each value integrated anew from t0."""
        a, b, ga, gb = t0, t1, g0, g1
        for _ in range(200):
            c = b - gb * (b - a) / (gb - ga)
            path = Path(self.f, t0, y0, (c - t0))
            y = path.to(c)
            g = guard(c, y)
            if g * gb < 0:
                a, ga = b, gb
            else:
                ga = ga / 2
            b, gb = c, g
            self.t, self.y = c, y
            if abs(g) < mpfr("1e-38") or abs(b - a) < mpfr("1e-36"):
                return
