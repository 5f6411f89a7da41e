"""The upright motion of a pendulum, a'' = 9.81 sin a + 2 cos 0.5t, that a period magnifies 10^17 times: odd cosines by collocation in 50 digits, then Taylor series of order 40 of the motion and its variations over a period."""
from mpmath import cos, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt
mp.dps = 50
K, F, W, ORDER = mpf("9.81"), mpf(2), mpf("0.5"), 40


def turn(a, v, steps):
    h, t, y = 2 * pi / W / steps, mpf(0), [[a, v], [mpf(1), mpf(0)], [mpf(0), mpf(1)]]
    for _ in range(steps):
        x, s, c = list(y[0]), [sin(y[0][0])], [cos(y[0][0])]
        u, f, g = [list(y[1]), list(y[2])], [F * cos(W * t)], [F * sin(W * t)]
        for n in range(ORDER - 1):
            f.append(-W * g[n] / (n + 1))
            g.append(W * f[n] / (n + 1))
            x.append((K * s[n] + f[n]) / ((n + 1) * (n + 2)))
            for w in u:
                w.append(K * sum(c[i] * w[n - i] for i in range(n + 1)) / ((n + 1) * (n + 2)))
            s.append(sum(i * x[i] * c[n + 1 - i] for i in range(1, n + 2)) / (n + 1))
            c.append(-sum(i * x[i] * s[n + 1 - i] for i in range(1, n + 2)) / (n + 1))
        y = [[sum(p * h**i for i, p in enumerate(z)), sum(i * p * h ** (i - 1) for i, p in enumerate(z) if i)] for z in [x] + u]
        t += h
    return y


# odd cosines, a(t + T/2) = -a(t): equations at as many instants of a quarter of the period
n = 24
times = [2 * pi / W * (2 * j + 1) / (8 * n) for j in range(n)]
table = [[cos((2 * k + 1) * W * t) for k in range(n)] for t in times]
amplitudes = matrix([-F / (K + W * W)] + [mpf(0)] * (n - 1))
for _ in range(40):
    jacobian, miss = matrix(n, n), matrix(n, 1)
    for j in range(n):
        a = sum(table[j][k] * amplitudes[k] for k in range(n))
        miss[j] = sum(-((2 * k + 1) * W) ** 2 * table[j][k] * amplitudes[k] for k in range(n)) - K * sin(a) - F * cos(W * times[j])
        for k in range(n):
            jacobian[j, k] = -table[j][k] * (((2 * k + 1) * W) ** 2 + K * cos(a))
    change = lu_solve(jacobian, -miss)
    amplitudes = amplitudes + change
    if max(abs(x) for x in change) < mpf(10) ** -35:
        break
a, v = sum(amplitudes), mpf(0)
(xe, ve), (p, pd), (q, qd) = turn(a, v, 100)
print("comes back to", nstr(xe - a, 3), nstr(ve, 3))
half = (p + qd) / 2
mu = half + sqrt(half * half - (p * qd - q * pd))
print("a(0) =", nstr(a, 20), " a'(0) =", nstr(v, 5), " multipliers", nstr(mu, 15), nstr(1 / mu, 15))
