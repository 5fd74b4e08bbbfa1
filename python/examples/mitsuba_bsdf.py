"""A ball of roughened aluminium in Mitsuba 3, and its roughness found again from a noisy picture."""

from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

import hts

mi.set_variant("llvm_ad_mono")
hts.mitsuba.register()


def scene(rms_roughness_um: float, correlation_length_um: float) -> Any:
    return mi.load_dict(
        {
            "type": "scene",
            "ball": {
                "type": "sphere",
                "bsdf": {
                    "type": "hts",
                    "rms_roughness_um": rms_roughness_um,
                    "correlation_length_um": correlation_length_um,
                    "index": "Al",
                    "wavelength_um": 0.633,
                },
            },
            "lamp": {"type": "directional", "direction": [0.4, -0.3, -1.0], "irradiance": 10.0},
            "side lamp": {"type": "directional", "direction": [-1.0, 0.1, 0.1], "irradiance": 10.0},
            "sensor": {
                "type": "orthographic",
                "to_world": mi.ScalarTransform4f().look_at(origin=[0, 0, 4], target=[0, 0, 0], up=[0, 1, 0]),
                "film": {
                    "type": "hdrfilm",
                    "width": 48,
                    "height": 48,
                    "pixel_format": "luminance",
                    "rfilter": {"type": "box"},
                },
                "sampler": {"type": "multijitter"},
            },
            "integrator": {"type": "direct"},
        }
    )


truth = np.array(mi.render(scene(0.12, 2.5), spp=256, seed=mi.UInt32(1000)))
noise = np.random.default_rng(2).normal(0, 1, (2, *truth.shape))
picture = np.maximum(truth * (1 + 0.03 * noise[0]) + 0.01 * noise[1], 0)
floor = 0.1  # below it noise prevails; logarithms bring the rest to one scale
error = (0.03 * picture + 0.01) / (picture + floor)

found = scene(0.15, 2.0)
parameters = mi.traverse(found)
names = ["ball.bsdf.rms_roughness_um", "ball.bsdf.correlation_length_um"]
for step in range(14):  # Gauss and Newton's, in the logarithms: both parameters change the picture in much the same way
    slopes = []
    for name in names:
        scale = mi.Float(1)
        dr.enable_grad(scale)
        parameters[name] = dr.detach(parameters[name]) * scale
        parameters.update()
        shown = mi.render(found, parameters, spp=256, seed=mi.UInt32(step))
        dr.forward(scale)
        slopes.append((np.array(dr.grad(shown)) / (np.array(shown) + floor) / error).ravel())
        parameters[name] = dr.detach(parameters[name])
    residual = (np.log((picture + floor) / (np.array(shown) + floor)) / error).ravel()
    change = np.linalg.lstsq(np.stack(slopes, axis=1), residual)[0]
    change *= min(1, 0.2 / np.abs(change).max())
    for name, by in zip(names, change):
        parameters[name] = parameters[name] * float(np.exp(by))
    parameters.update()

for name, true_value in zip(names, (0.12, 2.5)):
    off = parameters[name][0] / true_value - 1
    print(f"{name}: {true_value} um, found within 2 %: {abs(off) < 0.02}")
