#pragma once

#include <memory>
#include <mutex>

namespace palpa {

/// A part of an immutable object that is made when it is first asked for, from any thread.
template <class Part>
class Lazy {
 public:
  /// The part; the first call makes it from the arguments. When that throws, the next call tries
  /// again.
  template <class... Arguments>
  const Part& get(const Arguments&... arguments) const {
    std::call_once(flag_, [&] { part_ = std::make_unique<Part>(arguments...); });
    return *part_;
  }

 private:
  mutable std::once_flag flag_;
  mutable std::unique_ptr<const Part> part_;
};

}  // namespace palpa
