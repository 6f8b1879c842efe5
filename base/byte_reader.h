#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "base/byte_stream.h"

namespace palpa {

/// Stored bytes are not what was written.
class DamagedData : public std::runtime_error {
 public:
  DamagedData() : std::runtime_error("stored data are damaged") {}
};

template <class Value>
Value readValue(const ByteSource& source) {
  Value value{};
  source(std::as_writable_bytes(std::span(&value, 1)));
  return value;
}

/// A count from writeCount(). Throws DamagedData if it is larger than `most`.
inline std::size_t readCount(const ByteSource& source, std::size_t most = SIZE_MAX) {
  const auto count = readValue<std::uint64_t>(source);
  if (count > most) throw DamagedData();
  return count;
}

/// A list from writeList(). Memory grows with the values that are there, so that a damaged count
/// takes none.
template <class Value>
std::vector<Value> readList(const ByteSource& source) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 20;
  const std::size_t count = readCount(source);
  std::vector<Value> values;
  while (values.size() < count) {
    const std::size_t begin = values.size();
    values.resize(std::min(count, begin + kAtOnce));
    source(std::as_writable_bytes(std::span(values).subspan(begin)));
  }
  return values;
}

/// The numbers of a dense matrix, whose size is known.
template <class Matrix>
void writeNumbers(const ByteSink& sink, const Matrix& matrix) {
  sink(std::as_bytes(std::span(matrix.data(), static_cast<std::size_t>(matrix.size()))));
}
template <class Matrix>
void readNumbers(const ByteSource& source, Matrix& matrix) {
  source(std::as_writable_bytes(std::span(matrix.data(), static_cast<std::size_t>(matrix.size()))));
}

}  // namespace palpa
