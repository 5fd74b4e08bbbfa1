"""What the tests of the Mitsuba plugin share: surfaces, variants, scenes."""

import time

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


def figure_14(mi, bsdf, size):
    """Cylinder, ball, cube and table of the paper's Fig. 14, under a sky and a lamp; `bsdf` makes an entry of a surface."""
    at = mi.ScalarTransform4f
    surfaces = {
        "cylinder": (0.18, 3.0, "Al", 0.0),
        "ball": (0.13, 1.2, "Cu", 0.0),
        "cube": (0.0, 2.0, 1.5, 0.28),
        "table": (0.20, 2.0, 1.5, 0.28),
    }
    made = {name: {"type": "twosided", "bsdf": bsdf(surface)} for name, surface in surfaces.items()}
    return {
        "type": "scene",
        "table": {"type": "rectangle", "to_world": at().scale(6), "bsdf": made["table"]},
        "cylinder": {"type": "cylinder", "p0": [-1.2, 0, 0], "p1": [-1.2, 0, 1.8], "radius": 0.6, "bsdf": made["cylinder"]},
        "ball": {"type": "sphere", "center": [0.5, 0.6, 0.7], "radius": 0.7, "bsdf": made["ball"]},
        "cube": {"type": "cube", "to_world": at().translate([0.9, -1.1, 0.45]).scale(0.45), "bsdf": made["cube"]},
        "sky": {"type": "constant", "radiance": 0.3},
        "lamp": {
            "type": "rectangle",
            "to_world": at().look_at(origin=[2, -3, 5], target=[0, 0, 0], up=[0, 0, 1]),
            "emitter": {"type": "area", "radiance": 12.0},
        },
        "sensor": {
            "type": "perspective", "fov": 35,
            "to_world": at().look_at(origin=[1.5, -7, 3.5], target=[0, 0, 0.7], up=[0, 0, 1]),
            "film": {"type": "hdrfilm", "width": size, "height": size},
        },
        "integrator": {"type": "path", "max_depth": 4},
    }  # fmt: skip


def conductor(surface):
    """Mitsuba's rough metal as wide as the lobe in the limit of geometric optics."""
    sigma, tau, index, _ = surface
    material = {"Al": "Al", "Cu": "Cu"}.get(index)
    optics = {"material": material} if material else {"eta": 1.5, "k": 0.0}
    return {"type": "roughconductor", "distribution": "beckmann", "alpha": max(2 * sigma / tau, 0.02), **optics}


def scenes_of_figure_14(mi, size):
    """With the plugin and with roughconductor."""
    return [mi.load_dict(figure_14(mi, bsdf, size)) for bsdf in (scene_entry, conductor)]


def seconds_of_figure_14(variant, size, samples, rounds):
    """The least time of each; they take turns, and the first round compiles."""
    mi = mitsuba_in(variant)
    scenes, seconds = scenes_of_figure_14(mi, size), ([], [])
    for seed in range(rounds + 1):
        for scene, times in zip(scenes, seconds):
            start = time.perf_counter()
            np.array(mi.render(scene, spp=samples, seed=seed))
            times.append(time.perf_counter() - start)
    return [min(times[1:]) for times in seconds]
