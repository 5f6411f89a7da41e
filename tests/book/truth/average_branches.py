"""The motor on a hardening foundation of tests/book/average.md: answers of the foundation over the speed by collocation at 64 instants and pseudo-arclength,
speeds at which N = V on all of them, folds of these speeds over the idle speed Om (Om(s) along the branch is extreme)."""

import numpy as np
from numpy.fft import fft, fftfreq, ifft

M, m, e, cx, cy, b3, bx, by, k = 10, 0.5, 0.04, 4200, 9000, 4e6, 12, 20, 0.05
N = 64
th = np.arange(N) * 2 * np.pi / N
order = np.where(np.abs(fftfreq(N, 1 / N)) < N / 2, fftfreq(N, 1 / N), 0)
D1 = np.real(np.array([ifft(1j * order * fft(r)) for r in np.eye(N)])).T
D2 = np.real(np.array([ifft(-(order**2) * fft(r)) for r in np.eye(N)])).T
SIZE = 1e-3


def rest(z):
    x, W = z[:-1] * SIZE, z[-1]
    return (M + m) * W * W * (D2 @ x) + bx * W * (D1 @ x) + cx * x + b3 * x**3 - m * e * W * W * np.cos(th)


def slopes(z):
    x, W, d = z[:-1] * SIZE, z[-1], 1e-6
    by_x = ((M + m) * W * W * D2 + bx * W * D1 + np.diag(cx + 3 * b3 * x**2)) * SIZE
    step = np.append(np.zeros(N), d)
    return np.hstack([by_x, ((rest(z + step) - rest(z - step)) / (2 * d))[:, None]])


def idle(z):
    """Om at which the moments balance: k (Om - W) - 4e-5 W^2 = V, from the powers of the dampers."""
    x, W = z[:-1] * SIZE, z[-1]
    y = m * e * W * W * abs(1 / (cy - (M + m) * W * W + 1j * by * W))
    V = bx * np.mean((D1 @ x) ** 2) * W + by * W * y**2 / 2
    return W + (V + 4e-5 * W * W) / k


def ahead(z, t, h):
    guess = z + h * t
    z = guess.copy()
    for _ in range(12):
        step = np.linalg.solve(np.vstack([slopes(z), t]), -np.append(rest(z), t @ (z - guess)))
        z = z + step
        if np.linalg.norm(step) < 1e-11:
            break
    n = np.linalg.solve(np.vstack([slopes(z), t]), np.append(np.zeros(N), 1))
    return z, n / np.linalg.norm(n)


def brent(f, low, high):
    """Zero of f between both."""
    a, fa = low, f(low)
    for _ in range(60):
        c = 0.5 * (low + high)
        if (f(c) > 0) == (fa > 0):
            low = c
        else:
            high = c
    return 0.5 * (low + high)


z = np.append(np.zeros(N), 8.0)
t = np.append(np.zeros(N), 1.0)
z, t = ahead(z, t, 0.0)
points = [(z, t)]
while z[-1] < 62:
    z, t = ahead(z, t, 0.4)
    points.append((z, t))
values = [idle(z) for z, _ in points]
for Om in (60.0, 34.0):
    for i in range(len(points) - 1):
        if (values[i] - Om) * (values[i + 1] - Om) < 0:
            s = brent(lambda s: idle(ahead(*points[i], s)[0]) - Om, 0, 0.4)
            print("Om", Om, "speed", repr(ahead(*points[i], s)[0][-1]))
for i in range(1, len(points) - 1):
    if (values[i + 1] - values[i]) * (values[i] - values[i - 1]) < 0:
        slope = lambda s: idle(ahead(*points[i - 1], s + 1e-4)[0]) - idle(ahead(*points[i - 1], s - 1e-4)[0])
        s = brent(slope, 0, 0.8)
        z = ahead(*points[i - 1], s)[0]
        print("fold of the speeds: Om", repr(idle(z)), "speed", repr(z[-1]))
