"""What a material offers besides values: identities, limits and other ways to the same number."""

import copy
import gc
import json
import pickle
import resource
import shutil
import threading

import numpy as np
import pytest

import hts

from conftest import SOURCE


def test_mueller_and_brdf(aluminium, rng):
    theta = rng.uniform(0, 1.5, (50, 1))
    matrix = aluminium.mueller([0.5, 2.0], 0.4, theta, 2.0, tolerance=1e-12)
    np.testing.assert_allclose(matrix[..., 0, 0], aluminium.brdf([0.5, 2.0], 0.4, theta, 2.0, tolerance=1e-12), rtol=4e-12)
    plastic = hts.Material(
        model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index=1.5 + 0j, diffuse_albedo=0.3
    )
    whole = plastic.mueller(0.5, 0.4, 0.5, 2.0, terms="diffuse", tolerance=1e-12)
    lobe = plastic.mueller(0.5, 0.4, 0.5, 2.0, tolerance=1e-12)
    difference = whole - lobe
    assert difference[0, 0] == pytest.approx(0.3 / np.pi, rel=1e-12)
    assert np.count_nonzero(difference) == 1


def test_specular(aluminium):
    matrix = aluminium.specular_mueller([1.0, 3.0], 0.4)
    np.testing.assert_allclose(matrix[..., 0, 0], aluminium.specular_reflectance([1.0, 3.0], 0.4), rtol=1e-6)


def test_emissivity(aluminium):
    theta = np.array([0.0, 0.5, 1.2, 1.5])
    s, p, both = (aluminium.emissivity(3.0, theta, state) for state in ("s", "p", None))
    np.testing.assert_allclose((s + p) / 2, both, atol=1e-7)
    assert s[0] == pytest.approx(p[0], abs=1e-7)
    assert np.all(p[1:] > s[1:])
    # by the Mueller matrix over the hemisphere, another way
    x, w = np.polynomial.legendre.leggauss(200)
    mu, weight = (x + 1) / 2, w / 2
    phi = (np.arange(400) + 0.5) / 400 * 2 * np.pi
    matrix = aluminium.mueller(3.0, 0.5, np.arccos(mu)[:, np.newaxis], phi)
    mirror = aluminium.specular_mueller(3.0, 0.5)
    reflected = np.sum(matrix * (mu * weight)[:, np.newaxis, np.newaxis, np.newaxis], axis=(0, 1)) * 2 * np.pi / 400 + mirror
    assert 1 - (reflected[0, 0] + reflected[0, 1]) == pytest.approx(s[1], abs=1e-6)
    assert 1 - (reflected[0, 0] - reflected[0, 1]) == pytest.approx(p[1], abs=1e-6)


def test_hemispherical_emissivity():
    white = hts.Material(model="lambert", diffuse_albedo=0.3)
    assert white.hemispherical_emissivity(0.5) == pytest.approx(0.7, abs=1e-6)
    with pytest.raises(hts.Error, match="wavelength"):
        white.hemispherical_emissivity("green")
    assert white.band_emissivity([8, 9, 10], [0, 1, 0], 0.3) == pytest.approx(0.7, abs=1e-6)


def test_sampling(aluminium):
    drawn = aluminium.sample(0.5, 0.5, rng=3, size=20_000)
    albedo = aluminium.albedo(0.5, 0.5)
    error = np.std(drawn.weight) / np.sqrt(20_000)
    assert np.mean(drawn.weight) == pytest.approx(albedo, abs=5 * error)
    lobe = drawn.lobe == "directional_diffuse"
    density = aluminium.pdf(0.5, 0.5, drawn.theta_r[lobe], drawn.phi_r[lobe])
    np.testing.assert_allclose(density, drawn.pdf[lobe], rtol=1e-8)
    brdf = aluminium.brdf(0.5, 0.5, drawn.theta_r, drawn.phi_r, tolerance=1e-12)
    weight = (brdf * np.cos(drawn.theta_r))[lobe] / drawn.pdf[lobe]
    np.testing.assert_allclose(weight, drawn.weight[lobe], rtol=2e-6)
    again = aluminium.sample(0.5, 0.5, rng=np.random.default_rng(3), size=20_000)
    assert np.array_equal(again.theta_r, drawn.theta_r)
    theta_r, phi_r, pdf, weight, lobes = aluminium.sample(0.5, [0.1, 0.2], rng=1)
    assert theta_r.shape == lobes.shape == (2,)


@pytest.mark.parametrize("of", ["brdf", "mueller", "specular"])
def test_gradient(of):
    surface = dict(rms_roughness_um=0.25, correlation_length_um=2.0, n=1.2, k=3.4, diffuse_albedo=0.1)
    material = hts.Material(model="he", rms_roughness_um=1, correlation_length_um=1, index="Al")
    where = dict(theta_i=0.5, theta_r=0.7, phi=2.5)

    def value(**changed):
        at = {**where, **surface, **changed}
        if of == "specular":
            del at["theta_r"], at["phi"]
            return material.specular_reflectance(2.0, tolerance=1e-12, **at)
        return np.asarray((material.brdf if of == "brdf" else material.mueller)(2.0, tolerance=1e-12, **at))

    found = material.gradient(2.0, **where, of=of, **surface)
    assert set(found) == {*surface, "theta_i", *(["theta_r", "phi"] if of != "specular" else [])} - {"n", "k"} | {"n", "k"}
    for name, derivative in found.items():
        at = {**where, **surface}[name]
        h = 1e-4 * max(at, 1e-2)
        difference = (value(**{name: at + h}) - value(**{name: at - h})) / (2 * h)
        np.testing.assert_allclose(derivative, difference, rtol=2e-6, atol=2e-7)


def test_validity(aluminium):
    verdict = aluminium.validity(0.5, [0.1, 1.4])
    assert verdict.severity.tolist() == ["fine", "outside"]
    assert verdict.most[0] == 1.1 and np.isnan(verdict.most[1])


def test_validity_of_the_successor():
    # by its expected distance from exact scattering, which the view does not change
    unified = hts.Material(model="he_unified", rms_roughness_um=0.14, correlation_length_um=1.1, index="Al")
    verdict = unified.validity(0.55, [30.0, 80.0], degrees=True)
    assert verdict.severity.tolist() == ["fine", "outside"]
    assert verdict.least[0] == verdict.most[0] < 0.5 and np.isnan(verdict.most[1])
    elsewhere = unified.validity(0.55, 30.0, 70.0, 10.0, degrees=True)
    assert elsewhere.most == verdict.most[0]


def test_index_of_a_function():
    aluminium = hts.Material(model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index="Al")
    function = hts.Material(
        model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index=lambda um: hts.refractive_index("Al", um)
    )
    um = np.array([0.45, 0.52, 0.8])
    np.testing.assert_allclose(function.brdf(um, 0.3, 0.4, 3.0), aluminium.brdf(um, 0.3, 0.4, 3.0), rtol=1e-12)
    assert function.brdf(0.5, 0.3, 0.4, 3.0) == aluminium.brdf(0.5, 0.3, 0.4, 3.0)
    per_element = function.brdf(um, 0.3, [0.1, 0.2, 0.3], 3.0)
    np.testing.assert_allclose(per_element, aluminium.brdf(um, 0.3, [0.1, 0.2, 0.3], 3.0), rtol=1e-12)

    class Ellipsometry:
        def get_refractive_index(self, nm):
            return hts.refractive_index("Al", np.asarray(nm) / 1000)

    pye = hts.Material(model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index=Ellipsometry())
    assert pye.brdf(0.5, 0.3, 0.4, 3.0) == pytest.approx(aluminium.brdf(0.5, 0.3, 0.4, 3.0), rel=1e-9)


def index_for_pickling(um):
    return 1 + 5j + 0 * um


def test_index_of_a_function_goes_along(tmp_path):
    surface = {"model": "he", "rms_roughness_um": 0.2, "correlation_length_um": 2}
    of_function = hts.Material({**surface, "index": index_for_pickling})
    constant = hts.Material({**surface, "index": 1 + 5j})
    expected = constant.brdf(0.5, 0.1, 0.2, 3.0)
    copies = [pickle.loads(pickle.dumps(of_function)), copy.copy(of_function), copy.deepcopy(of_function), hts.Material(of_function)]
    for each in copies:
        assert each.brdf(0.5, 0.1, 0.2, 3.0) == expected
    um = [0.5, 0.6]
    assert of_function.plan(um, pairs=256).material.brdf(0.5, 0.1, 0.2, 3.0) == constant.plan(um, pairs=256).material.brdf(0.5, 0.1, 0.2, 3.0)
    np.testing.assert_allclose(hts.render("sphere", of_function, size=16), hts.render("sphere", constant, size=16), rtol=1e-12)
    assert "1.5" not in of_function.description and "function" in of_function.description
    of_function.table([0.5, 0.55, 0.6]).save(tmp_path / "t.htst")
    assert b'"n":1.5' not in (tmp_path / "t.htst").read_bytes().replace(b" ", b"")


def test_pickled_files_are_found_from_elsewhere(tmp_path, monkeypatch):
    (tmp_path / "i.csv").write_text("wavelength_um,n,k\n0.4,1.2,3\n0.7,1.4,4\n")
    surface = {"model": "he", "rms_roughness_um": 0.2, "correlation_length_um": 2, "index": {"file": "i.csv"}}
    (tmp_path / "m.json").write_text(json.dumps(surface))
    of_file = hts.Material(tmp_path / "m.json")
    monkeypatch.chdir(tmp_path)
    of_dict = hts.Material(surface)
    monkeypatch.chdir("/")
    for each in (of_file, of_dict):
        assert pickle.loads(pickle.dumps(each)).brdf(0.5, 0.1, 0.2, 3.0) == of_file.brdf(0.5, 0.1, 0.2, 3.0)


def test_nan_is_no_key_of_what_is_kept(aluminium):
    aluminium.brdf(0.5, 0.1, 0.2, 3.0)
    aluminium.brdf(0.5, 0.1, 0.2, 3.0, rms_roughness_um=0.1)
    aluminium.sample(0.5, 0.1, rng=1)
    for call in (
        lambda: aluminium.brdf(np.nan, 0.1, 0.2, 3.0),
        lambda: aluminium.brdf([0.5, np.nan], [0.1, 0.1], 0.2, 3.0),
        lambda: aluminium.albedo(np.nan, 0.1),
        lambda: aluminium.sample(np.nan, 0.1),
        lambda: aluminium.hemispherical_emissivity([0.5, np.nan]),
        lambda: aluminium.pdf(np.nan, 0.1, 0.2, 3.0),
    ):
        with pytest.raises(hts.Error, match="wavelength nan"):
            call()
    for name in ("n", "k", "rms_roughness_um", "correlation_length_um", "diffuse_albedo"):
        with pytest.raises(hts.Error, match=r"nan.*\(element 1\)"):
            aluminium.brdf(0.5, [0.1, 0.1], 0.2, 3.0, **{name: [0.3, np.nan]})


def test_band_emissivity_is_of_one_direction():
    surface = {"model": "he", "rms_roughness_um": 0.2, "correlation_length_um": [1.5, 3], "azimuth_deg": 0, "index": "Al"}
    material, um, flat = hts.Material(surface), np.array([0.5, 0.55, 0.6]), np.ones(3)
    with pytest.raises(hts.Error, match="theta: must be one number"):
        material.band_emissivity(um, flat, [10, 20, 80], degrees=True)
    along, across = (material.band_emissivity(um, flat, 60, phi_i=phi, degrees=True) for phi in (0, 90))
    assert along != across
    assert along == pytest.approx(float(np.trapezoid(material.emissivity(um, 60, phi_i=0, degrees=True), um) / 0.1), rel=1e-9)


def test_models():
    names = [name for name, source in hts.models()]
    assert {"he", "walter", "ashikhmin", "kurt", "lambert", "ward"} <= set(names)
    mirror = hts.Material(model="walter", distribution="ggx", alpha=0.3, index="Au")
    assert 0.5 < mirror.albedo(0.6, 0.3) < 1
    with pytest.raises(hts.Error, match="Mueller|polaris"):
        mirror.mueller(0.6, 0.3, 0.3, 3.0)


def test_table(aluminium, tmp_path):
    table = aluminium.table([0.5, 0.6], 1e-2)
    assert table.error["largest"] <= table.tolerance == 1e-2
    path = tmp_path / "aluminium.htst"
    table.save(path)
    again = hts.read(path)
    assert again.brdf(0.5, 0.4, 0.5, 3.0) == table.brdf(0.5, 0.4, 0.5, 3.0)
    assert table.brdf(0.5, 0.4, 0.5, 3.0) == pytest.approx(aluminium.brdf(0.5, 0.4, 0.5, 3.0), rel=1e-2)


def test_fit():
    truth = hts.Material(model="he", rms_roughness_um=0.3, correlation_length_um=3.0, index="Al")
    theta = np.linspace(5, 80, 25)
    brdf = truth.brdf(1.0, 30, theta, 180, degrees=True)
    found = hts.fit(
        {"wavelength": 1.0, "theta_i": 30, "theta_r": theta, "phi": 180, "brdf": brdf}, index="Al", degrees=True
    )
    assert found.parameters["sigma0"].value == pytest.approx(0.3, rel=1e-3)
    assert found.parameters["tau"].value == pytest.approx(3.0, rel=1e-3)
    assert found.covariance.shape == (len(found.correlated),) * 2
    np.testing.assert_allclose(found.material.brdf(1.0, 30, theta, 180, degrees=True), brdf, rtol=1e-3)
    assert "sigma0" in str(found)


def test_curves():
    set_ = hts.curves("curet-sandpaper")
    assert set_.value.size == set_.theta_i.size > 40
    assert "curet-sandpaper" in hts.curve_names()


def test_curves_of_a_file(tmp_path):
    """A file is fitted as it is, whatever set of the package has its name."""
    path = tmp_path / "curet-sandpaper.json"
    shutil.copy(SOURCE / "validation/curves/data/curet-ceramic-quarry-tile.json", path)
    found, expected = (hts.fit(each, starts=1) for each in (hts.curves(path), "curet-ceramic-quarry-tile"))
    assert np.array_equal(found.predicted, expected.predicted)


def test_render(aluminium):
    picture = hts.render(aluminium, size=24, samples=2)
    assert picture.shape == (24, 24, 3) and picture.max() > 0.1
    assert hts.srgb(picture).dtype == np.uint8
    assert hts.srgb([0.0, 1.0, 2.0]).tolist() == [0, 255, 255]


def test_phi(rng):
    mpmath = pytest.importorskip("mpmath")
    for g, t in [(0.1, 0.3), (3.0, 5.0), (40.0, 20.0)]:
        series = mpmath.exp(-g) * mpmath.nsum(
            lambda m: mpmath.mpf(g) ** m / (mpmath.factorial(m) * m) * mpmath.exp(-t / m), [1, mpmath.inf]
        )
        assert hts.phi(g, t) == pytest.approx(float(series), rel=1e-12)
        assert hts.log_phi(g, t) == pytest.approx(float(mpmath.log(series)), rel=1e-12)
    assert hts.phi(rng.uniform(0, 9, (3, 1)), rng.uniform(0, 9, 4)).shape == (3, 4)
    assert np.isfinite(hts.log_phi(1.0, 1e6))


def test_conversions():
    assert hts.bidirectional_reflectance_factor(1 / np.pi) == pytest.approx(1)
    assert hts.radar_cross_section(0.1, 60, 0, degrees=True) == pytest.approx(0.2 * np.pi)


def test_pickling(aluminium):
    again = pickle.loads(pickle.dumps(aluminium))
    assert again.name == aluminium.name
    assert again.brdf(0.5, 0.3, 0.4, 3.0) == aluminium.brdf(0.5, 0.3, 0.4, 3.0)


def test_threads_at_once(aluminium, rng):
    theta = rng.uniform(0, 1.5, 3000)
    expected = aluminium.brdf(0.5, theta, 0.2, 3.0)
    results = [None] * 8

    def work(i):
        results[i] = aluminium.brdf(0.5 if i % 2 else np.full(3000, 0.5), theta, 0.2, 3.0)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in results:
        np.testing.assert_allclose(result, expected, rtol=2e-6)


def test_no_leak():
    def construct(times):
        for _ in range(times):
            material = hts.Material(model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index="Al")
            material.brdf(0.5, 0.1, 0.2, 3.0)
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    construct(500)
    before = construct(500)
    assert construct(5000) - before < 4000  # kB
