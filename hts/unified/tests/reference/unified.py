"""Writes unified.csv: he_unified at 50 digits by the formulas of docs/models/he_unified.md as printed there, without the engine's
rearrangements. Only the coefficients of hts/unified/return_factor_table.cpp are shared.

    python3 unified.py > unified.csv          needs mpmath; some minutes
"""
import pathlib
import random
import re

from mpmath import acos, cos, cot, erfc, exp, mp, mpc, mpf, pi, quad, sin, sqrt

mp.dps = 50
DEGREE = pi / 180


def table():
    text = (pathlib.Path(__file__).parents[2] / "return_factor_table.cpp").read_text()
    m, single = text.split("single_reflection_table{")
    rows = re.findall(r"\{\{?([-\d.,\s]+)\}\}", m)
    numbers = lambda row: [mpf(x) for x in re.findall(r"-?\d+\.\d+", row)]
    return [numbers(row) for row in rows], numbers(single)


M_TABLE, SINGLE_TABLE = table()


def chebyshev(coefficients, x):
    angle = acos(x)
    return sum(c * cos(j * angle) for j, c in enumerate(coefficients))


def return_factor(theta, slope):
    y = 1 / (1 + cot(theta) / (2 * slope)) if theta else mpf(0)
    by_y = [chebyshev([row[j] for row in M_TABLE], 2 * slope - 1) for j in range(len(M_TABLE[0]))]
    return chebyshev(by_y, 2 * y - 1)


def kicks(g, t):
    """Phi and the mean of 1/m."""
    m, term = 1, g * exp(-g - t)
    phi = chi = mpf(0)
    while True:
        phi, chi = phi + term, chi + term / m
        step = g * m / mpf(m + 1) ** 2 * exp(t / (m * (m + 1)))
        if step < mpf(1) / 2 and term < phi * mpf(10) ** -60:
            return phi, chi / phi
        m, term = m + 1, term * step


def fresnel(c, e):
    r = sqrt(e - 1 + c * c)
    return (c - r) / (c + r), (e * c - r) / (e * c + r)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def frame(k):
    s = cross(k, [0, 0, 1])
    s = [x / sqrt(dot(s, s)) for x in s]
    return s, cross(s, k)


def kirchhoff(k_i, k_r, e):
    """2 cos^2 theta_d times the rotation into the facet's plane, diag(F_s, F_p), and the rotation out."""
    half = [a - b for a, b in zip(k_r, k_i)]
    cosine = sqrt(dot(half, half)) / 2
    f = fresnel(cosine, e)
    s = cross(k_i, k_r)
    s = [x / sqrt(dot(s, s)) for x in s]
    p_i, p_r = cross(s, k_i), cross(s, k_r)
    frame_i, frame_r = frame(k_i), frame(k_r)
    jones = lambda out, into: f[0] * dot(out, s) * dot(into, s) + f[1] * dot(out, p_r) * dot(into, p_i)
    return [[2 * cosine**2 * jones(out, into) for into in frame_i] for out in frame_r]


def bragg(theta_i, theta_r, phi, e, lift):
    c_i, c_r, s_i, s_r = cos(theta_i), cos(theta_r), sin(theta_i), sin(theta_r)
    r_i, r_r = sqrt(e - s_i**2), sqrt(e - s_r**2)
    n_i, n_r = e * (c_i + lift) + r_i, e * (c_r + lift) + r_r
    b = [[-(e - 1) * cos(phi) / ((c_i + r_i) * (c_r + r_r)), -(e - 1) * r_i * sin(phi) / (n_i * (c_r + r_r))],
         [-(e - 1) * r_r * sin(phi) / ((c_i + r_i) * n_r), (e - 1) * (r_i * r_r * cos(phi) - e * s_i * s_r) / (n_i * n_r)]]
    return [[2 * c_i * c_r * x for x in row] for row in b]


def shadow(theta, slope):
    c = cot(theta) / (2 * slope)
    return (exp(-c * c) / (sqrt(pi) * c) - erfc(c)) / 2


def lift(ks, kt):
    """Z and how it fades."""
    z = ks**2 / kt ** mpf(1.5) / 4
    return z * (6 / ks if ks > 6 else 1) * ((kt / 2) ** mpf(2.5) if kt < 2 else 1)


def flat(n, k, e):
    kink = sqrt(1 - (n - k) * (n + k)) if (n - k) * (n + k) < 1 else mpf(0)
    ends = [mpf(0), kink, mpf(1)] if 0 < kink < 1 else [mpf(0), mpf(1)]
    reflected = lambda c: c * sum(abs(f) ** 2 for f in fresnel(c, e))
    with mp.workdps(25):
        return quad(reflected, ends, maxdegree=9)


def mueller(j):
    """Tr(sigma_a J sigma_b J^+)/2 for S = (I, s - p, 2 Re E_s E_p*, -2 Im E_s E_p*)."""
    i = mpc(0, 1)
    sigma = [[[1, 0], [0, 1]], [[1, 0], [0, -1]], [[0, 1], [1, 0]], [[0, -i], [i, 0]]]
    times = lambda a, b: [[sum(a[r][x] * b[x][c] for x in (0, 1)) for c in (0, 1)] for r in (0, 1)]
    adjoint = [[j[c][r].conjugate() for c in (0, 1)] for r in (0, 1)]
    trace = lambda a: a[0][0] + a[1][1]
    return [trace(times(times(times(a, j), b), adjoint)).real / 2 for a in sigma for b in sigma]


def point(sigma, tau, theta_i, theta_r, azimuth, n, k):
    """Wavelength 1, degrees; azimuth of the view where that of the light is 0."""
    t_i, t_r, a = theta_i * DEGREE, theta_r * DEGREE, azimuth * DEGREE
    ks, kt, slope, e = 2 * pi * sigma, 2 * pi * tau, sigma / tau, mpc(n, k) ** 2
    c_i, c_r, s_i, s_r = cos(t_i), cos(t_r), sin(t_i), sin(t_r)
    k_i, k_r = [-s_i, mpf(0), -c_i], [s_r * cos(a), s_r * sin(a), c_r]
    up = c_i + c_r
    g = (ks * up) ** 2
    t = ((k_r[0] - k_i[0]) ** 2 + k_r[1] ** 2) * kt**2 / 4
    phi, beta = kicks(g, t)
    w = 1 - beta
    edge = lambda c: (1 + mpf(1.25) * ks * c) ** -4
    share = 1 - w * (1 - edge(c_i)) * (1 - edge(c_r))
    kirch, brag = kirchhoff(k_i, k_r, e), bragg(t_i, t_r, a - pi, e, lift(ks, kt))
    m = [[x + share * (y - x) for x, y in zip(*rows)] for rows in zip(kirch, brag)]
    single = chebyshev(SINGLE_TABLE, 2 * slope - 1)
    single = min(single, mpf(1))
    r = flat(n, k, e)
    r = r * single / (1 - r * (1 - single))
    shadowing = (1 + r * w * (return_factor(t_i, slope) * return_factor(t_r, slope) - 1)) / (
        1 + w * (shadow(t_i, slope) + shadow(t_r, slope)))
    scale = kt**2 * phi * shadowing / (4 * pi * up**2 * c_i * c_r)
    f_s, f_p = fresnel(c_i, e)
    root = (c_i**4 + mpf("0.229") * s_i**2 / kt**2) ** mpf(0.25)
    f_s *= exp(-2 * ks**2 * c_i * root)
    f_p *= exp(-2 * ks**2 * c_i * (root + mpf("0.65") / kt ** mpf(1.5) * s_i**4 / abs(c_i + 1 / mpc(n, k)) ** 2))
    return [phi, beta, w] + [scale * x for x in mueller(m)] + [abs(f_s) ** 2, abs(f_p) ** 2, (f_s * f_p.conjugate()).real,
                                                              (f_s * f_p.conjugate()).imag]


def draw(seed):
    while True:
        logarithmic = lambda low, high: low * (high / low) ** seed.random()
        slope = logarithmic(0.003, 1.0)
        sigma = logarithmic(0.003, 3.0)
        theta_i = seed.uniform(0.01, 89.9) if seed.random() < 0.9 else 90 - logarithmic(1e-4, 1)
        if seed.random() < 0.7:
            off = min(40.0, 60 * slope + 0.1 * slope / sigma * 57)
            theta_r = abs(theta_i + seed.gauss(0, off))
            azimuth = 180 + seed.gauss(0, off)
        else:
            theta_r, azimuth = seed.uniform(0.01, 89.9), seed.uniform(0.1, 359.9)
        n, k = ((seed.uniform(0.1, 3), 0.0) if seed.random() < 0.4 else (logarithmic(0.05, 5), logarithmic(1e-3, 8)))
        values = [float("%.5g" % x) for x in (sigma, sigma / slope, theta_i, theta_r, azimuth, n, k)]
        sigma, tau, theta_i, theta_r = values[:4]
        if not 0.001 < theta_r < 89.9999 or not 0.003 <= sigma / tau <= 1 or theta_i > 89.9999:
            continue
        exact = [mpf(x) for x in values]
        g = (2 * pi * exact[0] * (cos(exact[2] * DEGREE) + cos(exact[3] * DEGREE))) ** 2
        across = (2 * pi * exact[1]) ** 2 / 4
        k_r = [sin(exact[3] * DEGREE) * cos(exact[4] * DEGREE) + sin(exact[2] * DEGREE),
               sin(exact[3] * DEGREE) * sin(exact[4] * DEGREE)]
        t = dot(k_r, k_r) * across
        if t < 300 * max(g, 1):
            return exact, values


def main():
    seed = random.Random(15)
    print("# he_unified at 50 digits, written by unified.py. Wavelength 1 um; phi, beta and w = 1 - beta; the Mueller matrix of the")
    print("# lobe [1/sr]; |R_s|^2, |R_p|^2 and R_s R_p* of the specular term, in its closed form.")
    names = [f"m{i}{j}" for i in range(4) for j in range(4)]
    print("sigma,tau,theta_i,theta_r,azimuth,n,k,phi,beta,w," + ",".join(names) + ",rs,rp,rsp_re,rsp_im")
    for _ in range(300):
        exact, values = draw(seed)
        print(",".join([repr(x) for x in values] + [mp.nstr(x, 20) for x in point(*exact)]))


if __name__ == "__main__":
    main()
