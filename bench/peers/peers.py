"""One job of one peer in a fresh process, so that set-up is paid as a user pays it. Prints one JSON line: seconds of each stage and a result."""
import json
import sys
import time


def shaft_heyoka(tolerance):
    """Card P3, 30 s, m = 20 g. The compact set of equations solved for the accelerations by hand; heyoka compiles it."""
    began = time.perf_counter()
    import heyoka as hy
    imported = time.perf_counter()
    x, y, p, vx, vy, w = hy.make_vars("x", "y", "p", "vx", "vy", "w")
    m, l, k, b, cx, cy, g = 0.02, 0.05, 1e-4, 25.0, 4e5, 1e5, 9.81
    M = 10.0 + m
    def system(omega):
        fx = m * l * w**2 * hy.sin(p) - cx * x - b * vx
        fy = -m * l * w**2 * hy.cos(p) - cy * y - b * vy
        fp = k * (omega - w) - m * g * l * hy.sin(p)
        a = (fp - m * l / M * (hy.cos(p) * fx + hy.sin(p) * fy)) / (m * l * l * (1 - m / M))
        return [(x, vx), (y, vy), (p, w), (vx, (fx - m * l * hy.cos(p) * a) / M), (vy, (fy - m * l * hy.sin(p) * a) / M), (w, a)]
    # one compiled system: the speed is 30 t, then a parameter holds it
    omega = hy.par[0] * hy.time + hy.par[1]
    ta = hy.taylor_adaptive(system(omega), [0.0] * 6, tol=tolerance, pars=[30.0, 0.0])
    ready = time.perf_counter()
    ta.propagate_until(10.0)
    ta.pars[0], ta.pars[1] = 0.0, 300.0
    ta.propagate_until(30.0)
    done = time.perf_counter()
    return {"import": imported - began, "set-up": ready - imported, "run": done - ready, "phi(30)": float(ta.state[2])}


def sweep_heyoka(rows):
    """Card P3 for many masses from 2 to 60 g, 30 s, tolerance 1e-9, four at a time: heyoka's compiled batch integrator. The mean speed from 20 s to 30 s."""
    began = time.perf_counter()
    import heyoka as hy
    import numpy as np
    imported = time.perf_counter()
    x, y, p, vx, vy, w = hy.make_vars("x", "y", "p", "vx", "vy", "w")
    l, k, b, cx, cy, g, m = 0.05, 1e-4, 25.0, 4e5, 1e5, 9.81, hy.par[2]
    M, omega = 10.0 + m, hy.par[0] * hy.time + hy.par[1]
    fx = m * l * w**2 * hy.sin(p) - cx * x - b * vx
    fy = -m * l * w**2 * hy.cos(p) - cy * y - b * vy
    fp = k * (omega - w) - m * g * l * hy.sin(p)
    a = (fp - m * l / M * (hy.cos(p) * fx + hy.sin(p) * fy)) / (m * l * l * (1 - m / M))
    system = [(x, vx), (y, vy), (p, w), (vx, (fx - m * l * hy.cos(p) * a) / M), (vy, (fy - m * l * hy.sin(p) * a) / M), (w, a)]
    ta = hy.taylor_adaptive_batch(system, np.zeros((6, 4)), tol=1e-9, pars=np.zeros((3, 4)))
    ready = time.perf_counter()
    masses, means = np.linspace(0.002, 0.06, rows), []
    for i in range(0, rows, 4):
        four = np.resize(masses[i:i + 4], 4)
        ta.set_time(0.0)
        ta.state[:] = 0.0
        ta.pars[0], ta.pars[1], ta.pars[2] = 30.0, 0.0, four
        ta.propagate_until(10.0)
        ta.pars[0], ta.pars[1] = 0.0, 300.0
        ta.propagate_until(20.0)
        from_20 = ta.state[2].copy()
        ta.propagate_until(30.0)
        means.extend(((ta.state[2] - from_20) / 10.0).tolist())
    done = time.perf_counter()
    return {"import": imported - began, "set-up": ready - imported, "run": done - ready, "means": means[:rows]}


def shaft_scipy(tolerance):
    """The same by DOP853 with a plain Python right-hand side."""
    began = time.perf_counter()
    from math import cos, sin
    from scipy.integrate import solve_ivp
    imported = time.perf_counter()
    m, l, k, b, cx, cy, g = 0.02, 0.05, 1e-4, 25.0, 4e5, 1e5, 9.81
    M = 10.0 + m
    def f(t, s, rate, base):
        x, y, p, vx, vy, w = s
        sp, cp = sin(p), cos(p)
        fx = m * l * w * w * sp - cx * x - b * vx
        fy = -m * l * w * w * cp - cy * y - b * vy
        a = (k * (rate * t + base - w) - m * g * l * sp - m * l / M * (cp * fx + sp * fy)) / (m * l * l * (1 - m / M))
        return [vx, vy, w, (fx - m * l * cp * a) / M, (fy - m * l * sp * a) / M, a]
    one = solve_ivp(f, (0, 10), [0.0] * 6, "DOP853", rtol=tolerance, atol=tolerance, args=(30.0, 0.0))
    two = solve_ivp(f, (10, 30), one.y[:, -1], "DOP853", rtol=tolerance, atol=tolerance, args=(0.0, 300.0))
    return {"import": imported - began, "run": time.perf_counter() - imported, "phi(30)": float(two.y[2, -1])}


def chain_sympy(n):
    """Lagrange's equations of n pendulums with separate m_i, l_i by sympy.physics.mechanics, to mass matrix and forcing."""
    began = time.perf_counter()
    import sympy
    from sympy.physics.mechanics import LagrangesMethod, Particle, Point, ReferenceFrame, Lagrangian, dynamicsymbols
    imported = time.perf_counter()
    q = dynamicsymbols(f"phi1:{n + 1}")
    q = list(q)
    u = [a.diff() for a in q]
    m, l, g = sympy.symbols(f"m1:{n + 1}"), sympy.symbols(f"l1:{n + 1}"), sympy.symbols("g")
    N, O = ReferenceFrame("N"), Point("O")
    O.set_vel(N, 0)
    particles, at, velocity = [], 0 * N.x, 0 * N.x
    for i in range(n):
        at = at + l[i] * (sympy.sin(q[i]) * N.x - sympy.cos(q[i]) * N.y)
        velocity = velocity + l[i] * u[i] * (sympy.cos(q[i]) * N.x + sympy.sin(q[i]) * N.y)
        P = O.locatenew(f"P{i}", at)
        P.set_vel(N, velocity)
        body = Particle(f"B{i}", P, m[i])
        body.potential_energy = m[i] * g * at.dot(N.y)
        particles.append(body)
    method = LagrangesMethod(Lagrangian(N, *particles), q, frame=N)
    method.form_lagranges_equations()
    method.mass_matrix, method.forcing
    return {"import": imported - began, "derive": time.perf_counter() - imported}


def chain_heyoka(n):
    """The same by heyoka's own Lagrangian routine, expressions only (nothing compiled). It solves for the accelerations, so it is asked for small n only."""
    began = time.perf_counter()
    import heyoka as hy
    imported = time.perf_counter()
    q = [hy.expression(f"p{i}") for i in range(n)]
    u = [hy.expression(f"w{i}") for i in range(n)]
    par = hy.par
    T = U = hy.expression(0.0)
    vx = vy = y = hy.expression(0.0)
    for i in range(n):
        l, m = par[n + i], par[i]
        vx = vx + l * u[i] * hy.cos(q[i])
        vy = vy + l * u[i] * hy.sin(q[i])
        y = y - l * hy.cos(q[i])
        T = T + 0.5 * m * (vx**2 + vy**2)
        U = U + 9.81 * m * y
    hy.lagrangian(T - U, q, u)
    return {"import": imported - began, "derive": time.perf_counter() - imported}


def frame_scipy(bays):
    """20 lowest modes of a plane frame of bays x bays bays by shift-invert eigsh at 0; the structure of crates/analysis/examples/frame.rs."""
    began = time.perf_counter()
    import resource
    import numpy as np
    import scipy.sparse as sp
    from scipy.sparse.linalg import eigsh
    imported = time.perf_counter()
    E, A, I, rho, span, height = 2.1e11, 0.01, 1e-4, 7850.0, 6.0, 3.0
    def rod(l):
        k, m, bend, axial = np.zeros((6, 6)), np.zeros((6, 6)), np.ix_([1, 2, 4, 5], [1, 2, 4, 5]), np.ix_([0, 3], [0, 3])
        k[bend] = E * I / l**3 * np.array([[12, 6*l, -12, 6*l], [6*l, 4*l*l, -6*l, 2*l*l], [-12, -6*l, 12, -6*l], [6*l, 2*l*l, -6*l, 4*l*l]])
        k[axial] = E * A / l * np.array([[1, -1], [-1, 1]])
        m[bend] = rho * A * l / 420 * np.array([[156, 22*l, 54, -13*l], [22*l, 4*l*l, 13*l, -3*l*l], [54, 13*l, 156, -22*l], [-13*l, -3*l*l, -22*l, 4*l*l]])
        m[axial] = rho * A * l / 420 * np.array([[140, 70], [70, 140]])
        return k, m
    turn = np.kron(np.eye(2), np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]))
    (kb, mb), (kc, mc) = rod(span), (turn.T @ a @ turn for a in rod(height))
    node = np.arange((bays + 1) ** 2).reshape(bays + 1, bays + 1)
    beams, columns = np.stack([node[1:, :-1].ravel(), node[1:, 1:].ravel()], 1), np.stack([node[:-1].ravel(), node[1:].ravel()], 1)
    n, held = 3 * (bays + 1) ** 2, 3 * (bays + 1)
    def build(beam, column):
        rows, cols, values = [], [], []
        for ends, matrix in ((beams, beam), (columns, column)):
            places = (3 * ends[:, :, None] + np.arange(3)).reshape(len(ends), 6)
            rows.append(np.repeat(places, 6, 1).ravel())
            cols.append(np.tile(places, (1, 6)).ravel())
            values.append(np.tile(matrix.ravel(), len(ends)))
        return sp.csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(cols))), shape=(n, n))[held:, held:]
    K, M = build(kb, kc), build(mb, mc)
    assembled = time.perf_counter()
    values = eigsh(K, 20, M, sigma=0)[0]
    done = time.perf_counter()
    return {"import": imported - began, "assembly": assembled - imported, "solution": done - assembled, "size": K.shape[0],
            "memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, "values": sorted(values.tolist())}


if __name__ == "__main__":
    job, value = sys.argv[1], sys.argv[2]
    whole = time.perf_counter()
    out = globals()[job](float(value) if job.startswith("shaft") else int(value))
    out["all"] = time.perf_counter() - whole
    print(json.dumps(out))
