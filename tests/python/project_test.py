"""Projects: shapes, files, parts, edits and their history."""

import pathlib

import numpy as np
import palpa
import pytest


def test_shapes_equal_those_of_the_command_line(cli, tmp_path):
    shapes = {
        "sphere": palpa.sphere(20),
        "ellipsoid": palpa.ellipsoid((30, 20, 10)),
        "box": palpa.box((10, 20, 30), degree=2),
        "cylinder": palpa.cylinder(10, 30),
        "cone": palpa.cone(20, 0, 30),
        "capsule": palpa.capsule(8, 20),
        "torus": palpa.torus(30, 7),
    }
    options = {
        "sphere": ["--radius", 20],
        "ellipsoid": ["--radii", "30,20,10"],
        "box": ["--size", "10,20,30", "--degree", 2],
        "cylinder": ["--radius", 10, "--height", 30],
        "cone": ["--bottom-radius", 20, "--top-radius", 0, "--height", 30],
        "capsule": ["--radius", 8, "--length", 20],
        "torus": ["--major-radius", 30, "--minor-radius", 7],
    }
    for name, project in shapes.items():
        file = tmp_path / f"{name}.json"
        cli("new", name, *options[name], "-o", file)
        assert project.json() == file.read_text(), name


def test_profiles_make_solids():
    square = {"degree": 1, "knots": [0, 0, 1, 2, 3, 4, 4]}
    square["points_mm"] = [[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]
    assert palpa.extrude(square, 20, degree=1).volume == pytest.approx(2000)
    small = {**square, "points_mm": [[x / 2, y / 2] for x, y in square["points_mm"]]}
    frustum = palpa.loft([(0, square), (12, small)], degree=1)
    assert frustum.volume == pytest.approx(12 / 3 * (100 + 25 + 50), rel=1e-6)
    line = {"degree": 1, "knots": [0, 0, 1, 1], "points_mm": [[5, 0], [5, 30]]}
    assert palpa.revolve(line).volume == pytest.approx(np.pi * 25 * 30, rel=1e-3)


def test_a_project_reads_and_saves_its_file_unchanged(projects, tmp_path):
    for file in sorted(projects.glob("*.json")):
        project = palpa.open(file)
        assert project.file == str(file) and not project.is_modified
        target = tmp_path / file.name
        project.save(target)
        assert target.read_text() == project.json() == palpa.open(target).json(), file.name


def test_parts_survive_the_way_through_python(projects):
    for file in sorted(projects.glob("*.json")):
        project = palpa.open(file)
        before = project.json()
        project.material = project.material
        project.supports = project.supports
        project.loads = project.loads
        project.touches = project.touches
        assert project.json() == before, file.name


def test_all_kinds_of_parts():
    project = palpa.box((40, 30, 20))
    top = palpa.patches("top")
    loads = [
        palpa.Pressure("press", top, 0.01),
        palpa.Traction("shear", top, (0.01, 0.0, 0.0)),
        palpa.Force("pull", top, (0.0, 0.0, 1.0)),
        palpa.Moment("turn", top, (0.0, 0.0, 5.0)),
        palpa.Gravity("weight"),
        palpa.Bump("bump", (0.0, 0.0, 20.0), 5.0, 0.02),
    ]
    project.loads = loads
    assert list(project.loads) == loads
    supports = [
        palpa.Support("guide", palpa.patches("bottom"), "roller"),
        palpa.Support("paint", palpa.stroke([(20, 0, 5), (20, 0, 8)], 2) | palpa.stroke((20, 9, 5), 1)),
        palpa.Support("low", palpa.below((0, 0, 1), 3) - palpa.patches("bottom"), displacement=(0.0, 0.0, 0.1)),
    ]
    project.supports = supports
    assert list(project.supports) == supports
    touches = [
        palpa.Touch("grab", (0.0, 0.0, 20.0), displace=(0.0, 0.0, -1.0), kind="grab"),
        palpa.Touch("ball", (9.0, 0.0, 20.0), displace=(0.0, 0.0, -1.0), kind="ball", radius=4.0, friction=0.3),
        palpa.Touch("pull", (-9.0, 0.0, 20.0), force=(0.0, 0.0, 0.2), kind="force"),
    ]
    project.touches = touches
    assert list(project.touches) == touches
    mesh = palpa.Mesh(4.0, "triangles", refinement_levels=1, refine_at=("sharp_edges",), patch_factors={"top": 0.5})
    project.mesh = mesh
    assert project.mesh == mesh
    project.remove(loads[0], touches[1])
    assert [each.name for each in project.loads] == ["shear", "pull", "turn", "weight", "bump"]
    assert [each.name for each in project.touches] == ["grab", "pull"]
    project.add(loads[0])
    assert project.loads[-1] == loads[0]


def test_materials_of_the_library():
    project = palpa.sphere()
    name, material = next(iter(palpa.materials().items()))
    project.material = name
    assert project.material == material
    with pytest.raises(palpa.InputError, match="the library has no 'unobtainium'"):
        project.material = "unobtainium"


def test_moving_control_points_is_an_edit():
    project = palpa.sphere(25)
    before = np.array(project.control_points)
    project.control_points[12] += (0, 0, 1.5)
    after = np.array(project.control_points)
    assert after[12].tolist() == (before[12] + (0, 0, 1.5)).tolist()
    assert project.is_modified and "Move" in project.undo_label
    assert project.undo() and np.array_equal(project.control_points, before)
    assert project.redo() and np.array_equal(project.control_points, after)
    assert not project.redo()


def test_control_points_behave_as_an_array():
    project = palpa.box((40, 30, 20))
    points = project.control_points
    assert points.shape == (len(points), 3)
    assert (points - points.__array__() == 0).all() and np.max(points, axis=0)[2] == pytest.approx(20)
    project.control_points[:, 2] *= 1.5
    assert project.volume == pytest.approx(1.5 * 24000)
    project.control_points *= (2, 1, 1)
    assert project.volume == pytest.approx(3 * 24000)
    with pytest.raises(IndexError):
        project.control_points[len(points)] = (0, 0, 0)
    with pytest.raises(palpa.InputError):
        project.control_points[0] = (np.nan, 0, 0)


def test_commands_and_groups():
    project = palpa.box()
    before = project.json()
    project.perform(
        {"command": "rename_project", "name": "block"},
        {"command": "scale_points", "points": {"patches": ["top"]}, "factors": [0.5, 0.5, 1]},
        label="Taper",
    )
    assert project.name == "block" and project.undo_label == "Taper"
    project.undo()
    assert project.json() == before
    with pytest.raises(palpa.InputError, match=r"commands\[1\]|no patch"):
        project.perform(
            {"command": "rename_project", "name": "x"},
            {"command": "rename_patch", "patch": "no", "name": "y"},
        )
    assert project.json() == before, "a failing list has no effect"
    with pytest.raises(KeyError):
        with project.group("Two edits"):
            project.name = "first"
            raise KeyError("second")
    assert project.json() == before, "an exception undoes the group"
    with project.group("Two edits"):
        project.name = "first"
        project.material = project.material.replace(youngs_modulus=0.3)
    assert project.undo_label == "Two edits"
    project.undo()
    assert project.json() == before


def test_cad_and_mesh_files(cli, tmp_path):
    block = palpa.box((40, 30, 20))
    for ending in (".step", ".iges", ".brep", ".stl", ".obj", ".ply"):
        block.export(tmp_path / f"block{ending}")
    step = palpa.read_step(tmp_path / "block.step")
    assert step.is_solid and step.volume == pytest.approx(24000)
    assert any("Held on" in note for note in step.notes)
    inches = palpa.read_mesh(tmp_path / "block.stl", unit="in", up="y")
    assert not inches.is_solid and inches.volume == pytest.approx(24000 * 25.4**3)
    assert inches.vertices.shape[1] == 3
    assert palpa.open(tmp_path / "block.ply").volume == pytest.approx(24000)
    # Imported in the same way as by the command line.
    cli("import", tmp_path / "block.step", "-o", tmp_path / "imported.json")
    assert step.json() == pathlib.Path(tmp_path / "imported.json").read_text()


def test_errors_have_the_messages_of_the_command_line(failing_cli, tmp_path):
    broken = tmp_path / "broken.json"
    broken.write_text('{"format": "palpa-project", "version": 3, "name": 5}')
    with pytest.raises(palpa.InputError) as caught:
        palpa.open(broken)
    assert str(caught.value) == failing_cli("solve", broken)
    assert isinstance(caught.value, palpa.Error) and isinstance(caught.value, ValueError)
    free = palpa.sphere()
    free.supports = []
    free.save(tmp_path / "free.json")
    with pytest.raises(palpa.SolveError) as caught:
        free.build()
    assert str(caught.value) == failing_cli("solve", tmp_path / "free.json")
    with pytest.raises(palpa.InputError) as caught:
        palpa.open(tmp_path / "none.json")
    assert str(caught.value) == failing_cli("solve", tmp_path / "none.json")


def test_wrong_arguments_are_refused(tmp_path):
    for action, message in [
        (lambda: palpa.sphere(-1), "radius"),
        (lambda: palpa.box((1, 2)), "size: expected"),
        (lambda: palpa.torus(5, 9), "minor radius"),
        (lambda: palpa.sphere().build(engine="glue"), "engine: expected"),
        (lambda: palpa.sphere().build(edge_length=-1), "edge_length"),
        (lambda: palpa.sphere().build(0.01, element_length=2), "either accuracy"),
        (lambda: palpa.read_mesh(tmp_path / "a.stl", unit="ell"), "unit: expected"),
        (lambda: palpa.read_mesh(tmp_path / "a.stl", up="w"), "up: expected"),
        (lambda: palpa.sphere().save(), "no file yet"),
        (lambda: palpa.sphere().export(tmp_path / "a.json"), "use save"),
        (lambda: palpa.sphere().perform({"command": "fly"}), "fly"),
        (lambda: palpa.sphere().perform({"command": "rename_project", "name": object()}), "no JSON form"),
        (lambda: palpa.sphere().add(palpa.Touch("t", (0.0, 0.0, 25.0))), "needs displace"),
        (lambda: palpa.sphere().vertices, "is a solid"),
    ]:
        with pytest.raises(palpa.InputError, match=message):
            action()
