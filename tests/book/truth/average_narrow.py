"""Truth of average.md for narrow resonances: all balances are roots of polynomials, all folds zeros of a derivative; mpmath, 40 digits."""

from mpmath import diff, findroot, im, lu_solve, matrix, mp, mpf, nstr, polyroots, re, sqrt

mp.dps = 40
T, ME = mpf("20.5"), mpf("0.01")


def linear(b, c=20000, k="0.02", idle=150):
    """k(Om - W) D - b me^2 W^5/2 = 0, D = (c - T W^2)^2 + b^2 W^2."""
    b, k = mpf(b), mpf(k)
    d = [T * T, 0, b * b - 2 * c * T, 0, mpf(c) ** 2]
    p = [mpf(0)] * 6
    for i, v in enumerate(d):
        p[i] -= k * v
        p[i + 1] += k * idle * v
    p[0] -= b / 2 * ME**2
    return sorted(re(x) for x in polyroots(p, maxsteps=500, extraprec=400) if abs(im(x)) < 1e-25 and re(x) > 10)


def folds(cs, b, k=mpf("0.02")):
    """Extremes of W + V(W)/k, searched on meshes that close in on each resonance."""
    b, out = mpf(b), []

    def idle(w):
        return w + sum(b * w * (ME * w * w) ** 2 / ((c - T * w * w) ** 2 + (b * w) ** 2) / 2 for c in cs) / k

    def slope(w):
        s = mpf(1)
        for c in cs:
            d = (c - T * w * w) ** 2 + (b * w) ** 2
            dp = -4 * T * w * (c - T * w * w) + 2 * b * b * w
            s += b * ME**2 / 2 / k * (5 * w**4 / d - w**5 * dp / d**2)
        return s

    for c in cs:
        top, width = sqrt(c / T), b / 2 / T
        grid = sorted(top + s * width * mpf(10) ** (mpf(j) / 40) for s in (-1, 1) for j in range(-400, 300))
        grid = [w for w in grid if 10 < w < 200]
        for left, right in zip(grid, grid[1:]):
            if slope(left) * slope(right) < 0:
                w = findroot(slope, (left, right), solver="anderson", tol=1e-60)
                out.append((nstr(idle(w), 14), nstr(w, 14)))
    return sorted(set(out), key=lambda pair: float(pair[1]))


def circle(c3, b, idle=60, k="0.05", c=20000):
    """s((c + c3 s - T W^2)^2 + b^2 W^2) = (me W^2)^2 with s = k(Om - W)/(b W), times W^3: a polynomial, from its values."""
    c3, b, k = mpf(c3), mpf(b), mpf(k)

    def left(w):
        s = k * (idle - w) / (b * w)
        return (s * ((c + c3 * s - T * w * w) ** 2 + (b * w) ** 2) - (ME * w * w) ** 2) * w**3

    n = 8
    at = [mpf(10 + 19 * i) for i in range(n + 1)]
    rows = matrix(n + 1, n + 1)
    for i, w in enumerate(at):
        for j in range(n + 1):
            rows[i, j] = (w / 100) ** (n - j)
    p = list(lu_solve(rows, matrix([left(w) for w in at])))
    while abs(p[0]) < mpf(10) ** -30 * max(abs(v) for v in p):
        p = p[1:]
    roots = polyroots(p, maxsteps=2000, extraprec=600)
    return sorted(100 * re(x) for x in roots if abs(im(x)) < 1e-15 and 10 < 100 * re(x) < idle)


if __name__ == "__main__":
    for b in ("0.2", "1.2806e-3"):
        print(b, [nstr(w, 16) for w in linear(b)])
    print(folds([mpf(20000), mpf(45000)], "0.05"))
    for c3, b in (("5e8", "20"), ("5e4", "1.28e-3"), ("-5e3", "0.2")):
        print(c3, b, [nstr(w, 16) for w in circle(c3, b)])
