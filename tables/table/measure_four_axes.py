#!/usr/bin/env python3
"""How large a lookup table of an anisotropic surface would be: nodes along each of four axes, by cubic interpolation.

    tables/table/measure_four_axes.py build/release/bin/hts cli/data/brushed-aluminium.json

The axes are those in which the lobe keeps its shape best: the root of cos theta_i, the azimuth of the light, and the two
slopes of the half-way direction through asinh. Values are ln f. Each axis gets nodes until the worst of some 2400 random pairs
is within a quarter of 1e-2, the other three axes being exact: some half too many at most. Needs NumPy.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

command, path = sys.argv[1:]
surface = json.loads(pathlib.Path(path).read_text())
widths = [2 * surface["rms_roughness_um"] / length for length in surface["correlation_length_um"]]
TOLERANCE = 1e-2 / 4


def exact(light, view):
    """The lobe at 0.5 um, axes along x and y."""
    rows = np.zeros(len(light), dtype=[(name, "f8") for name in ("wavelength_um", "theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg")])
    rows["wavelength_um"] = 0.5
    for which, d in (("i", light), ("r", view)):
        rows[f"theta_{which}_deg"] = np.degrees(np.arctan2(np.hypot(d[:, 0], d[:, 1]), d[:, 2]))
        rows[f"phi_{which}_deg"] = np.degrees(np.arctan2(d[:, 1], d[:, 0])) + surface.get("azimuth_deg", 0)
    with tempfile.TemporaryDirectory() as folder:
        np.save(f"{folder}/in.npy", rows)
        words = [command, "eval", "--material", path, "--tolerance", "1e-6", "--points", f"{folder}/in.npy", "--output", f"{folder}/out.npy"]
        subprocess.run(words, check=True, stderr=subprocess.DEVNULL)
        return np.load(f"{folder}/out.npy")["directional_diffuse"]


def directions(x):
    """Light, view, and whether both are above the horizon and the half-way direction is lit."""
    cosine = np.clip(x[:, 0] ** 2, 1e-9, 1)
    sine = np.sqrt(1 - cosine**2)
    light = np.stack([sine * np.cos(x[:, 1]), sine * np.sin(x[:, 1]), cosine], 1)
    half = np.stack([2 * widths[0] * np.sinh(x[:, 2]), 2 * widths[1] * np.sinh(x[:, 3]), np.ones(len(x))], 1)
    half /= np.linalg.norm(half, axis=1)[:, np.newaxis]
    along = np.sum(light * half, axis=1)
    view = 2 * along[:, np.newaxis] * half - light
    return light, view, (view[:, 2] > 0.02) & (along > 0) & (x[:, 0] <= 1)


rng = np.random.default_rng(1)
COUNT = 4000
cosine, azimuth = rng.uniform(0.17, 1, COUNT), rng.uniform(0, np.pi / 2, COUNT)
spread = np.where(np.arange(COUNT) % 2, rng.normal(0, 1, COUNT), 2 * rng.standard_cauchy(COUNT))
other = np.where(np.arange(COUNT) % 2, rng.normal(0, 1, COUNT), 2 * rng.standard_cauchy(COUNT))
steepest = np.arcsinh(np.array([1, 5]) / (2 * np.array(widths)))  # slopes of the half-way direction along both axes
ends = [(np.sqrt(0.17), 1), (0, np.pi / 2), *((-reach, reach) for reach in steepest)]
x = np.stack([np.sqrt(cosine), azimuth, np.arcsinh(spread / 2), np.arcsinh(other / 2)], 1)
light, view, seen = directions(x)
x, light, view = x[seen], light[seen], view[seen]
value, peak = exact(light, view), exact(light, light * [-1, -1, 1])
kept = value > 1e-3 * peak
x, value, peak = x[kept], value[kept], peak[kept]

nodes = []
for axis, (first, last) in enumerate(ends):
    count, worst = 8, np.inf
    while worst > TOLERANCE:
        count = int(1.5 * count)
        step = (last - first) / (count - 1)
        place = (x[:, axis] - first) / step
        cell = np.floor(place)
        logs, usable = [], np.ones(len(x), bool)
        for offset in (-1, 0, 1, 2):
            moved = x.copy()
            moved[:, axis] = first + (cell + offset) * step
            light, view, seen = directions(moved)
            usable &= seen
            view[~seen] = [0, 0, 1]
            logs.append(np.log(np.maximum(exact(light, view), 1e-300)))
        t, (a, b, c, d) = place - cell, logs
        cubic = b + t / 2 * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))
        worst = np.max((np.abs(np.exp(cubic) - value) / (value + 1e-3 * peak))[usable])
    nodes.append(count)
total = np.prod([float(n) for n in nodes])
print(f"{' x '.join(map(str, nodes))} nodes, {total / 1e6:.0f} million, {4 * total / 2**20:.0f} MiB of floats a wavelength")
