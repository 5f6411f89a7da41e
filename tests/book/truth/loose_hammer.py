"""Periodic motions of a hammer that is loose between two stops on a driven carriage: periodic.md, 'A correction that leads into a wall'.

The motion between impacts by scipy's DOP853, an impact by Newton's law and momentum, the regime by Newton's method with central differences.
"""
import numpy as np
from scipy.integrate import solve_ivp

M, m, k, b, kh, bh, F, W, D = 6, 1.1, 900, 12, 40, 0.4, 45, 13, 0.03
INVERSE = np.linalg.inv(np.array([[M + m, m], [m, m]]))


def field(t, y):
    force = [F * np.cos(W * t) - k * y[0] - b * y[2], -kh * (y[1] - 0.002) - bh * y[3]]
    return np.r_[y[2:], INVERSE @ force]


def period(y, R):
    right, left = lambda t, y: D - y[1], lambda t, y: y[1] + D
    for wall in (right, left):
        wall.terminal, wall.direction = True, -1
    t, end = 0.0, 2 * np.pi / W
    while t < end - 1e-15:
        s = solve_ivp(field, (t, end), y, method="DOP853", rtol=1e-13, atol=1e-15, events=[right, left])
        t, y = s.t[-1], s.y[:, -1].copy()
        if s.status == 1:
            change = -(1 + R) * y[3]
            y[2:] += [-m * change / (M + m), change]
            y[1] = np.sign(y[1]) * D * (1 - 1e-15)
    return y


def slope(y, R, h=1e-6):
    return np.column_stack([(period(y + h * e, R) - period(y - h * e, R)) / (2 * h) for e in np.eye(4)])


for R, x in [(0.85, [-0.108, -0.0247, 0.6487, 0.508]), (0.62, [-0.104, -0.0184, 0.844, -0.446])]:
    x = np.array(x)
    for _ in range(8):
        x = x - np.linalg.solve(slope(x, R) - np.eye(4), period(x, R) - x)
    print(R, x.tolist(), np.linalg.eigvals(slope(x, R)))
