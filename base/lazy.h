#pragma once

#include <memory>
#include <mutex>

namespace palpa {

/// Part of an immutable object that is computed on first use, from any thread.
template <class Part>
class Lazy {
 public:
  /// The part; the first call constructs it from the arguments. If that throws, the next call tries
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
