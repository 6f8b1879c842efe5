#pragma once

#include <stdexcept>

namespace palpa {

/// An error that input or environment causes: a bad file, an unsolvable problem, no memory. The
/// message says what is wrong, where, and what the user can do about it. The libraries throw
/// subclasses that tell the kinds apart (bem::SolverError, modeling::ModelingError).
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace palpa
