#include "app/python/state.h"

#include <pybind11/stl.h>

#include <algorithm>

#include "app/core/live/touch_table.h"
#include "app/core/results/field_sample.h"
#include "app/python/run_work.h"
#include "base/parallel.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_writer.h"

namespace palpa::python {
namespace {

namespace py = pybind11;

py::dict toDict(const std::string& name, const bem::Resultant& resultant) {
  py::dict dict;
  dict["name"] = name;
  dict["force"] = arrayOf(resultant.force);
  dict["moment"] = arrayOf(resultant.moment);
  return dict;
}

py::dict toDict(const app::TouchState::Contact& contact) {
  py::dict dict;
  dict["name"] = contact.name;
  dict["kind"] = contact.kind ? modeling::infoOf(*contact.kind).name : "node";
  dict["status"] = app::nameOf(contact.status);
  dict["at"] = arrayOf(contact.at);
  dict["normal"] = arrayOf(contact.normal);
  dict["radius"] = contact.radius;
  dict["friction"] = contact.friction;
  dict["force"] = arrayOf(contact.force);
  dict["normal_force"] = contact.normalForce();
  dict["tangential_force"] = contact.tangentialForce().norm();
  dict["displacement"] = arrayOf(contact.displacement);
  dict["deflection"] = arrayOf(contact.deflection);
  dict["stiffness"] = contact.stiffness;
  dict["patch_radius"] = contact.patchRadius();
  return dict;
}

}  // namespace

py::list State::contacts() const {
  py::list list;
  for (const auto& contact : state_.contacts) list.append(toDict(contact));
  return list;
}

py::list State::supports() const {
  py::list list;
  for (const auto& support : state_.supports) list.append(toDict(support.name, support.resultant));
  return list;
}

py::list State::loads() const {
  py::list list;
  for (const auto& load : model_->model().setup().loads)
    list.append(toDict(load.name, load.resultant));
  return list;
}

py::dict State::numbers() const {
  py::dict dict;
  dict["energy"] = state_.energy;
  dict["balance"] = state_.balance;
  dict["relative_balance"] = state_.relativeBalance;
  return dict;
}

py::tuple State::errors() {
  // Only the errors are kept: other Python threads may read the state meanwhile.
  if (!errors_)
    errors_ = computed<Errors>(py::none(), 0, [this](const Job& job) {
      app::TouchState copy = state_;
      app::addErrors(model_->model(), copy, job);
      Errors errors{copy.errorEstimate.value_or(0), copy.forceErrorEstimate.value_or(0), {}};
      for (const auto& contact : copy.contacts)
        errors.contacts.push_back(contact.errorEstimate.value_or(0));
      return errors;
    });
  return py::make_tuple(errors_->largest, errors_->forces, errors_->contacts);
}

py::array_t<double> State::displacements() const {
  const Eigen::MatrixXd u = model_->model().setup().discretisation->valuesOnMesh(state_.field).u;
  return py::array_t<double>({u.rows() / 3, Eigen::Index{3}}, u.data());
}

py::array_t<double> State::tractions() const {
  const app::BoundarySetup& setup = model_->model().setup();
  const Eigen::MatrixXd p = setup.discretisation->valuesOnMesh(state_.field).p;
  const auto& corners = setup.meshSlots().ofCorner;
  py::array_t<double> array(
      {static_cast<py::ssize_t>(corners.size()), py::ssize_t{3}, py::ssize_t{3}});
  double* out = array.mutable_data();
  for (const auto& slots : corners)
    for (const int slot : slots) out = std::copy_n(p.col(0).data() + 3 * slot, 3, out);
  return array;
}

py::array_t<double> State::stresses() const {
  const app::BoundarySetup& setup = model_->model().setup();
  const std::vector<Eigen::Matrix3d> stress = setup.discretisation->surfaceStress(
      state_.field.u.col(0), state_.field.p.col(0), setup.material);
  const auto& corners = setup.meshSlots().ofCorner;
  py::array_t<double> array(
      {static_cast<py::ssize_t>(corners.size()), py::ssize_t{3}, py::ssize_t{3}, py::ssize_t{3}});
  double* out = array.mutable_data();
  for (const auto& slots : corners)
    for (const int slot : slots)
      out = std::copy_n(stress[static_cast<std::size_t>(slot)].data(), 9, out);
  return array;
}

py::tuple State::sample(const Numbers& points) const {
  const std::vector<Eigen::Vector3d> places = vectorsOf(points, "points");
  std::vector<Eigen::Vector3d> nearest, displacements, tractions;
  runWork(py::none(), 0, [&](const Job& job) {
    for (const Eigen::Vector3d& place : places) {
      job.throwIfCancelled();
      const app::FieldSample sample = app::sampleField(model_->model(), state_, place);
      nearest.push_back(sample.nearestSurface);
      displacements.push_back(sample.displacement);
      tractions.push_back(sample.traction);
    }
  });
  return py::make_tuple(rowsOf(nearest), rowsOf(displacements), rowsOf(tractions));
}

py::tuple State::inside(const Numbers& points) const {
  const std::vector<Eigen::Vector3d> places = vectorsOf(points, "points");
  std::vector<bem::InteriorState> states(places.size());
  runWork(py::none(), 0, [&](const Job& job) {
    const app::BoundarySetup& setup = model_->model().setup();
    const Eigen::VectorXd u = state_.field.u.col(0), p = state_.field.p.col(0);
    parallelFor(static_cast<std::ptrdiff_t>(places.size()), job, [&](std::ptrdiff_t k) {
      const auto index = static_cast<std::size_t>(k);
      const auto found = setup.discretisation->interiorState(u, p, setup.bulk(), places[index]);
      if (!found)
        throw ArgumentError("points: the point " + std::to_string(k) +
                            " is not inside the body; use sample() on the surface");
      states[index] = *found;
    });
  });
  const auto count = static_cast<py::ssize_t>(states.size());
  py::array_t<double> displacements({count, py::ssize_t{3}});
  py::array_t<double> stresses({count, py::ssize_t{3}, py::ssize_t{3}});
  double* u = displacements.mutable_data();
  double* stress = stresses.mutable_data();
  for (const bem::InteriorState& state : states) {
    u = std::copy_n(state.displacement.data(), 3, u);
    stress = std::copy_n(state.stress.data(), 9, stress);
  }
  return py::make_tuple(displacements, stresses);
}

void State::save(const std::string& path) const {
  const modeling::FileFormat format = modeling::requireFormat(path, modeling::isWritableMesh);
  const app::BoundarySetup& setup = model_->model().setup();
  const bem::BoundaryField onMesh = setup.discretisation->valuesOnMesh(state_.field);
  modeling::MeshFile file{setup.mesh().nodes, setup.mesh().triangles, {}, {}};
  const auto u = onMesh.u.col(0);
  if (format == modeling::FileFormat::kVtp) {
    file.pointData.push_back({"displacement_mm", 3, {u.begin(), u.end()}});
    modeling::MeshData traction{"traction_MPa", 3, {}};
    for (const auto& slots : setup.meshSlots().ofCorner) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const int slot : slots) mean += onMesh.p.col(0).segment<3>(3 * slot) / 3;
      traction.values.insert(traction.values.end(), mean.begin(), mean.end());
    }
    file.triangleData.push_back(std::move(traction));
  } else {
    for (int node = 0; node < setup.mesh().nodeCount(); ++node)
      file.positions[static_cast<std::size_t>(node)] += u.segment<3>(3 * node);
  }
  modeling::writeMesh(file, path);
}

void bindState(py::module_& module) {
  py::class_<State>(module, "State")
      .def("contacts", &State::contacts)
      .def("supports", &State::supports)
      .def("loads", &State::loads)
      .def("numbers", &State::numbers)
      .def("errors", &State::errors)
      .def("displacements", &State::displacements)
      .def("tractions", &State::tractions)
      .def("stresses", &State::stresses)
      .def("sample", &State::sample, py::arg("points"))
      .def("inside", &State::inside, py::arg("points"))
      .def("save", &State::save, py::arg("path"));
}

}  // namespace palpa::python
