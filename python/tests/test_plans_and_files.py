"""Plans, files of other programs, and long jobs that are given up."""

import json
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest

import hts

GRID = np.linspace(0.4, 0.7, 31)


def test_a_plan_keeps_its_promise(aluminium, rng):
    plan = aluminium.plan(GRID, 1e-2)
    assert plan.form.lobe == "full" and 2 <= plan.form.wavelengths.size < 31 and plan.form.worst <= 8e-3
    assert plan.nbytes > 0 and all(each.worst > 8e-3 for each in plan.rejected)
    theta_i, theta_r, phi = rng.uniform(0, 1.39, (200, 1)), rng.uniform(0, 1.39, (200, 1)), rng.uniform(0, 6.2, (200, 1))
    exact = aluminium.brdf(GRID, theta_i, theta_r, phi, tolerance=1e-12)
    peak = aluminium.brdf(GRID, theta_i, theta_i, np.pi, tolerance=1e-12)
    difference = np.abs(plan.material.brdf(GRID, theta_i, theta_r, phi) - exact)
    assert np.max(difference / (exact + 1e-3 * peak)) <= 1e-2
    mirror = aluminium.specular_reflectance(GRID, 0.4, tolerance=1e-12)
    np.testing.assert_allclose(plan.material.specular_reflectance(GRID, 0.4), mirror, atol=1e-2)


def test_plans_of_colours_and_of_other_models():
    paint = hts.Material(model="lambert", diffuse_albedo=0.3)
    assert paint.plan(GRID, {"delta_e_2000": 1}, output="rgb").form.wavelengths.size == 1
    with pytest.raises(hts.Error, match="polarised"):
        paint.plan(GRID, polarised=True)
    with pytest.raises(hts.Error, match="plan: colour: must be one of"):
        paint.plan(GRID, colour=True)
    with pytest.raises(hts.Error, match="tolerance"):
        paint.plan(GRID, 7.0)


@pytest.mark.parametrize("source", ["material", "table"])
def test_files_of_other_programs(aluminium, tmp_path, source):
    path = tmp_path / "aluminium.csv"
    wavelengths = [0.5, 0.6]
    written = aluminium if source == "material" else aluminium.table(wavelengths, 1e-2)
    how = {"wavelengths": wavelengths} if source == "material" else {}
    report = written.export(path, "csv", pairs=2000, **how)
    assert report["pairs"] == 2000
    assert json.loads((tmp_path / "aluminium.csv.json").read_text())["wavelengths_um"] == wavelengths
    back = hts.read(path)
    exact = aluminium.brdf(wavelengths, 0.5, 0.6, 3.0)
    np.testing.assert_allclose(back.brdf(wavelengths, 0.5, 0.6, 3.0), exact, rtol=0.05)


def test_files_that_cannot_be(aluminium, tmp_path):
    assert {"rgl", "merl", "glsl"} <= {name for name, _ in hts.written_formats()}
    with pytest.raises(hts.Error, match='format "png": must be one of'):
        aluminium.export(tmp_path / "x", "png")
    with pytest.raises(hts.Error, match="basis: must not come with format rgl"):
        aluminium.export(tmp_path / "x", "rgl", basis="half")
    with pytest.raises(hts.Error, match="solid angle"):
        aluminium.export(tmp_path / "x", "merl", specular_spread=7.0)
    assert list(tmp_path.iterdir()) == []


def test_emissivity_of_what_lets_light_through():
    glass = hts.Material(model="walter", distribution="ggx", alpha=0.1, index=1.5 + 0j)
    for call in (lambda: glass.emissivity(0.5, 0.3), lambda: glass.hemispherical_emissivity(0.5)):
        with pytest.raises(hts.Error, match="lets no light through, as this does at 0.5 um"):
            call()


def test_subinterpreters_are_refused(tmp_path):
    program = """
        import warnings, _xxsubinterpreters as interpreters
        warnings.simplefilter("ignore")
        other = interpreters.create()
        try:
            interpreters.run_string(other, "import hts")
        except interpreters.RunFailedError as error:
            print(error)
        import hts
        print(hts.phi(1, 1) > 0)
    """
    said = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", textwrap.dedent(program)], capture_output=True, text=True, cwd=tmp_path
    ).stdout
    assert "must be imported in the main interpreter" in said and said.endswith("True\n")


# Each in a process of its own, which is interrupted: (what runs, and takes some ten seconds or more).
JOBS = {
    "table": "material.table(np.linspace(0.4, 0.7, 31), 1e-4)",
    "fit": "hts.fit('curet-sandpaper', 'ashikhmin', starts=64)",
    "values": "material.brdf(np.linspace(0.4, 0.7, 31), np.full((4000000, 1), 0.3), 0.4, 3.0, tolerance=1e-12)",
}


@pytest.mark.parametrize("job", JOBS)
def test_long_jobs_are_given_up(job, tmp_path):
    program = f"""
        import hts, numpy as np
        material = hts.Material(model="he", rms_roughness_um=0.28, correlation_length_um=1.77, index="Al")
        print("begun", flush=True)
        try:
            {JOBS[job]}
            print("ended", flush=True)
        except KeyboardInterrupt:
            print("interrupted", material.brdf(0.5, 0.3, 0.3, 3.1) > 0, flush=True)
    """
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(program)], stdout=subprocess.PIPE, cwd=tmp_path, text=True
    )
    assert process.stdout is not None and process.stdout.readline() == "begun\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=120)
    assert output == "interrupted True\n"
    assert process.returncode == 0
