#pragma once

#include <cstddef>

/// Inner loops over the quadrature points of curved elements, compiled once per instruction set:
/// summing Kelvin's kernels over them, adding the sums of an element to the sums of the whole
/// surface, and computing the blocks of the operators from the sums.
namespace palpa::bem {

/// Points and functions are padded to multiples of this number; padding has weight zero.
inline constexpr int kElementLanes = 8;
constexpr int roundUpToLanes(int count) {
  return (count + kElementLanes - 1) / kElementLanes * kElementLanes;
}
/// Largest number of functions in one direction of a tensor rule.
inline constexpr int kMaxFunctionsAlong = 6;

/// Values per point: position (mm), outward area vector times weight (mm^2), and the length of this
/// vector.
inline constexpr int kPointValues = 7;

/// Sums of Kelvin's kernels at one collocation point, without the material constants. With r = y -
/// x, R = |r| and one function N:
///   0 … 5:   ∫ N r r / R^3, in the order 00, 01, 11, 02, 12, 22
///   6 … 11:  ∫ N (r.n) r r / R^5, in the same order
///   12 … 14: ∫ N r × n / R^3
inline constexpr int kKernelSums = 15, kKernelSumsU = 6, kKernelSumsT = 9;
inline constexpr int kKernelStride = 16;
struct alignas(64) KernelSums {
  double of[kKernelStride];  ///< the last entry is unused
};

/// Sums Kelvin's kernels times the functions over the quadrature points of one element.
struct SumKernelsTask {
  const double* x;  ///< collocation point, 3 coordinates in mm; not one of the quadrature points
  int used;         ///< number of quadrature points with a weight
  int count;        ///< number including padding, a multiple of kElementLanes
  const double* geometry;  ///< [kPointValues][count]
  /// Points per direction of a tensor rule, at most kElementLanes, with the functions along u in
  /// basis[0] and along v in basis[1], [point][function]. 0: arbitrary points, with all functions
  /// in basis[0], [point][functionStride].
  int perDirection;
  const double* basis[2];
  int functions[2];  ///< numbers of functions in `basis`; without a tensor rule the first counts
                     ///< all functions
  int functionStride;
  KernelSums* sums;  ///< one per function; the sums are added to them
};

/// Adds the sums of an element's functions to the sums of their coefficients.
struct AddSumsTask {
  const KernelSums* sums;
  int functions;
  const int *coefficients, *slots;  ///< of each function
  double *T, *U;                    ///< [coefficient][kKernelSumsT], [slot][kKernelSumsU]
};

/// Material constants that multiply the sums of Kelvin's kernels (kelvin.h).
struct KelvinConstants {
  double weightU, weightT;      ///< 1 / (16 pi G (1 - nu)), -1 / (8 pi (1 - nu))
  double diagonalU, diagonalT;  ///< 3 - 4 nu, 1 - 2 nu
};

/// Computes the 3 x 3 blocks of some coefficients for kElementLanes collocation points at once.
struct MakeBlocksTask {
  KelvinConstants constants;
  /// One per point: [coefficient][kKernelSumsT] or [coefficient][kKernelSumsU]. kSumsPadding
  /// numbers beyond the end must be readable.
  const double* sums[kElementLanes];
  const int* coefficients;
  int count;
  double*
      blocks;  ///< [index into coefficients][3 c + i][point], component (i, c); aligned to 64 bytes
};
inline constexpr int kSumsPadding = kElementLanes;

void sumKernelsBaseline(const SumKernelsTask&);
void addSumsBaseline(const AddSumsTask&);
void makeBlocksUBaseline(const MakeBlocksTask&);
void makeBlocksTBaseline(const MakeBlocksTask&);
void sumKernelsAvx2(const SumKernelsTask&);
void addSumsAvx2(const AddSumsTask&);
void makeBlocksUAvx2(const MakeBlocksTask&);
void makeBlocksTAvx2(const MakeBlocksTask&);
void sumKernelsAvx512(const SumKernelsTask&);
void makeBlocksUAvx512(const MakeBlocksTask&);
void makeBlocksTAvx512(const MakeBlocksTask&);

/// Fastest variants of the loops that this processor supports.
struct KelvinSumLoops {
  void (*sumKernels)(const SumKernelsTask&);
  void (*addSums)(const AddSumsTask&);
  void (*makeBlocksU)(const MakeBlocksTask&);
  void (*makeBlocksT)(const MakeBlocksTask&);
};
KelvinSumLoops kelvinSumLoopsForThisProcessor();

}  // namespace palpa::bem
