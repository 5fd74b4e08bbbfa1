"""The calls that frameworks of derivatives have in common."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ._material import Material

PARAMETERS = ("rms_roughness_um", "correlation_length_um", "n", "k", "diffuse_albedo")

# what, material, wavelength and angles, parameters
Evaluate = Callable[[str, Material, tuple[Any, ...], dict[str, Any]], Any]


def names_of(arguments: tuple[Any, ...], parameters: dict[str, Any]) -> tuple[str, ...]:
    """Of the arguments after the wavelength, in their order."""
    return (*("theta_i", "theta_r", "phi")[: len(arguments) - 1], *parameters)


def method(material: Material, of: str) -> Any:
    return {"brdf": material.brdf, "mueller": material.mueller, "specular": material.specular_reflectance}[of]


def numbers(names: tuple[str, ...], arrays: list[Any]) -> tuple[list[Any], dict[str, Any]]:
    """Wavelength and angles, and the parameters by name."""
    angles = sum(name not in PARAMETERS for name in names)
    return arrays[: 1 + angles], dict(zip(names[angles:], arrays[1 + angles :]))


def functions(evaluate: Evaluate) -> tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]]:
    """brdf, mueller and specular_reflectance by a framework's way of calling the library."""

    def given(*values: Any) -> dict[str, Any]:
        return {name: value for name, value in zip(PARAMETERS, values) if value is not None}

    def brdf(
        material: Material,
        wavelength: Any,
        theta_i: Any,
        theta_r: Any,
        phi: Any,
        rms_roughness_um: Any = None,
        correlation_length_um: Any = None,
        n: Any = None,
        k: Any = None,
        diffuse_albedo: Any = None,
    ) -> Any:
        """BRDF of all diffuse terms [1/sr], as Material.brdf; parameters go before the material's."""
        parameters = given(rms_roughness_um, correlation_length_um, n, k, diffuse_albedo)
        return evaluate("brdf", material, (wavelength, theta_i, theta_r, phi), parameters)

    def mueller(
        material: Material,
        wavelength: Any,
        theta_i: Any,
        theta_r: Any,
        phi: Any,
        rms_roughness_um: Any = None,
        correlation_length_um: Any = None,
        n: Any = None,
        k: Any = None,
    ) -> Any:
        """Mueller matrix (..., 4, 4) of the directional-diffuse term [1/sr], as Material.mueller."""
        parameters = given(rms_roughness_um, correlation_length_um, n, k)
        return evaluate("mueller", material, (wavelength, theta_i, theta_r, phi), parameters)

    def specular_reflectance(
        material: Material,
        wavelength: Any,
        theta_i: Any,
        rms_roughness_um: Any = None,
        correlation_length_um: Any = None,
        n: Any = None,
        k: Any = None,
    ) -> Any:
        """Reflectance into the mirror direction [1], as Material.specular_reflectance."""
        parameters = given(rms_roughness_um, correlation_length_um, n, k)
        return evaluate("specular", material, (wavelength, theta_i), parameters)

    return brdf, mueller, specular_reflectance
