#include "bem/compressed/exact_rows.h"

#include <algorithm>
#include <iterator>

#include "bem/element/kelvin_blocks.h"

namespace palpa::bem {

ExactRows::ExactRows(const ElementSurface& surface, const ElementQuadrature& quadrature,
                     const KelvinConstants& constants, const CompressedOrder& order)
    : surface_(surface),
      quadrature_(quadrature),
      constants_(constants),
      order_(order),
      loops_(kelvinSumLoopsForThisProcessor()),
      elements_(static_cast<std::size_t>(order.tree.count())) {
  const ClusterTree& tree = order.tree;
  const auto addTo = [&](int cluster, int element) {
    // Elements come in ascending order.
    auto& list = elements_[cluster];
    if (list.empty() || list.back() != element) list.push_back(element);
  };
  for (int e = 0; e < surface.elementCount(); ++e)
    for (const int node : surface.coefficients(e)) addTo(tree.leafOf(tree.positionOf()[node]), e);
  for (int c = ClusterTree::firstOf(tree.levelCount() - 1) - 1; c >= 0; --c) {
    const auto &a = elements_[2 * static_cast<std::size_t>(c) + 1],
               &b = elements_[2 * static_cast<std::size_t>(c) + 2];
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(elements_[c]));
  }
}

ExactRows::Scratch ExactRows::makeScratch() const {
  Scratch scratch;
  scratch.quadrature = quadrature_.makeWorkspace();
  return scratch;
}

void ExactRows::compute(const CollocationPlace& point, int cluster, std::span<const int> leftOut,
                        Scratch& scratch, float* rows) const {
  const ClusterTree::Cluster range = order_.tree.cluster(cluster);
  const int firstSlot = order_.firstSlot[range.begin], nodes = range.size(),
            slots = order_.firstSlot[range.end] - firstSlot;
  // One more of each for functions of other clusters.
  scratch.T.assign(static_cast<std::size_t>(kKernelSumsT) * (nodes + 1) + kSumsPadding, 0);
  scratch.U.assign(static_cast<std::size_t>(kKernelSumsU) * (slots + 1) + kSumsPadding, 0);
  auto next = leftOut.begin();
  for (const int e : elements_[cluster]) {
    next = std::find_if(next, leftOut.end(), [e](int left) { return left >= e; });
    if (next != leftOut.end() && *next == e) continue;
    quadrature_.integrate(e, point.position, placeIn(point, e), *scratch.quadrature);
    const std::vector<KernelSums>& sums = scratch.quadrature->sums;
    std::vector<int>& places = scratch.places;
    places.clear();
    const auto add = [&](int position, int first, int count) {
      const int place = position - first;
      places.push_back(place >= 0 && place < count ? place : count);
    };
    for (const int node : surface_.coefficients(e))
      add(order_.tree.positionOf()[node], range.begin, nodes);
    for (const int slot : surface_.slots(e)) add(order_.slotPositionOf[slot], firstSlot, slots);
    loops_.addSums({sums.data(), static_cast<int>(sums.size()), places.data(),
                    places.data() + surface_.coefficients(e).size(), scratch.T.data(),
                    scratch.U.data()});
  }
  const std::ptrdiff_t columns = 3 * (static_cast<std::ptrdiff_t>(nodes) + slots);
  for (int j = 0; j < nodes; ++j)
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c)
        rows[i * columns + 3 * j + c] = static_cast<float>(-detail::BlockT::component(
            constants_, scratch.T.data() + static_cast<std::ptrdiff_t>(kKernelSumsT) * j, i, c));
  for (int s = 0; s < slots; ++s)
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c)
        rows[i * columns + 3 * (nodes + s) + c] = static_cast<float>(detail::BlockU::component(
            constants_, scratch.U.data() + static_cast<std::ptrdiff_t>(kKernelSumsU) * s, i, c));
}

}  // namespace palpa::bem
