"""Mean moment of a slider-crank pump with Coulomb friction in its guide, the shaft turning uniformly (cycle.md)."""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

r, l, m, m_rod, mu, g, w = 0.1, 0.35, 2.0, 1.0, 0.15, 9.81, 20.0


def forces(p, sliding, pressed):
    """Force on the rod at the crank pin, force on the piston, normal force of the guide; `sliding`, `pressed`: signs of x' and N."""
    b = np.arcsin(-r * np.sin(p) / l)
    b1 = -r * np.cos(p) * w / (l * np.cos(b))
    b2 = (r * np.sin(p) * w**2 + l * np.sin(b) * b1**2) / (l * np.cos(b))
    x2 = -r * np.cos(p) * w**2 - l * np.cos(b) * b1**2 - l * np.sin(b) * b2
    a_x = -r * np.cos(p) * w**2 - l / 2 * (np.cos(b) * b1**2 + np.sin(b) * b2)
    a_y = -r * np.sin(p) * w**2 + l / 2 * (np.cos(b) * b2 - np.sin(b) * b1**2)
    load = -800.0 if sliding > 0 else -80.0
    c, s = np.cos(b) * l / 2, np.sin(b) * l / 2
    matrix = [[0, 0, 1, 0, -mu * sliding * pressed], [0, 0, 0, 1, 1], [1, 0, -1, 0, 0], [0, 1, 0, -1, 0], [s, -c, s, -c, 0]]
    return np.linalg.solve(matrix, [m * x2 - load, m * g, m_rod * a_x, m_rod * (a_y + g), m_rod * l**2 / 12 * b2])


def moment(p, sliding, pressed):
    a_x, a_y = forces(p, sliding, pressed)[:2]
    return r * (np.cos(p) * a_y - np.sin(p) * a_x)


def over(a, b, sliding):
    grid = np.linspace(a, b, 2001)
    normal = lambda p: forces(p, sliding, 1)[4]  # its sign does not hang on that of the friction's share here
    ends = [a] + [brentq(normal, u, v) for u, v in zip(grid, grid[1:]) if normal(u) * normal(v) < 0] + [b]
    part = lambda u, v: quad(moment, u, v, args=(sliding, np.sign(normal((u + v) / 2))), epsabs=1e-12, epsrel=1e-12)[0]
    return sum(part(u, v) for u, v in zip(ends, ends[1:]))


print((over(0, np.pi, -1) + over(np.pi, 2 * np.pi, 1)) / (2 * np.pi))
