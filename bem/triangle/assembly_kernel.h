#pragma once

#include <cstddef>

#include "bem/base/triangle_rule.h"
#include "bem/triangle/flat_triangle.h"

namespace palpa::bem {

/// Below `rule16` (distance of the collocation point from the centroid over the element's radius)
/// integrals are taken in closed form, up to `rule7` by the 16-point rule, beyond by the 7-point
/// rule.
struct QuadratureRange {
  double rule16;
  double rule7;
};

/// Collocation points of one tile. Their rows are summed in a small buffer, [coefficient][3 x 3
/// components][point], where one element changes a few contiguous pieces, and then copied to the
/// large matrices: adding to their columns directly costs more in cache misses than the integrals.
inline constexpr int kTilePoints = 16;

/// Task of one call: assembly of all rows of up to kTilePoints collocation points. Plain pointers,
/// because the loop is compiled for several instruction sets.
/// Row of point i, component c: c * pointCount + i. Column of coefficient j, component c: 3 j + c.
/// Column-major.
template <class Scalar>
struct AssemblyTask {
  const double* position[3];  ///< collocation points by component, pointCount each
  std::ptrdiff_t pointCount, pointBegin, pointEnd;
  const int* hostNodes;       ///< 3 per point: displacement coefficients that determine u there
  const double* hostWeights;  ///< their weights
  std::ptrdiff_t displacementCount, tractionCount;  ///< coefficients
  const FlatTriangle* triangles;
  const double* corners;            ///< 9 per triangle: the positions of its corners, mm
  const int* displacementOfCorner;  ///< 3 per triangle: displacement coefficient of each corner
  const int* tractionOfCorner;      ///< 3 per triangle: traction coefficient of each corner
  std::ptrdiff_t triangleCount;
  QuadratureRange range;
  const TrianglePoint* rule7;
  const TrianglePoint* rule16;
  const double (*products7)[10];  ///< RuleProducts of the rules
  const double (*products16)[10];
  double shear, poissonRatio;
  Scalar* H;      ///< (3 pointCount) x (3 displacement coefficients)
  Scalar* G;      ///< (3 pointCount) x (3 traction coefficients)
  double* tileH;  ///< scratch of this call: 9 kTilePoints values per displacement coefficient
  double* tileG;  ///< the same per traction coefficient; both 64-byte aligned
  bool (*cancelled)(const void*);
  const void* cancelledContext;
};

/// Integrates over all elements, adds the free term to H and stores the rows. Returns early if
/// cancelled.
template <class Scalar>
using AssembleRows = void (*)(const AssemblyTask<Scalar>&);

/// y += A x over some columns and a range of rows, in double precision for any storage of A, as
/// iterative refinement needs it for residuals.
template <class Scalar>
struct ProductTask {
  const Scalar* matrix;  ///< column-major
  std::ptrdiff_t rows;   ///< also the leading dimension of y
  std::ptrdiff_t rowBegin, rowEnd;
  const int* columns;  ///< columns of A to use
  std::ptrdiff_t columnCount;
  const double*
      x;  ///< per right-hand side k: x + k xStride, indexed by column of A; zeros are skipped
  std::ptrdiff_t xStride;
  int rightHandSides;
  double* y;  ///< rows x rightHandSides
};
template <class Scalar>
using AddProduct = void (*)(const ProductTask<Scalar>&);

/// Fastest variants that this processor supports.
template <class Scalar>
AssembleRows<Scalar> assembleRowsForThisProcessor();
template <class Scalar>
AddProduct<Scalar> addProductForThisProcessor();

// One group per instruction set, to be called only if the processor supports it.
void assembleRowsAvx512(const AssemblyTask<double>&);
void assembleRowsAvx512(const AssemblyTask<float>&);
void addProductAvx512(const ProductTask<double>&);
void addProductAvx512(const ProductTask<float>&);
void assembleRowsAvx2(const AssemblyTask<double>&);
void assembleRowsAvx2(const AssemblyTask<float>&);
void addProductAvx2(const ProductTask<double>&);
void addProductAvx2(const ProductTask<float>&);
void assembleRowsBaseline(const AssemblyTask<double>&);
void assembleRowsBaseline(const AssemblyTask<float>&);
void addProductBaseline(const ProductTask<double>&);
void addProductBaseline(const ProductTask<float>&);

}  // namespace palpa::bem
