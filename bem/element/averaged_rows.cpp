#include "bem/element/averaged_rows.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bem/element/kelvin_blocks.h"

namespace palpa::bem {

using Eigen::Index;

namespace {

/// Sums per equation [function][sum] -> blocks [3 equation + i][3 function + c].
template <class Block>
Eigen::MatrixXd blocksOf(const KelvinConstants& constants, const Eigen::MatrixXd& sums,
                         Index functions) {
  Eigen::MatrixXd blocks(3 * sums.cols(), 3 * functions);
  for (Index j = 0; j < functions; ++j)
    for (Index e = 0; e < sums.cols(); ++e)
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i)
          blocks(3 * e + i, 3 * j + c) =
              Block::component(constants, sums.col(e).data() + Block::kSums * j, i, c);
  return blocks;
}

}  // namespace

AveragedRows::AveragedRows(const ElementSurface& surface, const ElementQuadrature& quadrature,
                           const KelvinConstants& constants, const WeightedEquations& equations,
                           std::optional<std::span<const int>> part)
    : surface_(surface),
      quadrature_(quadrature),
      constants_(constants),
      equations_(equations),
      part_(part),
      loops_(kelvinSumLoopsForThisProcessor()),
      leftOut_(equations.points.size()) {
  std::vector<char> isSet(equations.points.size(), 0);
  std::vector<int> common;
  for (const AveragedElement& element : equations.averaged)
    for (const int node : element.nodes) {
      if (std::exchange(isSet[node], 1) == 0) {
        leftOut_[node] = element.near;
        continue;
      }
      common.clear();
      std::set_intersection(leftOut_[node].begin(), leftOut_[node].end(), element.near.begin(),
                            element.near.end(), std::back_inserter(common));
      leftOut_[node] = common;
    }
}

AveragedRows::Scratch AveragedRows::makeScratch() const {
  Scratch scratch;
  scratch.quadrature = quadrature_.makeWorkspace();
  scratch.placeOfCoefficient.assign(static_cast<std::size_t>(surface_.coefficientCount()), -1);
  scratch.placeOfSlot.assign(static_cast<std::size_t>(surface_.slotCount()), -1);
  return scratch;
}

std::span<const int> AveragedRows::inPart(std::span<const int> elements,
                                          std::vector<int>& chosen) const {
  if (!part_) return elements;
  chosen.clear();
  std::set_intersection(elements.begin(), elements.end(), part_->begin(), part_->end(),
                        std::back_inserter(chosen));
  return chosen;
}

void AveragedRows::number(const AveragedElement& element, Blocks& blocks, Scratch& scratch) const {
  const auto add = [](const std::vector<int>& functions, std::vector<int>& places,
                      std::vector<int>& numbered) {
    for (const int function : functions) {
      if (places[function] >= 0) continue;
      places[function] = static_cast<int>(numbered.size());
      numbered.push_back(function);
    }
  };
  std::vector<int> chosen;
  for (const int e : inPart(element.near, chosen)) {
    add(surface_.coefficients(e), scratch.placeOfCoefficient, blocks.coefficients);
    add(surface_.slots(e), scratch.placeOfSlot, blocks.slots);
  }
}

void AveragedRows::addSums(int element, const Eigen::Vector3d& x, const ElementPlace* inside,
                           Index column, Scratch& scratch) const {
  quadrature_.integrate(element, x, inside, *scratch.quadrature);
  const std::vector<KernelSums>& sums = scratch.quadrature->sums;
  std::vector<int>& places = scratch.elements;
  places.clear();
  for (const int coefficient : surface_.coefficients(element))
    places.push_back(scratch.placeOfCoefficient[coefficient]);
  for (const int slot : surface_.slots(element)) places.push_back(scratch.placeOfSlot[slot]);
  loops_.addSums({sums.data(), static_cast<int>(sums.size()), places.data(),
                  places.data() + surface_.coefficients(element).size(),
                  scratch.T.col(column).data(), scratch.U.col(column).data()});
}

void AveragedRows::subtractTranslation(const AveragedElement& element,
                                       std::span<const Total> totals, Scratch& scratch) const {
  using Sums = Eigen::Matrix<double, kKernelSumsT, 1>;
  const std::vector<int>& coefficients = surface_.coefficients(element.element);
  const auto pointCount = static_cast<Index>(element.points.size());
  const auto totalOf = [&](Index column) {
    return Sums(Eigen::Map<const Eigen::MatrixXd>(scratch.T.col(column).data(), kKernelSumsT,
                                                  (scratch.T.rows() - kSumsPadding) / kKernelSumsT)
                    .rowwise()
                    .sum());
  };
  Eigen::MatrixXd ofNodes(kKernelSumsT, static_cast<Index>(element.nodes.size()));
  for (Index k = 0; k < ofNodes.cols(); ++k)
    ofNodes.col(k) =
        totalOf(pointCount + k) + Eigen::Map<const Sums>(totals[element.nodes[k]].data());
  const Eigen::MatrixXd far = ofNodes * element.interpolated;
  for (Index q = 0; q < pointCount; ++q) {
    // The near total has errors of singular integrals that cancel at the point itself.
    const Sums total = totalOf(q) + far.col(q);
    surface_.evaluateBasis(element.points[q].places.front(), scratch.basis);
    for (std::size_t f = 0; f < coefficients.size(); ++f)
      scratch.T.col(q).segment<kKernelSumsT>(
          kKernelSumsT * scratch.placeOfCoefficient[coefficients[f]]) -= scratch.basis[f] * total;
  }
}

AveragedRows::Blocks AveragedRows::blocks(const AveragedElement& element,
                                          std::span<const Total> totals, Scratch& scratch) const {
  Blocks blocks;
  number(element, blocks, scratch);
  const auto points = static_cast<Index>(element.points.size()),
             nodes = static_cast<Index>(element.nodes.size()),
             coefficients = static_cast<Index>(blocks.coefficients.size()),
             slots = static_cast<Index>(blocks.slots.size());
  if (coefficients == 0) return blocks;
  scratch.T.setZero(kKernelSumsT * coefficients + kSumsPadding, points + nodes);
  scratch.U.setZero(kKernelSumsU * slots + kSumsPadding, points + nodes);
  std::vector<int> chosen, others;
  // By elements: their quadrature points are used for all points.
  for (const int e : inPart(element.near, chosen))
    for (Index q = 0; q < points; ++q) {
      const CollocationPlace& point = element.points[q];
      addSums(e, point.position, placeIn(point, e), q, scratch);
    }
  for (Index k = 0; k < nodes; ++k) {
    const std::vector<int>& leftOut = leftOut_[element.nodes[k]];
    others.clear();
    std::set_difference(element.near.begin(), element.near.end(), leftOut.begin(), leftOut.end(),
                        std::back_inserter(others));
    for (const int e : inPart(others, chosen))
      addSums(e, equations_.points[element.nodes[k]].position, nullptr, points + k, scratch);
    scratch.T.col(points + k) *= -1;
    scratch.U.col(points + k) *= -1;
  }
  if (!part_) subtractTranslation(element, totals, scratch);
  Eigen::MatrixXd weights(points + nodes, static_cast<Index>(element.equations.size()));
  weights.topRows(points) = element.weights.transpose();
  weights.bottomRows(nodes) = element.interpolated * element.weights.transpose();
  scratch.ofT.noalias() = scratch.T * weights;
  scratch.ofU.noalias() = scratch.U * weights;
  blocks.H = blocksOf<detail::BlockT>(constants_, scratch.ofT, coefficients);
  blocks.G = blocksOf<detail::BlockU>(constants_, scratch.ofU, slots);
  for (const int each : blocks.coefficients) scratch.placeOfCoefficient[each] = -1;
  for (const int each : blocks.slots) scratch.placeOfSlot[each] = -1;
  return blocks;
}

}  // namespace palpa::bem
