// palpa._core: the part of the Python package that is compiled. The classes that users see are in
// app/python/palpa/*.py.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "app/python/errors.h"
#include "app/python/model.h"
#include "app/python/project.h"
#include "modeling/project/material_library.h"

namespace {

namespace py = pybind11;

/// The materials of the library, as in resources/materials.json.
py::list libraryMaterials() {
  py::list list;
  for (const auto& [material, note, reference] : palpa::modeling::materialLibrary()) {
    py::dict dict;
    dict["name"] = material.name;
    dict["youngs_modulus"] = material.youngsModulus;
    dict["poisson_ratio"] = material.poissonRatio;
    dict["density"] = material.densityKgPerM3 ? py::object(py::float_(*material.densityKgPerM3))
                                              : py::object(py::none());
    list.append(dict);
  }
  return list;
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.attr("version") = PALPA_VERSION;
  palpa::python::registerErrors(module);
  palpa::python::bindModel(module);
  palpa::python::bindProject(module);
  module.def("materials", &libraryMaterials);
}
