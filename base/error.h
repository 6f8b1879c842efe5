#pragma once

#include <stdexcept>

namespace palpa {

/// Error caused by input or environment: a bad file, an unsolvable problem, too little memory. The
/// message names the place, the problem and the remedy. The libraries throw subclasses that
/// distinguish kinds (bem::SolverError, modeling::ModelingError).
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace palpa
