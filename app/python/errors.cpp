#include "app/python/errors.h"

#include <exception>
#include <new>
#include <string>

#include "base/atomic_file.h"
#include "base/job.h"
#include "bem/base/error.h"
#include "modeling/error.h"
#include "modeling/exchange/file_bodies.h"

namespace palpa::python {
namespace {

namespace py = pybind11;

/// The exception types, which live as long as the interpreter.
struct Types {
  PyObject* error = nullptr;
  PyObject* input = nullptr;
  PyObject* solve = nullptr;
  PyObject* cancelled = nullptr;
};
Types types;

PyObject* makeType(py::module_& module, const char* name, const char* documentation,
                   const py::tuple& bases) {
  PyObject* type = PyErr_NewExceptionWithDoc((std::string("palpa.") + name).c_str(), documentation,
                                             bases.ptr(), nullptr);
  if (!type) throw py::error_already_set();
  module.attr(name) = py::handle(type);
  return type;
}

bool cannotBeSolved(bem::SolverError::Kind kind) {
  using Kind = bem::SolverError::Kind;
  switch (kind) {
    case Kind::kBadMesh:
    case Kind::kBadMaterial:
    case Kind::kBadCondition:
      return false;
    case Kind::kNotFixed:
    case Kind::kIncompressible:
    case Kind::kTooLarge:
    case Kind::kSingular:
    case Kind::kNotConverged:
      break;
  }
  return true;
}

void translate(std::exception_ptr failure) {
  const auto raise = [](PyObject* type, const std::string& message) {
    PyErr_SetString(type, message.c_str());
  };
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const Cancelled&) {
    raise(types.cancelled, "cancelled");
  } catch (const modeling::SeveralBodies& several) {
    raise(types.input, several.what() + std::string("; choose one with solid=N or solid=NAME"));
  } catch (const modeling::ModelingError& error) {
    raise(error.kind() == modeling::ModelingError::Kind::kTooLarge ? types.solve : types.input,
          error.what());
  } catch (const bem::SolverError& error) {
    raise(cannotBeSolved(error.kind()) ? types.solve : types.input, error.what());
  } catch (const FileError& error) {
    raise(types.input, error.what());
  } catch (const ArgumentError& error) {
    raise(types.input, error.what());
  } catch (const std::bad_alloc&) {
    raise(types.solve, "out of memory; a larger edge length needs less");
  }
}

}  // namespace

void registerErrors(py::module_& module) {
  const auto borrowed = [](PyObject* type) { return py::reinterpret_borrow<py::object>(type); };
  types.error = makeType(module, "Error", "Base class of all errors of Palpa.",
                         py::make_tuple(borrowed(PyExc_Exception)));
  const py::object base = borrowed(types.error);
  types.input = makeType(
      module, "InputError",
      "A file, a value or an argument is wrong; the message names the place, the problem and the "
      "remedy. Exit code 3 of palpa-cli.",
      py::make_tuple(base, borrowed(PyExc_ValueError)));
  types.solve = makeType(module, "SolveError",
                         "The input is valid but has no solution here: the body is free to move, "
                         "the model is too large, … Exit code 4 of palpa-cli.",
                         py::make_tuple(base, borrowed(PyExc_RuntimeError)));
  types.cancelled =
      makeType(module, "Cancelled", "A progress callback returned False, which stops the work.",
               py::make_tuple(base));
  py::register_exception_translator(&translate);
}

}  // namespace palpa::python
