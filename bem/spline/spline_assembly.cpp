#include "bem/spline/spline_assembly.h"

#include <algorithm>
#include <numbers>

#include "bem/lending_pool.h"
#include "bem/parallel.h"
#include "bem/spline/spline_quadrature.h"

namespace palpa::bem {
namespace {

constexpr std::ptrdiff_t kPointsPerTask = 16;
/// Sums per displacement and per traction coefficient, see spline_kernel.h.
constexpr int kSumsT = 9, kSumsU = 6;
constexpr int kPacked[3][3] = {{0, 1, 3}, {1, 2, 4}, {3, 4, 5}};

/// What a thread needs; used again from task to task.
struct Scratch {
  SplineQuadrature::Workspace quadrature;
  std::vector<double> H, G;          ///< sums of one row, [coefficient][sum]
  std::vector<double> rowsH, rowsG;  ///< blocks of a task, [coefficient][3 x 3][point]
  std::vector<double> basis;
};

class Rows {
 public:
  Rows(const SplineSurface& surface, const SplineTractions& tractions, const Material& material,
       const SplineQuadrature& quadrature)
      : surface_(surface), tractions_(tractions), quadrature_(quadrature) {
    const double nu = material.poissonRatio;
    weightU_ = 1.0 / (16 * std::numbers::pi * material.shear() * (1 - nu));
    weightT_ = -1.0 / (8 * std::numbers::pi * (1 - nu));
    diagonalU_ = 3 - 4 * nu;
    diagonalT_ = 1 - 2 * nu;
  }

  /// Sums over all elements, as seen from a point.
  void integrate(const SplineCollocationPoint& point, Scratch& scratch, const Job& job) const {
    scratch.H.assign(static_cast<std::size_t>(kSumsT) * surface_.coefficientCount(), 0);
    scratch.G.assign(static_cast<std::size_t>(kSumsU) * tractions_.slots.count(), 0);
    for (int e = 0; e < surface_.elementCount(); ++e) {
      if (e % 64 == 0) job.throwIfCancelled();
      const auto inside = std::find_if(point.places.begin(), point.places.end(),
                                       [e](const SplinePlace& p) { return p.element == e; });
      quadrature_.integrate(e, point.position, inside == point.places.end() ? nullptr : &*inside,
                            scratch.quadrature);
      const double* sums = scratch.quadrature.sums.data();
      const int stride = quadrature_.stride(e);
      const std::vector<int>&coefficients = surface_.functions(e),
            &slots = tractions_.ofFunction[e];
      for (std::size_t f = 0; f < coefficients.size(); ++f) {
        double* h = scratch.H.data() + static_cast<std::ptrdiff_t>(kSumsT) * coefficients[f];
        double* g = scratch.G.data() + static_cast<std::ptrdiff_t>(kSumsU) * slots[f];
        for (int k = 0; k < kSumsU; ++k) g[k] += sums[k * stride + f];
        for (int k = 0; k < kSumsT; ++k) h[k] += sums[(kSumsU + k) * stride + f];
      }
    }
    subtractTranslation(point, scratch);
  }

  /// Turns the sums into blocks of T and U (see kelvin.h).
  void store(std::ptrdiff_t place, Scratch& scratch) const {
    for (int j = 0; j < surface_.coefficientCount(); ++j) {
      const double* sum = scratch.H.data() + static_cast<std::ptrdiff_t>(kSumsT) * j;
      const double trace = diagonalT_ * (sum[0] + sum[2] + sum[5]);
      double* out = scratch.rowsH.data() + static_cast<std::ptrdiff_t>(9) * kPointsPerTask * j;
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) {
          // e_i n_j - e_j n_i is the component of r × n across i and j.
          double value = 3 * sum[kPacked[i][c]] + (i == c ? trace : 0);
          if (i != c) {
            const int across = 3 - i - c;
            const double turn = (c - i + 3) % 3 == 1 ? sum[6 + across] : -sum[6 + across];
            value -= diagonalT_ * turn;
          }
          out[(3 * i + c) * kPointsPerTask + place] = weightT_ * value;
        }
    }
    for (int s = 0; s < tractions_.slots.count(); ++s) {
      const double* sum = scratch.G.data() + static_cast<std::ptrdiff_t>(kSumsU) * s;
      const double trace = diagonalU_ * (sum[0] + sum[2] + sum[5]);
      double* out = scratch.rowsG.data() + static_cast<std::ptrdiff_t>(9) * kPointsPerTask * s;
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c)
          out[(3 * i + c) * kPointsPerTask + place] =
              weightU_ * (sum[kPacked[i][c]] + (i == c ? trace : 0));
    }
  }

 private:
  void subtractTranslation(const SplineCollocationPoint& point, Scratch& scratch) const {
    double total[kSumsT] = {};
    for (int j = 0; j < surface_.coefficientCount(); ++j)
      for (int k = 0; k < kSumsT; ++k)
        total[k] += scratch.H[static_cast<std::size_t>(kSumsT) * j + k];
    const SplinePlace& place = point.places.front();
    surface_.evaluateBasis(place, scratch.basis);
    const std::vector<int>& coefficients = surface_.functions(place.element);
    for (std::size_t f = 0; f < coefficients.size(); ++f)
      for (int k = 0; k < kSumsT; ++k)
        scratch.H[static_cast<std::size_t>(kSumsT) * coefficients[f] + k] -=
            scratch.basis[f] * total[k];
  }

  const SplineSurface& surface_;
  const SplineTractions& tractions_;
  const SplineQuadrature& quadrature_;
  double weightU_, weightT_, diagonalU_, diagonalT_;
};

/// Copies the blocks of a task to its rows of a matrix.
template <class Scalar>
void copyRows(const std::vector<double>& rows, std::ptrdiff_t begin, std::ptrdiff_t end,
              std::ptrdiff_t pointCount, LargeMatrix<Scalar>& matrix) {
  const std::ptrdiff_t coefficients = matrix.cols() / 3;
  for (std::ptrdiff_t j = 0; j < coefficients; ++j)
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) {
        const double* from = rows.data() + (9 * j + 3 * i + c) * kPointsPerTask;
        Scalar* to = matrix.data() + (3 * j + c) * matrix.rows() + i * pointCount + begin;
        for (std::ptrdiff_t k = 0; k < end - begin; ++k) to[k] = static_cast<Scalar>(from[k]);
      }
}

}  // namespace

template <class Scalar>
BoundaryOperators<Scalar> assemble(const SplineSurface& surface, const SplineTractions& tractions,
                                   const std::vector<SplineCollocationPoint>& points,
                                   const Material& material, const AssemblyOptions& options,
                                   const Job& job) {
  material.validate();
  const auto m = static_cast<std::ptrdiff_t>(points.size());
  BoundaryOperators<Scalar> result{
      LargeMatrix<Scalar>(3 * m, 3 * static_cast<Eigen::Index>(surface.coefficientCount())),
      LargeMatrix<Scalar>(3 * m, 3 * static_cast<Eigen::Index>(tractions.slots.count()))};
  const SplineQuadrature quadrature(surface, options.tolerance);
  const Rows rows(surface, tractions, material, quadrature);
  LendingPool<Scratch> pool([] { return Scratch{}; });
  parallelFor((m + kPointsPerTask - 1) / kPointsPerTask, job, "assemble", [&](std::ptrdiff_t task) {
    const std::ptrdiff_t begin = task * kPointsPerTask, end = std::min(m, begin + kPointsPerTask);
    Scratch scratch = pool.take();
    scratch.rowsH.resize(static_cast<std::size_t>(9 * kPointsPerTask) * surface.coefficientCount());
    scratch.rowsG.resize(static_cast<std::size_t>(9 * kPointsPerTask) * tractions.slots.count());
    for (std::ptrdiff_t k = begin; k < end; ++k) {
      rows.integrate(points[k], scratch, job);
      rows.store(k - begin, scratch);
    }
    copyRows(scratch.rowsH, begin, end, m, result.H);
    copyRows(scratch.rowsG, begin, end, m, result.G);
    pool.giveBack(std::move(scratch));
  });
  return result;
}

template BoundaryOperators<double> assemble(const SplineSurface&, const SplineTractions&,
                                            const std::vector<SplineCollocationPoint>&,
                                            const Material&, const AssemblyOptions&, const Job&);
template BoundaryOperators<float> assemble(const SplineSurface&, const SplineTractions&,
                                           const std::vector<SplineCollocationPoint>&,
                                           const Material&, const AssemblyOptions&, const Job&);

}  // namespace palpa::bem
