"""Woodpecker toy of tests/book/machines-with-contacts.md: linear motion by matrix exponentials, modes by enumeration, events by halving."""

from itertools import product

import numpy as np
from scipy.linalg import expm

M_M, J_M, M_S, J_S, C, G = 0.0003, 5e-9, 0.0045, 7e-7, 0.0056, 9.81
R_0, R_M, H_M, L_M, L_G, H_S, L_S = 0.0025, 0.0031, 0.0058, 0.010, 0.015, 0.02, 0.0201
RESTITUTION, MU, STEP = [0.5, 0.0, 0.0], 0.3, 5e-5
MASS = np.array(
    [[M_S + M_M, M_S * L_M, M_S * L_G], [M_S * L_M, J_M + M_S * L_M**2, M_S * L_M * L_G], [M_S * L_G, M_S * L_M * L_G, J_S + M_S * L_G**2]]
)
STIFFNESS = C * np.array([[0, 0, 0], [0, 1, -1], [0, -1, 1]])
WEIGHT = -G * np.array([M_S + M_M, M_S * L_M, M_S * L_G])
NORMAL = np.array([[0, 0, -H_S], [0, H_M, 0], [0, -H_M, 0]])
OPEN = np.array([L_M + L_G - L_S - R_0, R_M - R_0, R_M - R_0])
ALONG = np.array([[1, L_M, L_G - L_S], [1, R_M, 0], [1, R_M, 0]])
INVERSE = np.linalg.inv(MASS)
SIGN = {"+": 1, "-": -1}


def forces(mode, q):
    """Accelerations and (normal, tangential) force of each closed contact; a mode is o(pen), s(ticks), + or - (slides)."""
    closed = [i for i in range(3) if mode[i] != "o"]
    stuck = [i for i in closed if mode[i] == "s"]
    load = INVERSE @ (WEIGHT - STIFFNESS @ q)
    if not closed:
        return load, {}
    slides = [NORMAL[i] - (0 if mode[i] == "s" else MU * SIGN[mode[i]]) * ALONG[i] for i in closed]
    directions = np.array(slides + [ALONG[i] for i in stuck]).T
    held = np.array([NORMAL[i] for i in closed] + [ALONG[i] for i in stuck])
    impulse = np.linalg.solve(held @ INVERSE @ directions, -held @ load)
    found = {i: [impulse[j], 0 if mode[i] == "s" else -MU * impulse[j] * SIGN[mode[i]]] for j, i in enumerate(closed)}
    for j, i in enumerate(stuck):
        found[i][1] = impulse[len(closed) + j]
    return load + INVERSE @ directions @ impulse, found


def agrees(mode, q, u, closed):
    try:
        a, found = forces(mode, q)
    except np.linalg.LinAlgError:
        return False
    for i in closed:
        if mode[i] == "o":
            if NORMAL[i] @ a <= -1e-9:
                return False
            continue
        normal, along = found[i]
        if normal < -1e-12 or (mode[i] == "s" and abs(along) > MU * normal + 1e-12):
            return False
        if mode[i] != "s" and abs(ALONG[i] @ u) < 1e-9 and (ALONG[i] @ a) * SIGN[mode[i]] <= 0:
            return False
    return True


def decide(q, u, closed, banned):
    def options(i):
        if i not in closed:
            return ["o"]
        v = ALONG[i] @ u
        return (["s", "+", "-"] if abs(v) < 1e-9 else ["+"] if v > 0 else ["-"]) + ["o"]

    for mode in product(*map(options, range(3))):
        if not any(mode[i] == m for i, m in banned) and agrees(mode, q, u, closed):
            return mode
    raise ValueError("no mode")


def strike(u, i):
    n, t = NORMAL[i], ALONG[i]
    both = np.array([n, t])
    impulse = np.linalg.solve(both @ INVERSE @ both.T, [-(1 + RESTITUTION[i]) * (n @ u), -(t @ u)])
    if abs(impulse[1]) <= MU * impulse[0]:
        return u + INVERSE @ both.T @ impulse
    for sign in (1, -1):
        d = n - MU * sign * t
        after = u + INVERSE @ d * (-(1 + RESTITUTION[i]) * (n @ u) / (n @ INVERSE @ d))
        if sign * (t @ after) >= 0:
            return after
    raise ValueError("no impact")


def watched(mode, u):
    """What must stay positive, linear in (q, q', 1)."""
    a, found = forces(mode, np.zeros(3))
    units = [forces(mode, e)[1] for e in np.eye(3)]
    rows = {}
    for i in range(3):
        if mode[i] == "o":
            rows["gap", i] = np.concatenate([NORMAL[i], np.zeros(3), [OPEN[i]]])
            continue
        part = [np.array([unit[i][k] - found[i][k] for unit in units] + [0, 0, 0, found[i][k]]) for k in (0, 1)]
        rows["normal", i] = part[0]
        if mode[i] == "s":
            rows["forth", i], rows["back", i] = MU * part[0] - part[1], MU * part[0] + part[1]
        else:
            rows["slip", i] = np.concatenate([np.zeros(3), ALONG[i] * SIGN[mode[i]], [0]])
    return rows


def field(mode):
    constant = forces(mode, np.zeros(3))[0]
    matrix = np.zeros((7, 7))
    matrix[:3, 3:6] = np.eye(3)
    matrix[3:6, :3] = np.array([forces(mode, e)[0] - constant for e in np.eye(3)]).T
    matrix[3:6, 6] = constant
    return matrix


def first(matrix, z, rows, t, end):
    """Time, state and guard of the first sign change."""
    keys, values = list(rows), np.array(list(rows.values()))
    step = expm(matrix * STEP)
    while t < end - 1e-15:
        h = min(STEP, end - t)
        after = (step if h == STEP else expm(matrix * h)) @ z
        hit = values @ after < 0
        if hit.any():
            low, high = 0.0, h
            for _ in range(70):
                middle = (low + high) / 2
                below = (values[hit] @ expm(matrix * middle) @ z < 0).any()
                low, high = (low, middle) if below else (middle, high)
            beyond = np.where(hit, values @ expm(matrix * (high + 1e-13)) @ z, np.inf)
            return t + low, expm(matrix * low) @ z, keys[int(np.argmin(beyond))]
        z, t = after, t + h
    return end, z, None


def run(q, u, end):
    t, banned, events = 0.0, [], []
    closed = {i for i in range(3) if abs(OPEN[i] + NORMAL[i] @ q) < 1e-9 and abs(NORMAL[i] @ u) < 1e-9}
    while t < end:
        mode = decide(q, u, closed, banned)
        banned, closed = [], {i for i in range(3) if mode[i] != "o"}
        t, z, guard = first(field(mode), np.concatenate([q, u, [1]]), watched(mode, u), t, end)
        q, u = z[:3], z[3:6]
        if guard is None:
            break
        events.append((t, guard))
        kind, i = guard
        if kind in ("forth", "back"):
            banned = [(i, "s")]
        elif kind == "normal":
            closed = closed - {i}
        elif kind == "gap":
            u = strike(u, i)
            while any(NORMAL[j] @ u < -1e-12 for j in closed | {i}):
                u = strike(u, min(closed | {i}, key=lambda j: NORMAL[j] @ u))
            closed = {j for j in closed | {i} if abs(NORMAL[j] @ u) < 1e-9}
    return q, u, events


if __name__ == "__main__":
    q, u, events = run(np.array([0, -(R_M - R_0) / H_M, -0.2788]), np.array([-0.3411, 0, -7.4583]), 1.5)
    away = [t for t, (kind, _) in events if kind in ("forth", "back")]
    print("break-aways", away, "intervals", np.diff(away))
    print("at 1.5 s", q, u)
