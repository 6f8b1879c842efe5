#pragma once

#include "bem/element/kelvin_sums.h"

/// Inner loops that place quadrature points on quadratic triangles, compiled once per instruction
/// set.
namespace palpa::bem {

/// Position of a quadratic triangle at geometric coordinates (BorderCoordinates), with the measure
/// of the area there.
struct PlaceOnTriangleTask {
  const double* polynomial;  ///< coefficients of 1, u, v, u^2, uv, v^2, 3 each, mm
  int count;                 ///< number of points, a multiple of kElementLanes
  const double *u, *v;       ///< geometric coordinates
  const double* weight;      ///< weights in the plane of these coordinates
  double* geometry;          ///< result: [kPointValues][count], see ElementPoints
};

/// The six functions of a quadratic triangle (QuadraticBasis).
struct TriangleBasisTask {
  int count;            ///< number of points
  const double *u, *v;  ///< local coordinates
  double* basis;        ///< result: [point][kElementLanes], zeros after the sixth function
};

void placeOnTriangleBaseline(const PlaceOnTriangleTask&);
void triangleBasisBaseline(const TriangleBasisTask&);
void placeOnTriangleAvx2(const PlaceOnTriangleTask&);
void triangleBasisAvx2(const TriangleBasisTask&);
void placeOnTriangleAvx512(const PlaceOnTriangleTask&);
void triangleBasisAvx512(const TriangleBasisTask&);

/// Fastest variants of the loops that this processor supports.
struct QuadraticKernel {
  void (*place)(const PlaceOnTriangleTask&);
  void (*basis)(const TriangleBasisTask&);
};
QuadraticKernel quadraticKernelForThisProcessor();

}  // namespace palpa::bem
