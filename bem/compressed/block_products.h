#pragma once

#include <cstddef>

#include "bem/compressed/packed_block.h"

/// Products of rows of packed blocks, compiled once per instruction set.
namespace palpa::bem {

/// y += A x for a row of A.
template <class Block>
struct BlockProductTask {
  const Block* blocks;    ///< of the row
  const ColumnRun* runs;  ///< the columns of its blocks
  std::size_t runCount;
  const float* x;        ///< [3 column + c][width], and kReadBehind readable numbers behind it
  std::ptrdiff_t width;  ///< right-hand sides
  const char* isLoaded;  ///< of each column: false if x is zero there; null: none is known
  float* y;              ///< [3][width]
};
/// Whole vectors are read.
constexpr std::ptrdiff_t kReadBehind = 3;

void addBlockProductBaseline(const BlockProductTask<PackedBlock>&);
void addBlockProductBaseline(const BlockProductTask<PackedSymmetricBlock>&);
void addBlockProductAvx2(const BlockProductTask<PackedBlock>&);
void addBlockProductAvx2(const BlockProductTask<PackedSymmetricBlock>&);
void addBlockProductAvx512(const BlockProductTask<PackedBlock>&);
void addBlockProductAvx512(const BlockProductTask<PackedSymmetricBlock>&);

/// The functions for one instruction set.
struct AddBlockProduct {
  void (*ofBlocks)(const BlockProductTask<PackedBlock>&);
  void (*ofSymmetricBlocks)(const BlockProductTask<PackedSymmetricBlock>&);
  void operator()(const BlockProductTask<PackedBlock>& task) const { ofBlocks(task); }
  void operator()(const BlockProductTask<PackedSymmetricBlock>& task) const {
    ofSymmetricBlocks(task);
  }
};
/// Fastest variant that this processor supports.
AddBlockProduct addBlockProductForThisProcessor();

}  // namespace palpa::bem
