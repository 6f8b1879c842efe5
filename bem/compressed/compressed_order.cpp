#include "bem/compressed/compressed_order.h"

#include <algorithm>
#include <limits>

#include "base/byte_reader.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::Vector3d;

namespace {

/// Leaves have half as many nodes at least. The equations keep the integrals over nearer elements
/// in any case.
constexpr int kLeafSize = 40;

/// Node beside each point: the node of its equation, or the node itself.
std::vector<int> nodesOfPoints(const ElementSurface& surface, const WeightedEquations& equations,
                               const std::vector<Vector3d>& nodes) {
  std::vector<int> nodeOf(equations.points.size(), -1);
  for (const AveragedElement& element : equations.averaged)
    for (std::size_t k = 0; k < element.nodes.size(); ++k)
      nodeOf[element.nodes[k]] = surface.coefficients(element.element)[k];
  for (std::size_t p = 0; p < equations.points.size(); ++p) {
    if (nodeOf[p] >= 0) continue;
    // The nearest node of an element with the point.
    const CollocationPlace& place = equations.points[p];
    double least = std::numeric_limits<double>::infinity();
    for (const int candidate : surface.coefficients(place.places.front().element))
      if (const double distance = (nodes[candidate] - place.position).squaredNorm();
          distance < least) {
        least = distance;
        nodeOf[p] = candidate;
      }
  }
  return nodeOf;
}

std::vector<int> inverseOf(const std::vector<int>& list) {
  std::vector<int> inverse(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) inverse[list[k]] = static_cast<int>(k);
  return inverse;
}

/// Throws DamagedData unless the list orders 0 … size() - 1 and `first` divides it into `parts`.
void check(const std::vector<int>& list, const std::vector<int>& first, std::size_t parts) {
  const auto n = static_cast<int>(list.size());
  if (first.size() != parts + 1 || first.front() != 0 || first.back() != n ||
      !std::is_sorted(first.begin(), first.end()) ||
      std::any_of(list.begin(), list.end(), [n](int k) { return k < 0 || k >= n; }))
    throw DamagedData();
}

}  // namespace

void write(const CompressedOrder& order, const ByteSink& sink) {
  order.tree.write(sink);
  for (const auto* list : {&order.slots, &order.firstSlot, &order.points, &order.firstPoint})
    writeList(sink, *list);
}

CompressedOrder readCompressedOrder(const ByteSource& source) {
  CompressedOrder order;
  order.tree = ClusterTree(source);
  for (auto* list : {&order.slots, &order.firstSlot, &order.points, &order.firstPoint})
    *list = readList<int>(source);
  check(order.slots, order.firstSlot, order.positionCount());
  check(order.points, order.firstPoint, order.positionCount());
  order.slotPositionOf = inverseOf(order.slots);
  order.pointPositionOf = inverseOf(order.points);
  return order;
}

CompressedOrder makeCompressedOrder(const ElementSurface& surface,
                                    const WeightedEquations& equations,
                                    const std::vector<Vector3d>& nodes,
                                    const TractionSlots& slots) {
  CompressedOrder order;
  order.tree = ClusterTree(nodes, kLeafSize);
  std::vector<std::vector<int>> pointsOfNode(nodes.size());
  const std::vector<int> nodeOf = nodesOfPoints(surface, equations, nodes);
  for (std::size_t p = 0; p < nodeOf.size(); ++p)
    pointsOfNode[nodeOf[p]].push_back(static_cast<int>(p));
  order.firstSlot.push_back(0);
  order.firstPoint.push_back(0);
  for (const int node : order.tree.order()) {
    for (int s = slots.firstOfNode[node]; s < slots.firstOfNode[node + 1]; ++s)
      order.slots.push_back(s);
    order.firstSlot.push_back(static_cast<int>(order.slots.size()));
    order.points.insert(order.points.end(), pointsOfNode[node].begin(), pointsOfNode[node].end());
    order.firstPoint.push_back(static_cast<int>(order.points.size()));
  }
  order.slotPositionOf = inverseOf(order.slots);
  order.pointPositionOf = inverseOf(order.points);
  return order;
}

}  // namespace palpa::bem
