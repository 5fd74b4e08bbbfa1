#!/usr/bin/env python3
"""Writes dispersion.csv: the nine dispersion formulas of refractiveindex.info with 50 digits (mpmath)."""
from mpmath import mp, mpf, sqrt, power, nstr

mp.dps = 50


def pairs(c):
    return [(c[i], c[i + 1]) for i in range(1, len(c) - 1, 2)]


def formula_4(c, l):
    c = c + [mpf(0)] * (17 - len(c))
    square = c[0] + sum(c[i] * power(l, c[i + 1]) for i in (9, 11, 13, 15) if c[i])
    for i in (1, 5):
        if c[i]:
            square += c[i] * power(l, c[i + 1]) / (l**2 - power(c[i + 2], c[i + 3]))
    return sqrt(square)


def formula_8(c, l):
    x = c[0] + c[1] / (1 - c[2] / l**2) + c[3] * l**2
    return sqrt((2 * x + 1) / (1 - x))


FORMULAS = {
    1: lambda c, l: sqrt(1 + c[0] + sum(b / (1 - (r / l) ** 2) for b, r in pairs(c))),
    2: lambda c, l: sqrt(1 + c[0] + sum(b / (1 - r / l**2) for b, r in pairs(c))),
    3: lambda c, l: sqrt(c[0] + sum(b * power(l, p) for b, p in pairs(c))),
    4: formula_4,
    5: lambda c, l: c[0] + sum(b * power(l, p) for b, p in pairs(c)),
    6: lambda c, l: 1 + c[0] + sum(b / (r - 1 / l**2) for b, r in pairs(c)),
    7: lambda c, l: c[0] + c[1] / (l**2 - mpf("0.028")) + c[2] / (l**2 - mpf("0.028")) ** 2
    + sum(c[i + 2] * l ** (2 * i) for i in (1, 2, 3)),
    8: formula_8,
    9: lambda c, l: sqrt(c[0] + c[1] / (l**2 - c[2]) + c[3] * (l - c[4]) / ((l - c[4]) ** 2 + c[5])),
}

# Formula, coefficients, wavelengths: the ends of the range first and last. Fused silica, N-BK7, a polynomial
# as of a Schott glass, MgO, SiC, dry air and made-up ones, among them one with all 17 coefficients of formula 4.
CASES = [
    (1, "0 0.6961663 0.0684043 0.4079426 0.1162414 0.8974794 9.896161", "0.21 0.5876 1.55 6.7"),
    (1, "0.3 0.5 0.1 0.25 0.2 0.1 0.05 0.2 9 0.1 11 0.3 12 0.05 15 0.02 20", "0.3 0.9 4.5"),
    (2, "0 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653", "0.3 0.5875618 2.5"),
    (3, "2.2718929 -0.010108077 2 0.010592509 -2 0.00020816965 -4 -7.6472538e-06 -6 4.9240991e-07 -8", "0.4 1 1.6"),
    (4, "2.956362 0.02195770 0 0.01428322 1 0 0 0 1 -0.01062387 2 -0.0000204968 4", "0.36 0.5876 5.4"),
    (4, "2.1 0.3 2 0.1 2 0.2 1 12 1.5 0.01 1 -0.002 2 0.003 -2 -0.0001 4", "0.4 1.1 3"),
    (5, "2.5538 0.0342 -2", "0.467 0.5893 0.691"),
    (5, "1.5 0.01 -2 0.0002 -4 -0.001 2 0.00001 4 0.02 0.5", "0.4 1.3 2"),
    (6, "0 0.05792105 238.0185 0.00167917 57.362", "0.23 0.5876 1.69"),
    (7, "1.5 0.01 0.0002 -0.002 -0.00001 0.0000003", "0.4 1 2.3"),
    (8, "0.452505 0.09939 0.0537 -0.00147", "0.45 0.5876 0.65"),
    (9, "2.1823 0.0125 0.03 0.02 1.52 0.88", "0.3 0.5876 1.06"),
]


def main():
    print("# The dispersion formulas of refractiveindex.info with 50 digits.")
    print("# made by: spectral/materials/tests/reference/dispersion.py > dispersion.csv")
    print("formula,coefficients,um,n")
    for number, coefficients, wavelengths in CASES:
        # The formulas see the doubles that a program reads, not the decimals.
        c = [mpf(float(x)) for x in coefficients.split()]
        ends = wavelengths.split()
        first, last = float(ends[0]), float(ends[-1])
        between = [f"{first * (last / first) ** (i / 20):.6g}" for i in range(1, 20)]
        for um in ends + between:
            print(f"{number},{coefficients},{um},{nstr(FORMULAS[number](c, mpf(float(um))), 25)}")


main()
