"""What the tests of the Python package share."""

import json
import os
import pathlib
import subprocess

import numpy as np
import palpa
import pytest

ROOT = pathlib.Path(os.environ["PALPA_ROOT"])
BUILD = pathlib.Path(os.environ["PALPA_BUILD"])


@pytest.fixture(scope="session")
def projects():
    """The folder of the example projects."""
    return ROOT / "projects"


@pytest.fixture(scope="session")
def cli():
    """Runs palpa-cli with --json and returns the object that it prints."""

    def run(*arguments):
        words = [os.environ["PALPA_CLI"], *map(str, arguments), "--json"]
        return json.loads(subprocess.run(words, check=True, capture_output=True).stdout)

    return run


@pytest.fixture(scope="session")
def failing_cli():
    """Runs palpa-cli, expects it to fail and returns the message."""

    def run(*arguments):
        words = [os.environ["PALPA_CLI"], *map(str, arguments)]
        outcome = subprocess.run(words, capture_output=True, text=True)
        assert outcome.returncode != 0
        return outcome.stderr.strip().removeprefix("palpa-cli: ")

    return run


@pytest.fixture(scope="session")
def ball():
    """A sphere of 25 mm, held at its lowest tenth, with a coarse mesh."""
    return palpa.sphere(25).build(edge_length=6)


@pytest.fixture(scope="session")
def block():
    """A box held at its bottom, computed with splines."""
    return palpa.box((40, 30, 20)).build(accuracy=0.05)


def spread_over_top(count, seed=0):
    """Places on the upper half of the sphere of 25 mm, and the outward normals there."""
    normals = np.random.default_rng(seed).normal(size=(count, 3))
    normals[:, 2] = np.abs(normals[:, 2])
    normals /= np.linalg.norm(normals, axis=1)[:, np.newaxis]
    return 25 * normals, normals
