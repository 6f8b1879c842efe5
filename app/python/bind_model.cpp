#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/core/live/touch_table.h"
#include "app/core/results/mask_compliance.h"
#include "app/core/results/touch_sweep.h"
#include "app/python/model.h"
#include "app/python/run_work.h"
#include "app/python/state.h"

namespace palpa::python {
namespace {

namespace py = pybind11;

/// A touch as the Python layer gives it: name, place, kind, vector, radius or None, friction.
using TouchTuple =
    std::tuple<std::string, Numbers, std::string, Numbers, std::optional<double>, double>;

modeling::TouchKind kindNamed(const std::string& name) {
  if (const auto kind = modeling::touchKindNamed(name)) return *kind;
  throw ArgumentError("kind: expected grab, force, push, ball or pin, found '" + name + "'");
}

/// Checks the touches as in a project file: `touches[0].radius_mm: …`.
void checkTouches(const modeling::Project& project, std::vector<modeling::Touch> touches) {
  modeling::Project checked = project;
  checked.touches = std::move(touches);
  modeling::checkProject(checked);
}

std::vector<modeling::Touch> touchesOf(const Model& model, const std::vector<TouchTuple>& given) {
  std::vector<modeling::Touch> touches;
  for (const auto& [name, at, kind, vector, radius, friction] : given)
    touches.push_back({name, vectorOf(at, "at"), kindNamed(kind), vectorOf(vector, "displace"),
                       radius, friction});
  checkTouches(model.project(), touches);
  return touches;
}

std::unique_ptr<State> play(const std::shared_ptr<Model>& model,
                            const std::vector<TouchTuple>& given, int steps,
                            const py::object& progress, int threads) {
  const std::vector<modeling::Touch> touches = touchesOf(*model, given);
  return std::make_unique<State>(model,
                                 computed<app::TouchState>(progress, threads, [&](const Job& job) {
                                   return model->play(touches, steps, job);
                                 }));
}

/// Force-depth curves of touches: (shares, forces, displacements, stiffness, energies).
py::tuple sweep(const std::shared_ptr<Model>& model, const std::vector<TouchTuple>& given,
                int count, int steps, const py::object& progress, int threads) {
  const std::vector<modeling::Touch> touches = touchesOf(*model, given);
  std::vector<app::SweepRow> rows;
  runWork(progress, threads, [&](const Job& job) {
    app::sweepTouches(model->model(), touches, count, steps, job,
                      [&rows](app::SweepRow row) { rows.push_back(std::move(row)); });
  });
  const auto states = static_cast<py::ssize_t>(rows.size());
  const auto contacts = static_cast<py::ssize_t>(touches.size());
  py::array_t<double> shares(states), energies(states);
  py::array_t<double> forces({states, contacts, py::ssize_t{3}});
  py::array_t<double> displacements({states, contacts, py::ssize_t{3}});
  py::array_t<double> stiffness({states, contacts});
  for (py::ssize_t i = 0; i < states; ++i) {
    const app::SweepRow& row = rows[static_cast<std::size_t>(i)];
    shares.mutable_at(i) = row.share;
    energies.mutable_at(i) = row.energy;
    for (py::ssize_t k = 0; k < contacts; ++k) {
      const app::TouchState::Contact& contact = row.contacts[static_cast<std::size_t>(k)];
      for (int axis = 0; axis < 3; ++axis) {
        forces.mutable_at(i, k, axis) = contact.force[axis];
        displacements.mutable_at(i, k, axis) = contact.displacement[axis];
      }
      stiffness.mutable_at(i, k) = contact.stiffness;
    }
  }
  return py::make_tuple(shares, forces, displacements, stiffness, energies);
}

/// Results of touches one at a time.
struct Batch {
  std::shared_ptr<Model> model;
  app::TouchBatch results;
};

void requireFinite(const Numbers& numbers, const char* name) {
  for (py::ssize_t k = 0; k < numbers.size(); ++k)
    if (!std::isfinite(numbers.data()[k]))
      throw ArgumentError(std::string(name) + ": row " + std::to_string(k / 3) +
                          " has a number that is not finite");
}

std::unique_ptr<Batch> touchMany(const std::shared_ptr<Model>& model, const Numbers& at,
                                 const Numbers& vectors, const std::string& kind,
                                 std::optional<double> radius, double friction, int steps,
                                 const py::object& progress, int threads) {
  const std::vector<Eigen::Vector3d> places = vectorsOf(at, "at");
  const std::vector<Eigen::Vector3d> values = vectorsOf(vectors, "displace");
  if (places.size() != values.size())
    throw ArgumentError("displace: there are " + std::to_string(values.size()) + " vectors for " +
                        std::to_string(places.size()) + " places; give one for each place");
  requireFinite(at, "at");
  requireFinite(vectors, "displace");
  std::vector<modeling::Touch> touches(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    touches[k] = {"touch", places[k], kindNamed(kind), values[k], radius, friction};
  if (!touches.empty()) checkTouches(model->project(), {touches.front()});
  return std::make_unique<Batch>(
      Batch{model, computed<app::TouchBatch>(progress, threads, [&](const Job& job) {
              return app::touchOneByOne(*model->touchable(), touches, steps, job);
            })});
}

py::list statusesOf(const Batch& batch) {
  py::list list;
  for (const auto status : batch.results.statuses) list.append(app::nameOf(status));
  return list;
}

py::array_t<double> compliance(const std::shared_ptr<Model>& model, const Numbers& points,
                               std::optional<double> radius, const py::object& progress,
                               int threads) {
  const std::vector<Eigen::Vector3d> places = vectorsOf(points, "points");
  requireFinite(points, "points");
  if (radius && !(*radius > 0)) throw ArgumentError("radius: expected a length above 0 mm");
  return transposedOf(computed<Eigen::MatrixXd>(progress, threads, [&](const Job& job) {
    const auto touchable = model->touchable();
    return app::maskCompliance(
        *touchable, places,
        radius.value_or(app::defaultTouchRadius(touchable->model().setup().mesh())), job);
  }));
}

py::tuple gradient(const std::shared_ptr<Model>& model, const State& state, int contact,
                   const py::object& progress, int threads) {
  const auto& contacts = state.state().contacts;
  if (state.model() != model) throw ArgumentError("gradient: the touch belongs to another model");
  if (contact < 0 || contact >= static_cast<int>(contacts.size()))
    throw ArgumentError("gradient: there is no contact " + std::to_string(contact));
  const app::StiffnessGradient result =
      computed<app::StiffnessGradient>(progress, threads, [&](const Job& job) {
        return model->gradient(contacts[static_cast<std::size_t>(contact)], job);
      });
  return py::make_tuple(result.stiffness, rowsOf(result.gradient));
}

py::dict reportOf(const Model& model) {
  const app::BuildReport& build = model.model().report();
  const app::BoundarySetup& setup = model.model().setup();
  const char* engine = setup.engine == modeling::Engine::kSplines     ? "splines"
                       : setup.engine == modeling::Engine::kQuadratic ? "quadratic"
                                                                      : "triangles";
  py::dict dict;
  dict["engine"] = engine;
  dict["nodes"] = build.nodes;
  dict["triangles"] = build.triangles;
  dict["elements"] = setup.discretisation->elementCount();
  dict["coefficients"] = setup.discretisation->displacementCount();
  dict["memory_bytes"] = build.memory;
  dict["storage"] = build.storage;
  dict["notice"] = build.notice;
  py::dict seconds;
  seconds["mesh"] = build.meshSeconds;
  seconds["check"] = build.checkSeconds;
  seconds["assemble"] = build.assembleSeconds;
  seconds["factorise"] = build.factoriseSeconds;
  seconds["solve"] = build.solveSeconds;
  dict["seconds"] = seconds;
  return dict;
}

/// A sensor with the model whose fields it reads.
struct Sensor {
  std::shared_ptr<Model> model;
  std::shared_ptr<const app::SurfaceSensor> sensor;

  void require(const std::shared_ptr<Model>& other) const {
    if (other != model) throw ArgumentError("sensor: the touch belongs to another model");
  }
};

std::unique_ptr<Sensor> makeSensor(const std::shared_ptr<Model>& model, const Numbers& taxels) {
  const std::vector<Eigen::Vector3d> places = vectorsOf(taxels, "taxels");
  requireFinite(taxels, "taxels");
  auto sensor = computed<std::shared_ptr<const app::SurfaceSensor>>(py::none(), 0, [&](const Job&) {
    return std::make_shared<const app::SurfaceSensor>(model->touchable(), places);
  });
  return std::make_unique<Sensor>(Sensor{model, std::move(sensor)});
}

py::array_t<double> placesOf(const Sensor& sensor) {
  std::vector<Eigen::Vector3d> places;
  for (const bem::SurfacePoint& place : sensor.sensor->places()) places.push_back(place.position);
  return rowsOf(places);
}

py::array_t<double> markersOf(const Sensor& sensor, const Batch& batch, const py::object& progress,
                              int threads) {
  sensor.require(batch.model);
  const Eigen::MatrixXd columns = computed<Eigen::MatrixXd>(progress, threads, [&](const Job& job) {
    return sensor.sensor->displacements(batch.results, job);
  });
  return py::array_t<double>({columns.cols(), columns.rows() / 3, Eigen::Index{3}}, columns.data());
}

py::array_t<double> pressuresOf(const Sensor& sensor, const Batch& batch,
                                const py::object& progress, int threads) {
  sensor.require(batch.model);
  return transposedOf(computed<Eigen::MatrixXd>(progress, threads, [&](const Job& job) {
    return sensor.sensor->pressures(batch.results, job);
  }));
}

py::array_t<int> trianglesOf(const Model& model) {
  const auto& triangles = model.model().setup().mesh().triangles;
  static_assert(sizeof(triangles.front()) == 3 * sizeof(int));
  return py::array_t<int>({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}},
                          triangles.front().data());
}

}  // namespace

void bindModel(py::module_& module) {
  bindState(module);
  py::class_<Batch>(module, "Batch")
      .def("places", [](const Batch& self) { return rowsOf(self.results.places); })
      .def("normals", [](const Batch& self) { return rowsOf(self.results.normals); })
      .def("forces", [](const Batch& self) { return rowsOf(self.results.forces); })
      .def("displacements", [](const Batch& self) { return rowsOf(self.results.displacements); })
      .def("deflections", [](const Batch& self) { return rowsOf(self.results.deflections); })
      .def("stiffness", [](const Batch& self) { return arrayOf(self.results.stiffness); })
      .def("statuses", &statusesOf);
  py::class_<Sensor>(module, "Sensor")
      .def("places", &placesOf)
      .def("normals", [](const Sensor& self) { return rowsOf(self.sensor->normals()); })
      .def(
          "displacements",
          [](const Sensor& self, const State& state) {
            self.require(state.model());
            return rowsOf(self.sensor->displacements(state.state().field));
          },
          py::arg("state"))
      .def(
          "pressures",
          [](const Sensor& self, const State& state) {
            self.require(state.model());
            return arrayOf(self.sensor->pressures(state.state().field));
          },
          py::arg("state"))
      .def("displacements_of_batch", &markersOf, py::arg("batch"), py::arg("progress"),
           py::arg("threads"))
      .def("pressures_of_batch", &pressuresOf, py::arg("batch"), py::arg("progress"),
           py::arg("threads"));
  py::class_<Model, std::shared_ptr<Model>>(module, "Model")
      .def("report", &reportOf)
      .def("nodes", [](const Model& self) { return rowsOf(self.model().setup().mesh().nodes); })
      .def("triangles", &trianglesOf)
      .def("default_radius",
           [](const Model& self) { return app::defaultTouchRadius(self.model().setup().mesh()); })
      .def("solve",
           [](const std::shared_ptr<Model>& self) {
             return std::make_unique<State>(self, self->model().rest());
           })
      .def("play", &play, py::arg("touches"), py::arg("steps"), py::arg("progress"),
           py::arg("threads"))
      .def("sweep", &sweep, py::arg("touches"), py::arg("count"), py::arg("steps"),
           py::arg("progress"), py::arg("threads"))
      .def("touch_many", &touchMany, py::arg("at"), py::arg("vectors"), py::arg("kind"),
           py::arg("radius"), py::arg("friction"), py::arg("steps"), py::arg("progress"),
           py::arg("threads"))
      .def("compliance", &compliance, py::arg("points"), py::arg("radius"), py::arg("progress"),
           py::arg("threads"))
      .def("gradient", &gradient, py::arg("state"), py::arg("contact"), py::arg("progress"),
           py::arg("threads"))
      .def("sensor", &makeSensor, py::arg("taxels"));
}

}  // namespace palpa::python
