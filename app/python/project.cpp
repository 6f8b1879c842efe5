#include "app/python/project.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "app/core/model/build_touch_model.h"
#include "app/core/session/import_project.h"
#include "app/core/session/new_project.h"
#include "app/python/run_work.h"
#include "modeling/editing/command_file.h"
#include "modeling/error.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_writer.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::python {
namespace {

namespace py = pybind11;

modeling::Engine engineNamed(const std::string& name) {
  if (name == "splines") return modeling::Engine::kSplines;
  if (name == "triangles") return modeling::Engine::kTriangles;
  if (name == "quadratic") return modeling::Engine::kQuadratic;
  if (name == "automatic") return modeling::Engine::kAutomatic;
  throw ArgumentError("engine: expected splines, quadratic, triangles or automatic, found '" +
                      name + "'");
}

modeling::ImportPlacement placementOf(const Project::Import& from) {
  modeling::ImportPlacement placement;
  if (!from.unit.empty()) {
    const auto& units = modeling::kLengthUnits;
    const auto* const found = std::find_if(
        units.begin(), units.end(), [&](const auto& each) { return from.unit == each.name; });
    if (found == units.end())
      throw ArgumentError("unit: expected " + modeling::lengthUnitsText() + ", found '" +
                          from.unit + "'");
    placement.unit = found->mm;
  }
  const auto& axes = modeling::kUpAxisNames;
  const auto* const axis = std::find(axes.begin(), axes.end(), from.up);
  if (axis == axes.end())
    throw ArgumentError("up: expected x, -x, y, -y, z or -z, found '" + from.up + "'");
  placement.up = static_cast<modeling::UpAxis>(axis - axes.begin());
  placement.scale = from.scale;
  return placement;
}

/// The mesh of the body, or the triangles of a mesh body as they are.
void writeMeshOf(const modeling::Project& project, const std::string& path, const Job& job) {
  if (const auto* body = std::get_if<modeling::MeshBody>(&project.body)) {
    modeling::writeMesh({body->positions(), body->triangles(), {}, {}}, path);
    return;
  }
  const auto regions = modeling::meshRegions(project);
  const modeling::SurfaceMesh mesh =
      modeling::mesh(project.body, project.mesh, regions, job, modeling::meshFoci(project));
  modeling::writeMesh({mesh.positions, mesh.triangles, {}, {}}, path);
}

}  // namespace

std::unique_ptr<Project> Project::read(const std::string& path) {
  return std::make_unique<Project>(modeling::readProject(path));
}

std::unique_ptr<Project> Project::make(const std::string& command, const std::string& name) {
  const std::vector<modeling::Command> commands = modeling::parseCommands(command, name);
  const modeling::Primitive& primitive =
      std::get<modeling::MakePrimitive>(commands.front()).primitive;
  modeling::Project project = app::makeProject(primitive, modeling::makePrimitive(primitive), name);
  modeling::checkProject(project);
  return std::make_unique<Project>(std::move(project));
}

py::tuple Project::import(const Import& from, const py::object& progress) {
  modeling::ImportOptions options;
  options.edgeLength = from.edgeLength;
  options.tolerance = from.tolerance;
  options.solid = from.solid;
  options.placement = placementOf(from);
  app::ImportedProject imported = computed<app::ImportedProject>(
      progress, 0, [&](const Job& job) { return app::importProject(from.path, options, job); });
  return py::make_tuple(std::make_unique<Project>(std::move(imported.project)), imported.notes,
                        imported.deviation, imported.held.description());
}

std::string Project::json() const {
  return modeling::toJson(project());
}

std::string Project::partsJson() const {
  modeling::Project parts = project();
  parts.body = modeling::makePrimitive({modeling::BoxShape{}, 1, 0});
  return modeling::toJson(parts);
}

double Project::perform(const std::string& commands, const std::string& label) {
  const std::vector<modeling::Command> parsed = modeling::parseCommands(commands, "perform");
  if (parsed.size() == 1) return document_.perform(parsed.front()).deviation;
  document_.beginGroup(label);
  double deviation = 0;
  try {
    for (const modeling::Command& command : parsed)
      deviation = std::max(deviation, document_.perform(command).deviation);
  } catch (...) {
    document_.cancelGroup();
    throw;
  }
  document_.endGroup();
  return deviation;
}

void Project::movePoints(const std::vector<int>& indices, const Numbers& positions) {
  document_.perform(modeling::MovePoints{modeling::PointSelection::of(indices),
                                         modeling::MoveTo{vectorsOf(positions, "positions")},
                                         {}});
}

bool Project::undo() {
  if (!document_.canUndo()) return false;
  document_.undo();
  return true;
}

bool Project::redo() {
  if (!document_.canRedo()) return false;
  document_.redo();
  return true;
}

void Project::save(const std::string& path) {
  modeling::writeProject(project(), path);
  document_.markSaved();
}

void Project::exportTo(const std::string& path, const py::object& progress) const {
  const modeling::FileKind kind = infoOf(modeling::requireFormat(path, modeling::isWritable)).kind;
  if (kind == modeling::FileKind::kProject)
    throw ArgumentError("export: " + path + " is the name of a project; use save()");
  const modeling::Project copy = project();
  runWork(progress, 0, [&](const Job& job) {
    if (kind == modeling::FileKind::kCad)
      modeling::exportCad(copy.body, path, copy.name, job);
    else
      writeMeshOf(copy, path, job);
  });
}

py::array_t<double> Project::points() const {
  if (const auto* solid = std::get_if<modeling::Solid>(&project().body))
    return rowsOf(solid->controlPoints());
  return rowsOf(std::get<modeling::MeshBody>(project().body).positions());
}

bool Project::isSolid() const {
  return std::holds_alternative<modeling::Solid>(project().body);
}

std::vector<std::string> Project::patches() const {
  return modeling::patchNames(project().body);
}

double Project::volume() const {
  return modeling::volume(project().body);
}

double Project::area() const {
  return modeling::area(project().body);
}

std::shared_ptr<Model> Project::build(const Build& options, const py::object& progress) {
  modeling::Project copy = project();
  if (options.accuracy && options.elementLength)
    throw ArgumentError("build: give either accuracy or element_length");
  if (options.engine) copy.mesh.engine = engineNamed(*options.engine);
  if (options.edgeLength) copy.mesh.edgeLength = *options.edgeLength;
  if (options.accuracy) {
    copy.mesh.accuracy = *options.accuracy;
    copy.mesh.splineDensity = 1;
    copy.mesh.elementLength.reset();
  }
  if (options.elementLength) copy.mesh.elementLength = options.elementLength;
  modeling::checkProject(copy);
  const std::shared_ptr<const app::TouchModel> former = last_.lock();
  auto model = computed<std::shared_ptr<const app::TouchModel>>(
      progress, options.threads,
      [&](const Job& job) { return app::buildTouchModel(copy, {}, job, former.get()); });
  last_ = model;
  return std::make_shared<Model>(std::move(copy), std::move(model));
}

void bindProject(py::module_& module) {
  py::class_<Project>(module, "Project")
      .def_static("read", &Project::read, py::arg("path"))
      .def_static("make", &Project::make, py::arg("command"), py::arg("name"))
      .def_static(
          "import_file",
          [](const std::string& path, const std::string& solid, const std::string& unit,
             const std::string& up, double scale, double edgeLength, double tolerance,
             const py::object& progress) {
            return Project::import({path, solid, unit, up, edgeLength, tolerance, scale}, progress);
          },
          py::arg("path"), py::arg("solid"), py::arg("unit"), py::arg("up"), py::arg("scale"),
          py::arg("edge_length"), py::arg("tolerance"), py::arg("progress"))
      .def("json", &Project::json)
      .def("parts_json", &Project::partsJson)
      .def("perform", &Project::perform, py::arg("commands"), py::arg("label"))
      .def("move_points", &Project::movePoints, py::arg("indices"), py::arg("positions"))
      .def("begin_group", &Project::beginGroup, py::arg("label"))
      .def("end_group", &Project::endGroup)
      .def("cancel_group", &Project::cancelGroup)
      .def("undo", &Project::undo)
      .def("redo", &Project::redo)
      .def("undo_label", &Project::undoLabel)
      .def("redo_label", &Project::redoLabel)
      .def("is_modified", &Project::isModified)
      .def("save", &Project::save, py::arg("path"))
      .def("export", &Project::exportTo, py::arg("path"), py::arg("progress"))
      .def("points", &Project::points)
      .def("is_solid", &Project::isSolid)
      .def("patches", &Project::patches)
      .def("volume", &Project::volume)
      .def("area", &Project::area)
      .def(
          "build",
          [](Project& self, std::optional<double> accuracy, std::optional<double> edgeLength,
             std::optional<double> elementLength, std::optional<std::string> engine, int threads,
             const py::object& progress) {
            return self.build({accuracy, edgeLength, elementLength, std::move(engine), threads},
                              progress);
          },
          py::arg("accuracy"), py::arg("edge_length"), py::arg("element_length"), py::arg("engine"),
          py::arg("threads"), py::arg("progress"));
}

}  // namespace palpa::python
