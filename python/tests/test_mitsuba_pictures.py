"""Pictures that Mitsuba renders with the plugin: a furnace, the scene of the paper's Fig. 14, files of the command."""

import json
import subprocess

import numpy as np
import pytest

from mitsuba_scenes import (
    SURFACES,
    interaction,
    material_of,
    mitsuba_in,
    scene_entry,
    scenes_of_figure_14,
    unit,
    vectors,
    viewed_plane,
)

import hts


def test_furnace_picture():
    """A plane under an even sky is as bright as its albedo."""
    mi = mitsuba_in("llvm_ad_rgb")
    theta = 0.7
    scene = viewed_plane(mi, scene_entry(SURFACES["plastic"]), 0.5, 1.0, theta, size=16)
    scene["light"] = {"type": "constant", "radiance": 1.0}
    scene["integrator"] = {"type": "path", "max_depth": 2}
    pixels = np.array(mi.render(mi.load_dict(scene), spp=256)).reshape(-1, 3)
    error = pixels.std(axis=0) / np.sqrt(len(pixels))
    exact = material_of(SURFACES["plastic"]).albedo(hts.mitsuba.SRGB_WAVELENGTHS, theta)
    print(f"{(pixels.mean(axis=0) - exact) / error} errors of {error}")
    assert np.all(np.abs(pixels.mean(axis=0) - exact) < 4.5 * error)
    assert np.all(error < 5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "llvm_ad_spectral"])
def test_figure_14(variant):
    """Its pictures are whole; python/benchmarks/speed.py prints their times."""
    mi = mitsuba_in(variant)
    for scene in scenes_of_figure_14(mi, 128):
        picture = np.array(mi.render(scene, spp=16, seed=1))
        assert np.isfinite(picture).all() and picture.mean() > 0.05


def test_exported_file(command, tmp_path, rng):
    """Mitsuba's measured BSDF reads what the command writes, and has the values of the model."""
    mi = mitsuba_in("llvm_ad_spectral")
    material, path = tmp_path / "material.json", tmp_path / "material.bsdf"
    material.write_text(
        json.dumps({"name": "rough", "model": "he", "rms_roughness_um": 1.0, "correlation_length_um": 4.0, "index": "Al"})
    )
    subprocess.run(
        [command, "table", "export", material, "--format", "rgl", "--output", path], check=True, capture_output=True
    )
    wavelengths, count = [0.45, 0.5, 0.55, 0.6], 2000
    bsdf = mi.load_dict({"type": "measured", "filename": str(path)})
    si = interaction(mi, 0.7, 0.0, count, wavelengths)
    wo = vectors(rng.uniform(0, 1.2, count), rng.uniform(0, 2 * np.pi, count))
    value = np.array(bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(wo)))
    exact = hts.Material(material).brdf(
        np.reshape(wavelengths, (4, 1)), incident=unit(np.array(si.wi)), reflected=unit(wo)
    ) * unit(wo)[:, 2]
    error = np.abs(value - exact) / exact.max()
    print(f"worst {error.max():.2g} of the peak, median {np.median(error):.2g}")
    assert error.max() < 0.03 and np.median(error) < 1e-3
