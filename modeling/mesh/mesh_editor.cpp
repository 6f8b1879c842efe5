#include "modeling/mesh/mesh_editor.h"

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <numbers>
#include <set>

#include "modeling/mesh/triangle_shape.h"

namespace palpa::modeling {
namespace {

constexpr double kGoodAngle = 35.0 * std::numbers::pi / 180.0;
constexpr double kTurn = 20.0 * std::numbers::pi / 180.0;  // nodes at stronger bends must remain
constexpr double kSmallGain = 1e-6;   // of the penalty; smaller gains do not justify a change
constexpr double kAlongNormal = 0.3;  // least cosine between a triangle's normal and the surface's

}  // namespace

MeshEditor::MeshEditor(WorkMesh mesh, std::vector<RegionBorder> borders, Job job)
    : mesh_(std::move(mesh)),
      borders_(std::move(borders)),
      around_(mesh_.nodes.size()),
      job_(std::move(job)) {
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    for (int node : mesh_.triangles[t].nodes) around_[node].push_back(static_cast<int>(t));
}

WorkMesh MeshEditor::take() {
  std::vector<int> number(mesh_.nodes.size(), -1);
  std::vector<WorkNode> nodes;
  for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) {
    if (around_[i].empty()) continue;
    number[i] = static_cast<int>(nodes.size());
    nodes.push_back(std::move(mesh_.nodes[i]));
  }
  std::erase_if(mesh_.triangles, [](const WorkTriangle& t) { return t.patch < 0; });
  for (WorkTriangle& triangle : mesh_.triangles)
    for (int& node : triangle.nodes) node = number[node];
  mesh_.nodes = std::move(nodes);
  around_.clear();
  return std::move(mesh_);
}

int MeshEditor::leftOf(int a, int b) const {
  for (int t : around_[a]) {
    const auto& n = mesh_.triangles[t].nodes;
    for (int k = 0; k < 3; ++k)
      if (n[k] == a && n[(k + 1) % 3] == b) return t;
  }
  return -1;
}

bool MeshEditor::isInterface(int a, int b) const {
  const WorkTriangle& left = mesh_.triangles[leftOf(a, b)];
  const WorkTriangle& right = mesh_.triangles[leftOf(b, a)];
  return left.patch != right.patch || left.sides != right.sides;
}

std::vector<int> MeshEditor::neighbours(int node) const {
  std::vector<int> result;
  for (int t : around_[node])
    for (int other : mesh_.triangles[t].nodes)
      if (other != node) result.push_back(other);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<int> MeshEditor::interfaceNeighbours(int node) const {
  const auto& first = mesh_.triangles[around_[node].front()];
  const bool plain = std::all_of(around_[node].begin(), around_[node].end(), [&](int t) {
    return mesh_.triangles[t].patch == first.patch && mesh_.triangles[t].sides == first.sides;
  });
  if (plain) return {};
  std::vector<int> result = neighbours(node);
  std::erase_if(result, [&](int other) { return !isInterface(node, other); });
  return result;
}

WorkNode MeshEditor::between(int a, int b, double s) const {
  const WorkTriangle& left = mesh_.triangles[leftOf(a, b)];
  const WorkTriangle& right = mesh_.triangles[leftOf(b, a)];
  // In coarse meshes an edge inside a patch can join nodes on two edges of the solid. The solid's
  // edge counts only if the patches differ here.
  if (left.patch != right.patch) return mesh_.between(a, b, left.patch, s);
  const SurfaceParameter& p = mesh_.in(a, left.patch);
  const SurfaceParameter& q = mesh_.in(b, left.patch);
  return mesh_.nodeInPatch({left.patch, p.u + s * (q.u - p.u), p.v + s * (q.v - p.v)});
}

int MeshEditor::split(int a, int b, double s) {
  const WorkNode plain = between(a, b, s);
  const double length = (position(a) - position(b)).norm();
  const std::uint64_t differing =
      mesh_.triangles[leftOf(a, b)].sides ^ mesh_.triangles[leftOf(b, a)].sides;
  const int middle = split(a, b, plain);
  if (plain.edge >= 0 || differing == 0) return middle;
  // If a node only counts as on the border, the border can run outside the triangles here. Then the
  // middle of the edge is used.
  WorkNode fitted = onBorder(plain, borders_[std::countr_zero(differing)]);
  if ((fitted.position - plain.position).norm() < 0.25 * length) move(middle, std::move(fitted));
  return middle;
}

int MeshEditor::split(int a, int b, WorkNode node) {
  checkpoint();
  const int middle = static_cast<int>(mesh_.nodes.size());
  const std::array<std::pair<int, int>, 2> halves{{{leftOf(a, b), b}, {leftOf(b, a), a}}};
  mesh_.nodes.push_back(std::move(node));
  around_.emplace_back();
  for (const auto& [t, end] : halves) {
    // (start, end, apex) becomes (start, middle, apex) and (middle, end, apex).
    const WorkTriangle old = mesh_.triangles[t];
    std::array<int, 3> kept = old.nodes;
    std::array<int, 3> added = old.nodes;
    const int start = end == b ? a : b;
    std::replace(kept.begin(), kept.end(), end, middle);
    std::replace(added.begin(), added.end(), start, middle);
    replace(t, kept);
    mesh_.triangles.push_back({added, old.patch, old.sides});
    for (int n : added) around_[n].push_back(static_cast<int>(mesh_.triangles.size()) - 1);
  }
  return middle;
}

void MeshEditor::replace(int triangle, const std::array<int, 3>& nodes) {
  for (int node : mesh_.triangles[triangle].nodes) std::erase(around_[node], triangle);
  mesh_.triangles[triangle].nodes = nodes;
  for (int node : nodes) around_[node].push_back(triangle);
}

double MeshEditor::shapePenalty(int a, int b, int c) const {
  const double missing =
      std::max(0.0, 1.0 - smallestAngle(position(a), position(b), position(c)) / kGoodAngle);
  return missing * missing;
}

double MeshEditor::penalty(int triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle].nodes;
  return shapePenalty(a, b, c);
}

double MeshEditor::smallestAngleOf(int triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle].nodes;
  return smallestAngle(position(a), position(b), position(c));
}

bool MeshEditor::isValid(int a, int b, int c, int patch) const {
  const SurfaceParameter& p = mesh_.in(a, patch);
  const SurfaceParameter& q = mesh_.in(b, patch);
  const SurfaceParameter& r = mesh_.in(c, patch);
  const double area = (q.u - p.u) * (r.v - p.v) - (r.u - p.u) * (q.v - p.v);
  const auto [uLow, uHigh] = mesh_.surface->range(patch, 0);
  const auto [vLow, vHigh] = mesh_.surface->range(patch, 1);
  if (area <= 1e-12 * (uHigh - uLow) * (vHigh - vLow)) return false;
  const Eigen::Vector3d normal = (position(b) - position(a)).cross(position(c) - position(a));
  const Eigen::Vector3d surface =
      mesh_.surface->normal(patch, (p.u + q.u + r.u) / 3.0, (p.v + q.v + r.v) / 3.0);
  return normal.dot(surface) > kAlongNormal * normal.norm();
}

bool MeshEditor::starIsValid(int node) const {
  return std::all_of(around_[node].begin(), around_[node].end(), [&](int t) {
    const auto& [a, b, c] = mesh_.triangles[t].nodes;
    return isValid(a, b, c, mesh_.triangles[t].patch);
  });
}

double MeshEditor::starPenalty(int node) const {
  double sum = 0.0;
  for (int t : around_[node]) sum += penalty(t);
  return sum;
}

bool MeshEditor::flip(int a, int b) {
  checkpoint();
  const int t0 = leftOf(a, b);
  const int t1 = leftOf(b, a);
  if (t0 < 0 || t1 < 0 || isInterface(a, b)) return false;
  const auto apex = [&](int t) {
    for (int node : mesh_.triangles[t].nodes)
      if (node != a && node != b) return node;
    return -1;
  };
  const int c = apex(t0);
  const int d = apex(t1);
  const double before = penalty(t0) + penalty(t1);
  if (before <= 0.0 || leftOf(c, d) >= 0 || leftOf(d, c) >= 0) return false;
  if (shapePenalty(a, d, c) + shapePenalty(d, b, c) >= before - kSmallGain) return false;
  const int patch = mesh_.triangles[t0].patch;
  if (!isValid(a, d, c, patch) || !isValid(d, b, c, patch)) return false;
  replace(t0, {a, d, c});
  replace(t1, {d, b, c});
  return true;
}

bool MeshEditor::turnsAt(int node, int before, int after) const {
  const Eigen::Vector3d in = position(node) - position(before);
  const Eigen::Vector3d out = position(after) - position(node);
  return in.dot(out) < std::cos(kTurn) * in.norm() * out.norm();
}

bool MeshEditor::collapse(int from, int to) {
  checkpoint();
  if (mesh_.nodes[from].isCorner()) return false;
  const std::vector<int> rails = interfaceNeighbours(from);
  if (!rails.empty() &&
      (rails.size() != 2 || std::find(rails.begin(), rails.end(), to) == rails.end()))
    return false;
  if (!rails.empty() && turnsAt(from, rails[0], rails[1])) return false;
  // Only the two triangles at the edge may disappear; more common neighbours would pinch the mesh.
  const std::vector<int> first = neighbours(from);
  const std::vector<int> second = neighbours(to);
  std::vector<int> common;
  std::set_intersection(first.begin(), first.end(), second.begin(), second.end(),
                        std::back_inserter(common));
  if (common.size() != 2 || first.size() <= 3) return false;
  for (int node : common)
    if (around_[node].size() <= 3) return false;

  double after = 0.0;
  double longestBefore = 0.0;
  for (int node : first)
    longestBefore = std::max(longestBefore, (position(node) - position(from)).norm());
  for (int t : around_[from]) {
    auto nodes = mesh_.triangles[t].nodes;
    if (std::find(nodes.begin(), nodes.end(), to) != nodes.end()) continue;
    std::replace(nodes.begin(), nodes.end(), from, to);
    if (!isValid(nodes[0], nodes[1], nodes[2], mesh_.triangles[t].patch)) return false;
    after += shapePenalty(nodes[0], nodes[1], nodes[2]);
    for (int node : nodes)
      if ((position(node) - position(to)).norm() > 1.6 * longestBefore) return false;
  }
  if (after >= starPenalty(from) - kSmallGain) return false;
  const std::vector<int> star = around_[from];
  for (int t : star) {
    auto nodes = mesh_.triangles[t].nodes;
    if (std::find(nodes.begin(), nodes.end(), to) != nodes.end()) {
      for (int node : nodes) std::erase(around_[node], t);
      mesh_.triangles[t].patch = -1;
    } else {
      std::replace(nodes.begin(), nodes.end(), from, to);
      replace(t, nodes);
    }
  }
  return true;
}

WorkNode MeshEditor::shifted(const WorkNode& node, const Eigen::Vector3d& step) const {
  const SurfaceParameter& at = node.at.front();
  const SurfacePoint p = mesh_.surface->evaluate(at.patch, at.u, at.v);
  // Parameter step δ that moves the point by `step` in its tangent plane: (JᵀJ) δ = Jᵀ step. The
  // small diagonal term is for places where du and dv are nearly parallel.
  Eigen::Matrix<double, 3, 2> jacobian;
  jacobian << p.du, p.dv;
  Eigen::Matrix2d metric = jacobian.transpose() * jacobian;
  metric.diagonal().array() += 1e-6 * metric.trace();
  const Eigen::Vector2d delta = metric.inverse() * (jacobian.transpose() * step);
  const auto [uLow, uHigh] = mesh_.surface->range(at.patch, 0);
  const auto [vLow, vHigh] = mesh_.surface->range(at.patch, 1);
  return mesh_.nodeInPatch({at.patch, std::clamp(at.u + delta[0], uLow, uHigh),
                            std::clamp(at.v + delta[1], vLow, vHigh)});
}

WorkNode MeshEditor::onBorder(WorkNode node, const RegionBorder& border) const {
  // Newton's method along the steepest tangential direction of the border's value.
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double value = border.value(node.position);
    const SurfaceParameter& at = node.at.front();
    const Eigen::Vector3d surface = mesh_.surface->normal(at.patch, at.u, at.v);
    const Eigen::Vector3d gradient = border.gradient(node.position);
    const Eigen::Vector3d slope = gradient - gradient.dot(surface) * surface;
    if (value == 0.0 || slope.squaredNorm() < 1e-8 * border.slope() * border.slope()) break;
    node = shifted(node, -value / slope.squaredNorm() * slope);
  }
  return node;
}

bool MeshEditor::tryPosition(int node, const WorkNode& where, double before) {
  const WorkNode old = mesh_.nodes[node];
  mesh_.nodes[node] = where;
  if (starPenalty(node) < before - kSmallGain && starIsValid(node)) return true;
  mesh_.nodes[node] = old;
  return false;
}

bool MeshEditor::move(int node, WorkNode where) {
  checkpoint();
  std::swap(mesh_.nodes[node], where);
  if (starIsValid(node)) return true;
  std::swap(mesh_.nodes[node], where);
  return false;
}

bool MeshEditor::smooth(int node) {
  checkpoint();
  const double before = starPenalty(node);
  if (before <= 0.0 || mesh_.nodes[node].isCorner()) return false;
  const std::vector<int> rails = interfaceNeighbours(node);
  if (!rails.empty() && rails.size() != 2) return false;
  const std::vector<int> ring = rails.empty() ? neighbours(node) : rails;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int other : ring) middle += position(other) / static_cast<double>(ring.size());
  std::vector<Eigen::Vector3d> targets{middle};
  // If the middle does not help: away from or towards single neighbours.
  for (int other : ring) targets.push_back(2.0 * position(node) - position(other));

  for (const Eigen::Vector3d& target : targets)
    for (double part : {1.0, 0.5, 0.2}) {
      const Eigen::Vector3d step = part * (target - position(node));
      WorkNode moved;
      if (rails.empty()) {
        moved = shifted(mesh_.nodes[node], step);
      } else if (mesh_.nodes[node].edge >= 0) {
        // Along the solid's edge, towards one of the two neighbours on it.
        const Eigen::Vector3d ahead = position(rails[1]) - position(rails[0]);
        const double along = step.dot(ahead) / ahead.squaredNorm();
        const int towards = along > 0.0 ? rails[1] : rails[0];
        const double whole = (position(towards) - position(node)).norm();
        moved = between(node, towards,
                        std::min(0.9, std::abs(along) * ahead.norm() / std::max(whole, 1e-300)));
        if (moved.edge != mesh_.nodes[node].edge) continue;
      } else {
        const std::uint64_t differing = mesh_.triangles[leftOf(node, rails[0])].sides ^
                                        mesh_.triangles[leftOf(rails[0], node)].sides;
        moved = onBorder(shifted(mesh_.nodes[node], step), borders_[std::countr_zero(differing)]);
      }
      if (tryPosition(node, moved, before)) return true;
    }
  return false;
}

}  // namespace palpa::modeling
