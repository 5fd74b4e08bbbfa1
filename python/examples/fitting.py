"""Roughness from scatter: a fit with errors, and what the data leave open."""

import numpy as np

import hts

truth = hts.Material(model="he", rms_roughness_um=0.1, correlation_length_um=3.0, index="Al")
rng = np.random.default_rng(5)
theta_i = np.array([[15.0], [45.0]])
theta_r = np.linspace(0, 75, 26)
brdf = truth.brdf(0.633, theta_i, theta_r, 180.0, degrees=True) * np.exp(rng.normal(0, 0.02, (2, 26)))

fit = hts.fit(
    {"wavelength": 0.633, "theta_i": theta_i, "theta_r": theta_r, "phi": 180.0, "brdf": brdf, "uncertainty": 0.02 * brdf},
    index="Al",
    degrees=True,
)
print(fit)

slope = truth.gradient(0.633, 15.0, 20.0, 180.0, degrees=True)
print(f"d f/d sigma0 = {float(slope['rms_roughness_um']):.4g} /sr/um")
