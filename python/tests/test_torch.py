"""The functions of PyTorch, where it is installed, against the package's own numbers and derivatives."""

import numpy as np
import pytest

import hts

torch = pytest.importorskip("torch")

WHERE = (0.5, 0.3, 0.4, 3.0)
PARAMETERS = {"rms_roughness_um": 0.28, "correlation_length_um": 1.77, "n": 0.8, "k": 6.0, "diffuse_albedo": 0.2}


@pytest.fixture
def material():
    return hts.Material(
        model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index=0.8 + 6.0j, diffuse_albedo=0.2
    )


def double(value, **how):
    return torch.tensor(value, dtype=torch.float64, **how)


def test_values(material):
    theta = np.linspace(0.1, 1.5, 6)
    expected = material.brdf([[0.5], [0.9]], 0.3, theta, 3.0)
    found = hts.torch.brdf(material, double([[0.5], [0.9]]), 0.3, double(theta), 3.0)
    np.testing.assert_allclose(found.numpy(), expected, rtol=1e-12)
    matrix = hts.torch.mueller(material, *(double(x) for x in WHERE))
    np.testing.assert_allclose(matrix.numpy(), material.mueller(*WHERE), rtol=1e-12, atol=1e-15)
    assert hts.torch.specular_reflectance(material, 2.0, 0.3).dtype == torch.float32
    assert hts.torch.brdf(material, 0.5, 0.3, torch.tensor([0, 1]), 3.0).dtype == torch.float32


@pytest.mark.parametrize("name", [*PARAMETERS, "theta_i", "theta_r", "phi"])
def test_derivatives(material, name):
    point = dict(zip(("wavelength", "theta_i", "theta_r", "phi"), WHERE)) | PARAMETERS
    x = double(point[name], requires_grad=True)
    hts.torch.brdf(material, **(point | {name: x})).backward()
    assert float(x.grad) == pytest.approx(material.gradient(*WHERE)[name], rel=1e-12)


def test_derivative_of_matrices(material):
    sigma = double(0.28, requires_grad=True)
    theta = double([0.2, 0.7], requires_grad=True)
    matrix = hts.torch.mueller(material, 0.5, 0.3, theta, 3.0, rms_roughness_um=sigma)
    weight = double(np.random.default_rng(1).random((2, 4, 4)))
    (weight * matrix).sum().backward()
    expected = material.gradient(0.5, 0.3, [0.2, 0.7], 3.0, of="mueller")
    assert float(sigma.grad) == pytest.approx(np.sum(weight.numpy() * expected["rms_roughness_um"]), rel=1e-12)
    np.testing.assert_allclose(theta.grad, np.sum(weight.numpy() * expected["theta_r"], axis=(1, 2)), rtol=1e-12)
    angle = double(0.3, requires_grad=True)
    hts.torch.specular_reflectance(material, 2.0, angle).backward()
    assert float(angle.grad) == pytest.approx(material.gradient(2.0, 0.3, of="specular")["theta_i"], rel=1e-12)


def test_errors(material):
    um = double(0.5, requires_grad=True)
    with pytest.raises(hts.Error, match="no derivative by wavelength"):
        hts.torch.brdf(material, um, 0.3, 0.4, 3.0).backward()
    with pytest.raises(hts.Error, match=r"wavelength -0.5 um: must be > 0"):
        hts.torch.brdf(material, -0.5, 0.3, 0.4, 3.0)
