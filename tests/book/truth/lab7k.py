"""The laboratory table of card P1: d, e, the traces of Hill's and Mathieu's equation and the three verdicts, for seven variants and R = 0.10 ... 0.24 m, from the card's formulas.

J(phi) = J_S1 + m1 l_OS1^2 + m_d R_d^2 + m2 U_S2^2 + J_S2 U_21^2 + m3 U_31^2; psi = c R^2/J(omega1 t); traces by DOP853 with 3e-14 over a turn.
Prints one line a row; with --check PROGRAM each row is laid beside the JSON of `strutt stability`.
"""
import json, subprocess, sys
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar
l1, l2, s1, s2 = 0.032, 0.142, 0.015, 0.064
m1, m2, m3, md, j1, j2, c = 1.12, 0.26, 2.1, 0.8, 1.6e-4, 9.5e-6, 7800.0
def inertia(phi, rd):
    sin, cos = np.sin(phi), np.cos(phi)
    beta = np.arcsin(l1 / l2 * sin)                      # the rod leans by -beta
    u21 = -l1 * cos / (l2 * np.cos(beta))
    u31 = -l1 * sin + l2 * np.sin(beta) * u21
    xs, ys = -l1 * sin + s2 * np.sin(beta) * u21, l1 * cos + s2 * np.cos(beta) * u21
    return j1 + m1 * s1**2 + md * rd**2 + m2 * (xs**2 + ys**2) + j2 * u21**2 + m3 * u31**2
def trace(psi, period):
    f = lambda t, z: [z[1], -psi(t) * z[0], z[3], -psi(t) * z[2]]
    z = solve_ivp(f, (0, period), [1, 0, 0, 1], method="DOP853", rtol=3e-14, atol=3e-14).y[:, -1]
    return z[0] + z[3]
def row(variant, r):
    w, rd = 260.0 - 10 * variant, 0.07 + 0.01 * variant
    j = lambda p: inertia(p, rd)
    low = j(0.0)
    high = -minimize_scalar(lambda p: -j(p), bounds=(1.0, 1.6), method="bounded", options={"xatol": 1e-12}).fun
    a, b = c * r * r / low, c * r * r / high
    d, e = 2 * (a + b) / w**2, (a - b) / w**2
    hill = trace(lambda t: c * r * r / j(w * t), 2 * np.pi / w)
    mathieu = trace(lambda t: d - 2 * e * np.cos(2 * t), np.pi)
    word = lambda unstable: "unstable" if unstable else "stable"
    return d, e, hill, mathieu, word(e * e > (1 - d) ** 2), word(abs(mathieu) > 2), word(abs(hill) > 2)
if __name__ == "__main__":
    worst = 0.0
    for variant in range(1, 8):
        if "--check" in sys.argv:
            base = [sys.argv[2], "stability", "gallery/slider-crank-spring/model.toml", "--set", f"omega1={260 - 10 * variant} rad/s", "--set", f"R_d={0.07 + 0.01 * variant} m"]
        for k in range(15):
            r = 0.10 + 0.01 * k
            own = row(variant, r)
            print(variant, f"{r:.2f}", *(repr(float(v)) if not isinstance(v, str) else v for v in own))
            if "--check" in sys.argv:
                f = json.loads(subprocess.run(base + ["--set", f"R={r} m", "--json"], capture_output=True, text=True).stdout)
                off = max(abs(f[n] - v) for n, v in zip(("d", "e", "trace", "trace_of_mathieu"), own))
                same = [f["verdicts"][n] for n in ("classical", "mathieu", "hill")] == list(own[4:])
                worst = max(worst, off)
                if not same or off > 1e-9:
                    print("  differs", off, f["verdicts"])
    print("largest difference", worst)
