"""Period doubling of the motion with one impact in a period (tests/book/continue.md): x'' + 0.2 x' + x = 0.5 cos wt, a stop at x = 1, r = 0.8; matrices of the damped oscillator and of the impact alone."""
import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq, fsolve

A, r, xs = np.array([[0.0, 1.0], [-1.0, -0.2]]), 0.8, 1.0

def motion(w, guess):
    """Phase and speed of the impact of the motion that comes back after one period."""
    T = 2 * np.pi / w
    E = expm(A * T)
    H = 1 / (1 - w * w + 0.2j * w)
    def part(p):  # forced motion where the force has the phase p
        z = 0.5 * H * np.exp(1j * p)
        return np.array([z.real, (1j * w * z).real])
    def miss(u):
        p, V = u
        begin = np.array([xs, -r * V]) - part(p)
        return E @ begin + part(p) - np.array([xs, V])
    p, V = fsolve(miss, guess, xtol=1e-13)
    a = -0.2 * V - xs + 0.5 * np.cos(p)          # acceleration before the impact
    after = 0.2 * r * V - xs + 0.5 * np.cos(p)   # and after it
    S = np.array([[-r, 0], [(r * a + after) / V, -r]])
    return (p, V), np.linalg.eigvals(E @ S)

if __name__ == "__main__":
    found = []
    for p0 in np.linspace(0, 2 * np.pi, 13):
        for V0 in (0.1, 0.3, 0.6):
            u, m = motion(0.85, (p0, V0))
            if u[1] > 1e-3 and not any(abs(u[1] - v[1]) < 1e-6 for v, _ in found):
                found.append((u, m))
    print(found)
    (u, m) = [f for f in found][0]
    ws = np.linspace(0.85, 0.9, 51)
    for (u, m) in found:
        g, track = u, []
        for w in ws:
            g, m = motion(w, g)
            track.append((w, g, np.prod(m + 1).real))
        for (w0, g0, f0), (w1, g1, f1) in zip(track, track[1:]):
            if f0 * f1 < 0:
                print("doubling", brentq(lambda w: np.prod(motion(w, g0)[1] + 1).real, w0, w1, xtol=1e-14), g0)
