"""The examples of the documentation run, and print what the documentation says."""

import pathlib
import re
import subprocess
import sys

import pytest

from mitsuba_scenes import mitsuba_in

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "python/examples").glob("*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example(path):
    if path.stem.startswith("mitsuba"):
        mitsuba_in("llvm_ad_mono")
    said = subprocess.run([sys.executable, path], capture_output=True, text=True, check=True).stdout
    page = (ROOT / "docs/python.md").read_text()
    shown = re.search(rf"\{{literalinclude\}} \.\./python/examples/{path.name}\n.*?```text\n(.*?)```", page, re.S)
    assert shown, f"docs/python.md does not show {path.name}"
    assert said == shown.group(1)
