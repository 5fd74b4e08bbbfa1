"""What a perfect conductor of he_unified returns, by the formulas of docs/models/he_unified.md alone: facets by
vectors, m by Sinkhorn's scaling of the kernel itself, Phi and beta by their series, integrals by Gauss's rule.

    python3 furnace.py SIGMA0 TAU      in wavelengths; NumPy and SciPy
"""
import sys
import numpy as np
from scipy.special import erfc, gammaln
from scipy.interpolate import CubicSpline
k = 2*np.pi

def solve_m(slope, n=120, nphi=256):
    """m(theta) and E by Sinkhorn in mu = cos(theta), Gauss-Legendre in theta"""
    x, w = np.polynomial.legendre.leggauss(n)
    th = (x+1)*np.pi/4; w = w*np.pi/4
    c, s = np.cos(th), np.sin(th)
    L = lam(th, slope)
    px, pw = np.polynomial.legendre.leggauss(nphi)
    ph = (px+1)*np.pi/2; pw = pw*np.pi/2*2
    K = np.zeros((n, n))
    a2 = (2*slope)**2
    for i in range(n):
        vx2 = s[i]**2 + s[:, None]**2 - 2*s[i]*s[:, None]*np.cos(ph)[None, :]
        up = c[i] + c[:, None]
        q2 = vx2/up**2
        cosh4 = 1/(1+q2)**2
        D = np.exp(-q2/a2)/(np.pi*a2*cosh4)
        K[i] = (D/(4*c[i]*c[:, None]*(1+L[i]+L[:, None]))*pw[None, :]).sum(1)*c*s*w
    E = K.sum(1)
    m = np.ones(n)
    for _ in range(4000):
        new = np.sqrt(m/(K@m))
        if abs(new/m-1).max() < 1e-13:
            break
        m = new
    Ebar = 2*(E*c*s*w).sum()
    return CubicSpline(th, m), E[0], Ebar

def lam(th, slope):
    c = np.cos(th)/np.sin(np.maximum(th, 1e-9))/(2*slope)
    return 0.5*(np.exp(-c*c)/(np.sqrt(np.pi)*c) - erfc(c))

def phi_beta(g, t):
    m = np.arange(1, 400)[:, None]
    lt = m*np.log(g)[None, :] - gammaln(m+1) - np.log(m) - t[None, :]/m - g[None, :]
    term = np.exp(lt)
    P = term.sum(0)
    b = (term/m).sum(0)
    return P, b/np.maximum(P, 1e-300)

def lobe(sig, tau, th, m, Rp, n=160, nphi=256):
    x, w = np.polynomial.legendre.leggauss(n)
    tr = (x+1)*np.pi/4; w = w*np.pi/4
    px, pw = np.polynomial.legendre.leggauss(nphi)
    ph = (px+1)*np.pi/2; pw = pw*np.pi/2*2     # phi from forward, symmetric
    TR, PH = np.meshgrid(tr, ph, indexing='ij')
    W = (w[:, None]*pw[None, :])
    ci, si, cr, sr = np.cos(th), np.sin(th), np.cos(TR), np.sin(TR)
    cp, sp = np.cos(PH), np.sin(PH)
    up = ci+cr
    vxy2 = si*si+sr*sr-2*si*sr*cp
    g = (k*sig*up)**2; t = vxy2*(k*tau)**2/4
    P, b = phi_beta(g.ravel(), t.ravel()); P = P.reshape(g.shape); b = b.reshape(g.shape)
    ww = 1-b
    Lf = lambda c: (1+1.25*k*sig*c)**-4.0
    bp = 1-ww*(1-Lf(ci))*(1-Lf(cr))
    slope = sig/tau
    G = (1+Rp*ww*(m(th)*m(TR)-1))/(1+ww*(lam(np.array(max(th, 1e-6)), slope)+lam(TR, slope)))
    # facet's matrix by vectors: light travels towards +x, downwards
    kin = np.array([si, 0, -ci])
    kout = np.stack([sr*cp, sr*sp, cr], -1)
    h = kout-kin; h /= np.linalg.norm(h, axis=-1, keepdims=True)
    def frame(kv):
        z = np.array([0, 0, 1.0])
        s = np.cross(kv, z); s /= np.linalg.norm(s, axis=-1, keepdims=True)
        return s, np.cross(s, kv)
    s_i, p_i = frame(kin); s_r, p_r = frame(kout)
    refl = lambda e: 2*h*(h@e)[..., None]-e
    dot = lambda a, b: (a*b).sum(-1)
    es, ep = refl(s_i), refl(p_i)
    Jss, Jps, Jsp, Jpp = dot(es, s_r), dot(es, p_r), dot(ep, s_r), dot(ep, p_r)
    A = 1-si*sr*cp+ci*cr
    Z = 0.25*(k*sig)**2*(k*tau)**-1.5
    di, dr = ci/(ci+Z), cr/(cr+Z)
    B = dict(ss=-2*ci*cr*cp, sp=-2*cr*di*sp, ps=-2*ci*dr*sp, pp=2*di*dr*(cp-si*sr))
    J = dict(ss=Jss, sp=Jsp, ps=Jps, pp=Jpp)
    pre = (k*tau)**2*P*G/(4*np.pi*up**2*ci*cr)*cr*sr*W
    M = {e: A*J[e]+bp*(B[e]-A*J[e]) for e in B}
    s_in = (pre*(M['ss']**2+M['ps']**2)).sum(); p_in = (pre*(M['sp']**2+M['pp']**2)).sum()
    return s_in, p_in

def mirror(sig, tau, th):
    c, s = np.cos(th), np.sin(th)
    a4 = 0.229*s*s/(k*tau)**2
    q = (c**4+a4)**0.25
    xs = 4*(k*sig)**2*c*q
    xp = 4*(k*sig)**2*c*(q+0.65*(k*tau)**-1.5*s**4/c**2)
    return np.exp(-xs), np.exp(-xp)

if __name__ == "__main__":
    sig, tau = float(sys.argv[1]), float(sys.argv[2])
    m, E0, Ebar = solve_m(sig/tau)
    print("slope", sig/tau, "E(0)", E0, "Ebar", Ebar, "m(0,60,85)", m(0.0), m(np.radians(60)), m(np.radians(85)))
    for d in [0.5, 30, 60, 75, 80, 85, 87]:
        th = np.radians(d)
        s, p = lobe(sig, tau, th, m, 1.0); ms, mp = mirror(sig, tau, th)
        print(f"{d:5} lobe s {s:.4f} p {p:.4f}  mirror s {ms:.4f} p {mp:.4f}  total s {s+ms:.4f} p {p+mp:.4f} unpolarised {(s+p+ms+mp)/2:.4f}")
