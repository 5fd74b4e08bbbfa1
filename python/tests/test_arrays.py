"""Broadcasting, types, strides and out=, against one number at a time."""

import os
import signal

import numpy as np
import pytest

import hts


def one_by_one(material, *arrays):
    arrays = np.broadcast_arrays(*arrays)
    flat = [material.brdf(*(float(x) for x in row)) for row in zip(*(a.ravel() for a in arrays))]
    return np.array(flat).reshape(arrays[0].shape)


@pytest.mark.parametrize(
    "shapes",
    [
        ((), (), (), ()),
        ((4,), (), (), ()),
        ((3,), (5, 1), (5, 1), (5, 1)),
        ((3, 1), (5,), (5,), ()),
        ((2, 1, 3), (4, 1), (1, 4, 1), ()),
        ((6,), (6,), (6,), (6,)),
        ((2, 3), (3,), (2, 1), ()),
        ((1,), (1, 1), (), (1, 1, 1)),
    ],
)
def test_broadcasting(aluminium, rng, shapes):
    wavelength = rng.uniform(0.3, 2, shapes[0])
    angles = [rng.uniform(0, 1.5, shape) for shape in shapes[1:]]
    found = aluminium.brdf(wavelength, *angles)
    expected = one_by_one(aluminium, wavelength, *angles)
    assert np.shape(found) == expected.shape
    # whole spectra go through vector lanes, with the tolerance as their bound
    np.testing.assert_allclose(found, expected, rtol=2e-6)


def test_repeated_and_unsorted_wavelengths(aluminium):
    found = aluminium.brdf([0.6, 0.4, 0.6], 0.3, [[0.2], [0.5]], 3.0, tolerance=1e-12)
    assert np.array_equal(found[:, 0], found[:, 2])
    np.testing.assert_allclose(found[:, 1], aluminium.brdf(0.4, 0.3, [0.2, 0.5], 3.0, tolerance=1e-12), rtol=1e-12)


@pytest.mark.parametrize("dtype", ["f4", "f8", "i4", "u1", ">f8", "f2", np.longdouble])
def test_types(aluminium, dtype):
    theta = np.array([0, 1], dtype=dtype)
    expected = aluminium.brdf(0.5, 0.25, [0.0, 1.0], 3)
    assert np.array_equal(aluminium.brdf(0.5, 0.25, theta, 3), expected)


def test_strides(aluminium, rng):
    theta = rng.uniform(0, 1.5, (6, 8))
    whole = aluminium.brdf([0.4, 0.6], 0.3, theta[..., np.newaxis], 3.0)
    for view in (np.s_[::-1], np.s_[::2, ::-3], np.s_[1:4, 3]):
        part = aluminium.brdf([0.4, 0.6], 0.3, theta[view][..., np.newaxis], 3.0)
        assert np.array_equal(part, whole[view])
    field = np.zeros(6, dtype=[("x", "i4"), ("theta", "f8")])
    field["theta"] = theta[:, 0]
    assert np.array_equal(aluminium.brdf(0.5, 0.3, field["theta"], 3.0), aluminium.brdf(0.5, 0.3, theta[:, 0].copy(), 3.0))
    theta.flags.writeable = False
    assert np.array_equal(aluminium.brdf([0.4, 0.6], 0.3, theta[..., np.newaxis], 3.0), whole)


def test_out(aluminium, rng):
    theta = rng.uniform(0, 1.5, 5)
    expected = aluminium.brdf(0.5, theta, 0.3, 3.0)
    out = np.empty(10)[::2]
    assert aluminium.brdf(0.5, theta, 0.3, 3.0, out=out) is out
    assert np.array_equal(out, expected)
    over = theta.copy()  # results in place of arguments
    aluminium.brdf(0.5, over, 0.3, 3.0, out=over)
    assert np.array_equal(over, expected)
    shifted = np.concatenate([theta, np.empty(700)])  # each result where a later argument stands
    long = np.resize(theta, 600)
    shifted[:600] = long
    aluminium.brdf(0.5, shifted[:600][::-1], 0.3, 3.0, out=shifted[100:700])
    assert np.array_equal(shifted[100:700], aluminium.brdf(0.5, long[::-1], 0.3, 3.0))
    aluminium.brdf([0.4, 0.6], theta[:, np.newaxis], 0.3, 3.0, out=(turned := np.empty((2, 5)).T))
    assert np.array_equal(turned, aluminium.brdf([0.4, 0.6], theta[:, np.newaxis], 0.3, 3.0))
    swapped = aluminium.brdf([0.6, 0.4], theta[:, np.newaxis], 0.3, 3.0)
    assert np.array_equal(swapped[:, ::-1], turned)
    matrices = np.empty((4, 4, 5))
    aluminium.mueller(0.5, theta, 0.3, 3.0, out=np.moveaxis(matrices, -1, 0))
    assert np.array_equal(np.moveaxis(matrices, -1, 0), aluminium.mueller(0.5, theta, 0.3, 3.0))
    number = np.empty(())
    aluminium.brdf(0.5, 0.3, 0.3, 3.0, out=number)
    assert number == aluminium.brdf(0.5, 0.3, 0.3, 3.0)


def test_empty(aluminium):
    assert aluminium.brdf(0.5, np.empty((0, 3)), 0.3, 3.0).shape == (0, 3)
    assert aluminium.mueller(np.empty(0), 0.1, 0.3, 3.0).shape == (0, 4, 4)


def test_vectors(aluminium, rng):
    theta_i, theta_r, phi = rng.uniform(0, 1.5, 20), rng.uniform(0, 1.5, 20), rng.uniform(0, 6, 20)
    light = np.stack([np.sin(theta_i), 0 * theta_i, np.cos(theta_i)], axis=-1)
    view = np.stack([np.sin(theta_r) * np.cos(phi), np.sin(theta_r) * np.sin(phi), np.cos(theta_r)], axis=-1)
    found = aluminium.brdf(0.5, incident=light, reflected=view, tolerance=1e-12)
    np.testing.assert_allclose(found, aluminium.brdf(0.5, theta_i, theta_r, phi, tolerance=1e-12), rtol=1e-9)
    assert aluminium.brdf([0.5, 0.6], incident=light[:, np.newaxis], reflected=view[:, np.newaxis]).shape == (20, 2)


def test_any_number_of_threads(aluminium, rng):
    theta = rng.uniform(0, 1.5, 5000)
    one, two = (aluminium.brdf(0.5, theta, 0.3, 3.0, threads=threads) for threads in (1, 2))
    assert np.array_equal(one, two)


def test_forked_process(aluminium, rng):
    """A child of a process whose threads have worked computes too, on one of its own, whatever is asked."""
    theta = rng.uniform(0, 1.5, 5000)
    wanted = aluminium.brdf(0.5, theta, 0.3, 3.0, threads=2)
    child = os.fork()
    if child == 0:
        signal.alarm(60)  # ends the child, were it to wait
        same = [np.array_equal(aluminium.brdf(0.5, theta, 0.3, 3.0, threads=n), wanted) for n in (0, 2)]
        os._exit(0 if all(same) and aluminium.albedo(0.5, 0.3) > 0 else 1)
    assert os.waitpid(child, 0)[1] == 0


def smooth(**keys):
    return hts.Material(model="he", rms_roughness_um=0.0, correlation_length_um=1, **keys)


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda m: m.brdf(0.5, 2.0, 0.1, 3.0), "polar angle 2 rad: must be from 0 to pi/2"),
        (lambda m: m.brdf(0.5, 91, 0.1, 3.0, degrees=True), "polar angle 91 deg"),
        (lambda m: m.brdf(0.5, [0.1, np.nan], 0.1, 3.0), "nan"),
        (lambda m: m.brdf(0.5, [1, 2, 3], [1, 2], 3.0), "theta_i (3,), theta_r (2,)"),
        (lambda m: m.brdf("red", 0.1, 0.1, 3.0), "wavelength: must be real numbers"),
        (lambda m: m.brdf(0.5 + 1j, 0.1, 0.1, 3.0), "wavelength: must be real numbers"),
        (lambda m: m.brdf([[1, 2], [3]], 0.1, 0.1, 3.0), "wavelength"),
        (lambda m: m.brdf(None, 0.1, 0.1, 3.0), "wavelength"),
        (lambda m: m.brdf(-0.5, 0.1, 0.1, 3.0), "wavelength -0.5 um"),
        (lambda m: m.brdf(999, 0.1, 0.1, 3.0), "range of Al"),
        (lambda m: m.brdf(0.5, 0.1), "theta_r: must be given"),
        (lambda m: m.brdf(0.5, 0.1, 0.1, 3.0, incident=[0, 0, 1], reflected=[0, 0, 1]), "directions given twice"),
        (lambda m: m.brdf(0.5, incident=[0, 1], reflected=[0, 0, 1]), "must be of shape (..., 3), not (2,)"),
        (lambda m: m.brdf(0.5, incident=[0, 0, -1], reflected=[0, 0, 1]), "z"),
        (lambda m: m.brdf(0.5, 0.1, 0.1, 3.0, out=np.empty(3)), "out: must be of shape ()"),
        (lambda m: m.brdf(0.5, [0.1], 0.1, 3.0, out=np.empty(1, "f4")), "float64"),
        (lambda m: m.brdf(0.5, [0.1], 0.1, 3.0, out=[0.0]), "out: must be an array"),
        (lambda m: m.brdf(0.5, 0.1, 0.1, 3.0, tolerance=0), "tolerance"),
        (lambda m: m.brdf(0.5, 0.1, 0.1, 3.0, outside="guess"), "outside"),
        (lambda m: m.brdf(0.5, 0.1, 0.1, 3.0, n=-1.0), "n"),
        (lambda m: m.gradient(0.5, 0.1, 0.1, 3.0, of="colour"), "brdf"),
        (lambda m: m.emissivity(0.5, 0.1, "x"), "polarisation"),
        (lambda m: m.sample(0.5, [0.1, 0.2], size=3), "size"),
        (lambda m: hts.phi(-1, 2), "g -1"),
        (lambda m: hts.Material(model="he"), "rms_roughness_um"),
        (lambda m: hts.Material(), "must be a file, a dict or keywords"),
        (lambda m: hts.Material(3), "int"),
        (lambda m: hts.Material("nothing.json"), "nothing.json: no such file"),
        (lambda m: hts.Material(model="he", rms_roughness_um=float("nan"), correlation_length_um=1, index="Al"), "material"),
        (lambda m: hts.fit({"theta_i": 1}), "missing"),
        (lambda m: hts.fit("curet-sandpaper", residual="best"), "residual"),
        (lambda m: hts.render("moon"), "fig12"),
        (lambda m: hts.render("sphere"), "material"),
        (lambda m: hts.read("nothing.binary"), "nothing.binary"),
        (lambda m: m.brdf(0.5, np.ma.array([0.1, 0.2], mask=[False, True]), 0.1, 3.0), "theta_i: holds masked values"),
        (lambda m: m.brdf(0.5, [0.1], 0.1, 3.0, threads=-1), "threads -1: must be 0, for all cores, ... 1024"),
        (lambda m: m.brdf(0.5, [0.1], 0.1, 3.0, threads=10**6), "threads 1000000"),
        (lambda m: m.sample(0.5, 0.1, size=2.5), "size 2.5: must be a whole number"),
        (lambda m: m.sample([0.5, 0.6], 0.1), "wavelength: must be one number, not (2,)"),
        (lambda m: m.plan("x"), "wavelengths: must be a number or an array of numbers"),
        (lambda m: m.band_emissivity([0.5, 0.6], [1, -0.5], 0.1), "response -0.5: must be >= 0"),
        (lambda m: m.band_emissivity([0.6, 0.5], [1, 1], 0.1), "wavelengths: must increase"),
        (lambda m: m.band_emissivity([0.5, 0.6], [0, 0], 0.1), "response: must be > 0 somewhere"),
        (lambda m: hts.fit(3), "curves: int: must be"),
        (lambda m: hts.srgb([np.nan]), "linear: holds what is no number"),
        (lambda m: hts.srgb("x"), "linear: must be a number or an array of numbers"),
        (lambda m: hts.Material("a\0b"), "must be a path without NUL"),
        (lambda m: smooth(index=complex("nan")), "what is no finite number"),
        (lambda m: smooth(index=lambda um: np.zeros(7)).brdf([0.5, 0.6], 0.1, 0.1, 3.0), "must be 2 numbers"),
        (lambda m: smooth(index=lambda um: "x").brdf(0.5, 0.1, 0.1, 3.0), "must be 1 numbers"),
    ],
)
def test_bad_input(aluminium, call, words):
    with pytest.raises(hts.Error, match=".*") as error:
        call(aluminium)
    assert words in str(error.value)


def test_read_only_out(aluminium):
    out = np.empty(1)
    out.flags.writeable = False
    with pytest.raises(hts.Error, match="read-only"):
        aluminium.brdf(0.5, [0.1], 0.1, 3.0, out=out)


def test_errors_name_the_element(aluminium):
    theta = np.full((20, 30), 10.0)
    theta[8, 15] = 91
    with pytest.raises(hts.Error, match=r"polar angle 91 deg.*\(pair of directions \(8, 15\)\)"):
        aluminium.brdf([0.5, 0.6], theta[..., np.newaxis], 20, 180, degrees=True)
    with pytest.raises(hts.Error, match=r"\(element \(8, 15\)\)"):
        aluminium.brdf(np.full((20, 30), 0.5) + np.arange(30) / 100, theta, 20, 180, degrees=True)
    for wrong in (0, 255, 256, 300):
        angles = np.full(301, 0.3)
        angles[wrong] = np.nan
        with pytest.raises(hts.Error, match=rf"polar angle nan rad.*directions {wrong}\)"):
            aluminium.brdf(0.5, 0.2, angles, 3.0)
        with pytest.raises(hts.Error, match=rf"polar angle nan deg.*directions {wrong}\)"):
            aluminium.brdf(0.5, 0.2, angles, 3.0, degrees=True)
    with pytest.raises(hts.Error, match=r"polar angle 95 deg.*\(element 1\)"):
        aluminium.sample(0.5, [20, 95], degrees=True)
    bad = {"wavelength": 0.5, "theta_i": 30, "theta_r": [20, 95], "phi": 180, "brdf": 0.1}
    with pytest.raises(hts.Error, match=r"polar angle 95 deg.*\(element 1\)"):
        hts.fit(bad, degrees=True)


def test_errors_are_of_one_family(aluminium):
    for call in (
        lambda: aluminium.brdf(0.5, 0.1, 0.2, 10**400),
        lambda: aluminium.sample(0.5, [0.1, 0.2], [1, 2, 3]),
        lambda: aluminium.sample(0.5, 0.1, rng="x"),
        lambda: aluminium.sample(0.5, 0.1, rng=-1),
        lambda: aluminium.brdf(0.5, 0.1, 0.2, 3.0, threads=-1),
        lambda: aluminium.brdf(0.5, [], 0.2, 3.0, threads=-1),
    ):
        with pytest.raises(hts.Error):
            call()
