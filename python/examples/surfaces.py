"""Brushed, polished and coated surfaces; plans, tables and files of other programs."""

import tempfile
from pathlib import Path

import numpy as np

import hts

brushed = hts.Material(
    model="he", rms_roughness_um=0.2, correlation_length_um=[12.0, 1.5], azimuth_deg=30, index="Al"
)
polished = hts.Material(
    model="he_unified",
    rms_roughness_um=0.003,
    correlation={"type": "k_correlation", "B_um": 5, "C": 3, "psd": "2d"},
    index=0.18 + 3.4j,
)
coated = hts.Material(
    model="he",
    rms_roughness_um=0.1,
    correlation_length_um=2.0,
    index="Al",
    films=[{"index": 1.77, "thickness_um": 0.004}],
)
for material in (brushed, polished, coated):
    values = material.brdf(0.55, 30.0, 40.0, [170.0, 190.0], phi_i=20.0, degrees=True)
    print(material.model, np.array_str(values, precision=4))

plan = coated.plan(np.linspace(0.4, 0.7, 31), 1e-2)
print(f"{plan.form.lobe}, {plan.form.wavelengths.size} of 31 wavelengths, error {plan.form.worst:.2g}")
with tempfile.TemporaryDirectory() as folder:
    report = coated.export(Path(folder) / "coated.csv", "csv", wavelengths=[0.55], pairs=5000)
    print(f"{report['pairs']} pairs; 99 % within {report['percentile_99_of_peak']:.1g} of the peak")
