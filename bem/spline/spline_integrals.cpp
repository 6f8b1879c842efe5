#include "bem/spline/spline_integrals.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/scratch_pool.h"
#include "bem/element/gather.h"
#include "bem/spline/spline_placement.h"

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

struct Workspace {
  ElementRule rule;
  ElementPoints points;
};

}  // namespace

SplineIntegrals::SplineIntegrals(const SplineSurface& surface, const SplineTractions& tractions,
                                 const Job& job)
    : surface_(surface),
      tractions_(tractions),
      elements_(surface.elements().size()),
      areas_(surface.controlPoints().size(), 0) {
  constexpr std::ptrdiff_t kElementsPerTask = 16;
  const std::ptrdiff_t count = surface.elementCount();
  const SplinePlacement placement(surface);
  ScratchPool<Workspace> pool([] { return Workspace{}; });
  parallelFor((count + kElementsPerTask - 1) / kElementsPerTask, job, [&](std::ptrdiff_t task) {
    Workspace work = pool.take();
    for (auto e = static_cast<int>(task * kElementsPerTask);
         e < std::min(count, (task + 1) * kElementsPerTask); ++e) {
      work.rule.clear();
      addTensor(cellOf(surface.elements()[e]), placement.degree(e) + 4, work.rule);
      placement.place(e, work.rule, work.points);
      const ElementPoints& points = work.points;
      const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> basis(
          points.basis.data(), placement.functionCount(e), points.used,
          Eigen::OuterStride<>(placement.stride(e)));
      const Eigen::Map<const Eigen::VectorXd> weights(points.tractionArea(), points.used);
      const Eigen::MatrixXd weighted = basis * weights.asDiagonal();
      Element& element = elements_[e];
      element.products = weighted * basis.transpose();
      element.moments.resize(4, basis.rows());
      for (int c = 0; c < 3; ++c)
        element.moments.row(c) =
            weighted * Eigen::Map<const Eigen::VectorXd>(points.position(c), points.used);
      element.moments.row(3) = weighted.rowwise().sum();
      if (const BorderFunctions* beside = surface.borderFunctions(e)) {
        const Eigen::MatrixXd ofTractions = beside->tractionsOfTable();
        element.products =
            ofTractions * element.products * beside->displacementsOfTable().transpose();
        element.moments = element.moments * ofTractions.transpose();
      }
    }
    pool.giveBack(std::move(work));
  });
  for (int e = 0; e < count; ++e)
    for (std::size_t f = 0; f < surface.functions(e).size(); ++f)
      areas_[surface.functions(e)[f]] += elements_[e].moments(3, static_cast<Index>(f));
}

Resultant SplineIntegrals::resultant(const Eigen::VectorXd& p,
                                     std::span<const int> elements) const {
  Resultant sum;
  for (const int e : elements) {
    const auto& moments = elements_[e].moments;
    const std::vector<int>& slots = tractions_.ofFunction[e];
    for (Index f = 0; f < moments.cols(); ++f) {
      const Vector3d traction = p.segment<3>(3 * static_cast<Index>(slots[f]));
      sum.force += moments(3, f) * traction;
      sum.moment += moments.col(f).head<3>().cross(traction);
    }
  }
  return sum;
}

double SplineIntegrals::strainEnergy(const Eigen::VectorXd& u, const Eigen::VectorXd& p) const {
  double sum = 0;
  Matrix3Xd displacements, tractions;
  for (int e = 0; e < surface_.elementCount(); ++e) {
    gather(p, tractions_.ofFunction[e], tractions);
    if (tractions.isZero(0)) continue;
    gather(u, surface_.functions(e), displacements);
    sum += displacements.cwiseProduct(tractions * elements_[e].products).sum();
  }
  return 0.5 * sum;
}

}  // namespace palpa::bem
