"""A wheel behind a spring on a shaft that is driven with the angle w t, and a torque in sin f: f = w t + psi(t), psi by collocation on a Fourier grid,
multipliers by Taylor steps of the variations. Truth of tests/book/periodic.md."""

from mpmath import cos, cot, eye, lu_solve, matrix, mp, mpf, norm, odefun, pi, sin, sqrt

mp.dps = 30
w, J, c, k, M, A = mpf(20), mpf(1) / 2, mpf(1), mpf(300), mpf(5), mpf(2)
N = 48
T = 2 * pi / w
times = [T * j / N for j in range(N)]
first = matrix(N, N)
for i in range(N):
    for j in range(N):
        if i != j:
            first[i, j] = mpf(1) / 2 * (-1) ** (i - j) * cot((i - j) * pi / N) * w
linear = J * first * first + c * first + k * eye(N)
psi = matrix(N, 1)
for _ in range(30):
    off, slope = linear * psi, linear.copy()
    for j in range(N):
        off[j] += M + A * sin(w * times[j] + psi[j])
        slope[j, j] += A * cos(w * times[j] + psi[j])
    change = lu_solve(slope, -off)
    psi += change
    if norm(change) < mpf(10) ** -27:
        break
rate = first * psi
print("f(0), f'(0):", psi[0], w + rate[0])


def flow(t, y):
    p, q, a, b, d, e = y
    acceleration = -(c * q + k * p + M + A * sin(w * t + p)) / J
    stiffness = (k + A * cos(w * t + p)) / J
    return [q, acceleration, b, -(c * b / J + stiffness * a), e, -(c * e / J + stiffness * d)]


mp.dps = 22
y = odefun(flow, 0, [psi[0], rate[0], mpf(1), mpf(0), mpf(0), mpf(1)])(T)
print("closes to:", y[0] - psi[0], y[1] - rate[0])
half, det = (y[2] + y[5]) / 2, y[2] * y[5] - y[3] * y[4]
print("multiplier:", half, sqrt(det - half**2), sqrt(det))
