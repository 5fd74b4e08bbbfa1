#!/usr/bin/env python3
"""Writes walter_facets.csv, walter_brdf.csv, walter_bsdf.csv and walter_furnace.csv beside itself, in a few minutes.

The equations of Walter et al. 2007 as printed, with angles and vectors of 50 digits (mpmath); G_1 from Smith's integral
(48) over slopes (42), (43), by quadrature, never from (26) or (34). Nothing of the engine is used. The furnace is an
integral over facets in double precision, done twice to know its error.
  usage: walter.py
"""
import math
import os
import random

from mpmath import mp, mpf, acos, atan2, cos, erfc, exp, fabs, gamma, inf, log, nstr, pi, quad, sin, sqrt, tan

mp.dps = 50
FOLDER = os.path.dirname(os.path.abspath(__file__))
BECKMANN, PHONG, GGX = 0, 1, 2


def rad(degrees):
    return mpf(degrees) * pi / 180


# ------------------------------------------------------------------------------------------- normals

def density(shape, width, theta):
    """D of (25), (30), (33); width is alpha, or Phong's exponent."""
    w = mpf(width)
    if shape == BECKMANN:
        return exp(-tan(theta) ** 2 / w**2) / (pi * w**2 * cos(theta) ** 4)
    if shape == PHONG:
        return (w + 2) / (2 * pi) * cos(theta) ** w
    return w**2 / (pi * cos(theta) ** 4 * (w**2 + tan(theta) ** 2) ** 2)


def slope_density(shape, width, q):
    """P_2(q) of (43): the integral of D cos^4 over the other slope, each in closed form (checked below)."""
    w = mpf(width)
    if shape == BECKMANN:
        return exp(-(q**2) / w**2) / (sqrt(pi) * w)
    if shape == PHONG:
        return (w + 2) / 2 * gamma((w + 3) / 2) / (sqrt(pi) * gamma((w + 4) / 2)) * (1 + q**2) ** (-(w + 3) / 2)
    return w**2 / (2 * (w**2 + q**2) ** mpf(1.5))


def check_slope_density():
    for shape, width in ((BECKMANN, 0.4), (PHONG, 7), (GGX, 0.6)):
        for q in (0, 0.3, 1.1):
            by_quadrature = quad(lambda p: density(shape, width, mp.atan(sqrt(p * p + q * q))) *
                                 cos(mp.atan(sqrt(p * p + q * q))) ** 4, [-inf, -1, 0, 1, inf])
            assert fabs(by_quadrature / slope_density(shape, width, q) - 1) < mpf("1e-15"), (shape, q)


def smith(shape, width, theta):
    """G_1 = 1/(1 + Lambda), (48) and (50); Lambda integrated with q = mu + scale x."""
    mu = cos(theta) / sin(theta)
    scale = mpf(width) if shape != PHONG else sqrt(2 / (mpf(width) + 2))
    scale = scale * scale / (scale + mu) if shape == BECKMANN else scale + mu
    integrand = lambda x: scale * x * slope_density(shape, width, mu + scale * x) * scale
    top = [1, 4, 16, 64] if shape == BECKMANN else [1, 10, 1000, inf]
    return 1 / (1 + quad(integrand, [0] + top) / mu)


# ------------------------------------------------------------------------------------------- vectors

def direction(theta, phi, side=1):
    t, p = rad(theta), rad(phi)
    return (sin(t) * cos(p), sin(t) * sin(p), side * cos(t))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def combined(s, a, t, b):
    return tuple(s * x + t * y for x, y in zip(a, b))


def unit(a):
    return combined(1 / sqrt(dot(a, a)), a, 0, a)


def conductor_fresnel(c, n, k):
    """(|F_s|^2 + |F_p|^2)/2 of a complex index."""
    index = mp.mpc(n, k)
    r = mp.sqrt(index**2 - 1 + c**2)
    return (fabs((c - r) / (c + r)) ** 2 + fabs((index**2 * c - r) / (index**2 * c + r)) ** 2) / 2


def dielectric_fresnel(c, eta_i, eta_t):
    """(22)."""
    g2 = (mpf(eta_t) / eta_i) ** 2 - 1 + c**2
    if g2 <= 0:
        return mpf(1)
    g = sqrt(g2)
    return ((g - c) / (g + c)) ** 2 / 2 * (1 + ((c * (g + c) - 1) / (c * (g - c) + 1)) ** 2)


def shadowing(shape, width, theta_i, theta_o):
    """(23)."""
    return smith(shape, width, rad(theta_i)) * smith(shape, width, rad(theta_o))


def reflection(shape, width, fresnel, i, o, theta_i, theta_o):
    """(20), for directions of one side, z up."""
    h = unit(combined(1, i, 1, o))
    return (fresnel(fabs(dot(i, h))) * shadowing(shape, width, theta_i, theta_o) * density(shape, width, acos(h[2])) /
            (4 * fabs(i[2]) * fabs(o[2])))


def refraction(shape, width, eta_i, eta_o, i, o, theta_i, theta_o):
    """(21), i up, o down; h_t of (16) points into the medium of lower index. None where chi+ is 0."""
    h = combined(-eta_i, i, -eta_o, o)
    squared = dot(h, h)
    h = unit(h)
    m = h if eta_o > eta_i else combined(-1, h, 0, h)
    if m[2] <= 0 or dot(i, m) <= 0 or dot(o, m) >= 0:
        return None
    im, om = dot(i, h), dot(o, h)
    return (fabs(im) * fabs(om) / (fabs(i[2]) * fabs(o[2])) * mpf(eta_o) ** 2 * (1 - dielectric_fresnel(fabs(im), eta_i, eta_o)) *
            shadowing(shape, width, theta_i, theta_o) * density(shape, width, acos(m[2])) / (eta_i * im + eta_o * om) ** 2)


# ------------------------------------------------------------------------------------------- points

def number(value):
    return "0" if value == 0 else nstr(value, 20, min_fixed=0, max_fixed=0)


class Table:
    def __init__(self, name, comments, header):
        self.lines = ["# " + c for c in comments] + ["# made by: hts/microfacet/tests/reference/walter.py", header]
        self.path = os.path.join(FOLDER, name)

    def add(self, inputs, values):
        self.lines.append(",".join([repr(x) for x in inputs] + [number(v) for v in values]))

    def close(self):
        with open(self.path, "w") as file:
            file.write("\n".join(self.lines) + "\n")


def draw_width(draw, shape, least=0.01):
    alpha = round(math.exp(draw.uniform(math.log(least), math.log(2 if shape != PHONG else 0.99))), 6)
    return round(2 / alpha**2 - 2, 3) if shape == PHONG else alpha


def draw_facet(draw, shape, width):
    """A facet within 30 decades of the peak, as a unit vector in double precision."""
    alpha = math.sqrt(2 / (width + 2)) if shape == PHONG else width
    tangent = alpha * (math.sqrt(draw.uniform(0, 50)) if shape != GGX else math.exp(draw.uniform(-4, 4)))
    turn = draw.uniform(0, 2 * math.pi)
    return unit((tangent * math.cos(turn), tangent * math.sin(turn), 1.0))


def degrees_of(v):
    theta = float(mp.atan2(sqrt(v[0] ** 2 + v[1] ** 2), fabs(v[2])) * 180 / pi)
    return round(theta, 10), round(float(atan2(v[1], v[0]) * 180 / pi), 10)


def write_facets():
    table = Table("walter_facets.csv",
                  ["D of Walter et al. 2007 (25), (30), (33) and Smith's G_1 = 1/(1 + Lambda) with Lambda by quadrature of (48).",
                   "shape 0 Beckmann, 1 Phong (width: exponent), 2 GGX."],
                  "shape,width,theta_deg,density,smith")
    draw = random.Random(1)
    for row in range(150):
        shape = row % 3
        width = draw_width(draw, shape, 1e-4)
        alpha = math.sqrt(2 / (width + 2)) if shape == PHONG else width
        theta = round(math.degrees(math.atan(alpha * math.exp(draw.uniform(-3, 2)))), 12)
        if row > 75:
            theta = round(draw.uniform(0.01, 89.99), 10)
        table.add([shape, width, theta], [density(shape, width, rad(theta)), smith(shape, width, rad(theta))])
    table.close()


def write_brdf():
    table = Table("walter_brdf.csv", ["(20) of Walter et al. 2007 with the complex Fresnel reflectance of index n + ik."],
                  "shape,width,n,k,theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,brdf")
    draw, rows = random.Random(2), 0
    while rows < 150:
        shape = rows % 3
        width = draw_width(draw, shape)
        n, k = round(draw.uniform(0.1, 3), 4), round(draw.choice([0, draw.uniform(0, 8)]), 4)
        theta_i, phi_i = round(draw.uniform(0.01, 89), 6), round(draw.uniform(0, 360), 6)
        i, m = direction(theta_i, phi_i), draw_facet(draw, shape, width)
        o = combined(2 * dot(i, m), m, -1, i)
        theta_o, phi_o = degrees_of(o)
        if dot(i, m) <= 0 or o[2] <= 0 or theta_o > 89.5:
            continue
        fresnel = lambda c: conductor_fresnel(c, n, k)
        table.add([shape, width, n, k, theta_i, phi_i, theta_o, phi_o],
                  [reflection(shape, width, fresnel, i, direction(theta_o, phi_o), theta_i, theta_o)])
        rows += 1
    table.close()


def write_bsdf():
    table = Table("walter_bsdf.csv",
                  ["(20), (21) with (22) of Walter et al. 2007; out_side -1 is across the interface, angles from that side's normal."],
                  "shape,width,eta_in,eta_out,theta_i_deg,phi_i_deg,out_side,theta_o_deg,phi_o_deg,bsdf")
    draw, rows = random.Random(3), 0
    while rows < 150:
        shape = rows % 3
        width = draw_width(draw, shape)
        eta = round(draw.choice([draw.uniform(1.1, 2.5), 1.51]), 4)
        eta_in, eta_out = (1.0, eta) if rows % 2 else (eta, 1.0)
        theta_i, phi_i = round(draw.uniform(0.01, 89), 6), round(draw.uniform(0, 360), 6)
        i, m = direction(theta_i, phi_i), draw_facet(draw, shape, width)
        c, side = dot(i, m), 1 if rows % 5 == 0 else -1
        if c <= 0:
            continue
        relative = mpf(eta_in) / eta_out
        root = 1 + relative**2 * (c * c - 1)
        if side < 0 and root <= 0:
            continue
        o = combined(2 * c, m, -1, i) if side > 0 else combined(relative * c - sqrt(root), m, -relative, i)
        theta_o, phi_o = degrees_of(o)
        if o[2] * side <= 0 or theta_o > 89.5:
            continue
        o = direction(theta_o, phi_o, side)
        if side > 0:
            value = reflection(shape, width, lambda x: dielectric_fresnel(x, eta_in, eta_out), i, o, theta_i, theta_o)
        else:
            value = refraction(shape, width, eta_in, eta_out, i, o, theta_i, theta_o)
            if value is None:
                continue
        table.add([shape, width, eta_in, eta_out, theta_i, phi_i, side, theta_o, phi_o], [value])
        rows += 1
    table.close()


# ------------------------------------------------------------------------------------------- furnace

def fast_smith(shape, width, c):
    """1/(1 + Lambda) in double precision: closed forms of (48), which check_fast_smith() compares with the quadrature.
    Phong's needs an even exponent."""
    mu = c / math.sqrt((1 - c) * (1 + c)) if c < 1 else math.inf
    if mu == math.inf:
        return 1.0
    if shape == GGX:
        return 2 / (1 + math.sqrt(1 + (width / mu) ** 2))
    if shape == PHONG:
        n, s2 = (width + 2) // 2, (1 - c) * (1 + c)
        term, beta = 1.0, 0.0  # the incomplete beta function of integer n
        for j in range(n):
            beta += term
            term *= s2 * (j + 0.5) / (j + 1)
        peak = math.gamma(n + 0.5) / (math.sqrt(math.pi) * math.gamma(n))
        return 1 / (1 + peak * s2**n / ((width + 1) * c) - (1 - c * beta) / 2)
    a = mu / width
    return 1 / (1 + (math.exp(-a * a) / (a * math.sqrt(math.pi)) - math.erfc(a)) / 2)


def check_fast_smith():
    for shape, width in ((BECKMANN, 0.5), (PHONG, 2), (PHONG, 16), (GGX, 0.5)):
        for degrees in (20, 60, 85):
            fast = fast_smith(shape, width, math.cos(math.radians(degrees)))
            assert abs(fast - smith(shape, width, rad(degrees))) < 1e-13, (shape, width, degrees)


def fast_fresnel(c, eta):
    g2 = eta**2 - 1 + c**2
    if g2 <= 0:
        return 1.0
    g = math.sqrt(g2)
    return ((g - c) / (g + c)) ** 2 / 2 * (1 + ((c * (g + c) - 1) / (c * (g - c) + 1)) ** 2)


def tangents(shape, width, nodes):
    """tan theta_m at the nodes with the weight of D cos d omega / 2 pi."""
    points = []
    for x, weight in nodes:
        if shape == BECKMANN:
            r = 6.5 * x
            points.append((width * r, 6.5 * weight * 2 * r * math.exp(-r * r)))
        elif shape == GGX:
            points.append((width * math.sqrt((1 - x * x) / (x * x)), weight * 2 * x))
        else:
            points.append((math.sqrt(x ** (-4 / (width + 2)) - 1), weight * 2 * x))
    return points


def midpoints(count):
    """The midpoint rule on [0, 1]: total reflection leaves integrands with roots, where it loses less than Gauss's."""
    return [((k + 0.5) / count, 1 / count) for k in range(count)]


def furnace(shape, width, theta, eta, nodes, azimuths):
    """Kept of the light by perfect mirrors; reflected and transmitted by facets of relative index eta."""
    ci, si = math.cos(math.radians(theta)), math.sin(math.radians(theta))
    mirrors = reflected = transmitted = 0.0
    for tangent, weight in tangents(shape, width, nodes):
        mz = 1 / math.sqrt(1 + tangent * tangent)
        for k in range(azimuths):
            x = tangent * math.cos(math.pi * (k + 0.5) / azimuths)
            seen = ci + si * x
            if seen <= 0:
                continue
            c = min(1.0, seen * mz)
            share = weight * seen / azimuths
            f = fast_fresnel(c, eta)
            up = 2 * c * mz - ci
            if up > 0:
                kept = share * fast_smith(shape, width, min(1.0, up))
                mirrors += kept
                reflected += kept * f
            if f < 1:
                down = (math.sqrt(1 - (1 - c * c) / eta**2) - c / eta) * mz + ci / eta
                if down > 0:
                    transmitted += share * (1 - f) * fast_smith(shape, width, min(1.0, down))
    return tuple(x * fast_smith(shape, width, ci) / ci for x in (mirrors, reflected, transmitted))


def write_furnace():
    table = Table("walter_furnace.csv",
                  ["What single scattering keeps: the share of light that facets of reflectance 1 send on past the others, and what",
                   "facets of relative index eta reflect and transmit; integrals over visible normals of G_1(out), to 1e-4."],
                  "shape,width,theta_deg,eta,mirrors,reflected,transmitted")
    coarse, fine = midpoints(600), midpoints(1300)
    worst = 0
    for shape, widths in ((BECKMANN, (0.2, 0.5, 1.0)), (PHONG, (16, 2)), (GGX, (0.2, 0.5, 1.0))):
        for width in widths:
            for row, theta in enumerate((0, 30, 60, 80)):
                eta = (1.5, 1 / 1.5)[row % 2] if width != 0.5 else (1 / 1.51, 1.51)[row % 2]
                value = furnace(shape, width, theta, eta, fine, 250)
                check = furnace(shape, width, theta, eta, coarse, 120)
                worst = max(worst, max(abs(a - b) for a, b in zip(value, check)))
                table.add([shape, width, theta, eta], [mpf(round(x, 8)) for x in value])
    print("furnace: coarse from fine at most", worst)
    assert worst < 2e-4
    table.close()


if __name__ == "__main__":
    check_slope_density()
    check_fast_smith()
    write_facets()
    write_brdf()
    write_bsdf()
    write_furnace()
