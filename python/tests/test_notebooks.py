"""The notebooks run, and print what they were saved with."""

import pathlib

import nbclient
import nbformat
import pytest

from mitsuba_scenes import mitsuba_in

NOTEBOOKS = sorted((pathlib.Path(__file__).resolve().parents[1] / "notebooks").glob("*.ipynb"))


def printed(notebook):
    return ["".join(o.text for o in cell.get("outputs", []) if o.output_type == "stream") for cell in notebook.cells]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(path):
    saved = nbformat.read(path, as_version=4)
    if any("mitsuba" in cell.source for cell in saved.cells if cell.cell_type == "code"):
        mitsuba_in("llvm_ad_spectral")
    fresh = nbformat.from_dict(saved)
    nbclient.NotebookClient(fresh, timeout=600, kernel_name="python3").execute()
    assert printed(fresh) == printed(saved)
    assert sum(len(cell.get("outputs", [])) for cell in fresh.cells) == sum(len(cell.get("outputs", [])) for cell in saved.cells)
