"""A slow run of limited-motor over its idle speed by steps of 0.5 rad/s, forth and back, 20 s each from the end of the one before: mean speed over the last 4 s (DOP853)."""
import numpy as np
from scipy.integrate import solve_ivp
M, m, e, J, c, b, k = 10.0, 0.5, 0.04, 0.02, 4200.0, 12.0, 0.05
def rates(t, y, Om):
    x, p, v, w = y
    s, co = np.sin(p), np.cos(p)
    # (M+m) x'' - m e s p'' = m e w^2 co - c x - b v ;  (J + m e^2) p'' - m e s x'' = k (Om - w)
    a11, a12, a22 = M + m, -m*e*s, J + m*e*e
    r1, r2 = m*e*w*w*co - c*x - b*v, k*(Om - w)
    d = a11*a22 - a12*a12
    return [v, w, (a22*r1 - a12*r2)/d, (a11*r2 - a12*r1)/d]
grid = np.linspace(18, 30, 25)
y = np.array([0.0, 0.0, 0.0, 18.0])
for way, list_ in (("forth", grid), ("back", grid[::-1])):
    for Om in list_:
        s = solve_ivp(rates, (0, 20), y, method="DOP853", rtol=1e-11, atol=1e-13, args=(Om,), t_eval=[16, 20])
        mean = (s.y[1, 1] - s.y[1, 0])/4
        print(way, Om, repr(float(mean)))
        y = s.y[:, -1]
