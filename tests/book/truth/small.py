"""Truths of the chapters modes.md and response.md, from matrices written by hand, in 40 digits.

No line of strutt is used: M, B, C and the loads come from the formulas in the chapters.
"""
from mpmath import mp, mpf, matrix, polyroots, sqrt, pi, lu_solve, mpc, findroot, diff, log, arg, eig, inverse, cos, sin
mp.dps = 40


def det_poly(M, C):
    """Roots z of det(C - z M) for 2 x 2 and 3 x 3 by interpolation."""
    n = M.rows
    xs = [mpf(k) for k in range(n + 1)]
    ys = [mp.det(C - x * M) for x in xs]
    A = matrix(n + 1, n + 1)
    for i, x in enumerate(xs):
        for j in range(n + 1):
            A[i, j] = x ** (n - j)
    coefficients = lu_solve(A, matrix(ys))
    return sorted(polyroots(list(coefficients), maxsteps=500, extraprec=200), key=lambda r: mp.re(r))


def show(name, value):
    print(f"{name:40s} {mp.nstr(value, 17)}")


def quadratic(M, B, C):
    n = M.rows
    A = matrix(2 * n, 2 * n)
    Mi = inverse(M)
    K, D = Mi * C, Mi * B
    for i in range(n):
        A[i, n + i] = 1
        for j in range(n):
            A[n + i, j] = -K[i, j]
            A[n + i, n + j] = -D[i, j]
    values, vectors = eig(A)
    return sorted([v for v in values if mp.im(v) > 0], key=lambda v: abs(v)), values


def response(M, B, C, F, w):
    n = M.rows
    Z = matrix(n, n)
    for i in range(n):
        for j in range(n):
            Z[i, j] = C[i, j] - w * w * M[i, j] + mpc(0, 1) * w * B[i, j]
    return lu_solve(Z, matrix(F))


print("double pendulum")
g = mpf("9.81")
for r in det_poly(matrix([[2, 1], [1, 1]]), matrix([[2 * g, 0], [0, g]])):
    show("omega", sqrt(r))

print("absorber")
M = matrix([[502, 0], [0, 50]])
ca = 50 * mpf(100) ** 2
C = matrix([[5000000 + ca, -ca], [-ca, ca]])
B = matrix([[2000, 0], [0, 0]])
roots, _ = quadratic(M, B, C)
for r in roots:
    show("omega", abs(r)); show("zeta", -mp.re(r) / abs(r))
amplitude = lambda w, k: abs(response(M, B, C, [2 * mpf("0.05") * w * w, 0], w)[k])
force = lambda w: abs(response(M, B, C, [2 * mpf("0.05") * w * w, 0], w)[0] * (5000000 + mpc(0, 1) * w * 2000))
for k, name in [(0, "x"), (1, "y")]:
    for start in (85.37, 116.9):
        w = findroot(lambda w: diff(lambda v: amplitude(v, k), w), start)
        show(f"resonance {name}", w); show("amplitude", amplitude(w, k))
w = findroot(lambda w: diff(force, w), 85.37)
show("resonance F", w); show("amplitude", force(w))
show("x(90)", amplitude(mpf(90), 0)); show("phase", arg(response(M, B, C, [2 * mpf("0.05") * 8100, 0], mpf(90))[0]))

print("shaft line")
M = matrix([[2, 0, 0], [0, mpf("0.25") + 4 * mpf("0.05"), 0], [0, 0, 1]])
C = matrix([[50000, -50000, 0], [-50000, 50000 + 80000, 40000], [0, 40000, 20000]])
for r in det_poly(M, C)[1:]:
    show("omega", sqrt(r))
x = response(M, 0 * M, C, [100, 0, 0], mpf(314))
show("twist_1 at 314", 50000 * (x[1] - x[0])); show("twist_2 at 314", 20000 * (x[2] + 2 * x[1]))

print("gyroscopic rotor")
m, R, l, c = mpf(8), mpf("0.2"), mpf("0.25"), mpf(12000)
A, G = m * (R ** 2 / 4 + l ** 2), m * R ** 2 / 2
for W in (0, 300, 600):
    for s in (-1, 1):
        show(f"omega at {W}", (s * G * W + sqrt((G * W) ** 2 + 4 * A * c)) / (2 * A))
show("critical forward", sqrt(c / (A - G))); show("critical backward", sqrt(c / (A + G)))

print("two masses, damped unlike")
M = matrix([[1, 0], [0, 2]]); C = matrix([[300, -200], [-200, 200]]); B = matrix([[3, -1], [-1, 1]])
roots, _ = quadratic(M, B, C)
for r in roots:
    show("omega", abs(r)); show("omega_d", mp.im(r)); show("zeta", -mp.re(r) / abs(r)); show("decrement", -2 * pi * mp.re(r) / mp.im(r))
