"""Writes anisotropic.csv, and anisotropic_gradient.csv where asked for the gradient: he and he_unified of surfaces of two correlation lengths at 50 digits, by the formulas of
docs/models/he.md and he_unified.md as printed there: slopes and lengths from the quadratic forms of the correlation function
in x and y, not from its axes.

    python3 anisotropic.py > anisotropic.csv                        needs mpmath; some minutes
    python3 anisotropic.py gradient > anisotropic_gradient.csv
"""
import functools
import pathlib
import random
import sys

from mpmath import acos, atan, cos, erfc, exp, lambertw, mp, mpc, mpf, pi, quad, sin, sqrt, tan

sys.path.append(str(pathlib.Path(__file__).parents[2] / "unified/tests/reference"))
from unified import (DEGREE, SINGLE_TABLE, bragg, chebyshev, dot, flat, fresnel, kicks, kirchhoff, lift, mueller,
                     return_factor, shadow)  # noqa: E402

mp.dps = 50
INDICES = [("0.77", "6.08"), ("1.5", "0"), ("0.3", "2.5"), ("2.2", "0.4")]


def form(a, b, psi):
    """The symmetric matrix with a along psi and b across, as (xx, xy, yy)."""
    c, s = cos(psi), sin(psi)
    return a * c * c + b * s * s, (a - b) * c * s, a * s * s + b * c * c


def of(matrix, x, y):
    return matrix[0] * x * x + 2 * matrix[1] * x * y + matrix[2] * y * y


def obstruction(theta, slope):
    return tan(theta) * erfc(1 / (2 * slope * tan(theta)))


def seen(theta, slope):
    return (1 - erfc(1 / (2 * slope * tan(theta))) / 2) / (1 + shadow(theta, slope))


@functools.cache
def flat_of(n, k):
    return flat(mpf(n), mpf(k), mpc(n, k) ** 2)


def single_reflection(sigma, inverse_squares, psi):
    """The mean over azimuths of that of each one's slope, 64 of half a turn."""
    def at(azimuth):
        slope = sigma * sqrt(of(inverse_squares, cos(azimuth), sin(azimuth)))
        return min(mpf(1), chebyshev(SINGLE_TABLE, 2 * slope - 1))
    return sum(at(psi + pi * (i + mpf("0.5")) / 64) for i in range(64)) / 64


def published(sigma, along, across, psi, t_i, p_i, t_r, p_r, e):
    """The lobe and the mirror term of he, unpolarised; angles in radians."""
    c_i, c_r, s_i, s_r = cos(t_i), cos(t_r), sin(t_i), sin(t_r)
    v = [s_r * cos(p_r) + s_i * cos(p_i), s_r * sin(p_r) + s_i * sin(p_i), c_r + c_i]
    inverse_squares = form(1 / along**2, 1 / across**2, psi)
    slope_i = sigma * sqrt(of(inverse_squares, cos(p_i), sin(p_i)))
    slope_r = sigma * sqrt(of(inverse_squares, cos(p_r), sin(p_r)))
    ks = 2 * pi * sigma

    def sigma_of(sum_of_k):
        return ks / sqrt(1 + lambertw(sum_of_k**2 / (8 * pi)).real)

    def reflectance(cosine):
        return sum(abs(f) ** 2 for f in fresnel(cosine, e)) / 2

    g = (sigma_of(obstruction(t_i, slope_i) + obstruction(t_r, slope_r)) * v[2]) ** 2
    phi, _ = kicks(g, pi**2 * of(form(along**2, across**2, psi), v[0], v[1]))
    squared = dot(v, v)
    lobe = reflectance(sqrt(squared) / 2) * (squared / v[2]) ** 2 * seen(t_i, slope_i) * seen(t_r, slope_r) * (
        4 * pi**2 * along * across * phi / 16) / (pi * c_i * c_r)
    mirror = reflectance(c_i) * exp(-(sigma_of(2 * obstruction(t_i, slope_i)) * 2 * c_i) ** 2) * seen(t_i, slope_i) ** 2
    return lobe, mirror


def gradient(values):
    """Of both by sigma, along, across [1/um], psi, theta_i, theta_r, phi_r [1/rad], by central differences at 50 digits."""
    e = mpc(values[8], values[9]) ** 2
    x = [mpf(v) * (DEGREE if 3 <= i < 8 else 1) for i, v in enumerate(values[:8])]
    step = mpf(10) ** -15
    result = []
    for which in (0, 1, 2, 3, 4, 6, 7):
        moved = lambda by: published(*[v + (by if i == which else 0) for i, v in enumerate(x)], e)
        result.append([(b - a) / (2 * step) for a, b in zip(moved(-step), moved(step))])
    return [row[0] for row in result] + [row[1] for row in result[:5]]


def point(sigma, along, across, psi, theta_i, phi_i, theta_r, phi_r, n, k):
    t_i, p_i, t_r, p_r, psi = (x * DEGREE for x in (theta_i, phi_i, theta_r, phi_r, psi))
    e = mpc(n, k) ** 2
    c_i, c_r, s_i, s_r = cos(t_i), cos(t_r), sin(t_i), sin(t_r)
    k_i = [-s_i * cos(p_i), -s_i * sin(p_i), -c_i]
    k_r = [s_r * cos(p_r), s_r * sin(p_r), c_r]
    inverse_squares, squares = form(1 / along**2, 1 / across**2, psi), form(along**2, across**2, psi)
    slope_i = sigma * sqrt(of(inverse_squares, cos(p_i), sin(p_i)))
    slope_r = sigma * sqrt(of(inverse_squares, cos(p_r), sin(p_r)))
    t = pi**2 * of(squares, k_r[0] - k_i[0], k_r[1] - k_i[1])
    ks, tau, up = 2 * pi * sigma, sqrt(along * across), c_i + c_r
    kt = 2 * pi * tau
    lobe, mirror = published(sigma, along, across, psi, t_i, p_i, t_r, p_r, e)
    m_s, m_p = fresnel(c_i, e)
    # he_unified
    phi, beta = kicks((ks * up) ** 2, t)
    w = 1 - beta
    edge = lambda c: (1 + mpf(1.25) * ks * c) ** -4
    share = 1 - w * (1 - edge(c_i)) * (1 - edge(c_r))
    rows = zip(kirchhoff(k_i, k_r, e), bragg(t_i, t_r, p_r - p_i - pi, e, lift(ks, kt)))
    m = [[x + share * (y - x) for x, y in zip(*row)] for row in rows]
    single, r = single_reflection(sigma, inverse_squares, psi), flat_of(n, k)
    r = r * single / (1 - r * (1 - single))
    shadowing = (1 + r * w * (return_factor(t_i, slope_i) * return_factor(t_r, slope_r) - 1)) / (
        1 + w * (shadow(t_i, slope_i) + shadow(t_r, slope_r)))
    scale = kt**2 * phi * shadowing / (4 * pi * up**2 * c_i * c_r)
    root = (c_i**4 + mpf("0.229") * (s_i * slope_i / ks) ** 2) ** mpf(0.25)
    r_s = m_s * exp(-2 * ks**2 * c_i * root)
    r_p = m_p * exp(-2 * ks**2 * c_i * (root + mpf("0.65") / kt ** mpf(1.5) * s_i**4 / abs(c_i + 1 / mpc(n, k)) ** 2))
    return [lobe, mirror] + [scale * x for x in mueller(m)] + [abs(r_s) ** 2, abs(r_p) ** 2]


def draw(seed):
    logarithmic = lambda low, high: low * (high / low) ** seed.random()
    while True:
        sigma, slope, ratio = logarithmic(0.01, 2.0), logarithmic(0.01, 0.9), logarithmic(1.2, 50)
        lengths = [sigma / slope, sigma / slope * ratio]
        seed.shuffle(lengths)
        psi, theta_i, phi_i = seed.uniform(-180, 180), seed.uniform(0.5, 88), seed.uniform(0, 360)
        if seed.random() < 0.7:  # within the lobe
            c, s = cos(psi * DEGREE), sin(psi * DEGREE)
            q = [seed.gauss(0, sqrt(2) * sigma / length + 0.1 / length) for length in lengths]
            up = 2 * cos(theta_i * DEGREE)
            x = up * (q[0] * c - q[1] * s) - sin(theta_i * DEGREE) * cos(phi_i * DEGREE)
            y = up * (q[0] * s + q[1] * c) - sin(theta_i * DEGREE) * sin(phi_i * DEGREE)
            radius = sqrt(x * x + y * y)
            if radius >= 0.9999:
                continue
            theta_r = atan(radius / sqrt(1 - radius**2)) / DEGREE
            phi_r = acos(x / radius) / DEGREE * (1 if y > 0 else -1)
        else:
            theta_r, phi_r = seed.uniform(0.5, 88), seed.uniform(0, 360)
        values = [float("%.6g" % x) for x in (sigma, *lengths, psi, theta_i, phi_i, theta_r, phi_r)]
        n, k = INDICES[seed.randrange(len(INDICES))]
        result = point(*map(mpf, values), mpf(n), mpf(k))
        if result[0] > 1e-100 and result[2] > 1e-100:
            return values + [float(n), float(k)], result


def gradients():
    rows = [line.split(",")[:12] for line in open(pathlib.Path(__file__).with_name("anisotropic.csv")) if line[0].isdigit()]
    print("# Derivatives of the lobe and of the mirror term of he at the points of anisotropic.csv, written by anisotropic.py.")
    by = ["sigma", "along", "across", "azimuth", "theta_i", "theta_r", "phi"]
    print("row," + ",".join("lobe_" + name for name in by) + "," + ",".join("mirror_" + name for name in by[:5]))
    for row, values in enumerate(rows):
        print(",".join([str(row)] + [mp.nstr(x, 20) for x in gradient(values[:10])]))


def main():
    seed = random.Random(17)
    print("# Surfaces of two correlation lengths at 50 digits, written by anisotropic.py. Wavelength 1 um; azimuth that of `along`. The")
    print("# lobe and the mirror of he, unpolarised; the Mueller matrix of the lobe of he_unified, and |R_s|^2 and |R_p|^2 of its mirror.")
    names = [f"m{i}{j}" for i in range(4) for j in range(4)]
    print("sigma,along,across,azimuth,theta_i,phi_i,theta_r,phi_r,n,k,lobe,mirror," + ",".join(names) + ",rs,rp")
    for _ in range(100):
        values, result = draw(seed)
        print(",".join([repr(x) for x in values] + [mp.nstr(x, 20) for x in result]))


if __name__ == "__main__":
    gradients() if sys.argv[1:] == ["gradient"] else main()
