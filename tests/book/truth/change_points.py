"""Motions of tests/book/change-points.md: one equation over the crank's angle, DOP853 at 1e-13."""

import numpy as np
from scipy.integrate import solve_ivp

G, H = 9.81, 1e-20


def motion(mass, height, start, rate, times):
    """mass(a) is the reduced inertia, height(a) that of 1 kg; derivatives by a complex and by an eighth-order difference."""

    def slope(a):
        weights = ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280))
        return sum(w * (mass(a + 1e-3 * k) - mass(a - 1e-3 * k)) for k, w in weights) / 1e-3

    def field(_, y):
        weight = G * np.imag(height(y[0] + 1j * H)) / H
        return [y[1], -(weight + 0.5 * slope(y[0]) * y[1] ** 2) / mass(y[0])]

    return solve_ivp(field, (0, max(times)), [start, rate], method="DOP853", rtol=1e-13, atol=1e-13, t_eval=times).y


def linkage(rocker, pin):
    """Reduced inertia and height of a four-bar with coupler of 1 kg, 0.01 kg m^2 between crank pin and `pin`."""

    def rate(f, a):
        return np.imag(f(a + 1j * H)) / H

    def crank(a):
        return 0.1 * np.cos(a), 0.1 * np.sin(a)

    def centre(k):
        return lambda a: (crank(a)[k] + pin(a)[k]) / 2

    def turning(a):
        d = [pin(a)[k] - crank(a)[k] for k in (0, 1)]
        v = [rate(lambda z, k=k: pin(z)[k] - crank(z)[k], a) for k in (0, 1)]
        return (d[0] * v[1] - d[1] * v[0]) / (d[0] ** 2 + d[1] ** 2)

    def mass(a):
        return 0.01 + 0.02 * rate(rocker, a) ** 2 + rate(centre(0), a) ** 2 + rate(centre(1), a) ** 2 + 0.01 * turning(a) ** 2

    return mass, centre(1)


def crossed(a):
    n = np.floor((np.real(a) + np.pi) / (2 * np.pi))
    return -2 * np.arctan(2 * np.tan((a - 2 * np.pi * n) / 2)) - 2 * np.pi * n


def crossed_pin(a):
    return 0.3 + 0.1 * np.cos(crossed(a)), 0.1 * np.sin(crossed(a))


def deltoid_pin(a):
    h = np.sqrt(0.09 - 0.01 * np.sin(a / 2) ** 2)
    return 0.05 * (1 + np.cos(a)) + h * np.cos(a / 2), 0.05 * np.sin(a) + h * np.sin(a / 2)


def deltoid(a):
    (x, y), c, s = deltoid_pin(a), np.cos(a / 2), np.sin(a / 2)
    return a / 2 + np.arctan((y * c - (x - 0.1) * s) / ((x - 0.1) * c + y * s))


def show(name, mass, height, start, rate, times):
    print(name, rate, motion(mass, height, start, rate, times).tolist())


def parallel(a):
    return 0.1 * np.sin(a)


if __name__ == "__main__":
    show("parallelogram", lambda a: 0.04, parallel, 1, 7.3, [2, 5])
    show("parallelogram", lambda a: 0.04, parallel, 1, 1000, [0.014, 0.04])
    show("parallelogram", lambda a: 0.04, parallel, 1, 6.2644, [6.38528829576655])
    turning = dict(method="DOP853", rtol=1e-13, atol=1e-13, max_step=0.05, t_eval=[6, 20])
    driven = solve_ivp(lambda _, y: [y[1], (0.5 - 0.05 * y[1] - 0.981 * np.cos(y[0])) / 0.04], (0, 20), [1, 7.3], **turning)
    print("driven parallelogram", driven.y.tolist())
    show("three cranks", lambda a: 0.04, parallel, 1, 10, [1, 2])
    show("two sides", lambda a: 0.05, lambda a: 0.1 * (np.sin(a) + np.cos(a)), 1, 10, [1, 3])
    show("crossed", *linkage(crossed, crossed_pin), 1, 10, [0.7, 2])
    show("crossed", *linkage(crossed, crossed_pin), 1, 40, [0.25, 0.5])
    show("crossed", *linkage(crossed, crossed_pin), 1, 1000, [0.02])
    show("deltoid", *linkage(deltoid, deltoid_pin), 1, 10, [0.7, 2])
    show("deltoid", *linkage(deltoid, deltoid_pin), 1, 2, [3.5, 10])
