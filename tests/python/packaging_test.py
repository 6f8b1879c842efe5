"""The wheel: pip installs it without network, and it touches a body and reads a CAD file from there."""

import os
import subprocess
import sys

import palpa
import pytest
from conftest import BUILD, ROOT

PROGRAM = """
import pathlib, sys
import palpa
folder = pathlib.Path(sys.argv[1])
assert pathlib.Path(palpa.__file__).is_relative_to(folder), palpa.__file__
project = palpa.box((40, 30, 20))
project.export(folder / "box.step")
again = palpa.read_step(folder / "box.step")
assert again.is_solid
force = again.build(accuracy=0.05).touch((0, 0, 20), (0, 0, -1), radius=6).force
print(palpa.__version__, force[2] < 0)
"""


def outside(command, **environment):
    """Runs a command without the built package in its path."""
    plain = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    outcome = subprocess.run(list(map(str, command)), capture_output=True, text=True, env={**plain, **environment})
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    return outcome.stdout


@pytest.fixture
def wheel(tmp_path):
    packer = ROOT / "app/python/make_wheel.py"
    options = ["--package", BUILD / "python/palpa", "--version", palpa.__version__, "--license", ROOT / "LICENSE"]
    path = outside([sys.executable, packer, *options, "--to", tmp_path]).strip()
    return path


def test_pip_installs_the_wheel(wheel, tmp_path):
    site = tmp_path / "site"
    outside([sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--target", site, wheel])
    assert outside([sys.executable, "-c", PROGRAM, site], PYTHONPATH=str(site)).split() == [palpa.__version__, "True"]


def test_equal_packages_give_equal_wheels(wheel, tmp_path):
    packer = ROOT / "app/python/make_wheel.py"
    again = tmp_path / "again"
    again.mkdir()
    options = ["--package", BUILD / "python/palpa", "--version", palpa.__version__, "--license", ROOT / "LICENSE"]
    path = outside([sys.executable, packer, *options, "--to", again]).strip()
    with open(path, "rb") as first, open(wheel, "rb") as second:
        assert first.read() == second.read()
