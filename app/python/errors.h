#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <utility>

namespace palpa::python {

/// Adds the exception types Error, InputError, SolveError and Cancelled to the module, and
/// translates the errors of the libraries into them. The messages equal the ones of palpa-cli; the
/// kinds correspond to its exit codes 3, 4 and 5.
void registerErrors(pybind11::module_& module);

/// Error of an argument, raised as InputError.
class ArgumentError : public std::exception {
 public:
  explicit ArgumentError(std::string message) : message_(std::move(message)) {}
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

}  // namespace palpa::python
