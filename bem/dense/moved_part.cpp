#include "bem/dense/moved_part.h"

namespace palpa::bem {
namespace {

/// Part of the given elements: their corners or functions and their slots.
template <class Functions, class Slots>
ElementPart partOf(std::vector<int> elements, int coefficientCount, int slotCount,
                   const Functions& functions, const Slots& slots) {
  std::vector<bool> hasCoefficient(coefficientCount), hasSlot(slotCount);
  for (const int e : elements) {
    for (const int k : functions(e)) hasCoefficient[k] = true;
    for (const int s : slots(e)) hasSlot[s] = true;
  }
  return {std::move(elements), indicesWhere(hasCoefficient), indicesWhere(hasSlot)};
}

}  // namespace

std::optional<MovedPart> findMovedPart(const BoundaryMesh& before, const BoundaryMesh& mesh,
                                       const TractionSlots& slots,
                                       const std::vector<CollocationPoint>& pointsBefore,
                                       const std::vector<CollocationPoint>& points) {
  if (before.nodeCount() != mesh.nodeCount() || before.triangles != mesh.triangles ||
      before.smoothingGroups != mesh.smoothingGroups || before.tags != mesh.tags ||
      pointsBefore.size() != points.size())
    return std::nullopt;
  MovedPart part;
  for (std::size_t p = 0; p < points.size(); ++p)
    part.isOwnRow.push_back(points[p].position != pointsBefore[p].position ||
                            points[p].triangle != pointsBefore[p].triangle);
  const auto hasMoved = [&](int node) { return before.nodes[node] != mesh.nodes[node]; };
  std::vector<int> elements;
  for (int t = 0; t < mesh.triangleCount(); ++t)
    if (std::any_of(mesh.triangles[t].begin(), mesh.triangles[t].end(), hasMoved))
      elements.push_back(t);
  part.moved = partOf(
      std::move(elements), mesh.nodeCount(),
      slots.count(), [&](int t) -> const auto& { return mesh.triangles[t]; },
      [&](int t) -> const auto& { return slots.ofCorner[t]; });
  return part;
}

std::optional<MovedPart> findMovedPart(std::optional<std::vector<int>> elements,
                                       const ElementSurface& surface,
                                       const WeightedEquations& equationsBefore,
                                       const WeightedEquations& equations) {
  const auto &weights = equations.weights, &weightsBefore = equationsBefore.weights;
  if (!elements || weights.rows() != weightsBefore.rows() ||
      weights.cols() != weightsBefore.cols() || weights.nonZeros() != weightsBefore.nonZeros() ||
      equations.averaged.size() != equationsBefore.averaged.size())
    return std::nullopt;
  MovedPart part;
  part.isOwnRow.assign(weights.rows(), false);
  const std::vector<int> place = placesIn(*elements, surface.elementCount());
  std::vector<bool> isNode(equations.points.size(), false);
  for (const AveragedElement& averaged : equations.averaged) {
    for (const int node : averaged.nodes) isNode[node] = true;
    if (place[averaged.element] >= 0)
      for (const int equation : averaged.equations) part.isOwnRow[equation] = true;
  }
  for (Eigen::Index p = 0; p < weights.cols(); ++p) {
    const CollocationPlace& point = equations.points[p];
    // A point on the border of the moved part does not move, but its free term may change. The
    // nodes of averaged elements only stand for points inside of them.
    const bool hasMoved =
        !isNode[p] && (point.position != equationsBefore.points[p].position ||
                       std::any_of(point.places.begin(), point.places.end(),
                                   [&](const ElementPlace& at) { return place[at.element] >= 0; }));
    Eigen::SparseMatrix<double>::InnerIterator w(weights, p), old(weightsBefore, p);
    for (; w && old; ++w, ++old) {
      if (w.row() != old.row()) return std::nullopt;
      if (hasMoved || w.value() != old.value()) part.isOwnRow[w.row()] = true;
    }
    if (w || old) return std::nullopt;
  }
  part.moved = partOf(
      std::move(*elements), surface.coefficientCount(),
      surface.slotCount(), [&](int e) -> const auto& { return surface.coefficients(e); },
      [&](int e) -> const auto& { return surface.slots(e); });
  return part;
}

std::optional<std::vector<int>> movedElements(const QuadraticDiscretisation& before,
                                              const QuadraticDiscretisation& after) {
  const BoundaryMesh &old = before.mesh(), &mesh = after.mesh();
  if (old.nodeCount() != mesh.nodeCount() || old.triangles != mesh.triangles ||
      old.smoothingGroups != mesh.smoothingGroups || old.tags != mesh.tags)
    return std::nullopt;
  std::vector<int> elements;
  for (int e = 0; e < after.elementCount(); ++e) {
    const std::vector<int>& nodes = after.surface().coefficients(e);
    if (std::any_of(nodes.begin(), nodes.end(),
                    [&](int node) { return old.nodes[node] != mesh.nodes[node]; }))
      elements.push_back(e);
  }
  return elements;
}

}  // namespace palpa::bem
