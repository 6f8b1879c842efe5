#include "bem/element/element_rows.h"

#include <algorithm>
#include <numbers>

#include "bem/element/kelvin_blocks.h"

namespace palpa::bem {

ElementRows::ElementRows(const ElementSurface& surface, const ElementQuadrature& quadrature,
                         const Material& material)
    : surface_(surface), quadrature_(quadrature), loops_(kelvinSumLoopsForThisProcessor()) {
  const double nu = material.poissonRatio;
  constants_ = {1.0 / (16 * std::numbers::pi * material.shear() * (1 - nu)),
                -1.0 / (8 * std::numbers::pi * (1 - nu)), 3 - 4 * nu, 1 - 2 * nu};
}

void ElementRows::clear(Sums& sums) const {
  sums.T.assign(static_cast<std::size_t>(kSumsT) * surface_.coefficientCount() + kSumsPadding, 0);
  sums.U.assign(static_cast<std::size_t>(kSumsU) * surface_.slotCount() + kSumsPadding, 0);
  if (!sums.quadrature) sums.quadrature = quadrature_.makeWorkspace();
}

void ElementRows::add(int element, const CollocationPlace& point, const ElementPlace* inside,
                      Sums& sums) const {
  quadrature_.integrate(element, point.position, inside, *sums.quadrature);
  const std::vector<KernelSums>& ofFunctions = sums.quadrature->sums;
  loops_.addSums({ofFunctions.data(), static_cast<int>(ofFunctions.size()),
                  surface_.coefficients(element).data(), surface_.slots(element).data(),
                  sums.T.data(), sums.U.data()});
}

void ElementRows::integrate(const CollocationPlace& point, Sums& sums, const Job& job) const {
  clear(sums);
  for (int e = 0; e < surface_.elementCount(); ++e) {
    if (e % 64 == 0) job.throwIfCancelled();
    add(e, point, placeIn(point, e), sums);
  }
  subtractTranslation(point, sums);
}

void ElementRows::integrateOver(std::span<const int> elements, const CollocationPlace& point,
                                Sums& sums, const Job& job) const {
  clear(sums);
  job.throwIfCancelled();
  for (const int e : elements) add(e, point, nullptr, sums);
}

void ElementRows::integrateOutside(std::span<const int> leftOut,
                                   const std::optional<std::span<const int>>& elements,
                                   const CollocationPlace& point, Sums& sums,
                                   const Job& job) const {
  clear(sums);
  auto next = leftOut.begin();
  const auto addUnlessLeftOut = [&](int e) {
    if (e % 64 == 0) job.throwIfCancelled();
    next = std::find_if(next, leftOut.end(), [e](int left) { return left >= e; });
    if (next == leftOut.end() || *next != e) add(e, point, nullptr, sums);
  };
  if (elements)
    std::for_each(elements->begin(), elements->end(), addUnlessLeftOut);
  else
    for (int e = 0; e < surface_.elementCount(); ++e) addUnlessLeftOut(e);
  setTotal(sums);
}

void ElementRows::setTotal(Sums& sums) const {
  std::fill(std::begin(sums.total), std::end(sums.total), 0);
  for (int j = 0; j < surface_.coefficientCount(); ++j)
    for (int k = 0; k < kSumsT; ++k)
      sums.total[k] += sums.T[static_cast<std::size_t>(kSumsT) * j + k];
}

void ElementRows::subtractTranslation(const CollocationPlace& point, Sums& sums) const {
  setTotal(sums);
  const ElementPlace& place = point.places.front();
  surface_.evaluateBasis(place, sums.basis);
  const std::vector<int>& coefficients = surface_.coefficients(place.element);
  for (std::size_t f = 0; f < coefficients.size(); ++f)
    for (int k = 0; k < kSumsT; ++k)
      sums.T[static_cast<std::size_t>(kSumsT) * coefficients[f] + k] -=
          sums.basis[f] * sums.total[k];
}

Eigen::Matrix3Xd ElementRows::residual(const Sums& sums, const Eigen::MatrixXd& u,
                                       const Eigen::MatrixXd& p) const {
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, u.cols());
  Eigen::Matrix3d block;
  for (Eigen::Index j = 0; 3 * j < u.rows(); ++j) {
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c)
        block(i, c) = detail::BlockT::component(constants_, &sums.T[kSumsT * j], i, c);
    sum -= block * u.middleRows<3>(3 * j);
  }
  for (Eigen::Index s = 0; 3 * s < p.rows(); ++s) {
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c)
        block(i, c) = detail::BlockU::component(constants_, &sums.U[kSumsU * s], i, c);
    sum += block * p.middleRows<3>(3 * s);
  }
  return sum;
}

Eigen::Matrix3d ElementRows::freeTerm(const Sums& sums) const {
  double symmetric[kSumsT] = {};
  std::copy_n(sums.total, kSumsU, symmetric);
  Eigen::Matrix3d C;
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) C(i, c) = -detail::BlockT::component(constants_, symmetric, i, c);
  return C;
}

}  // namespace palpa::bem
