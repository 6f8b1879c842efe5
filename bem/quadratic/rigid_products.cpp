#include "bem/quadratic/rigid_products.h"

#include <algorithm>
#include <span>

#include "bem/base/triangle_rule.h"
#include "bem/element/rigid_motions.h"
#include "bem/quadratic/quadratic_assembly.h"
#include "bem/quadratic/quartered_mesh.h"

namespace palpa::bem {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// True if the displacement functions of an element do not follow rotations: its position is none
/// of them.
bool isCurvedBesideBorder(const QuadraticSurface& surface, int element) {
  if (surface.coordinates(element).isPlain()) return false;
  constexpr double kRounding = 1e-9;  // of the body's size
  const std::vector<int>& nodes = surface.coefficients(element);
  std::vector<double> basis;
  for (const TrianglePoint& point : triangleRule7()) {
    const ElementPlace place{element, point.barycentric[1], point.barycentric[2]};
    surface.evaluateBasis(place, basis);
    Vector3d difference = surface.position(place);
    for (std::size_t f = 0; f < nodes.size(); ++f)
      difference -= basis[f] * surface.nodes()[nodes[f]];
    if (difference.norm() > kRounding * surface.boundingSize()) return true;
  }
  return false;
}

std::vector<int> sortedOnce(std::vector<int> list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

ElementPart partOf(const QuadraticSurface& surface, const std::vector<int>& elements) {
  std::vector<int> coefficients, slots;
  for (const int e : elements) {
    coefficients.insert(coefficients.end(), surface.coefficients(e).begin(),
                        surface.coefficients(e).end());
    slots.insert(slots.end(), surface.slots(e).begin(), surface.slots(e).end());
  }
  return {elements, sortedOnce(std::move(coefficients)), sortedOnce(std::move(slots))};
}

/// The same surface with functions that follow rotations in all elements.
QuadraticSurface withoutBorders(const QuadraticDiscretisation& on) {
  const QuadraticSurface& surface = on.surface();
  BoundaryMesh mesh = on.mesh();
  for (int e = 0; e < surface.elementCount(); ++e)
    if (!surface.coordinates(e).isPlain())
      for (std::size_t k = 3; k < kQuadraticNodes.size(); ++k)
        mesh.nodes[surface.coefficients(e)[k]] =
            surface.geometricJet(e, kQuadraticNodes[k]).position;
  return {mesh, on.slots()};
}

MatrixXd rowsOf(const MatrixXd& matrix, const std::vector<int>& nodes) {
  MatrixXd some(3 * static_cast<Index>(nodes.size()), matrix.cols());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    some.middleRows<3>(3 * static_cast<Index>(k)) =
        matrix.middleRows<3>(3 * static_cast<Index>(nodes[k]));
  return some;
}

/// Copies the products of some equations to their places among all.
void setProducts(const MatrixXd& ofSome, std::span<const int> equations, MatrixXd& all) {
  const Index count = all.rows() / 3, some = ofSome.rows() / 3;
  for (int i = 0; i < 3; ++i)
    for (Index k = 0; k < some; ++k) all.row(i * count + equations[k]) = ofSome.row(i * some + k);
}

}  // namespace

RigidProducts rigidProducts(const QuadraticDiscretisation& on, const WeightedEquations& equations,
                            const Material& material, const AssemblyOptions& options,
                            const Job& job) {
  const QuadraticSurface& surface = on.surface();
  const Index count = equations.weights.rows();
  Vector3d centre = Vector3d::Zero();
  for (const Vector3d& node : surface.nodes())
    centre += node / static_cast<double>(surface.nodes().size());
  RigidProducts result{rigidMotions(surface.nodes(), centre), MatrixXd::Zero(3 * count, 6),
                       std::vector<bool>(static_cast<std::size_t>(count), true)};
  std::vector<int> curved;
  for (int e = 0; e < surface.elementCount(); ++e)
    if (isCurvedBesideBorder(surface, e)) curved.push_back(e);
  if (curved.empty()) return result;
  // They are integrated twice per equation, which takes longer than compressed operators do.
  constexpr double kMaxShare = 0.03, kMaxCount = 150;
  if (static_cast<double>(curved.size()) >
      std::min(kMaxShare * static_cast<double>(surface.elementCount()), kMaxCount)) {
    result.areKnown.assign(result.areKnown.size(), false);
    return result;
  }
  const auto isBesideBorder = [&](const ElementPlace& place) {
    return !surface.coordinates(place.element).isPlain();
  };
  for (Index p = 0; p < equations.weights.cols(); ++p) {
    const std::vector<ElementPlace>& places = equations.points[p].places;
    if (std::any_of(places.begin(), places.end(), isBesideBorder))
      for (Eigen::SparseMatrix<double>::InnerIterator w(equations.weights, p); w; ++w)
        result.areKnown[w.row()] = false;
  }
  const ElementPart part = partOf(surface, curved);
  const QuadraticSurface other = withoutBorders(on);
  const MatrixXd motions = rowsOf(result.motions, part.coefficients),
                 motionsOfOther = rowsOf(rigidMotions(other.nodes(), centre), part.coefficients);
  const std::vector<int> known = indicesWhere(result.areKnown);
  constexpr std::size_t kAtOnce = 1024;
  for (std::size_t first = 0; first < known.size(); first += kAtOnce) {
    const auto chunk = std::span(known).subspan(first, std::min(kAtOnce, known.size() - first));
    const WeightedEquations some = equations.only(chunk);
    const auto of = assemblePart<double>(surface, part, some, material, options, job),
               ofOther = assemblePart<double>(other, part, some, material, options, job);
    setProducts(of.H.view() * motions - ofOther.H.view() * motionsOfOther, chunk, result.products);
  }
  return result;
}

}  // namespace palpa::bem
