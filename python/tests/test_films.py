"""Films against the transfer matrices of the package tmm, and as users write them."""

import numpy as np
import pytest

import hts

OXIDE = [{"index": "Al2O3", "thickness_um": 0.004}]


def smooth(**keys):
    return hts.Material(model="he", rms_roughness_um=0, correlation_length_um=1, **keys)


def test_against_tmm(rng):
    tmm = pytest.importorskip("tmm")
    for _ in range(60):
        films = [
            {"index": complex(rng.uniform(0.2, 4), rng.choice([0, 0, 0.1, 2])), "thickness_um": rng.uniform(0, 0.6)}
            for _ in range(rng.integers(0, 5))
        ]
        substrate = complex(rng.uniform(0.2, 4), rng.choice([0, 0.01, 3]))
        um, theta = rng.uniform(0.3, 2), rng.uniform(0, 1.5)
        material = smooth(index=substrate, films=films)
        indices = [1, *(film["index"] for film in films), substrate]
        widths = [np.inf, *(film["thickness_um"] for film in films), np.inf]
        s, p = (tmm.coh_tmm(state, indices, widths, theta, um) for state in "sp")
        assert material.specular_reflectance(um, theta, tolerance=1e-12) == pytest.approx((s["R"] + p["R"]) / 2, abs=1e-12)
        matrix = material.specular_mueller(um, theta)
        assert matrix[0, 1] == pytest.approx((s["R"] - p["R"]) / 2, abs=1e-12)
        # F_s F_p*, whatever sign a program gives p
        product = s["r"] * np.conj(p["r"])
        assert abs(matrix[2, 2]) == pytest.approx(abs(product.real), abs=1e-12)
        assert abs(matrix[2, 3]) == pytest.approx(abs(product.imag), abs=1e-12)


def test_dict_and_keywords():
    keys = {"model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 1.0, "index": "Al"}
    bare = hts.Material(**keys)
    coated = hts.Material({**keys, "films": OXIDE})
    wavelengths = [0.3, 0.5]
    value = coated.brdf(wavelengths, 0.5, 0.6, 3.0)
    np.testing.assert_array_equal(value, hts.Material(**keys, films=tuple(OXIDE)).brdf(wavelengths, 0.5, 0.6, 3.0))
    assert np.all(value < bare.brdf(wavelengths, 0.5, 0.6, 3.0))
    none = hts.Material(**keys, films=[{"index": 2 + 1j, "thickness_um": np.float64(0)}])
    np.testing.assert_array_equal(none.brdf(wavelengths, 0.5, 0.6, 3.0), bare.brdf(wavelengths, 0.5, 0.6, 3.0))
    unified = hts.Material({**keys, "model": "he_unified", "films": OXIDE})
    assert unified.brdf(0.5, 0.5, 0.6, 3.0) > 0
    assert coated.emissivity(0.5, 0.3) > bare.emissivity(0.5, 0.3)


@pytest.mark.parametrize(
    "films, message",
    [
        (0.004, "films: must be a list"),
        ([0.004], r"films\[1\]: must be"),
        ([{"index": "Al2O3"}], "thickness_um"),
        ([{"index": "Al2O3", "thickness_um": -1}], "film thickness -1 um: must be from 0 to 1000"),
        ([{"index": lambda um: 1.5, "thickness_um": 1}], r"films\[1\].index"),
    ],
)
def test_errors(films, message):
    with pytest.raises(hts.Error, match=message):
        smooth(index="Al", films=films).brdf(0.5, 0.1, 0.1, 3.0)


def test_no_derivatives():
    coated = hts.Material(model="he", rms_roughness_um=0.1, correlation_length_um=1, index="Al", films=OXIDE)
    with pytest.raises(hts.Error, match="gradient: must be of a surface without films"):
        coated.gradient(0.5, 0.3, 0.4, 3.0)


def test_fit_holds_films():
    truth = hts.Material(model="he", rms_roughness_um=0.1, correlation_length_um=2.0, index="Al", films=OXIDE)
    theta_r = np.linspace(0.1, 1.2, 12)
    curves = {"wavelength": 0.4, "theta_i": 0.5, "theta_r": theta_r, "phi": np.pi, "brdf": truth.brdf(0.4, 0.5, theta_r, np.pi)}
    fit = hts.fit(curves, "he", index="Al", films=OXIDE, fix={"a": 0})
    assert fit.parameters["sigma0"].value == pytest.approx(0.1, rel=1e-3)
    assert '"films"' in fit.material.description
