"""Batches, compliance, gradients and sensors against single touches and the command line."""

import csv

import numpy as np
import palpa
import pytest
from conftest import spread_over_top


@pytest.mark.parametrize("name", ["ball", "block"])
def test_a_batch_equals_single_touches(request, name):
    model = request.getfixturevalue(name)
    if name == "ball":
        at, normals = spread_over_top(30)
    else:
        at = np.random.default_rng(1).uniform((-15, -10, 20), (15, 10, 20), (30, 3))
        normals = np.tile((0.3, 0, 1), (30, 1))
    batch = model.touch_many(at, -normals, radius=6)
    assert len(batch) == 30 and batch.kind == "grab" and batch.radius == 6
    for k in range(30):
        state = model.touch(at[k], -normals[k], radius=6)
        contact, size = state.contacts[0], np.linalg.norm(state.force)
        assert batch.forces[k] == pytest.approx(state.force, abs=1e-4 * size)
        assert batch.displacements[k] == pytest.approx(contact.displacement, abs=1e-4)
        assert batch.deflections[k] == pytest.approx(contact.deflection, abs=1e-4)
        assert batch.stiffness[k] == pytest.approx(contact.stiffness, rel=1e-4)
        assert batch.at[k] == pytest.approx(contact.at, abs=1e-9)
        assert batch.normals[k] == pytest.approx(contact.normal, abs=1e-9)
        assert batch.statuses[k] == contact.status


def test_a_batch_does_not_depend_on_its_company(ball):
    at, normals = spread_over_top(200)
    whole = ball.touch_many(at, -normals, radius=6)
    one = ball.touch_many(at, -normals, radius=6, threads=1)
    alone = ball.touch_many(at[7], -normals[7], radius=6)
    assert (whole.forces == one.forces).all() and (alone.forces[0] == whole.forces[7]).all()


def test_forces_pins_and_loads_in_a_batch():
    project = palpa.box((40, 30, 20))
    project.loads = [palpa.Force("pull", palpa.patches("top"), (0.0, 0.0, 1.0))]
    model = project.build(accuracy=0.05)
    at = (0, 0, 20)
    for keywords in ({"force": (0, 0.1, -0.3)}, {"displace": (0, 0, 0)}, {"displace": (0, 0, -1), "kind": "pin"}):
        batch = model.touch_many(at, radius=6, **keywords)
        state = model.touch(at, radius=6, **keywords)
        assert batch.forces[0] == pytest.approx(state.force, abs=1e-5)
        assert batch.displacements[0] == pytest.approx(state.displacement, abs=1e-5)
        assert batch.deflections[0] == pytest.approx(state.contacts[0].deflection, abs=1e-5)


def test_balls_and_pushes_in_a_batch_equal_single_touches_bit_for_bit(ball):
    at, normals = spread_over_top(4)
    for kind in ("ball", "push"):
        batch = ball.touch_many(at, -normals, kind=kind, radius=8, friction=0.3)
        for k in range(len(at)):
            state = ball.touch(at[k], -normals[k], kind=kind, radius=8, friction=0.3)
            assert (batch.forces[k] == state.force).all()
            assert (batch.displacements[k] == state.displacement).all()


def test_wrong_batches_are_refused(ball):
    at, normals = spread_over_top(3)
    for action, message in [
        (lambda: ball.touch_many(at), "needs displace"),
        (lambda: ball.touch_many(at, normals[:2]), "2 vectors for 3 places"),
        (lambda: ball.touch_many(at, -normals, radius=0), "radius"),
        (lambda: ball.touch_many(at, -normals, friction=1), "no friction"),
        (lambda: ball.touch_many([[0, 0, 25], [0, np.nan, 0]], (0, 0, -1)), "row 1"),
        (lambda: ball.touch_many([[0, 0, 25], [0, 0, 70]], (0, 0, -1)), "touch 1"),
        (lambda: ball.touch_many([[0, 0, 25], [0, 0, -25]], (0, 0, -1)), "touch 1: the place touched at .* is fixed"),
        (lambda: ball.touch_many([[0, 0, -25]], (0, 0, -1), kind="ball"), "touch 0"),
    ]:
        with pytest.raises(palpa.InputError, match=message):
            action()
    assert len(ball.touch_many(np.zeros((0, 3)), np.zeros((0, 3)))) == 0


def test_compliance_answers_touches_at_once(ball):
    at, _ = spread_over_top(5, seed=3)
    compliance = ball.compliance(at, radius=5)
    assert compliance.shape == (15, 15) and (compliance == compliance.T).all()
    assert np.linalg.eigvalsh(compliance).min() > 0
    displace = np.random.default_rng(4).normal(size=(5, 3))
    forces = np.linalg.solve(compliance, displace.ravel()).reshape(5, 3)
    touches = [
        palpa.Touch(f"touch {k}", tuple(at[k]), displace=tuple(displace[k]), radius=5) for k in range(5)
    ]
    for force, contact in zip(forces, ball.play(touches).contacts):
        assert force == pytest.approx(contact.force, abs=1e-9)


def test_compliance_refuses_wrong_places(ball):
    for action, message in [
        (lambda: ball.compliance([[0, 0, 70]]), "place 0"),
        (lambda: ball.compliance([[0, 0, -25]]), "fixed by a support"),
        (lambda: ball.compliance([[0, 0, 25]], radius=-1), "radius"),
    ]:
        with pytest.raises(palpa.InputError, match=message):
            action()
    with pytest.raises(palpa.SolveError, match="at most"):
        ball.compliance(np.tile((0, 0, 25.0), (5001, 1)))


def test_gradients_equal_the_command_line(cli, projects):
    file = projects / "box.json"
    model = palpa.open(file).build()
    report = cli("gradient", file)
    state = model.play()
    for k, touch in enumerate(report["touches"]):
        assert model.gradient(state, k).tolist() == touch["gradient_N_per_mm2"]
    # The gradient predicts the stiffness of another shape.
    project = palpa.open(file)
    touch = project.touches[0]
    gradient = model.gradient(touch.name)
    project.touches = [touch]
    before = project.build().play().stiffness
    top = np.flatnonzero(np.array(project.control_points)[:, 2] > 19.9)
    # Everything above the support grows by a hundredth.
    step = 0.01 * np.array(project.control_points) * (0, 0, 1)
    predicted = np.sum(model.gradient(model.play(touch)) * step)
    project.control_points += step
    project.touches = [touch.replace(at=(touch.at[0], touch.at[1], 1.01 * touch.at[2]))]
    after = project.build().play().stiffness
    assert after - before == pytest.approx(predicted, rel=0.25)
    assert len(top) and gradient.shape == step.shape


def test_gradients_refuse_what_has_none(ball, block):
    state = ball.touch((0, 0, 25), (0, 0, -1))
    with pytest.raises(palpa.InputError, match="another model"):
        block.gradient(state)
    with pytest.raises(palpa.InputError, match="no contact 3"):
        ball.gradient(state, 3)


def test_a_sensor_reads_states_and_batches(ball):
    at, normals = spread_over_top(12, seed=5)
    sensor = ball.sensor(at)
    assert sensor.at == pytest.approx(at, abs=0.2) and sensor.normals.shape == (12, 3)
    batch = ball.touch_many(at, -normals, radius=6)
    markers, pressures = sensor.markers(batch), sensor.pressures(batch)
    assert markers.shape == (12, 12, 3) and pressures.shape == (12, 12)
    for k in range(12):
        state = ball.touch(at[k], -normals[k], radius=6)
        assert markers[k] == pytest.approx(sensor.markers(state), abs=1e-4)
        assert pressures[k] == pytest.approx(sensor.pressures(state), abs=1e-4 * np.abs(pressures).max())
        # Pressed there, and pressed most there.
        assert pressures[k, k] > 0 and pressures[k, k] == pressures[k].max()
        assert markers[k, k] @ normals[k] < -0.8
    # Samples of the same places.
    assert sensor.markers(state) == pytest.approx(state.sample(at)[0], abs=0.02)


def test_a_sensor_below_the_body_feels_the_support(block):
    grid = np.stack(np.meshgrid(np.linspace(-19, 19, 39), np.linspace(-14, 14, 29)), -1).reshape(-1, 2)
    sensor = block.sensor(np.column_stack([grid, np.zeros(len(grid))]))
    state = block.touch((0, 0, 20), (0, 0, -1), radius=6)
    pressures = sensor.pressures(state)
    assert pressures == pytest.approx(state.sample(sensor.at)[1][:, 2], abs=1e-12)
    # A sum over square millimetres; at the edges the pressure is unbounded.
    assert pressures.sum() == pytest.approx(-state.force[2], rel=0.2)
    assert (sensor.markers(state) == 0).all()
    with pytest.raises(palpa.InputError, match="another model"):
        sensor.markers(palpa.box().build(accuracy=0.05).solve())


def test_batches_are_saved(ball, tmp_path):
    at, normals = spread_over_top(3)
    batch = ball.touch_many(at, -normals, radius=6)
    markers = ball.sensor(at[:2]).markers(batch)
    batch.save(tmp_path / "batch.npz", markers_mm=markers)
    with np.load(tmp_path / "batch.npz") as file:
        assert (file["force_N"] == batch.forces).all() and (file["markers_mm"] == markers).all()
        assert file["given_mm"].shape == (3, 3) and file["status"].tolist() == ["holding"] * 3
    batch.save(tmp_path / "batch.csv", markers_mm=markers)
    with open(tmp_path / "batch.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 3
    assert float(rows[1]["force_z_N"]) == batch.forces[1, 2]
    assert float(rows[1]["markers_0_x_mm"]) == markers[1, 0, 0]
    assert float(rows[2]["stiffness_N_per_mm"]) == batch.stiffness[2]
    with pytest.raises(palpa.InputError, match="ends in .npz"):
        batch.save(tmp_path / "batch.txt")
    with pytest.raises(palpa.InputError, match="one row for each"):
        batch.save(tmp_path / "batch.npz", wrong_mm=markers[:2])
    with pytest.raises(palpa.InputError, match="cannot be written"):
        batch.save(tmp_path / "no folder" / "batch.npz")


def test_batches_are_saved_as_hdf5(ball, tmp_path):
    batch = ball.touch_many([(0, 0, 25)], (0, 0, -1))
    try:
        import h5py
    except ImportError:
        with pytest.raises(palpa.InputError, match="python3-h5py"):
            batch.save(tmp_path / "batch.h5")
        return
    batch.save(tmp_path / "batch.h5")
    with h5py.File(tmp_path / "batch.h5") as file:
        assert (file["force_N"][:] == batch.forces).all() and file["status"][0] == b"grabbed"
