#pragma once

#include <cstddef>

#include "bem/compressed/packed_block.h"

/// Products of rows of packed blocks, compiled once per instruction set.
namespace palpa::bem {

/// y += A x for a row of A.
struct BlockProductTask {
  const PackedBlock* blocks;  ///< of the row
  const int* columns;         ///< of each block
  std::size_t count;
  const float* x;        ///< [3 column + c][width], and kRead readable numbers behind it
  std::ptrdiff_t width;  ///< right-hand sides
  const char* isLoaded;  ///< of each column: false if x is zero there; null: none is known
  float* y;              ///< [3][width]

  static constexpr std::ptrdiff_t kRead = 3;  ///< whole vectors are read
};

void addBlockProductBaseline(const BlockProductTask&);
void addBlockProductAvx2(const BlockProductTask&);
void addBlockProductAvx512(const BlockProductTask&);

using AddBlockProduct = void (*)(const BlockProductTask&);
/// Fastest variant that this processor supports.
AddBlockProduct addBlockProductForThisProcessor();

}  // namespace palpa::bem
