"""Largest exponent of the driven pendulum of tests/book/stability.md: fourth-order steps of 64 motions beside one another, one tangent vector each, renormalised."""
import numpy as np
def exponent(b, g, w, time=3000.0, n=64, per=200, settle=60):
    rng = np.random.default_rng(1)
    T = 2*np.pi/w; h = T/per
    th = rng.uniform(-3, 3, n); v = rng.uniform(-1, 1, n); u = np.ones(n); z = np.zeros(n)
    def f(t, s):
        th, v, u, z = s
        return np.array([v, -b*v-np.sin(th)+g*np.cos(w*t), z, -b*z-np.cos(th)*u])
    s = np.array([th, v, u, z]); total = np.zeros(n); t = 0.0
    periods = int(time/T)
    for k in range(periods+settle):
        for i in range(per):
            t = h*i
            k1 = f(t, s); k2 = f(t+h/2, s+h/2*k1); k3 = f(t+h/2, s+h/2*k2); k4 = f(t+h, s+h*k3)
            s = s+h/6*(k1+2*k2+2*k3+k4)
        r = np.hypot(s[2], s[3]); s[2:] /= r
        if k >= settle: total += np.log(r)
    lam = total/(periods*T)
    return lam.mean(), lam.std()/np.sqrt(n), lam.min(), lam.max()
if __name__ == "__main__":
    for b, g, w in ((0.5, 1.5, 2/3), (0.5, 1.15, 2/3), (0.05, 0.6, 0.7)):
        print(b, g, w, exponent(b, g, w), flush=True)
