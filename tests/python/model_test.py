"""Models and touches: the same numbers as palpa-cli, bit for bit."""

import numpy as np
import palpa
import pytest


def same_contacts(state, report):
    assert len(state.contacts) == len(report["contacts"])
    for contact, expected in zip(state.contacts, report["contacts"]):
        assert contact.name == expected["name"] and contact.kind == expected["kind"]
        assert contact.status == expected["status"]
        for key, value in [
            ("at_mm", contact.at),
            ("normal", contact.normal),
            ("force_N", contact.force),
            ("displacement_mm", contact.displacement),
            ("deflection_mm", contact.deflection),
        ]:
            assert value.tolist() == expected[key], key
        assert contact.radius == expected["radius_mm"]
        assert contact.stiffness == expected["stiffness_N_per_mm"]
        assert contact.normal_force == expected["normal_force_N"]
        assert contact.tangential_force == expected["tangential_force_N"]


@pytest.mark.parametrize("name", ["sphere", "box", "gripper-finger"])
def test_touches_of_a_project_equal_the_command_line(cli, projects, name):
    # A triangle mesh, splines, and a ball with friction.
    model = palpa.open(projects / f"{name}.json").build()
    state = model.play()
    report = cli("touch", projects / f"{name}.json")
    same_contacts(state, report)
    assert model.report["nodes"] == report["nodes"] and model.report["engine"] == report["engine"]
    assert state.energy == report["energy_mJ"] and state.balance == report["balance_N"]
    assert state.error == report["force_error_estimate"]
    assert state.field_error == report["error_estimate"]
    assert state.contact_errors.tolist() == [each["error_estimate"] for each in report["contacts"]]
    for support, expected in zip(state.supports, report["supports"]):
        assert support.name == expected["name"]
        assert support.force.tolist() == expected["force_N"]
        assert support.moment.tolist() == expected["moment_Nmm"]
    largest = np.linalg.norm(state.displacements, axis=1).max()
    assert largest == pytest.approx(report["largest_displacement"]["u_mm"], rel=1e-14)


def test_a_touch_of_the_command_line(cli, tmp_path):
    project = palpa.sphere(25)
    project.save(tmp_path / "ball.json")
    # Meshes are finer at the touches of a project, so the touch belongs to it before it is built.
    project.touches = [palpa.Touch("touch", (0, 0, 25), displace=(0.5, 0, -2), radius=8)]
    state = project.build(edge_length=5).play("touch")
    options = ["--edge-length", 5, "--at", "0,0,25", "--displace", "0.5,0,-2", "--radius", 8]
    report = cli("touch", tmp_path / "ball.json", *options, "--sample", "25,0,0")
    same_contacts(state, report)
    displacements, tractions = state.sample((25, 0, 0))
    assert displacements[0].tolist() == report["samples"][0]["u_mm"]
    assert tractions[0].tolist() == report["samples"][0]["traction_MPa"]


def test_loads_without_touches(cli, projects):
    file = projects / "sole-cushion.json"
    model = palpa.open(file).build(accuracy=0.05)
    report = cli("solve", file, "--accuracy", 0.05)
    state = model.solve()
    assert not state.contacts
    assert [each.force.tolist() for each in state.supports] == [each["force_N"] for each in report["supports"]]
    assert [each.force.tolist() for each in state.loads] == [each["force_N"] for each in report["loads"]]


def test_a_sweep_equals_the_command_line(cli, projects):
    file = projects / "sphere.json"
    sweep = palpa.open(file).build().sweep(4)
    report = cli("touch", file, "--sweep", 4)
    assert sweep.shares.tolist() == [row["share"] for row in report["sweep"]]
    assert sweep.forces.shape == (5, 1, 3) and sweep.stiffness.shape == (5, 1)
    assert (sweep.forces[0] == 0).all() and sweep.energies[-1] == report["energy_mJ"]
    assert sweep.forces[-1, 0].tolist() == report["contacts"][0]["force_N"]


def test_a_touch_anywhere(ball):
    state = ball.touch(at=(0, 0, 25), displace=(0, 0, -2), radius=8)
    assert state.force.shape == (3,) and state.force[2] < 0
    assert state.displacement == pytest.approx((0, 0, -2))
    assert 0 < state.error < 0.5 and state.stiffness == pytest.approx(-state.force[2] / 2, rel=1e-3)
    # The support answers.
    assert state.supports[0].force + state.force == pytest.approx(np.zeros(3), abs=0.02 * state.stiffness)
    # A force gives the displacement back.
    back = ball.touch(at=(0, 0, 25), force=state.force, radius=8)
    assert back.displacement == pytest.approx(state.displacement, abs=1e-9)
    push = ball.touch(at=(0, 0, 25), displace=(0, 0, -1), kind="push", friction=0.3, radius=6)
    assert push.contacts[0].kind == "push" and push.force[2] < 0
    lifted = ball.touch(at=(0, 0, 25), displace=(0, 0, 1), kind="ball", radius=6)
    assert lifted.contacts[0].status == "open" and (lifted.force == 0).all()


def test_fields_have_the_shapes_of_the_mesh(ball, tmp_path):
    state = ball.touch(at=(0, 0, 25), displace=(0, 0, -2), radius=8)
    nodes, triangles = ball.report["nodes"], ball.report["triangles"]
    assert ball.nodes.shape == state.displacements.shape == (nodes, 3)
    assert ball.triangles.shape == (triangles, 3) and ball.triangles.max() == nodes - 1
    assert state.tractions.shape == (triangles, 3, 3)
    assert state.stresses.shape == (triangles, 3, 3, 3)
    assert np.allclose(state.stresses, np.swapaxes(state.stresses, 2, 3))
    # The integral of the tractions on the upper half is the force of the touch.
    corners = ball.nodes[ball.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1) / 2
    upper = corners[:, :, 2].mean(axis=1) > 0
    pressed = np.einsum("t,tci->i", areas[upper] / 3, state.tractions[upper])
    assert pressed == pytest.approx(state.force, abs=0.1 * np.linalg.norm(state.force))
    state.save(tmp_path / "touched.vtp")
    assert b"displacement_mm" in (tmp_path / "touched.vtp").read_bytes()
    state.save(tmp_path / "touched.stl")
    assert palpa.open(tmp_path / "touched.stl").volume < palpa.sphere(25).volume


def test_uniform_compression_inside():
    # E = 2 MPa, nu = 0.3, sigma_zz = -0.1 MPa between guides on three sides.
    project = palpa.box((10, 10, 20))
    project.material = palpa.Material(2.0, 0.3)
    low = np.min(project.control_points, axis=0)
    project.supports = [
        palpa.Support(name, palpa.patches(name), "roller") for name in ("bottom", "side_xmin", "side_ymin")
    ]
    project.loads = [palpa.Pressure("press", palpa.patches("top"), 0.1)]
    state = project.build(accuracy=0.01).solve()
    points = low + np.array([(2, 3, 5), (5, 5, 10), (7, 2, 16)])
    displacements, stresses = state.inside(points)
    assert stresses == pytest.approx(np.tile(np.diag([0, 0, -0.1]), (3, 1, 1)), abs=1e-4)
    expected = (points - low) * (0.3 * 0.05, 0.3 * 0.05, -0.05)
    assert displacements == pytest.approx(expected, abs=1e-4)
    with pytest.raises(palpa.InputError, match="point 1 is not inside"):
        state.inside([points[0], (0, 0, 90)])


def test_several_touches_at_once(ball):
    touches = [
        palpa.Touch("press", (0, 0, 25), displace=(0, 0, -1), radius=6),
        palpa.Touch("hold", (25, 0, 0), kind="pin", radius=6),
    ]
    state = ball.play(touches)
    assert [each.name for each in state.contacts] == ["press", "hold"]
    with pytest.raises(palpa.InputError, match="has 2 touches"):
        state.force
    assert ball.play(touches[0]).force[2] != state.contacts[0].force[2]


def test_wrong_touches_are_refused(ball):
    for action, message in [
        (lambda: ball.touch(at=(0, 0, 25)), "needs displace"),
        (lambda: ball.touch(at=(0, 0, 25), displace=(0, 0, 1), force=(0, 0, 1)), "but no"),
        (lambda: ball.touch(at=(0, 0, 60), displace=(0, 0, 1)), "away from the surface"),
        (lambda: ball.touch(at=(0, 0, -25), displace=(0, 0, 1)), "fixed by a support"),
        (lambda: ball.touch(at=(0, 0, 25), displace=(0, 0, 1), radius=-3), "radius"),
        (lambda: ball.touch(at=(0, 0, 25), displace=(0, 0, np.inf)), "finite"),
        (lambda: ball.touch(at=(0, 0, 25), displace=(0, 0, -1), kind="poke"), "kind: expected"),
        (lambda: ball.touch(at=(0, 0, 25), displace=(0, 0, -1), friction=0.5), "friction"),
        (lambda: ball.touch(at=(0, 25), displace=(0, 0, -1)), "at: expected"),
        (lambda: ball.play(), "no recorded touches"),
        (lambda: ball.play("poke"), "has no touch 'poke'"),
        (lambda: ball.sweep(0, palpa.Touch("t", (0, 0, 25), displace=(0, 0, -1))), "count"),
    ]:
        with pytest.raises(palpa.InputError, match=message):
            action()


def test_a_model_keeps_its_project():
    project = palpa.box((40, 30, 20))
    project.touches = [palpa.Touch("press", (0, 0, 20), displace=(0, 0, -1), radius=6)]
    model = project.build(accuracy=0.05)
    force = model.play().force
    project.material = project.material.replace(youngs_modulus=0.4)
    assert (model.play().force == force).all()
    assert project.build(accuracy=0.05).play().force == pytest.approx(2 * force)


def test_factors_are_used_again_for_other_loads():
    project = palpa.box((40, 30, 20))
    pull = palpa.Force("pull", palpa.patches("top"), (0.0, 0.0, 1.0))
    project.loads = [pull]
    first = project.build(accuracy=0.05)
    project.loads = [pull.replace(force=(0.0, 0.0, 2.0))]
    second = project.build(accuracy=0.05)
    assert second.report["seconds"]["assemble"] == 0
    assert second.solve().displacements == pytest.approx(2 * first.solve().displacements)
    fresh = palpa.box((40, 30, 20))
    fresh.loads = project.loads
    assert (fresh.build(accuracy=0.05).solve().displacements == second.solve().displacements).all()
