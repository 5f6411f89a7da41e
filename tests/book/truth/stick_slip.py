"""A mass on a belt with falling friction (tests/book/continue.md): x'' + 0.1 x' + x = F(v - x'), F(u) = 1/(1 + 3u). Stick-slip motions by one integration of the slip from
the break-away x = F(0) - 0.1 v, x' = v; the speed of the belt at which they vanish: the slip comes back to x' = v where it broke away, without an interval of sticking.
Oscillations that slip all the time: zeros of the map of x on x' = 0."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

D, C = 3.0, 0.1


def rates(v):
    return lambda t, s: [s[1], -s[0] - C * s[1] + 1 / (1 + D * max(v - s[1], 0.0))]


def slip(v, start, event, until=40.0):
    event.terminal = True
    return solve_ivp(rates(v), (0, until), start, method="DOP853", rtol=3e-14, atol=1e-15, events=event)


def stick_slip(v):
    def back(t, s):
        return s[1] - v
    back.direction = 1
    away = 1 - C * v
    r = slip(v, [away, v], back)
    return r.t_events[0][0] + (away - r.y_events[0][0][0]) / v, r.y[0].max()


def excess(v):
    """The greatest speed after a slip, less that of the belt; the friction stays at its limit where the slip would be negative."""
    def top(t, s):
        return rates(v)(t, s)[1] if t > 1 else -1.0
    top.direction = -1
    r = slip(v, [1 - C * v, v], top)
    return r.y_events[0][0][1] - v


def turned(v, x):
    def section(t, s):
        return s[1] if t > 0.5 else -1.0
    section.direction = -1
    r = slip(v, [x, 0.0], section)
    return r.y_events[0][0][0], r.t_events[0][0]


if __name__ == "__main__":
    print("Hopf", (np.sqrt(D / C) - 1) / D)
    print("v = 1:", stick_slip(1.0))
    for v in (2.9, 3.0, 3.2):
        print(v, excess(v))
    vc = brentq(excess, 2.5, 3.2, xtol=1e-14)
    print("stick-slip ends at", repr(vc))
    # the unstable slip at v = 2
    rest = 1 / (1 + D * 2)
    for a in (0.3,0.6,0.9,1.2,1.5,1.8):
        try: print(a, turned(2.0, rest + a)[0] - rest - a)
        except Exception as e: print(a, e)
