#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/core/results/error_estimate.h"
#include "app/python/model.h"

namespace palpa::python {

/// A solution of a model, with or without touches.
class State {
 public:
  State(std::shared_ptr<Model> model, app::TouchState state)
      : model_(std::move(model)), state_(std::move(state)) {}

  const std::shared_ptr<Model>& model() const { return model_; }
  const app::TouchState& state() const { return state_; }

  pybind11::list contacts() const;
  pybind11::list supports() const;
  pybind11::list loads() const;
  pybind11::dict numbers() const;

  /// (largest relative error, error of forces, errors of the contacts), computed when first asked
  /// for.
  pybind11::tuple errors();

  /// At the nodes of the mesh, mm: (n, 3).
  pybind11::array_t<double> displacements() const;
  /// At the corners of the triangles, MPa: (t, 3, 3).
  pybind11::array_t<double> tractions() const;
  /// Cauchy's stress at the corners of the triangles, MPa: (t, 3, 3, 3).
  pybind11::array_t<double> stresses() const;
  /// (places on the surface, displacements, tractions) for points, one row each.
  pybind11::tuple sample(const Numbers& points) const;
  /// (displacements in mm, Cauchy's stresses in MPa) at points inside the body, one row each.
  pybind11::tuple inside(const Numbers& points) const;
  /// The deformed mesh, or the mesh with its fields, depending on the file's ending.
  void save(const std::string& path) const;

 private:
  struct Errors {
    double largest = 0, forces = 0;
    std::vector<double> contacts;
  };
  const std::shared_ptr<Model> model_;
  const app::TouchState state_;
  std::optional<Errors> errors_;  // only with the interpreter's lock
};

/// Adds the class to the module.
void bindState(pybind11::module_& module);

}  // namespace palpa::python
