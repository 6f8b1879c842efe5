#pragma once
#include <stdexcept>
#include <string>

namespace palpa::bem {

/// The world's fault, not the caller's: a problem that cannot be solved as given. The message names
/// what is wrong, where, and what the user can do about it.
class SolverError : public std::runtime_error {
 public:
  enum class Kind {
    kBadMesh,         ///< open, degenerate or badly oriented surface
    kBadMaterial,     ///< constants outside the range of linear elasticity
    kBadCondition,    ///< contradicting or useless boundary data
    kNotHeld,         ///< a rigid motion is left free
    kIncompressible,  ///< nu = 0.5 with the displacement prescribed everywhere
    kTooLarge,        ///< the memory estimate exceeds the limit
    kSingular,        ///< the factorisation broke down
    kNotConverged     ///< contacts found no equilibrium
  };
  SolverError(Kind errorKind, const std::string& message)
      : std::runtime_error(message), kind_(errorKind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// Thrown by a long operation whose stop token was triggered. Deliberately not a std::exception:
/// cancelling is a result the caller asked for, and no handler of errors should swallow it.
struct Cancelled {};

}  // namespace palpa::bem
