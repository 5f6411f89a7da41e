"""Three masses on two floors and a cord, all impacts together: parabolas between blows, Newton's law for all that close or stand, 60 digits.

gaps g_i = G_i y + g0_i, M diagonal, constant forces f. Prints instants, impulses and the state at the end; 40 digits."""
from itertools import product
from mpmath import mp, mpf, matrix, lu_solve, polyroots, sqrt
mp.dps = 60
def run(e=('0.5','0.2','0.3'), F='20', w=('0.25','0.75'), end='0.5', most=60):
    e=[mpf(v) for v in e]; m=[mpf(4),mpf(1),mpf(3)]; f=[mpf(-40),mpf(-10),mpf(-30)-mpf(F)]
    G=[[mpf(1),0,0],[0,mpf(1),0],[-mpf(w[0]),-mpf(w[1]),mpf(1)]]; g0=[mpf(0),mpf(0),mpf(1)]
    y=[mpf('0.2'),mpf('0.2'),mpf('-0.8')]; v=[mpf(0)]*3; t=mpf(0); tiny=mpf(10)**-45
    dot=lambda a,b: sum(p*q for p,q in zip(a,b))
    def lcp(S,need,q):
        # Λ >= 0, G q + G M^-1 G' Λ >= need, complementary
        for s in product([1,0],repeat=len(S)):
            A=[i for i,k in zip(S,s) if k]; L=dict.fromkeys(S,mpf(0))
            if A:
                K=matrix(len(A),len(A)); r=matrix(len(A),1)
                for i,a in enumerate(A):
                    r[i]=need[a]-dot(G[a],q)
                    for j,b in enumerate(A): K[i,j]=sum(G[a][k]*G[b][k]/m[k] for k in range(3))
                x=lu_solve(K,r)
                for i,a in enumerate(A): L[a]=x[i]
            p=[q[k]+sum(L[a]*G[a][k] for a in S)/m[k] for k in range(3)]
            if all(L[a]>=-tiny for a in S) and all(dot(G[a],p)>=need[a]-tiny for a in S): return L,p
    out=[]
    end=mpf(end)
    while len(out)<most:
        gap=lambda: [dot(G[i],y)+g0[i] for i in range(3)]
        on=[i for i in range(3) if abs(gap()[i])<tiny]
        u=[dot(G[i],v) for i in range(3)]
        if any(u[i]<-tiny for i in on):
            while any(dot(G[i],v)<-tiny for i in on):
                S=[i for i in on if dot(G[i],v)<=tiny]
                L,v=lcp(S,[-e[i]*min(dot(G[i],v),0) for i in range(3)],v)
                out.append((t,{ 'abc'[k]:L[k] for k in S}))
        u=[dot(G[i],v) for i in range(3)]
        C=[i for i in on if abs(u[i])<tiny]
        a0=[f[k]/m[k] for k in range(3)]
        N,a=lcp(C,[mpf(0)]*3,a0)
        hit=end-t
        for i in range(3):
            if i in C and dot(G[i],a)<tiny: continue
            c=[dot(G[i],a)/2,dot(G[i],v),gap()[i] if i not in on else mpf(0)]
            if abs(c[0])<tiny: roots=[-c[2]/c[1]] if abs(c[1])>tiny else []
            else:
                d=c[1]**2-4*c[0]*c[2]
                roots=[(-c[1]-sqrt(d))/(2*c[0]),(-c[1]+sqrt(d))/(2*c[0])] if d>=0 else []
            for r in roots:
                if r>mpf(10)**-30 and r<hit: hit=r
        y=[y[k]+v[k]*hit+a[k]*hit**2/2 for k in range(3)]; v=[v[k]+a[k]*hit for k in range(3)]; t+=hit
        if t>=end-tiny: break
    return out,y,v,N
if __name__=='__main__':
    import sys
    out,y,v,N=run(end=sys.argv[1] if len(sys.argv)>1 else '0.3')
    for k,(t,L) in enumerate(out): print(k+1,mp.nstr(t,17),{a:mp.nstr(p,12) for a,p in L.items()})
    print([mp.nstr(q,16) for q in y+v], len(out))
