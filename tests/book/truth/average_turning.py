"""Truth of average.md for a stiffness that turns with the rotor: harmonics, poles of the answers, zeros of the balance; argument: b in N s/m."""

import numpy as np, sys
T,me,k,Om,c,h=20.5,0.01,0.02,150.,2e4,0.3
b=float(sys.argv[1]) if len(sys.argv)>1 else 0.2
N=24; n=np.arange(-N,N+1)
def A(W):
    M=np.diag(c-T*n*n*W*W+1j*b*n*W).astype(complex)
    for i in range(len(n)-2):
        M[i,i+2]+=c*h/2; M[i+2,i]+=c*h/2
    return M
def L(W):
    f=np.zeros(2*N+1,complex); f[N+1]=f[N-1]=me*W*W/2
    x=np.linalg.solve(A(W),f)
    # <x'' sin phi>: sin = (e-e^-)/(2i)
    acc=-n*n*W*W*x
    m1=(acc[N-1]-acc[N+1])/(2j)   # mean of acc*sin
    # <x^2 sin2phi>
    x2=np.convolve(x,x); z=2*N
    m2=(x2[z-2]-x2[z+2])/(2j)
    return (k*(Om-W)+me*m1+h*c*m2).real
# poles: QEP
M0=np.diag(np.full(2*N+1,c)).astype(complex)
for i in range(2*N-1): M0[i,i+2]+=c*h/2; M0[i+2,i]+=c*h/2
M1=np.diag(1j*b*n); M2=np.diag(-T*n*n.astype(float))
# exclude n=0 singular: linearize in mu=1/W
I=np.eye(2*N+1); Mi=np.linalg.inv(M0)
Cm=np.block([[-Mi@M1,-Mi@M2],[I,np.zeros_like(I)]])
mu=np.linalg.eigvals(Cm); mu=mu[abs(mu)>1e-6]; p=1/mu
p=[z for z in p if 10<z.real<200 and z.imag>0]
p=sorted(p,key=lambda z:z.real)
print('poles',[ (round(z.real,6),z.imag) for z in p][:40])
g=list(np.linspace(10,200,4001))
for z in p:
    w=abs(z.imag)
    for s in (-1,1):
        g+=[z.real+s*w*10**(j/40) for j in range(-80,240)]
g=np.array(sorted(x for x in set(g) if 10<x<200))
v=np.array([L(x) for x in g])
from scipy.optimize import brentq
out=[]
for i in range(len(g)-1):
    if v[i]*v[i+1]<0: out.append((brentq(L,g[i],g[i+1],xtol=1e-15,rtol=1e-15), v[i]>0))
print([(repr(float(a)),bool(s)) for a,s in out])
