#!/usr/bin/env python3
"""Times of the Python package beside those of C++ and of Mitsuba's own BSDF, as ratios from one run:

    ./run python                                        the package, into build/venv
    cmake --preset release -DHTS_BUILD_BENCH=ON && cmake --build build/release --target hts_bench
    build/venv/bin/python python/benchmarks/speed.py    or: … python/benchmarks/speed.py arrays | pictures

Both sides take turns, and the least time of each counts, since other programs may run. Inputs are of one kind: a million
pairs of directions as angles in degrees, values of double precision, the roughened aluminium of He et al., tolerance 1e-6.
"""

import json
import pathlib
import subprocess
import sys
import time
import timeit

import numpy as np

import hts

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = SOURCE / "build/release/bin/hts_bench"
COUNT = 1_000_000
ROUNDS = 5


def cpp_seconds(wavelengths, threads):
    """Of a million pairs by hts_bench, which knows the same surface."""
    name = f"^arrays/he/threads:{threads}/{wavelengths}$"
    text = subprocess.run(
        [PROGRAM, f"--benchmark_filter={name}", "--benchmark_format=json", "--benchmark_min_time=0.01"],
        capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    return json.loads(text)["benchmarks"][0]["per_item"] * COUNT


def seconds(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def arrays():
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is not built: see the head of {pathlib.Path(__file__).name}")
    rng = np.random.default_rng(7)
    theta_i, theta_r = rng.uniform(0, 89, (2, COUNT, 1))
    phi = rng.uniform(0, 360, (COUNT, 1))
    material = hts.Material(SOURCE / "cli/data/rough-aluminium.json")
    print("10^6 pairs of directions               C++ [s]  Python [s]   ratio")
    for wavelengths in (1, 4, 31):
        um = np.linspace(0.4, 0.7, wavelengths) if wavelengths > 1 else np.array([0.55])
        out = np.empty((COUNT, wavelengths))
        for threads in (1, 2):
            cpp, python = [], []
            for _ in range(ROUNDS):
                cpp.append(cpp_seconds(wavelengths, threads))
                call = lambda: material.brdf(um, theta_i, theta_r, phi, degrees=True, threads=threads, out=out)  # noqa: E731, B023
                python.append(seconds(call))
            what = f"x {wavelengths:2} wavelengths, {threads} thread{'s' if threads > 1 else ' '}"
            print(f"{what:38} {min(cpp):7.4f} {min(python):11.4f} {min(python) / min(cpp):7.3f}")
    call = lambda: material.brdf(0.55, 0.3, 0.4, 3.0)  # noqa: E731
    print(f"one scalar call: {min(timeit.repeat(call, number=2000, repeat=15)) / 2000 * 1e6:.2f} us")


def pictures():
    sys.path.insert(0, str(SOURCE / "python/tests"))
    from mitsuba_scenes import seconds_of_figure_14

    print("Fig. 14 of the paper, 512 x 512, 64 samples   hts [s]  roughconductor [s]   ratio")
    for variant in ("llvm_ad_rgb", "llvm_ad_spectral"):
        ours, theirs = seconds_of_figure_14(variant, 512, 64, ROUNDS)
        print(f"{variant:43} {ours:9.2f} {theirs:19.2f} {ours / theirs:7.2f}")


if __name__ == "__main__":
    parts = {"arrays": arrays, "pictures": pictures}
    chosen = sys.argv[1:] or list(parts)
    if not set(chosen) <= set(parts):
        sys.exit(__doc__)
    for part in chosen:
        parts[part]()
