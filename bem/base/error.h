#pragma once

#include <string>

#include "base/error.h"

namespace palpa::bem {

/// Error of a problem that cannot be solved as given. Callers distinguish the cases by kind(),
/// never by the text of the message.
class SolverError : public Error {
 public:
  enum class Kind {
    kBadMesh,         ///< open, degenerate or badly oriented surface
    kBadMaterial,     ///< constants outside the range of linear elasticity
    kBadCondition,    ///< contradicting or useless boundary data
    kNotFixed,        ///< the supports leave a rigid motion free
    kIncompressible,  ///< nu = 0.5 with the displacement prescribed everywhere
    kTooLarge,        ///< the memory estimate exceeds the limit
    kSingular,        ///< the factorisation broke down
    kNotConverged     ///< contacts found no equilibrium
  };
  SolverError(Kind errorKind, const std::string& message) : Error(message), kind_(errorKind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

}  // namespace palpa::bem
