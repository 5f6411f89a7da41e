"""Motions of tests/book/redundant.md: one equation over the first angle, DOP853 at 1e-13."""

import numpy as np
from scipy.integrate import solve_ivp


def run(field, start, times):
    y = solve_ivp(field, (0, max(times)), start, method="DOP853", rtol=1e-13, atol=1e-13, t_eval=times).y
    return list(zip(times, y[0], y[1]))


def locomotive(phases, start, times):
    """Two wheels of 30 kg m^2 at 6 rad/s under 50 N m, rods of 40 kg on cranks of 0.3 m."""
    inertia = 60 + len(phases) * 40 * 0.09

    def field(_, y):
        return [y[1], (50 - sum(40 * 9.81 * 0.3 * np.cos(y[0] + p) for p in phases)) / inertia]

    return run(field, [start, 6], times)


def hooke(start, times):
    """sin c = sin b sin e, tan a = tan b cos e: db/da = cos e/(cos² e cos² a + sin² a), dc/da from cos c dc = sin e cos b db."""
    e = np.deg2rad(35)

    def angles(a):
        n = np.round(a / np.pi)
        b = np.arctan(np.tan(a - n * np.pi) / np.cos(e)) + n * np.pi
        return b, np.arcsin(np.sin(b) * np.sin(e))

    def slopes(a):
        b, c = angles(a)
        db = np.cos(e) / (np.cos(e) ** 2 * np.cos(a) ** 2 + np.sin(a) ** 2)
        return db, np.sin(e) * np.cos(b) / np.cos(c) * db

    def mass(a):
        db, dc = slopes(a)
        return 0.03 + 0.002 * (1 + dc**2) + 0.05 * db**2

    def field(_, y):
        weights = ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280))
        dm = sum(w * (mass(y[0] + 1e-3 * k) - mass(y[0] - 1e-3 * k)) for k, w in weights) / 1e-3
        return [y[1], (2 - 1.2 * slopes(y[0])[0] - 0.5 * dm * y[1] ** 2) / mass(y[0])]

    return [(t, a, w, *angles(a)) for t, a, w in run(field, [start, 8], times)]


if __name__ == "__main__":
    for phases in ([0, np.pi / 2], [0, 2 * np.pi / 3, 4 * np.pi / 3]):
        for start in (0, np.pi / 2, np.pi):
            print("locomotive", len(phases), start, locomotive(phases, start, [1, 3]))
    for start in (0, np.pi / 2):
        print("hooke", start, hooke(start, [0.2, 1]))
