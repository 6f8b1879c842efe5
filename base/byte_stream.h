#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace palpa {

/// Receives the next bytes of an object that is being stored. An exception ends the writing.
using ByteSink = std::function<void(std::span<const std::byte>)>;

/// Fills the span with the next stored bytes. Throws if there are not enough.
using ByteSource = std::function<void(std::span<std::byte>)>;

/// Writes the bytes of a plain value without padding.
template <class Value>
void writeValue(const ByteSink& sink, const Value& value) {
  sink(std::as_bytes(std::span(&value, 1)));
}
inline void writeCount(const ByteSink& sink, std::size_t count) {
  writeValue(sink, static_cast<std::uint64_t>(count));
}
/// Writes the number of values and then the values.
template <class Value>
void writeList(const ByteSink& sink, const std::vector<Value>& values) {
  writeCount(sink, values.size());
  sink(std::as_bytes(std::span(values)));
}

}  // namespace palpa
