"""The examples of docs/python run and find what they should; the notebooks agree with them."""

import re
import subprocess
import sys

import numpy as np
import palpa
import pytest
from conftest import ROOT

FOLDER = ROOT / "docs/python"


@pytest.fixture(autouse=True)
def run(tmp_path, monkeypatch):
    """Runs an example in an empty folder and returns what it prints."""
    monkeypatch.setenv("PALPA_PROJECTS", str(ROOT / "projects"))

    def run_example(name):
        outcome = subprocess.run(
            [sys.executable, FOLDER / f"{name}.py"], cwd=tmp_path, capture_output=True, text=True
        )
        assert outcome.returncode == 0, outcome.stderr
        return outcome.stdout

    return run_example


def is_picture(path):
    return path.read_bytes().startswith(b"\x89PNG") and path.stat().st_size > 5000


def test_stiffness_grows_with_the_wall(run, tmp_path):
    text = run("stiffness_study")
    stiffness = [float(each) for each in re.findall(r"mm: ([\d.]+) N/mm", text)]
    assert len(stiffness) == 4 and stiffness == sorted(stiffness)
    exponent = float(re.search(r"power ([\d.]+)", text).group(1))
    assert 2 < exponent < 3, "less than of a thin plate, more than of a membrane"
    assert is_picture(tmp_path / "stiffness_study.png")


def test_the_calibration_finds_the_modulus(run, tmp_path):
    modulus, uncertainty = map(float, re.search(r"modulus: ([\d.]+) ± ([\d.]+)", run("material_calibration")).groups())
    # The modulus from which the table was computed.
    assert modulus == pytest.approx(0.17, rel=0.02) and abs(modulus - 0.17) < uncertainty
    assert palpa.open(tmp_path / "pad.json").material.youngs_modulus == pytest.approx(modulus, abs=0.001)
    assert is_picture(tmp_path / "material_calibration.png")


def test_the_skin_points_to_the_touch(run, tmp_path):
    text = run("tactile_skin")
    x, y = map(float, re.search(r"point to \[ *(-?[\d.]+) +(-?[\d.]+) *\]", text).groups())
    assert np.hypot(x - 4, y + 2) < 3
    assert is_picture(tmp_path / "tactile_skin.png")


def test_training_data_are_complete(run, tmp_path):
    run("training_data")
    with np.load(tmp_path / "touches.npz") as file:
        forces, given = file["force_N"], file["given_mm"]
        assert forces.shape == given.shape == (10_000, 3) and file["markers_mm"].shape == (10_000, 25, 3)
        assert np.isfinite(forces).all()
        # Work is done on the body in every touch.
        assert (np.einsum("ni,ni->n", forces, given) > 0).all()
        assert file["displacement_mm"] == pytest.approx(given, abs=1e-4)


def test_notebooks_agree_with_the_scripts():
    subprocess.run([ROOT / "scripts/make-notebooks", "--check"], check=True)


def test_the_reference_page_is_current():
    subprocess.run([sys.executable, ROOT / "scripts/make-python-page", "--check"], check=True)
