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


WHERE = {"wavelength": 0.5, "theta_i": 0.3, "theta_r": 0.4, "phi": 2.8}
LAYERS = {"films/0/n": 1.46, "films/0/k": 0.01, "films/0/thickness_um": 0.11, "films/1/n": 2.1, "films/1/k": 0.0, "films/1/thickness_um": 0.06}


def layered(rms_roughness_um=0.1, correlation_length_um=1.5, **numbers):
    layers = {**LAYERS, **numbers}
    films = [
        {"index": complex(layers[f"films/{i}/n"], layers[f"films/{i}/k"]), "thickness_um": layers[f"films/{i}/thickness_um"]}
        for i in range(2)
    ]
    return hts.Material(
        model="he", rms_roughness_um=rms_roughness_um, correlation_length_um=correlation_length_um, index=0.8 + 6j, films=films,
        correlation={"type": "matern", "nu": 1.5},
    )


@pytest.mark.parametrize("of", ["brdf", "mueller", "specular"])
def test_derivatives(of):
    where = {k: v for k, v in WHERE.items() if of != "specular" or k in ("wavelength", "theta_i")}

    def value(name, moved):
        material = layered(**{name: moved})
        return {"brdf": material.brdf, "mueller": material.mueller, "specular": material.specular_reflectance}[of](
            **where, tolerance=1e-6
        )

    found = layered().gradient(**where, of=of)
    for name, at in {**LAYERS, "rms_roughness_um": 0.1, "correlation_length_um": 1.5}.items():
        if name == "films/1/k":
            continue  # at the end of its range
        step = 1e-3 * at
        moved = [value(name, at + by * step) for by in (-2, -1, 1, 2)]
        expected = (8 * (moved[2] - moved[1]) - (moved[3] - moved[0])) / (12 * step)
        scale = np.max(np.abs(value(name, at))) / at
        np.testing.assert_allclose(found[name], expected, rtol=2e-4, atol=2e-4 * scale, err_msg=name)


def test_no_derivatives_of_what_is_not_there():
    keys = {"model": "he", "rms_roughness_um": 0.1, "correlation_length_um": 1, "index": "Al"}
    empty = hts.Material(**keys, films=[{"index": "Al2O3", "thickness_um": 0}])
    with pytest.raises(hts.Error, match="gradient: films of thickness 0"):
        empty.gradient(0.5, 0.3, 0.4, 3.0)
    assert not any(name.startswith("films") for name in hts.Material(**keys).gradient(0.5, 0.3, 0.4, 3.0))


def test_derivatives_of_a_band():
    def polished(rms, length):
        return hts.Material(
            model="he", rms_roughness_um=rms, correlation_length_um=length, correlation={"type": "matern", "nu": 0.8}, index="Al",
            rms_band_um=[0.6, 20.0],
        )

    found = polished(0.05, 2.0).gradient(**WHERE)
    for place, (name, at) in enumerate({"rms_roughness_um": 0.05, "correlation_length_um": 2.0}.items()):
        step = 1e-3 * at
        moved = [polished(*(v + (by * step if i == place else 0) for i, v in enumerate((0.05, 2.0)))).brdf(**WHERE) for by in (-1, 1)]
        assert found[name] == pytest.approx((moved[1] - moved[0]) / (2 * step), rel=1e-3), name


def test_fit_holds_films():
    truth = hts.Material(model="he", rms_roughness_um=0.1, correlation_length_um=2.0, index="Al", films=OXIDE)
    theta_r = np.linspace(0.1, 1.2, 12)
    curves = {"wavelength": 0.4, "theta_i": 0.5, "theta_r": theta_r, "phi": np.pi, "brdf": truth.brdf(0.4, 0.5, theta_r, np.pi)}
    fit = hts.fit(curves, "he", index="Al", films=OXIDE, fix={"a": 0})
    assert fit.parameters["sigma0"].value == pytest.approx(0.1, rel=1e-3)
    assert '"films"' in fit.material.description
