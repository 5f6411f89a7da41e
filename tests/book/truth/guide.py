"""Truth of the slider-crank with a dry guide in the chapter contacts.md: crank and rod angles with the pin force by hand, N from the balance of the piston,
branches of sign N and sign x' fixed from event to event, DOP853. No line of strutt is used.
"""
import numpy as np
from scipy.integrate import solve_ivp
def motion(times, end, r=.1, l=.35, mu=.1, g=9.81, P0=12., tol=2e-14):
    J, m, mp = .05, .8, 1.5
    Jr = m*l*l/12
    def solve(p, P, k):
        q = -np.arcsin(r*np.sin(p)/l); Q = -r*np.cos(p)*P/(l*np.cos(q))
        cp, sp, cq, sq = np.cos(p), np.sin(p), np.cos(q), np.sin(q)
        A = np.zeros((6, 6)); b = np.zeros(6)
        A[0,0] = J+m*r*r; A[0,1] = A[1,0] = m*r*l/2*np.cos(p-q); A[1,1] = Jr+m*l*l/4; A[2,2] = mp
        b[0] = 3-m*r*l/2*np.sin(p-q)*Q*Q-m*g*r*cp; b[1] = m*r*l/2*np.sin(p-q)*P*P-m*g*l/2*cq
        A[0,3] = -r*sp; A[0,4] = r*cp; A[1,3] = -l*sq; A[1,4] = l*cq; A[2,3] = -1; A[2,5] = 1
        A[3,2] = 1; A[3,0] = r*sp; A[3,1] = l*sq; b[3] = -(r*cp*P*P+l*cq*Q*Q)
        A[4,0] = r*cp; A[4,1] = l*cq; b[4] = r*sp*P*P+l*sq*Q*Q
        A[5,5] = 1; A[5,4] = k; b[5] = k*mp*g
        z = np.linalg.solve(A, b)
        return z[0], mp*g-z[4], -r*sp*P-l*sq*Q
    t, y = 0., np.array([.5, P0]); out = {}; events = []
    _, N, v = solve(*y, 0.); sN, sv = np.sign(N), np.sign(v)
    while t < end:
        k = mu*sN*sv
        f = lambda t, y: [y[1], solve(*y, k)[0]]
        eN = lambda t, y: solve(*y, k)[1]
        ev = lambda t, y: solve(*y, k)[2]
        for e, s in ((eN, sN), (ev, sv)): e.terminal = True; e.direction = -s
        s = solve_ivp(f, (t, end), y, method='DOP853', rtol=tol*5, atol=tol, max_step=2e-3, dense_output=True, events=[eN, ev])
        for w in times:
            if t <= w <= s.t[-1]: out[w] = (*s.sol(w), solve(*s.sol(w), k)[1])
        t, y = s.t[-1], s.y[:, -1]
        if len(s.t_events[0]): sN = -sN; events.append((t, 'N'))
        elif len(s.t_events[1]): sv = -sv; events.append((t, 'v'))
        else: break
    return out, events
if __name__ == '__main__':
    for kw in ({}, dict(mu=.2), dict(l=.3)):
        out, ev = motion((.32, .3206, .3207, .33, .5, 1.), 1., **kw)
        print(kw, [e for e in ev][:8], len(ev))
        for t, v in out.items(): print(t, *('%.15g' % x for x in v))
