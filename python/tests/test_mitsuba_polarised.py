"""Mueller matrices of the Mitsuba plugin in Mitsuba's frames, from its functions and from rendered pictures."""

import numpy as np

from mitsuba_scenes import interaction, material_of, mitsuba_in, scene_entry, unit, vectors, viewed_plane

GOLD = (0.12, 1.5, "Au", 0.1)


def stokes_basis(mi, k):
    return np.moveaxis(np.array(mi.mueller.stokes_basis(mi.Vector3f(np.moveaxis(k, -1, 0).astype(np.float32)))), 0, -1)


def rotation(k, s, x):
    """Stokes vectors of the right-handed frame of x axis s in that of x, (..., 4, 4)."""
    cosine, sine = np.sum(s * x, -1), np.sum(np.cross(s, x) * k, -1)
    double = 2 * np.arctan2(sine, cosine)
    matrix = np.zeros((*double.shape, 4, 4))
    matrix[..., 0, 0] = matrix[..., 3, 3] = 1
    matrix[..., 1, 1] = matrix[..., 2, 2] = np.cos(double)
    matrix[..., 1, 2], matrix[..., 2, 1] = np.sin(double), -np.sin(double)
    return matrix


def in_mitsubas_frames(mi, mueller, light, view):
    """The library's matrices, of left-handed frames (s, p, k): S2 changes its sign, then both frames turn about their rays."""
    flip = np.diag([1.0, 1.0, -1.0, 1.0])

    def turned(k):
        s = np.cross(k, [0.0, 0.0, 1.0])
        return rotation(k, s / np.linalg.norm(s, axis=-1, keepdims=True), stokes_basis(mi, k))

    return turned(view) @ flip @ mueller @ flip @ np.swapaxes(turned(-light), -1, -2)


def as_array(spectrum):
    """(channels, n, 4, 4)"""
    return np.moveaxis(np.array([[np.array(spectrum[i, j]) for j in range(4)] for i in range(4)]), (0, 1), (2, 3))


def test_mueller(rng):
    mi = mitsuba_in("llvm_ad_spectral_polarized")
    count, wavelengths = 500, [0.45, 0.5, 0.6, 0.7]
    si = interaction(mi, 0.7, 0.4, count, wavelengths)
    wo = vectors(rng.uniform(0.01, 1.45, count), rng.uniform(0, 2 * np.pi, count))
    value = as_array(mi.load_dict(scene_entry(GOLD)).eval(mi.BSDFContext(), si, mi.Vector3f(wo)))
    # radiance is traced: si.wi is the view, wo the light
    light, view = unit(wo), unit(np.array(si.wi))
    exact = material_of(GOLD).mueller(
        np.reshape(wavelengths, (4, 1)), incident=light, reflected=view, terms="diffuse", tolerance=1e-9
    )
    exact = in_mitsubas_frames(mi, exact, light, view) * light[:, 2, np.newaxis, np.newaxis]
    error = np.abs(value - exact).max(axis=(2, 3)) / exact[..., 0, 0]
    print(f"worst {error.max():.2g} of element 00")
    assert error.max() < 1e-4


def test_importance_is_transported_backwards():
    """With light and view exchanged and the mode too, the matrix is the same."""
    mi = mitsuba_in("llvm_ad_spectral_polarized")
    bsdf = mi.load_dict(scene_entry(GOLD))
    wavelengths = [0.45, 0.5, 0.6, 0.7]
    a, b = (0.7, 0.4), (0.9, 2.2)
    radiance = bsdf.eval(mi.BSDFContext(), interaction(mi, *a, 1, wavelengths), mi.Vector3f(vectors(*map(np.array, b))[:, None]))
    importance = bsdf.eval(
        mi.BSDFContext(mi.TransportMode.Importance),
        interaction(mi, *b, 1, wavelengths),
        mi.Vector3f(vectors(*map(np.array, a))[:, None]),
    )
    np.testing.assert_allclose(as_array(radiance) / np.cos(b[0]), as_array(importance) / np.cos(a[0]), rtol=1e-4, atol=1e-6)


def test_specular_mueller():
    mi = mitsuba_in("llvm_ad_spectral_polarized")
    surface = (0.03, 1.5, "Au", 0.0)
    context = mi.BSDFContext()
    context.type_mask = mi.BSDFFlags.DeltaReflection
    wavelengths = [0.45, 0.5, 0.6, 0.7]
    for theta in (0.0, 0.8, 1.4):
        si = interaction(mi, theta, 0.4, 1, wavelengths)
        drawn, weight = mi.load_dict(scene_entry(surface)).sample(context, si, mi.Float(0.3), mi.Point2f(0.3, 0.4))
        light, view = unit(np.array(drawn.wo)), unit(np.array(si.wi))
        exact = material_of(surface).specular_mueller(np.reshape(wavelengths, (4, 1)), incident=light)
        if theta > 0:
            exact = in_mitsubas_frames(mi, exact, light, view)
        value = as_array(weight)
        # along the normal the frames of the library follow the azimuth; the intensity has none
        compared = np.s_[...] if theta > 0 else np.s_[..., 0, 0]
        np.testing.assert_allclose(value[compared], exact[compared], atol=2e-5)


def polarised_light(mi, stokes):
    """A distant light of any state of polarisation, in the implicit frame of its rays."""
    import drjit as dr

    class Light(mi.Emitter):
        def __init__(self, properties):
            mi.Emitter.__init__(self, properties)
            self.m_flags = mi.EmitterFlags.DeltaDirection | mi.EmitterFlags.Infinite
            self.travels = mi.ScalarVector3f(properties["direction"])

        def sample_direction(self, it, sample, active=True):
            ds = dr.zeros(mi.DirectionSample3f)
            ds.d = -mi.Vector3f(self.travels)
            ds.n = mi.Normal3f(self.travels)
            ds.dist = mi.Float(1000.0)
            ds.p = it.p + ds.d * ds.dist
            ds.pdf = mi.Float(1.0)
            ds.delta = mi.Bool(True)
            column = [mi.UnpolarizedSpectrum(x) for x in stokes]
            zero = mi.UnpolarizedSpectrum(0.0)
            rows = [(each, zero, zero, zero) for each in column]
            return ds, mi.Spectrum(*(x for row in rows for x in row)) & active

        def eval(self, si, active=True):
            return mi.Spectrum(0.0)

        def pdf_direction(self, it, ds, active=True):
            return mi.Float(0.0)

    return Light


def test_polarised_render():
    """Under four lights of different polarisation, the pixels are the columns of the Mueller matrix."""
    mi = mitsuba_in("llvm_ad_mono_polarized")
    theta_i, phi_i, theta_r, um = 0.6, 2.5, 0.8, 0.6
    entry = {"type": "hts", "rms_roughness_um": 0.12, "correlation_length_um": 1.5, "n": 0.25, "k": 3.0, "wavelength_um": um}
    columns = []
    states = [(1, 0, 0, 0), (1, 1, 0, 0), (1, 0, 1, 0), (1, 0, 0, 1)]
    for i, stokes in enumerate(states):
        light = polarised_light(mi, stokes)
        mi.register_emitter(f"polarised{i}", lambda properties, light=light: light(properties))
        scene = viewed_plane(mi, entry, theta_i, phi_i, theta_r)
        scene["light"] = {"type": f"polarised{i}", "direction": [float(-x) for x in vectors(theta_i, phi_i)]}
        scene["integrator"] = {"type": "stokes", "nested": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0}}
        picture = np.array(mi.render(mi.load_dict(scene), spp=2))
        columns.append(picture[1, 1, -12::3])  # each of the four Stokes parameters has three channels
    columns = np.array(columns, dtype=float).T
    measured = columns - np.array([[0, 1, 1, 1]]) * columns[:, :1]
    light, view = unit(vectors(theta_i, phi_i)), unit(vectors(theta_r, 0.0))
    material = material_of((0.12, 1.5, 1.0, 0.0))
    exact = material.mueller(um, incident=light, reflected=view, n=0.25, k=3.0, tolerance=1e-9)
    exact = in_mitsubas_frames(mi, exact[np.newaxis], light[np.newaxis], view[np.newaxis])[0] * light[2]
    # the integrator turns what arrives into the frame of the sensor, x across its up vector
    basis = stokes_basis(mi, view[np.newaxis])
    up = np.array([0, 1, 0.1])
    horizontal = np.cross(view, up)[np.newaxis]
    sensor = rotation(view[np.newaxis], basis, horizontal / np.linalg.norm(horizontal))[0]
    np.testing.assert_allclose(measured / exact[0, 0], sensor @ exact / exact[0, 0], atol=2e-4)
