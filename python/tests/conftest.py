import os
import pathlib

import numpy as np
import pytest

os.environ["HTS_CACHE"] = "off"  # before the import: tables of another build must not answer

import hts  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def aluminium() -> hts.Material:
    return hts.Material(SOURCE / "cli/data/rough-aluminium.json")


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(7)


@pytest.fixture(scope="session")
def command() -> pathlib.Path:
    """The command of the same checkout."""
    path = SOURCE / "build/release/bin/hts"
    if not path.exists():
        pytest.skip(f"{path} is not built: ./run build")
    return path


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--slow", action="store_true", help="also run the tests that take minutes")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if config.getoption("--slow"):
        return
    for item in items:
        if "slow" in item.keywords:
            item.add_marker(pytest.mark.skip(reason="takes minutes: pytest --slow"))
