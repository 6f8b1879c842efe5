#pragma once

#include <string>

#include "base/error.h"

namespace palpa::modeling {

/// A bad file, an impossible solid, or a mesh that would not fit into memory. The message names the
/// place as a path in the project file where there is one. Callers tell the cases apart by kind(),
/// never by the text of the message.
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
