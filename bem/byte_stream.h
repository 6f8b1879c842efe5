#pragma once
#include <cstddef>
#include <functional>
#include <span>

namespace palpa::bem {

/// Takes the next bytes of something that is stored. May throw; that ends the writing.
using ByteSink = std::function<void(std::span<const std::byte>)>;

/// Fills the span with the next bytes of what was stored. Throws when there are not as many.
using ByteSource = std::function<void(std::span<std::byte>)>;

}  // namespace palpa::bem
