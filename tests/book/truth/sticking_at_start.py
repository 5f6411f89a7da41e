"""Where the beginning of a sticking comes to t = 0 (tests/book/continue.md): a block with a spring and a damper on a table that is shaken, events by roots."""
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

m, k, c, N, mu, mus, A, ph = 2.0, 50.0, 2.0, 19.62, 0.25, 0.3, 0.06, 0.628

def begins(w, periods=60):
    """Shares of the period at which sticking begins, in the last period."""
    T = 2 * np.pi / w
    u = lambda t: A * np.sin(w * t + ph)
    v = lambda t: A * w * np.cos(w * t + ph)
    a = lambda t: -A * w * w * np.sin(w * t + ph)
    t, x, s = 0.0, 0.0, -A * w * np.cos(ph)
    state, out = np.sign(s), []
    while t < periods * T:
        if state == 0:
            # held: x = x0 + u(t) - u(t0)
            x0, t0 = x, t
            need = lambda t: m * a(t) + c * v(t) + k * (x0 + u(t) - u(t0))
            over = lambda t: abs(need(t)) - mus * N
            ts = t0 + np.linspace(0, 1, 2001)[1:] * T
            i = next(i for i in range(len(ts)) if over(ts[i]) > 0)
            t = brentq(over, ts[i - 1] if i else t0, ts[i], xtol=1e-15, rtol=1e-15)
            x, s = x0 + u(t) - u(t0), v(t)
            # what friction would have to hold points forward: it slips back
            state = -np.sign(need(t))
            begin = t
        else:
            d = state
            f = lambda t, y: [y[1], (-k * y[0] - c * y[1] - d * mu * N) / m]
            hit = lambda t, y: (y[1] - v(t)) * d if t > begin + 1e-9 * T else 1.0
            hit.terminal, hit.direction = True, -1
            begin = t
            r = solve_ivp(f, (t, t + 5 * T), [x, s], method="DOP853", rtol=1e-12, atol=1e-14, events=hit, max_step=T / 20)
            t, (x, s) = r.t[-1], r.y[:, -1]
            need = m * a(t) + c * v(t) + k * x
            state = 0 if abs(need) <= mus * N else -np.sign(need)
            if state == 0:
                out.append((t / T) % 1.0)
    return out[-4:]

if __name__ == "__main__":
    near = lambda w: min(((e + 0.5) % 1.0 - 0.5 for e in begins(w)), key=abs)
    print(brentq(near, 9.97, 9.99, xtol=1e-10))
