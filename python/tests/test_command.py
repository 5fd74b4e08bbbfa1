"""The same numbers as the command."""

import csv
import io
import subprocess

import numpy as np
import pytest

import hts

COUNT = 10_000


@pytest.fixture(scope="module")
def rows(command):
    """Random rows of every regime, and what `hts eval` says of them."""
    rng = np.random.default_rng(20261128)
    columns = {
        "wavelength_um": 10 ** rng.uniform(-0.5, 1, COUNT),
        "theta_i_deg": rng.uniform(0, 89.9, COUNT),
        "phi_i_deg": np.zeros(COUNT),
        "theta_r_deg": rng.uniform(0, 89.9, COUNT),
        "phi_r_deg": rng.uniform(0, 360, COUNT),
        "n": rng.uniform(0.2, 3, COUNT),
        "k": rng.uniform(0, 6, COUNT),
        "rms_roughness_um": 10 ** rng.uniform(-3, 1, COUNT),
        "correlation_length_um": 10 ** rng.uniform(-0.5, 1.5, COUNT),
    }
    text = ",".join(columns) + "\n"
    for row in zip(*columns.values()):
        text += ",".join(repr(float(x)) for x in row) + "\n"
    said = subprocess.run(
        [command, "eval", "--points", "-", "--mueller"], input=text, capture_output=True, text=True, check=True
    )
    answer = list(csv.reader(io.StringIO(said.stdout)))
    values = np.array(answer[1:], dtype=float)
    return columns, {name: values[:, i] for i, name in enumerate(answer[0])}


def close(found, expected):
    """Relative difference, of values that are no underflows."""
    where = np.abs(expected) > 1e-270
    return np.max(np.abs(found - expected)[where] / np.abs(expected)[where], initial=0)


def arguments(columns):
    of = {key: columns[key] for key in ("n", "k", "rms_roughness_um", "correlation_length_um")}
    return dict(
        wavelength=columns["wavelength_um"],
        theta_i=columns["theta_i_deg"],
        theta_r=columns["theta_r_deg"],
        phi=columns["phi_r_deg"],
        tolerance=1e-12,
        degrees=True,
        **of,
    )


SHAPES = [(COUNT,), (100, 100), (10, 1, 1000), (5, 4, 5, 100)]


@pytest.mark.parametrize("shape", SHAPES)
def test_brdf(rows, shape):
    columns, said = rows
    surface = hts.Material(model="he", rms_roughness_um=1, correlation_length_um=1, index={"n": 1.5, "k": 0})
    shaped = {
        key: value.reshape(shape) if isinstance(value, np.ndarray) else value
        for key, value in arguments(columns).items()
    }
    found = surface.brdf(**shaped)
    assert found.shape == shape
    assert close(found.ravel(), said["brdf"]) < 1e-12


def test_mueller(rows):
    columns, said = rows
    surface = hts.Material(model="he", rms_roughness_um=1, correlation_length_um=1, index={"n": 1.5, "k": 0})
    found = surface.mueller(**arguments(columns))
    assert found.shape == (COUNT, 4, 4)
    for i in range(4):
        for j in range(4):
            difference = np.abs(found[:, i, j] - said[f"m{i}{j}"])
            assert np.all(difference <= 1e-12 * np.abs(said["m00"]))


def test_specular(rows):
    columns, said = rows
    surface = hts.Material(model="he", rms_roughness_um=1, correlation_length_um=1, index={"n": 1.5, "k": 0})
    asked = arguments(columns)
    del asked["theta_r"], asked["phi"]
    assert close(surface.specular_reflectance(**asked), said["specular_reflectance"]) < 1e-12


def test_refusals(command, tmp_path):
    """Errors carry the command's message."""
    path = tmp_path / "bad.json"
    path.write_text('{"name": "x", "model": "he", "rms_roughness_um": -1, "correlation_length_um": 1, "index": "Al"}')
    said = subprocess.run([command, "info", path], capture_output=True, text=True)
    assert said.returncode == 1
    with pytest.raises(hts.Error) as error:
        hts.Material(path)
    assert str(error.value) in said.stderr
