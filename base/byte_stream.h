#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace palpa {

/// Takes the next bytes of something that is stored. May throw; that ends the writing.
using ByteSink = std::function<void(std::span<const std::byte>)>;

/// Fills the span with the next bytes of what was stored. Throws when there are not as many.
using ByteSource = std::function<void(std::span<std::byte>)>;

/// A plain value without padding, byte by byte.
template <class Value>
void writeValue(const ByteSink& sink, const Value& value) {
  sink(std::as_bytes(std::span(&value, 1)));
}
inline void writeCount(const ByteSink& sink, std::size_t count) {
  writeValue(sink, static_cast<std::uint64_t>(count));
}
/// The number of values and these.
template <class Value>
void writeList(const ByteSink& sink, const std::vector<Value>& values) {
  writeCount(sink, values.size());
  sink(std::as_bytes(std::span(values)));
}

}  // namespace palpa
