"""What the tests of the Mitsuba plugin share: surfaces, variants, scenes."""

import numpy as np
import pytest

import hts

# sigma_0, tau [um], index, a: of the paper's Fig. 8, of its Fig. 14, and two whose lobes are narrow
SURFACES = {
    "aluminium": (0.28, 1.77, "Al", 0.0),
    "cylinder": (0.18, 3.0, "Al", 0.0),
    "copper": (0.13, 1.2, "Cu", 0.0),
    "plastic": (0.20, 2.0, 1.5, 0.28),
    "rough": (2.5, 16.0, "Cu", 0.0),
    "smooth": (0.5, 30.0, "Al", 0.0),
}


def mitsuba_in(variant):
    """Mitsuba in a variant with the plugin, or the test is skipped."""
    mi = pytest.importorskip("mitsuba")
    try:
        mi.set_variant(variant)
    except ImportError as error:
        pytest.skip(f"mitsuba's {variant} does not run here: {error}")
    hts.mitsuba.register()
    return mi


def scene_entry(surface, **more):
    sigma, tau, index, albedo = surface
    entry = {"type": "hts", "rms_roughness_um": sigma, "correlation_length_um": tau, "diffuse_albedo": albedo}
    entry |= {"index": index} if isinstance(index, str) else {"n": float(index)}
    return entry | more


def material_of(surface):
    sigma, tau, index, albedo = surface
    return hts.Material(
        model="he",
        rms_roughness_um=sigma,
        correlation_length_um=tau,
        index=index if isinstance(index, str) else complex(index),
        diffuse_albedo=albedo,
    )


def vectors(theta, phi):
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)]).astype(np.float32)


def interaction(mi, theta, phi, count, wavelengths=None):
    import drjit as dr

    si = dr.zeros(mi.SurfaceInteraction3f, count)
    si.wi = mi.Vector3f(vectors(np.full(count, theta), np.full(count, phi)))
    if wavelengths is not None:
        si.wavelengths = [float(1000 * um) for um in wavelengths]
    return si


def unit(direction):
    """Rays of single precision (3, ...) as the exact unit vectors (..., 3) that double precision makes of them."""
    rays = np.moveaxis(np.asarray(direction, dtype=float), 0, -1)
    return rays / np.linalg.norm(rays, axis=-1, keepdims=True)


def viewed_plane(mi, bsdf, theta_light, phi_light, theta_view, irradiance=1.0, size=4):
    """A wide plane under one distant light, of whose beam each square metre takes `irradiance`, seen from a distance in the
    azimuth of x."""
    from math import cos, sin

    view = [sin(theta_view), 0.0, cos(theta_view)]
    light = vectors(theta_light, phi_light).tolist()
    transform = mi.ScalarTransform4f
    return {
        "type": "scene",
        "plane": {"type": "rectangle", "to_world": transform().scale(100), "bsdf": bsdf},
        "light": {"type": "directional", "direction": [-x for x in light], "irradiance": irradiance},
        "sensor": {
            "type": "orthographic",
            "to_world": transform().look_at(origin=[10 * x for x in view], target=[0, 0, 0], up=[0, 1, 0.1]),
            "film": {
                "type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"},
                "pixel_format": "luminance" if "mono" in mi.variant() else "rgb",
            },
        },
    }  # fmt: skip


