"""A BRDF for a renderer: values, draws and their densities, a picture."""

import numpy as np

import hts

aluminium = hts.Material(model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index="Al")

wavelengths = np.linspace(0.4, 0.7, 4)  # um
theta_r = np.radians(np.linspace(0, 80, 9))[:, np.newaxis]
brdf = aluminium.brdf(wavelengths, np.radians(30), theta_r, np.pi)  # 1/sr, shape (9, 4)
print("BRDF at 40 degrees:", brdf[4].round(6))

drawn = aluminium.sample(0.55, np.radians(30), rng=1, size=100_000)
print(f"mean weight {drawn.weight.mean():.3f}, albedo {aluminium.albedo(0.55, np.radians(30)):.3f}")

picture = hts.render(aluminium, size=64, samples=4)
print("picture:", picture.shape, "brightest", f"{picture.max():.2f}")
