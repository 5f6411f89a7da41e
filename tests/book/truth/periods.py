"""Period of van der Pol's oscillator, mu = 1, in 30 digits: Newton's method on the return to x = 0, x' > 0, Taylor steps of mpmath."""
from mpmath import mp, mpf, odefun, findroot, diff

mp.dps = 30


def turn(v):
    """Time and speed of the next upward passage of x = 0."""
    f = odefun(lambda t, y: [y[1], (1 - y[0] ** 2) * y[1] - y[0]], 0, [mpf(0), v])
    t = findroot(lambda t: f(t)[0], mpf("6.66"))
    return t, f(t)[1]


v = mpf("2")
for _ in range(60):
    t, w = turn(v)
    if abs(w - v) < mpf(10) ** -27:
        break
    v = w
print("period", t)
