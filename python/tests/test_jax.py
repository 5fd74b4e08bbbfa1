"""The functions of JAX against the package's own numbers and derivatives."""

import numpy as np
import pytest

import hts

jax = pytest.importorskip("jax")

WHERE = (0.5, 0.3, 0.4, 3.0)
PARAMETERS = {"rms_roughness_um": 0.28, "correlation_length_um": 1.77, "n": 0.8, "k": 6.0, "diffuse_albedo": 0.2}


@pytest.fixture(autouse=True)
def double():
    with jax.enable_x64(True):
        yield


@pytest.fixture
def material():
    return hts.Material(
        model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index=0.8 + 6.0j, diffuse_albedo=0.2
    )


def test_values(material):
    theta = np.linspace(0.1, 1.5, 6)
    expected = material.brdf([[0.5], [0.9]], 0.3, theta, 3.0)
    np.testing.assert_allclose(hts.jax.brdf(material, [[0.5], [0.9]], 0.3, theta, 3.0), expected, rtol=1e-12)
    mapped = jax.jit(jax.vmap(lambda t: hts.jax.brdf(material, 0.5, 0.3, t, 3.0)))(theta)
    np.testing.assert_allclose(mapped, expected[0], rtol=1e-12)
    np.testing.assert_allclose(hts.jax.mueller(material, *WHERE), material.mueller(*WHERE), rtol=1e-12, atol=1e-15)
    assert float(hts.jax.specular_reflectance(material, 2.0, 0.3)) == pytest.approx(
        material.specular_reflectance(2.0, 0.3), rel=1e-12
    )


@pytest.mark.parametrize("name", [*PARAMETERS, "theta_i", "theta_r", "phi"])
def test_derivatives(material, name):
    point = dict(zip(("wavelength", "theta_i", "theta_r", "phi"), WHERE)) | PARAMETERS

    def value(x):
        return hts.jax.brdf(material, **(point | {name: x}))

    expected = material.gradient(*WHERE)[name]
    assert float(jax.grad(value)(point[name])) == pytest.approx(expected, rel=1e-12)
    assert float(jax.jit(jax.jacfwd(value))(point[name])) == pytest.approx(expected, rel=1e-12)
    step = 1e-5 * point[name]
    ends = [material.brdf(**(point | {name: x}), tolerance=1e-12) for x in (point[name] + step, point[name] - step)]
    assert (ends[0] - ends[1]) / (2 * step) == pytest.approx(expected, rel=1e-4)


def test_derivative_of_matrices(material):
    def value(sigma, theta):
        return hts.jax.mueller(material, 0.5, 0.3, theta, 3.0, rms_roughness_um=sigma)

    theta = np.array([0.2, 0.7])
    by_roughness = jax.jacrev(value)(0.28, theta)
    expected = material.gradient(0.5, 0.3, theta, 3.0, of="mueller")
    np.testing.assert_allclose(by_roughness, expected["rms_roughness_um"], rtol=1e-12, atol=1e-12)
    mapped = jax.vmap(jax.jacfwd(value, argnums=1), in_axes=(None, 0))(0.28, theta)
    np.testing.assert_allclose(mapped, expected["theta_r"], rtol=1e-12, atol=1e-12)
    reflectance = jax.grad(lambda t: hts.jax.specular_reflectance(material, 2.0, t))(0.3)
    assert float(reflectance) == pytest.approx(material.gradient(2.0, 0.3, of="specular")["theta_i"], rel=1e-12)


def test_errors(material):
    with pytest.raises(hts.Error, match="no derivative by wavelength"):
        jax.grad(lambda um: hts.jax.brdf(material, um, 0.3, 0.4, 3.0))(0.5)
    with pytest.raises(Exception, match=r"wavelength -0.5 um: must be > 0"):
        hts.jax.brdf(material, -0.5, 0.3, 0.4, 3.0).block_until_ready()
