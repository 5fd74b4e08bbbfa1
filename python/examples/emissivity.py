"""Polarised emissivity of a rough metal in the infrared, and its mean over a band."""

import numpy as np

import hts

aluminium = hts.Material(model="he", rms_roughness_um=0.8, correlation_length_um=6.0, index="Al")
theta = np.array([0.0, 30.0, 60.0, 75.0])

print("theta      e      e_s     e_p     at 4 um")
both, s, p = (aluminium.emissivity(4.0, theta, state, degrees=True) for state in (None, "s", "p"))
for row in zip(theta, both, s, p):
    print("%4.0f    %.4f  %.4f  %.4f" % row)

wavelengths = np.linspace(3.5, 5.0, 16)
response = np.exp(-(((wavelengths - 4.2) / 0.4) ** 2))
print(f"mean over the band: {aluminium.band_emissivity(wavelengths, response, 30, degrees=True):.4f}")
