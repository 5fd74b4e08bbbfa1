"""The BSDF of Mitsuba 3 against the library, and Mitsuba's own tests of it."""

import numpy as np
import pytest

import hts
from hts import _phi_table
from mitsuba_scenes import (
    SURFACES,
    interaction,
    material_of,
    mitsuba_in,
    scene_entry,
    unit,
    vectors,
    viewed_plane,
)


def test_phi_of_the_table(rng):
    g = 10 ** rng.uniform(-8, 10, 100_000)
    t = np.expm1(rng.uniform(0, np.log1p(200), g.size)) * (1 + g)
    exact = hts.phi(g, t)
    error = np.abs(_phi_table.phi(g, t) - exact) / (exact + 1e-3 * hts.phi(g, 0.0))
    worst = error.argmax()
    print(f"worst {error[worst]:.2g} at g {g[worst]:.3g}, t {t[worst]:.3g}")
    assert _phi_table.PHI_ERROR / 4 < error[worst] <= _phi_table.PHI_ERROR


def directions(mi, bsdf, si, rng, count):
    """Views of one incidence up to 85 degrees: half drawn by the BSDF, half spread over the hemisphere."""
    u = rng.random((3, count)).astype(np.float32)
    drawn, _ = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[0]), mi.Point2f(u[1:]))
    wo = np.array(drawn.wo)
    spread = vectors(np.arccos(rng.random(count)), rng.uniform(0, 2 * np.pi, count))
    wo = np.where(np.arange(count) % 2 == 0, wo, spread)
    above = wo[2] > np.cos(np.radians(85))
    return np.where(above, wo, vectors(np.zeros(1), np.zeros(1)))


def relative_error(mi, surface, wavelengths, theta, rng, count=20_000):
    bsdf = mi.load_dict(scene_entry(surface))
    si = interaction(mi, theta, 0.7, count, wavelengths if mi.is_spectral else None)
    wo = directions(mi, bsdf, si, rng, count)
    value = np.array(bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(wo)))
    incident, reflected = unit(np.array(si.wi)), unit(wo)
    exact = material_of(surface).brdf(np.reshape(wavelengths, (-1, 1)), incident=incident, reflected=reflected, tolerance=1e-9)
    exact = exact * reflected[:, 2]
    return np.abs(value - exact) / (exact + 1e-3 * exact.max(axis=1, keepdims=True))


@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "llvm_ad_spectral"])
def test_values(variant, rng):
    mi = mitsuba_in(variant)
    wavelengths = [0.4, 0.5, 0.6, 0.7] if mi.is_spectral else hts.mitsuba.SRGB_WAVELENGTHS
    errors = []
    for name, surface in SURFACES.items():
        for theta in np.radians([0, 45, 85]):
            errors.append(relative_error(mi, surface, wavelengths, theta, rng))
            print(f"{name} {np.degrees(theta):.0f} deg: worst {errors[-1].max():.2g}, median {np.median(errors[-1]):.2g}")
            assert np.median(errors[-1]) <= hts.mitsuba.ERROR_MEDIAN
    assert hts.mitsuba.ERROR_WORST / 4 < max(each.max() for each in errors) <= hts.mitsuba.ERROR_WORST


def mirrored(mi, surface, theta, wavelengths):
    """Reflectance of the specular lobe as drawn."""
    bsdf = mi.load_dict(scene_entry(surface))
    context = mi.BSDFContext()
    context.type_mask = mi.BSDFFlags.DeltaReflection
    si = interaction(mi, theta, 0.7, 1, wavelengths if mi.is_spectral else None)
    drawn, weight = bsdf.sample(context, si, mi.Float(0.3), mi.Point2f(0.3, 0.4))
    np.testing.assert_allclose(np.array(drawn.wo), np.array(si.wi) * [[-1], [-1], [1]], atol=1e-7)
    assert np.array(drawn.pdf)[0] == pytest.approx(1)
    return weight, si


def test_specular():
    mi = mitsuba_in("llvm_ad_rgb")
    for surface in ((0.05, 3.0, "Al", 0.0), (0.0, 2.0, 1.5, 0.28)):
        for theta in (0.0, 0.8, 1.4):
            weight, _ = mirrored(mi, surface, theta, None)
            exact = material_of(surface).specular_reflectance(hts.mitsuba.SRGB_WAVELENGTHS, theta)
            np.testing.assert_allclose(np.array(weight)[:, 0], exact, rtol=2e-5)


def test_furnace(rng):
    """The mean weight is the albedo, of each lobe alone and of all."""
    mi = mitsuba_in("llvm_ad_rgb")
    count = 100_000
    for name, surface in SURFACES.items():
        bsdf, material = mi.load_dict(scene_entry(surface)), material_of(surface)
        for theta in (0.0, 1.0, 1.45):
            u = rng.random((3, count)).astype(np.float32)
            si = interaction(mi, theta, 0.7, count)
            drawn, weight = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[0]), mi.Point2f(u[1:]))
            weight = np.array(weight)
            exact = material.albedo(hts.mitsuba.SRGB_WAVELENGTHS, theta)
            error = weight.std(axis=1) / np.sqrt(count)
            print(f"{name} {theta}: largest weight {weight.max():.2g}, {(weight.mean(axis=1) - exact) / error} errors")
            assert np.all(np.abs(weight.mean(axis=1) - exact) < 4.5 * error + 1e-4)
            assert weight.max() < hts.mitsuba.LARGEST_WEIGHT
            again = np.array(bsdf.pdf(mi.BSDFContext(), si, drawn.wo))
            rough = (np.array(drawn.sampled_component) > 0) & (np.array(drawn.wo)[2] > 0)
            np.testing.assert_allclose(again[rough], np.array(drawn.pdf)[rough], rtol=1e-4)


def chi_squared(mi, surface, theta, samples):
    from mitsuba.chi2 import BSDFAdapter, ChiSquareTest, SphericalDomain

    context = mi.BSDFContext()
    context.type_mask = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.DiffuseReflection
    sample, pdf = BSDFAdapter("hts", scene_entry(surface), wi=[float(x) for x in vectors(theta, 0.7)], ctx=context)
    test = ChiSquareTest(SphericalDomain(), sample, pdf, sample_dim=3, sample_count=samples, res=51, ires=16)
    return test.run(), test


CHI_SURFACES = ("aluminium", "copper", "plastic", "rough")


@pytest.mark.parametrize("name", CHI_SURFACES)
def test_chi_squared(name):
    mi = mitsuba_in("llvm_ad_rgb")
    for theta in np.radians([0, 40, 80]):
        passed, test = chi_squared(mi, SURFACES[name], theta, 100_000)
        assert passed, f"{np.degrees(theta)} deg: {test.messages}"


@pytest.mark.slow
@pytest.mark.parametrize("name", CHI_SURFACES)
def test_chi_squared_of_twelve_incidences(name):
    mi = mitsuba_in("llvm_ad_rgb")
    for theta in np.radians(np.linspace(0, 85, 12)):
        passed, test = chi_squared(mi, SURFACES[name], theta, 1_000_000)
        assert passed, f"{np.degrees(theta)} deg: {test.messages}"


@pytest.mark.parametrize("of", ["rms_roughness_um", "correlation_length_um", "n", "k", "diffuse_albedo"])
def test_gradients(of, rng):
    mi = mitsuba_in("llvm_ad_rgb")
    import drjit as dr

    point = {"rms_roughness_um": 0.2, "correlation_length_um": 2.0, "n": 1.1, "k": 4.0, "diffuse_albedo": 0.1}
    bsdf = mi.load_dict({"type": "hts", **point})
    parameters = mi.traverse(bsdf)
    key = of if of in parameters else f"{of}.value"
    count = 2000
    si = interaction(mi, 0.6, 0.7, count)
    wo = vectors(rng.uniform(0, 1.45, count), rng.uniform(0, 2 * np.pi, count))
    x = mi.Float(parameters[key])
    dr.enable_grad(x)
    parameters[key] = x
    parameters.update()
    value = bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(wo))
    dr.forward(x)
    slope = np.array(dr.grad(value))
    material = hts.Material(model="he", rms_roughness_um=0.2, correlation_length_um=2.0, index=1.1 + 4.0j, diffuse_albedo=0.1)
    incident, reflected = unit(np.array(si.wi)), unit(wo)
    angles = (np.arccos(incident[:, 2]), np.arccos(reflected[:, 2]))
    phi = np.arctan2(reflected[:, 1], reflected[:, 0]) - np.arctan2(incident[:, 1], incident[:, 0])
    exact = material.gradient(np.reshape(hts.mitsuba.SRGB_WAVELENGTHS, (3, 1)), *angles, phi)[of] * reflected[:, 2]
    error = np.abs(slope - exact).max(axis=1) / np.abs(exact).max(axis=1)
    print(f"{of}: {error.max():.2g} of the largest slope")
    assert np.all(error < 5e-4)


def test_errors():
    mi = mitsuba_in("llvm_ad_rgb")
    good = {"type": "hts", "rms_roughness_um": 0.2, "correlation_length_um": 2.0, "n": 1.5}
    for change, message in (
        ({"rms_roughness_um": -0.1}, "rms.roughness.* -0.1"),
        ({"correlation_length_um": 0.0}, "correlation.length.* 0"),
        ({"n": -1.0}, "n.* -1"),
        ({"diffuse_albedo": 1.5}, "diffuse.albedo.* 1.5"),
        ({"index": "Al"}, 'index "Al": must not be given along with n and k'),
        ({"wavelength_um": 0.0}, "wavelength_um 0.0 um"),
    ):
        with pytest.raises(Exception, match=message):
            mi.load_dict(good | change)
    with pytest.raises(Exception, match="correlation_length_um missing"):
        mi.load_dict({"type": "hts", "rms_roughness_um": 0.2, "n": 1.5})
    with pytest.raises(Exception, match="unobtainium"):
        mi.load_dict({"type": "hts", "rms_roughness_um": 0.2, "correlation_length_um": 2.0, "index": "unobtainium"})
