#pragma once
#include <cstddef>

#include "bem/spline/bspline_basis.h"

/// The two inner loops of the spline discretisation, compiled once per instruction set: placing
/// quadrature points on an element, and summing Kelvin's kernels over them.
namespace palpa::bem {

/// Points and functions come in multiples of this; what is added to fill up has weight zero.
inline constexpr int kSplineLanes = 8;
constexpr int roundUpToLanes(int count) {
  return (count + kSplineLanes - 1) / kSplineLanes * kSplineLanes;
}
inline constexpr int kMostElementFunctions = (kMostSplineDegree + 1) * (kMostSplineDegree + 1);

/// Geometry and basis at quadrature points of one element.
struct PlacePointsTask {
  SpanPolynomials direction[2];
  const double* points;  ///< control points of the element's functions, 3 each, mm
  int count;             ///< of quadrature points, a multiple of kSplineLanes
  const double *u, *v;   ///< their parameters
  const double* weight;  ///< their weights in the plane of the parameters
  // Results:
  double* position[3];  ///< mm
  double* area[3];      ///< outward area vectors times weights, mm^2
  double* areaSize;     ///< their lengths
  double* basis;        ///< [point][functionStride]
  int functionStride;   ///< a multiple of kSplineLanes; what is beyond the functions stays
};

/// Sums of Kelvin's kernels at one collocation point, before the constants of the material. With
/// r = y - x, per function N:
///   0 … 5:   ∫ N r r / R^3, in the order 00, 01, 11, 02, 12, 22
///   6 … 11:  ∫ N (r.n) r r / R^5, in the same order
///   12 … 14: ∫ N r × n / R^3
inline constexpr int kKernelSums = 15;
struct SumKernelsTask {
  const double* x;  ///< collocation point, 3 coordinates in mm; not one of the quadrature points
  int used;         ///< quadrature points that have a weight
  int count;        ///< with those that fill up, a multiple of kSplineLanes
  const double* position[3];
  const double* area[3];
  const double* areaSize;
  const double* basis;
  int functionStride;
  double* kernels;  ///< scratch: kKernelSums * count
  double* sums;     ///< [kKernelSums][functionStride], added to
};

void placePointsBaseline(const PlacePointsTask&);
void sumKernelsBaseline(const SumKernelsTask&);
void placePointsAvx2(const PlacePointsTask&);
void sumKernelsAvx2(const SumKernelsTask&);
void placePointsAvx512(const PlacePointsTask&);
void sumKernelsAvx512(const SumKernelsTask&);

/// The fastest variants this processor can run.
struct SplineKernel {
  void (*placePoints)(const PlacePointsTask&);
  void (*sumKernels)(const SumKernelsTask&);
};
SplineKernel splineKernelForThisProcessor();

}  // namespace palpa::bem
