#pragma once
#include "bem/assembly_kernel.h"
#include "bem/flat_triangle_integrals.h"

/// The assembly loop, included by one source file per instruction set. It knows neither what an
/// element's geometry is nor what its basis functions are: an element type brings `integrate` and
/// `kBasisCount`.
namespace palpa::bem::detail {

template <class Batch, class Scalar>
struct FlatLinearElement {
  static constexpr int kBasisCount = 3;
  const AssemblyTask<Scalar>& task;
  std::ptrdiff_t index;

  const FlatTriangle& geometry() const { return task.triangles[index]; }

  void integrate(const Batch (&x)[3], TriangleIntegrals<Batch>& out) const {
    const FlatTriangle& t = geometry();
    Batch squared(0.0);
    for (int i = 0; i < 3; ++i) squared += (x[i] - t.centroid[i]) * (x[i] - t.centroid[i]);
    const auto allBeyond = [&](double ratio) {
      const double distance = ratio * t.radius;
      return xsimd::all(squared >= Batch(distance * distance));
    };
    if (allBeyond(task.range.rule7))
      integrateByRule<Batch>(t, task.corners + 9 * index, task.rule7, 7, x, out);
    else if (allBeyond(task.range.rule16))
      integrateByRule<Batch>(t, task.corners + 9 * index, task.rule16, 16, x, out);
    else
      integrateClosedForm<Batch>(t, x, out);
  }
};

/// Adds the 3 x 3 blocks of one basis function for a batch of points: `block(i, j)` yields
/// component (i, j).
template <class Batch, class Scalar, class Block>
inline void scatter(Scalar* matrix, std::ptrdiff_t pointCount, std::ptrdiff_t firstPoint,
                    int validLanes, int coefficient, const Block& block) {
  constexpr int kLanes = static_cast<int>(Batch::size);
  alignas(64) double value[kLanes];
  for (int j = 0; j < 3; ++j) {
    Scalar* column = matrix + (3 * static_cast<std::ptrdiff_t>(coefficient) + j) * 3 * pointCount;
    for (int i = 0; i < 3; ++i) {
      block(i, j).store_aligned(value);
      Scalar* out = column + i * pointCount + firstPoint;
      if (validLanes == kLanes) {
        for (int lane = 0; lane < kLanes; ++lane) out[lane] += static_cast<Scalar>(value[lane]);
      } else {
        for (int lane = 0; lane < validLanes; ++lane) out[lane] += static_cast<Scalar>(value[lane]);
      }
    }
  }
}

/// Turns the integrals of one element into blocks of T and U (see kelvin.h) and adds them to H and
/// G.
template <class Batch, class Scalar>
inline void addElement(const AssemblyTask<Scalar>& task, std::ptrdiff_t element,
                       const TriangleIntegrals<Batch>& integrals, std::ptrdiff_t firstPoint,
                       int validLanes) {
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
    scatter<Batch>(task.G, task.pointCount, firstPoint, validLanes,
                   task.tractionOfCorner[3 * element + a], [&](int i, int j) {
                     const Batch rr = basis.rr3[kPacked[i][j]];
                     return weightU * (i == j ? rr + diagonalU : rr);
                   });
    scatter<Batch>(task.H, task.pointCount, firstPoint, validLanes,
                   task.displacementOfCorner[3 * element + a], [&](int i, int j) {
                     const Batch rr = Batch(3.0) * basis.rr5[kPacked[i][j]];
                     if (i == j) return weightT * (rr + diagonalT);
                     const Batch turn = basis.r3[i] * n[j] - basis.r3[j] * n[i];
                     return weightT * (rr - Batch(1 - 2 * nu) * turn);
                   });
  }
}

template <class Arch, class Scalar>
void addProduct(const ProductTask<Scalar>& task) {
  // Plain loops: the compiler vectorises them for the instruction set this file is compiled for.
  // `Arch` keeps the instances apart.
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
  constexpr std::ptrdiff_t kCancelPeriod = 256;
  for (std::ptrdiff_t element = 0; element < task.triangleCount; ++element) {
    if (element % kCancelPeriod == 0 && task.cancelled(task.cancelledContext)) return;
    const FlatLinearElement<Batch, Scalar> current{task, element};
    for (std::ptrdiff_t first = task.pointBegin; first < task.pointEnd; first += kLanes) {
      const auto left = task.pointEnd - first;
      const int validLanes = left < kLanes ? static_cast<int>(left) : kLanes;
      Batch x[3];
      for (int i = 0; i < 3; ++i) {
        // Lanes past the end repeat the last point: their results are not stored.
        alignas(64) double padded[kLanes];
        for (int lane = 0; lane < kLanes; ++lane)
          padded[lane] = task.position[i][first + (lane < validLanes ? lane : validLanes - 1)];
        x[i] = Batch::load_aligned(padded);
      }
      TriangleIntegrals<Batch> integrals;
      current.integrate(x, integrals);
      addElement<Batch>(task, element, integrals, first, validLanes);
    }
  }
}

}  // namespace palpa::bem::detail
