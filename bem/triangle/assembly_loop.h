#pragma once

#include "bem/triangle/assembly_kernel.h"
#include "bem/triangle/flat_triangle_integrals.h"

/// The assembly loop, included by one source file per instruction set. Every function template has
/// the instruction set (`Arch`, or a `Batch` of it) as a parameter: the linker keeps one of several
/// equal instances, which must not be one that this processor cannot run. An element type brings
/// its geometry (`integrate`) and the number of its basis functions (`kBasisCount`).
namespace palpa::bem::detail {

template <class Batch, class Scalar>
class FlatLinearElement {
 public:
  static constexpr int kBasisCount = 3;

  FlatLinearElement(const AssemblyTask<Scalar>& task, std::ptrdiff_t index)
      : geometry_(task.triangles[index]), corners_(task.corners + 9 * index), range_(task.range) {
    place(task.rule7, task.products7, rule7_);
    place(task.rule16, task.products16, rule16_);
  }

  void integrate(const Batch (&x)[3], TriangleIntegrals<Batch>& out) const {
    Batch squared(0.0);
    for (int i = 0; i < 3; ++i)
      squared += (x[i] - geometry_.centroid[i]) * (x[i] - geometry_.centroid[i]);
    const auto allBeyond = [&](double ratio) {
      const double distance = ratio * geometry_.radius;
      return xsimd::all(squared >= Batch(distance * distance));
    };
    if (allBeyond(range_.rule7))
      integrateByRule(geometry_, corners_, rule7_, x, out);
    else if (allBeyond(range_.rule16))
      integrateByRule(geometry_, corners_, rule16_, x, out);
    else
      integrateClosedForm<Batch>(geometry_, x, out);
  }

 private:
  template <int Count>
  void place(const TrianglePoint* rule, const double (*products)[10], PlacedRule<Count>& placed) {
    for (int q = 0; q < Count; ++q)
      for (int i = 0; i < 3; ++i)
        placed.point[q][i] = rule[q].barycentric[0] * corners_[i] +
                             rule[q].barycentric[1] * corners_[3 + i] +
                             rule[q].barycentric[2] * corners_[6 + i];
    placed.productWeight = products;
  }

  const FlatTriangle& geometry_;
  const double* corners_;
  QuadratureRange range_;
  PlacedRule<7> rule7_;
  PlacedRule<16> rule16_;
};

/// Adds the 3 x 3 blocks of one basis function for a batch of points to a tile: `block(i, j)`
/// yields the component (i, j).
template <class Batch, class Block>
inline void addToTile(double* tile, int coefficient, int firstLane, const Block& block) {
  double* place = tile + static_cast<std::ptrdiff_t>(coefficient) * 9 * kTilePoints + firstLane;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double* out = place + (3 * i + j) * kTilePoints;
      (Batch::load_aligned(out) + block(i, j)).store_aligned(out);
    }
}

/// Turns the integrals of one element into blocks of T and U (see kelvin.h) and adds them to the
/// tiles.
template <class Batch, class Scalar>
inline void addElement(const AssemblyTask<Scalar>& task, std::ptrdiff_t element,
                       const TriangleIntegrals<Batch>& integrals, int firstLane) {
  constexpr double kPi = 3.14159265358979323846;
  constexpr int kPacked[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};
  const double nu = task.poissonRatio;
  const Batch weightU(1.0 / (16 * kPi * task.shear * (1 - nu)));
  const Batch weightT(-1.0 / (8 * kPi * (1 - nu)));
  const double* n = task.triangles[element].normal;
  for (int a = 0; a < 3; ++a) {
    const BasisIntegrals<Batch>& basis = integrals[a];
    const Batch diagonalU = (basis.rr3[0] + basis.rr3[2] + basis.rr3[5]) * Batch(3 - 4 * nu);
    const Batch diagonalT = (basis.rr5[0] + basis.rr5[2] + basis.rr5[5]) * Batch(1 - 2 * nu);
    addToTile<Batch>(task.tileG, task.tractionOfCorner[3 * element + a], firstLane,
                     [&](int i, int j) {
                       const Batch rr = basis.rr3[kPacked[i][j]];
                       return weightU * (i == j ? rr + diagonalU : rr);
                     });
    addToTile<Batch>(task.tileH, task.displacementOfCorner[3 * element + a], firstLane,
                     [&](int i, int j) {
                       const Batch rr = Batch(3.0) * basis.rr5[kPacked[i][j]];
                       if (i == j) return weightT * (rr + diagonalT);
                       const Batch turn = basis.r3[i] * n[j] - basis.r3[j] * n[i];
                       return weightT * (rr - Batch(1 - 2 * nu) * turn);
                     });
  }
}

/// A translation of the whole body needs no traction, so each row of 3 x 3 blocks of H sums to
/// zero. The difference is the free term (at a node together with the singular block of the node)
/// and belongs to the coefficients of u(x).
template <class Arch, class Scalar>
void addFreeTerm(const AssemblyTask<Scalar>& task) {
  constexpr int kBlock = 9 * kTilePoints;
  double sum[kBlock] = {};
  for (std::ptrdiff_t j = 0; j < task.displacementCount; ++j)
    for (int k = 0; k < kBlock; ++k) sum[k] += task.tileH[j * kBlock + k];
  for (std::ptrdiff_t point = task.pointBegin; point < task.pointEnd; ++point)
    for (int corner = 0; corner < 3; ++corner) {
      const double weight = task.hostWeights[3 * point + corner];
      if (weight == 0) continue;
      double* block = task.tileH + task.hostNodes[3 * point + corner] * kBlock;
      for (int k = 0; k < 9; ++k) {
        const auto place = k * kTilePoints + (point - task.pointBegin);
        block[place] -= weight * sum[place];
      }
    }
}

/// Copies a tile to its rows of a matrix.
template <class Arch, class Scalar>
void storeTile(const AssemblyTask<Scalar>& task, const double* tile, std::ptrdiff_t coefficients,
               Scalar* matrix) {
  constexpr std::ptrdiff_t kCancelPeriod =
      128;  // the first tile faults in the pages of all columns
  const std::ptrdiff_t points = task.pointEnd - task.pointBegin;
  for (std::ptrdiff_t coefficient = 0; coefficient < coefficients; ++coefficient) {
    if (coefficient % kCancelPeriod == 0 && task.cancelled(task.cancelledContext)) return;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const double* from = tile + (coefficient * 9 + 3 * i + j) * kTilePoints;
        Scalar* to = matrix + (3 * coefficient + j) * 3 * task.pointCount + i * task.pointCount +
                     task.pointBegin;
        if (points == kTilePoints)
          for (int k = 0; k < kTilePoints; ++k) to[k] = static_cast<Scalar>(from[k]);
        else
          for (std::ptrdiff_t k = 0; k < points; ++k) to[k] = static_cast<Scalar>(from[k]);
      }
  }
}

template <class Arch, class Scalar>
void addProduct(const ProductTask<Scalar>& task) {
  // Plain loops: the compiler vectorises them for the instruction set this file is compiled for.
  for (std::ptrdiff_t c = 0; c < task.columnCount; ++c) {
    const int column = task.columns[c];
    const Scalar* a = task.matrix + column * task.rows;
    for (int k = 0; k < task.rightHandSides; ++k) {
      const double factor = task.x[k * task.xStride + column];
      if (factor == 0) continue;
      double* y = task.y + k * task.rows;
      for (std::ptrdiff_t row = task.rowBegin; row < task.rowEnd; ++row) y[row] += factor * a[row];
    }
  }
}

template <class Arch, class Scalar>
void assembleRows(const AssemblyTask<Scalar>& task) {
  using Batch = xsimd::batch<double, Arch>;
  constexpr int kLanes = static_cast<int>(Batch::size);
  constexpr int kBatches = kTilePoints / kLanes;
  constexpr std::ptrdiff_t kCancelPeriod = 1024;

  Batch x[kBatches][3];
  for (int b = 0; b < kBatches; ++b)
    for (int i = 0; i < 3; ++i) {
      // Lanes past the end repeat the last point; their sums are not stored.
      alignas(64) double lanes[kLanes];
      for (int lane = 0; lane < kLanes; ++lane) {
        const std::ptrdiff_t point = task.pointBegin + b * kLanes + lane;
        lanes[lane] = task.position[i][point < task.pointEnd ? point : task.pointEnd - 1];
      }
      x[b][i] = Batch::load_aligned(lanes);
    }
  const auto clear = [](double* tile, std::ptrdiff_t coefficients) {
    for (std::ptrdiff_t k = 0; k < coefficients * 9 * kTilePoints; ++k) tile[k] = 0;
  };
  clear(task.tileH, task.displacementCount);
  clear(task.tileG, task.tractionCount);
  for (std::ptrdiff_t index = 0; index < task.triangleCount; ++index) {
    if (index % kCancelPeriod == 0 && task.cancelled(task.cancelledContext)) return;
    const FlatLinearElement<Batch, Scalar> element(task, index);
    for (int b = 0; b < kBatches; ++b) {
      TriangleIntegrals<Batch> integrals;
      element.integrate(x[b], integrals);
      addElement<Batch>(task, index, integrals, b * kLanes);
    }
  }
  addFreeTerm<Arch>(task);
  storeTile<Arch>(task, task.tileH, task.displacementCount, task.H);
  storeTile<Arch>(task, task.tileG, task.tractionCount, task.G);
}

}  // namespace palpa::bem::detail
