#include "bench/peers/tetrahedra.h"

#include <Eigen/Dense>
#include <algorithm>

#include "bem/base/triangle_rule.h"
#include "bench/peers/tetrahedron_functions.h"

namespace palpa::bench {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>;

Edge edgeOf(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

bool isInsideOut(const TetrahedralMesh& mesh, const std::array<int, 10>& tetrahedron) {
  Eigen::Matrix<double, 3, 10> nodes;
  for (int k = 0; k < 10; ++k) nodes.col(k) = mesh.nodes[tetrahedron[k]];
  // The corners are where edges that bend turn an element first.
  for (int corner = 0; corner < 4; ++corner)
    if ((nodes * quadraticSlopes(Eigen::Vector4d::Unit(corner))).determinant() <= 0) return true;
  for (const TetrahedronPoint& point : tetrahedronRule(true))
    if ((nodes * quadraticSlopes(point.barycentric)).determinant() <= 0) return true;
  return false;
}

}  // namespace

double TetrahedralMesh::volume() const {
  double sum = 0;
  for (const auto& t : tetrahedra) {
    const Vector3d &a = nodes[t[0]], &b = nodes[t[1]], &c = nodes[t[2]], &d = nodes[t[3]];
    sum += (b - a).cross(c - a).dot(d - a) / 6;
  }
  return sum;
}

TetrahedralMesh makeQuadratic(const TetrahedralMesh& linear, const EdgeMiddle& middle) {
  TetrahedralMesh mesh = linear;
  mesh.isQuadratic = true;
  std::vector<Edge> edges;
  edges.reserve(6 * mesh.tetrahedra.size());
  for (const auto& t : mesh.tetrahedra)
    for (const auto& [a, b] : kTetrahedronEdges) edges.push_back(edgeOf(t[a], t[b]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const int corners = linear.nodeCount();
  const auto middleOf = [&](int a, int b) {
    const auto place = std::lower_bound(edges.begin(), edges.end(), edgeOf(a, b));
    return corners + static_cast<int>(place - edges.begin());
  };
  for (const auto& [a, b] : edges) mesh.nodes.push_back((mesh.nodes[a] + mesh.nodes[b]) / 2);
  for (auto& t : mesh.tetrahedra)
    for (int k = 0; k < 6; ++k)
      t[4 + k] = middleOf(t[kTetrahedronEdges[k].first], t[kTetrahedronEdges[k].second]);
  std::vector<Vector3d> straight(mesh.nodes);
  for (auto& face : mesh.faces)
    for (int k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3], m = face[3 + k] = middleOf(a, b);
      if (!middle) continue;
      const Vector3d normal =
          (mesh.nodes[face[1]] - mesh.nodes[face[0]]).cross(mesh.nodes[face[2]] - mesh.nodes[a]);
      const Vector3d moved = middle(mesh.nodes[a], mesh.nodes[b], normal.normalized());
      if ((moved - straight[m]).norm() > (mesh.nodes[m] - straight[m]).norm())
        mesh.nodes[m] = moved;
    }
  if (!middle) return mesh;
  for (const auto& t : mesh.tetrahedra)
    if (isInsideOut(mesh, t))
      for (int k = 4; k < 10; ++k) mesh.nodes[t[k]] = straight[t[k]];
  return mesh;
}

FaceFunctions::FaceFunctions(bool isQuadratic, const Vector3d& b) {
  constexpr double kSlopes[2][3] = {{-1, 1, 0}, {-1, 0, 1}};  // of the barycentric coordinates
  if (!isQuadratic) {
    for (int k = 0; k < 3; ++k) {
      value[k] = b[k];
      for (int d = 0; d < 2; ++d) slope[d][k] = kSlopes[d][k];
    }
    return;
  }
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    value[k] = b[k] * (2 * b[k] - 1);
    value[3 + k] = 4 * b[k] * b[next];
    for (int d = 0; d < 2; ++d) {
      slope[d][k] = (4 * b[k] - 1) * kSlopes[d][k];
      slope[d][3 + k] = 4 * (b[k] * kSlopes[d][next] + b[next] * kSlopes[d][k]);
    }
  }
}

void visitFaces(
    const TetrahedralMesh& mesh, std::span<const int> faces, int pieces,
    const std::function<void(int, const FaceFunctions&, const Vector3d&, const Vector3d&)>& visit) {
  struct Point {
    FaceFunctions functions;
    double weight;  // of half the cross product of the slopes
  };
  std::vector<Point> points;
  // A triangle of `pieces` rows: upright parts, and between them upside-down ones.
  for (int i = 0; i < pieces; ++i)
    for (int j = 0; i + j < pieces; ++j)
      for (const int turn : {1, -1}) {
        if (turn < 0 && i + j + 1 >= pieces) continue;
        for (const bem::TrianglePoint& q : bem::triangleRule16()) {
          const double from = turn > 0 ? 0 : 1;
          const double u = (i + from + turn * q.barycentric[1]) / pieces,
                       v = (j + from + turn * q.barycentric[2]) / pieces;
          points.push_back({FaceFunctions(mesh.isQuadratic, {1 - u - v, u, v}),
                            q.weight / 2 / (pieces * pieces)});
        }
      }
  for (const int face : faces)
    for (const Point& point : points) {
      Vector3d position = Vector3d::Zero(), along[2] = {Vector3d::Zero(), Vector3d::Zero()};
      for (int k = 0; k < mesh.faceNodes(); ++k) {
        const Vector3d& node = mesh.nodes[mesh.faces[face][k]];
        position += point.functions.value[k] * node;
        for (int d = 0; d < 2; ++d) along[d] += point.functions.slope[d][k] * node;
      }
      visit(face, point.functions, position, point.weight * along[0].cross(along[1]));
    }
}

}  // namespace palpa::bench
