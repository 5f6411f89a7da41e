"""Points once a period of the driven pendulum of tests/book/poincare.md by DOP853: one value before the period doubles, two behind it."""
import numpy as np
from scipy.integrate import solve_ivp

T = 3*np.pi
for A in (1.05, 1.06, 1.07, 1.075):
    for tolerance in (1e-9, 1e-11):
        f = lambda t, s: [s[1], -s[1]/2 - np.sin(s[0]) + A*np.cos(2*t/3)]
        at = [(81 + i)*T for i in range(4)]
        found = solve_ivp(f, (0, 84*T), [-0.25, 1.96], "DOP853", rtol=tolerance, atol=0.1*tolerance, t_eval=at)
        print(A, tolerance, [f"{rate:.10f}" for rate in found.y[1]])
