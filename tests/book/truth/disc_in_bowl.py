"""The disc that rolls in a bowl of tests/book/backbone.md, in its one freedom: frequency of small oscillations, amplitude of a given frequency."""

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

G = 9.81


def mass(q):
    # centre of mass at 0.75 (sin q, -cos q) + 0.08 (sin p, -cos p), p = -3 q
    v = np.array([0.75 * np.cos(q) - 0.24 * np.cos(3 * q), 0.75 * np.sin(q) + 0.24 * np.sin(3 * q)])
    return 2 * (v @ v) + 0.05 * 9


def energy(q):
    return -2 * G * (0.75 * np.cos(q) + 0.08 * np.cos(3 * q))


def frequency(a):
    # q = a sin s takes the root at the turning point away
    f = lambda s: np.sqrt(mass(a * np.sin(s)) / (2 * (energy(a) - energy(a * np.sin(s))))) * a * np.cos(s)
    return 2 * np.pi / (4 * quad(f, 0, np.pi / 2, epsabs=1e-13, epsrel=1e-13, limit=400)[0])


print("small", np.sqrt(2 * G * (0.75 + 0.72) / mass(0.0)))
print("amplitude at 4 rad/s", repr(brentq(lambda a: frequency(a) - 4, 0.5, 2.5, xtol=1e-13)))
