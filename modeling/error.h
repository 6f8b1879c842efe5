#pragma once

#include <stdexcept>
#include <string>

namespace palpa::modeling {

/// The world's fault: a bad file, an impossible solid, a mesh that would not fit into memory. The
/// message names what is wrong, where (a path as in the project file) and, where known, what to do.
/// Callers tell the cases apart by kind(), never by the text.
class ModelingError : public std::runtime_error {
 public:
  enum class Kind {
    badInput,  ///< a value or a file's content breaks a rule
    notFound,  ///< a file or a named thing does not exist
    io,        ///< reading or writing failed
    tooLarge,  ///< the request exceeds a stated limit
  };

  explicit ModelingError(const std::string& message, Kind kind = Kind::badInput)
      : std::runtime_error(message), kind_(kind) {}

  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace palpa::modeling
