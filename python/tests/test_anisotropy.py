"""Surfaces of two correlation lengths: the azimuth of the light, derivatives, and what is refused."""

import numpy as np
import pytest

import hts


def brushed(lengths=(20.0, 2.0), azimuth=0.0, **more):
    return hts.Material(
        model="he", rms_roughness_um=0.2, correlation_length_um=list(lengths), azimuth_deg=azimuth, index=1.4 + 7j, **more
    )


def test_azimuth_of_the_light():
    at = dict(theta_i=30.0, theta_r=40.0, phi=180.0, degrees=True, tolerance=1e-12)
    across, along = brushed().brdf(0.5, **at, phi_i=[90.0, 0.0])
    assert across > 100 * along
    assert brushed(azimuth=25).brdf(0.5, **at, phi_i=115.0) == pytest.approx(across, rel=1e-10)
    assert brushed((2.0, 20.0), 90).brdf(0.5, **at, phi_i=90.0) == pytest.approx(across, rel=1e-10)
    np.testing.assert_allclose(brushed().mueller(0.5, **at, phi_i=90.0)[0, 0], across, rtol=1e-11)
    assert brushed().specular_reflectance(3.0, 60.0, phi_i=[0.0, 90.0], degrees=True)[0] > 0
    verdicts = brushed().validity(0.5, 75.0, degrees=True, phi_i=[0.0, 90.0])
    assert verdicts.severity.shape == (2,)


def test_draws_make_the_albedo():
    material = brushed(azimuth=20)
    for phi in (0.0, 0.7):
        drawn = material.sample(0.5, 0.6, phi, rng=1, size=20000)
        assert np.mean(drawn.weight) == pytest.approx(float(material.albedo(0.5, 0.6, phi)), rel=0.01)


@pytest.mark.parametrize("of", ["brdf", "mueller", "specular"])
def test_gradient(of):
    names = {"correlation_length_x_um": 20.0, "correlation_length_y_um": 2.0, "azimuth": 0.3}
    where = dict(theta_i=0.5, phi_i=0.8) if of == "specular" else dict(theta_i=0.5, theta_r=0.6, phi=3.1, phi_i=0.8)

    def value(x, y, azimuth):
        material = brushed((x, y), np.degrees(azimuth))
        call = {"brdf": material.brdf, "mueller": material.mueller, "specular": material.specular_reflectance}[of]
        return call(2.0, **where, tolerance=1e-12)

    found = brushed((20.0, 2.0), np.degrees(0.3)).gradient(2.0, **where, of=of)
    assert "correlation_length_um" not in found
    for name, at in names.items():
        step = 1e-4 * at
        moved = [value(*(v + (by * step if n == name else 0) for n, v in names.items())) for by in (-2, -1, 1, 2)]
        expected = (8 * (moved[2] - moved[1]) - (moved[3] - moved[0])) / (12 * step)
        scale = np.max(np.abs(value(*names.values()))) / at
        np.testing.assert_allclose(found[name], expected, rtol=1e-6, atol=1e-6 * scale)


def test_hemispherical_emissivity():
    material = brushed()
    x, w = np.polynomial.legendre.leggauss(20)
    root, azimuths = (x + 1) / 2, 2 * np.pi * (np.arange(12) + 0.3) / 12
    each = material.emissivity(0.5, np.arccos(root**2)[:, np.newaxis], phi_i=azimuths)
    expected = np.sum(w / 2 * 4 * root**3 * np.mean(each, axis=1))
    assert material.hemispherical_emissivity(0.5) == pytest.approx(expected, abs=2e-5)


def test_refusals():
    with pytest.raises(hts.Error, match="isotropic surface"):
        brushed().table([0.5], 1e-2)
    with pytest.raises(hts.Error, match="azimuth_deg.*must be left out"):
        hts.Material(model="he", rms_roughness_um=0.2, correlation_length_um=2.0, azimuth_deg=3.0, index="Al")
