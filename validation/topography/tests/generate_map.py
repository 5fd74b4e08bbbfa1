#!/usr/bin/env python3
"""Writes cli/data/rough-surface.gsf: a computed map of K-correlation roughness, with noise, tilt and outliers.

    generate_map.py cli/data/rough-surface.gsf

rms 0.3 um, B 6 um, C 4 (C(x) = (1 + x) e^-x, x = r/0.955 um), noise 3 nm, 96 by 96 points of 0.25 um, by
circulant embedding in a period of 256 points.
"""
import array
import cmath
import math
import random
import sys

rms, length, step, side, period = 0.3, 6 / (2 * math.pi), 0.25, 96, 256


def fourier(line):
    if len(line) == 1:
        return line
    even, odd = fourier(line[::2]), fourier(line[1::2])
    turned = [cmath.exp(-2j * math.pi * k / len(line)) * z for k, z in enumerate(odd)]
    return [a + b for a, b in zip(even, turned)] + [a - b for a, b in zip(even, turned)]


def plane_fourier(field):
    rows = [fourier(row) for row in field]
    return [list(row) for row in zip(*(fourier(list(column)) for column in zip(*rows)))]


draw = random.Random(20)
lag = [step / length * min(i, period - i) for i in range(period)]
power = plane_fourier([[rms**2 * (1 + math.hypot(x, y)) * math.exp(-math.hypot(x, y)) for x in lag] for y in lag])
waves = [[math.sqrt(max(p.real, 0)) * complex(draw.gauss(0, 1), draw.gauss(0, 1)) for p in row] for row in power]
field = plane_fourier(waves)
heights = [field[j][i].real / period for j in range(side) for i in range(side)]
for k in range(side**2):
    heights[k] += draw.gauss(0, 0.003) + step * (0.01 * (k % side) - 0.004 * (k // side))
for _ in range(12):
    heights[draw.randrange(side**2)] += draw.choice([-4, 4])
for j in range(20, 26):
    for i in range(60, 68):
        heights[j * side + i] = math.nan
size = f"{side * step * 1e-6:.6g}"
head = (
    f"Gwyddion Simple Field 1.0\nXRes = {side}\nYRes = {side}\nXReal = {size}\nYReal = {size}\n"
    "XYUnits = m\nZUnits = m\nTitle = computed rough surface\n"
).encode()
head += b"\0" * (4 - len(head) % 4)
with open(sys.argv[1], "wb") as file:
    file.write(head + array.array("f", [1e-6 * z for z in heights]).tobytes())
