#pragma once

#include <string>

#include "base/error.h"

namespace palpa::modeling {

/// Error of the library: a bad file, an impossible solid, or a mesh beyond the limits. The message
/// begins with the place, as a path in the project file if there is one. Callers distinguish the
/// cases by kind(), never by the text of the message.
class ModelingError : public Error {
 public:
  enum class Kind {
    kBadInput,  ///< a value or a file's content breaks a rule
    kNotFound,  ///< a file or a named thing does not exist
    kIo,        ///< reading or writing failed
    kTooLarge,  ///< the request exceeds a stated limit
  };

  explicit ModelingError(const std::string& message, Kind kind = Kind::kBadInput)
      : Error(message), kind_(kind) {}

  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace palpa::modeling
