#pragma once

#include <cstddef>

#include "bem/spline/bspline_basis.h"

/// Inner loops of the spline discretisation, compiled once per instruction set: placing quadrature
/// points on an element, summing Kelvin's kernels over them, adding the sums of an element to the
/// sums of the whole surface, and computing the blocks of the operators from the sums.
namespace palpa::bem {

/// Points and functions are padded to multiples of this number; padding has weight zero.
inline constexpr int kSplineLanes = 8;
constexpr int roundUpToLanes(int count) {
  return (count + kSplineLanes - 1) / kSplineLanes * kSplineLanes;
}
inline constexpr int kMaxElementFunctions = (kMaxSplineDegree + 1) * (kMaxSplineDegree + 1);

/// Geometry and basis at quadrature points of one element.
struct PlacePointsTask {
  SpanPolynomials direction[2];
  const double* points;  ///< control points of the element's functions, 3 each, mm
  int count;             ///< number of quadrature points, a multiple of kSplineLanes
  const double *u, *v;   ///< their parameters
  const double* weight;  ///< their weights in the parameter plane
  // Results:
  double* geometry;  ///< [kPointValues][count], see SplinePoints
  /// Products of the functions, [point][functionStride]; entries beyond the last function keep
  /// their values. Null if not needed.
  double* basis;
  int functionStride;  ///< a multiple of kSplineLanes
};

/// Values per point: position (mm), outward area vector times weight (mm^2), and the length of this
/// vector.
inline constexpr int kPointValues = 7;

/// Tabulates the functions of a span: values[point][function].
struct TabulateTask {
  SpanPolynomials polynomials;
  const double* points;  ///< parameters
  int count;             ///< at most kSplineLanes
  double* values;
};

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
  int count;        ///< number including padding, a multiple of kSplineLanes
  const double* geometry;  ///< as in PlacePointsTask
  /// Points per direction of a tensor rule, at most kSplineLanes, with the functions along u in
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

/// Computes the 3 x 3 blocks of some coefficients for kSplineLanes collocation points at once.
struct MakeBlocksTask {
  KelvinConstants constants;
  /// One per point: [coefficient][kKernelSumsT] or [coefficient][kKernelSumsU]. kSumsPadding
  /// numbers beyond the end must be readable.
  const double* sums[kSplineLanes];
  const int* coefficients;
  int count;
  double*
      blocks;  ///< [index into coefficients][3 c + i][point], component (i, c); aligned to 64 bytes
};
inline constexpr int kSumsPadding = kSplineLanes;

void placePointsBaseline(const PlacePointsTask&);
void tabulateBaseline(const TabulateTask&);
void sumKernelsBaseline(const SumKernelsTask&);
void addSumsBaseline(const AddSumsTask&);
void makeBlocksUBaseline(const MakeBlocksTask&);
void makeBlocksTBaseline(const MakeBlocksTask&);
void placePointsAvx2(const PlacePointsTask&);
void tabulateAvx2(const TabulateTask&);
void sumKernelsAvx2(const SumKernelsTask&);
void addSumsAvx2(const AddSumsTask&);
void makeBlocksUAvx2(const MakeBlocksTask&);
void makeBlocksTAvx2(const MakeBlocksTask&);
void placePointsAvx512(const PlacePointsTask&);
void tabulateAvx512(const TabulateTask&);
void sumKernelsAvx512(const SumKernelsTask&);
void makeBlocksUAvx512(const MakeBlocksTask&);
void makeBlocksTAvx512(const MakeBlocksTask&);

/// Fastest variants of the loops that this processor supports.
struct SplineKernel {
  void (*placePoints)(const PlacePointsTask&);
  void (*tabulate)(const TabulateTask&);
  void (*sumKernels)(const SumKernelsTask&);
  void (*addSums)(const AddSumsTask&);
  void (*makeBlocksU)(const MakeBlocksTask&);
  void (*makeBlocksT)(const MakeBlocksTask&);
};
SplineKernel splineKernelForThisProcessor();

}  // namespace palpa::bem
