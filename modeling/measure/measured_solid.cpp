#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "modeling/error.h"
#include "modeling/measure/measured_surface.h"
#include "modeling/measure/patch_search.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Relative error of positions and derivatives by rounding.
constexpr double kRounding = 1e-12;
/// Edges continue without a corner below this angle, rad.
constexpr double kSmoothTurn = 0.02;
constexpr int kLinePieces = 24;  // per span, of an edge as a line

/// Nodes (in 0 … 1) and weights of Gauss' rule with 5 points, exact for polynomials of degree 9
/// (Abramowitz & Stegun, table 25.4).
constexpr std::array<std::array<double, 2>, 5> kGauss{{{0.046910077030668, 0.118463442528095},
                                                       {0.230765344947158, 0.239314335249683},
                                                       {0.5, 0.284444444444444},
                                                       {0.769234655052842, 0.239314335249683},
                                                       {0.953089922969332, 0.118463442528095}}};

class MeasuredSolid : public MeasuredSurface {
 public:
  explicit MeasuredSolid(const Solid& solid) : solid_(solid), search_(solid) {}

  double size() const override { return search_.size(); }

  PlacePoint at(const MeasuredPlace& place) const override {
    const PatchPoint point = pointOf(place);
    return {point.position, normal(point)};
  }

  EdgePoint edgeAt(const MeasuredPlace& place) const override {
    const Edge edge = edgeOf(place);
    return edgePoint(edge, parameter(place, edge));
  }

  EdgeLine edge(const MeasuredPlace& place) const override {
    const Edge edge = edgeOf(place);
    EdgeLine line;
    const auto [length, error] = lengthOf(edge);
    line.length = length;
    line.accuracy = error;
    line.chainLength = chainLength(solid_.edgeOf(edge.patch, edge.side));
    const auto& spans = search_.spans(edge.patch, edge.direction());
    for (std::size_t i = 1; i < spans.size(); ++i)
      for (int k = i == 1 ? 0 : 1; k <= kLinePieces; ++k)
        line.points.push_back(search_.position(
            edge.patch, uvOf(edge, spans[i - 1] + (spans[i] - spans[i - 1]) * k / kLinePieces)));
    return line;
  }

  /// Principal curvatures are the eigenvalues of I⁻¹ II with the first and second fundamental forms
  /// (do Carmo, Differential Geometry of Curves and Surfaces, section 3.3); the sign is turned, so
  /// that convex is positive with the outward normal.
  Curvatures curvatures(const MeasuredPlace& place) const override {
    PatchPoint point = pointOf(place);
    const Vector3d n = normal(point);
    PatchJet s = search_.jet(point.patch, point.uv);
    if (s.u.cross(s.v).norm() <= 1e-2 * s.u.norm() * s.v.norm()) {
      point.uv = inwards(point);
      s = search_.jet(point.patch, point.uv);
    }
    Eigen::Matrix2d first, second;
    first << s.u.dot(s.u), s.u.dot(s.v), s.u.dot(s.v), s.v.dot(s.v);
    second << s.uu.dot(n), s.uv.dot(n), s.uv.dot(n), s.vv.dot(n);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> eigen(second, first,
                                                                          Eigen::EigenvaluesOnly);
    double a = -eigen.eigenvalues()[0], b = -eigen.eigenvalues()[1];
    if (std::abs(a) < std::abs(b)) std::swap(a, b);
    // Second derivatives are differences of control points, so curvature has an absolute error.
    const double flat = 1e3 * kRounding / size();
    if (std::abs(a) < flat) a = 0;
    if (std::abs(b) < flat) b = 0;
    return {a, b, a == 0 ? 0 : flat / (a * a)};
  }

  Vector3d nearestOn(const MeasuredPlace& place, const Vector3d& x) const override {
    switch (place.what) {
      case MeasuredPlace::What::kFace:
        return search_.nearest(patchOf(place), x).position;
      case MeasuredPlace::What::kEdge:
        return nearestOnEdge(edgeOf(place), x).position;
      case MeasuredPlace::What::kPoint:
        break;
    }
    return at(place).position;
  }

  std::vector<Vector3d> samples(const MeasuredPlace& place) const override {
    if (place.what == MeasuredPlace::What::kPoint) return {at(place).position};
    if (place.what == MeasuredPlace::What::kEdge) return edge(place).points;
    std::vector<Vector3d> points = search_.samples(patchOf(place));
    for (const Side side : kSides) {
      const std::vector<Vector3d> border =
          edge({MeasuredPlace::What::kEdge, place.patch, Vector2d(0, 0), side}).points;
      for (std::size_t i = 0; i < border.size(); i += kLinePieces / 4) points.push_back(border[i]);
    }
    return points;
  }

  Vector3d nearest(const Vector3d& x) const override { return search_.nearest(x).position; }

  std::optional<double> firstHit(const Vector3d& origin, const Vector3d& direction,
                                 double least) const override {
    return search_.firstHit(origin, direction, least);
  }

  double facetHeight(const MeasuredPlace&) const override { return 0; }

  MeasuredPlace placeNear(int patch, const Vector3d& x) const override {
    const PatchPoint found = search_.nearest(patch, x);
    return {MeasuredPlace::What::kPoint, solid_.patches()[patch].name, fractions(found)};
  }

  std::optional<MeasuredPlace> edgeNear(int patch, const Vector3d& x) const override {
    MeasuredPlace best;
    double least = std::numeric_limits<double>::infinity();
    for (const Side side : kSides) {
      const PatchPoint found = nearestOnEdge({patch, side}, x);
      const double distance = (found.position - x).norm();
      if (distance >= least) continue;
      least = distance;
      best = {MeasuredPlace::What::kEdge, solid_.patches()[patch].name, fractions(found), side};
    }
    return best;
  }

 private:
  struct Edge {
    int patch;
    Side side;
    int direction() const { return directionOf(side); }
  };

  int patchOf(const MeasuredPlace& place) const {
    if (const auto patch = solid_.findPatch(place.patch);
        patch && std::holds_alternative<Vector2d>(place.at))
      return *patch;
    throw ModelingError("patch \"" + place.patch +
                        "\": the body has no such patch any more; measure again");
  }

  Edge edgeOf(const MeasuredPlace& place) const { return {patchOf(place), place.side.value()}; }

  Vector2d uvOf(const Edge& edge, double t) const {
    const auto across = search_.range(edge.patch, 1 - edge.direction());
    const bool atEnd = edge.side == Side::kUMax || edge.side == Side::kVMax;
    const double fixed = atEnd ? across[1] : across[0];
    return edge.direction() == 0 ? Vector2d(t, fixed) : Vector2d(fixed, t);
  }

  double parameter(const MeasuredPlace& place, const Edge& edge) const {
    const auto [low, high] = search_.range(edge.patch, edge.direction());
    const double t = std::get<Vector2d>(place.at)[edge.direction()];
    return t >= 1 ? high : low + t * (high - low);
  }

  PatchPoint pointOf(const MeasuredPlace& place) const {
    PatchPoint point{patchOf(place)};
    if (place.what == MeasuredPlace::What::kEdge) {
      const Edge edge = edgeOf(place);
      point.uv = uvOf(edge, parameter(place, edge));
    } else {
      for (int k = 0; k < 2; ++k) {
        const auto [low, high] = search_.range(point.patch, k);
        const double t = std::get<Vector2d>(place.at)[k];
        point.uv[k] = t >= 1 ? high : low + t * (high - low);
      }
    }
    point.position = search_.position(point.patch, point.uv);
    return point;
  }

  Vector2d fractions(const PatchPoint& point) const {
    Vector2d result;
    for (int k = 0; k < 2; ++k) {
      const auto [low, high] = search_.range(point.patch, k);
      result[k] = std::clamp((point.uv[k] - low) / (high - low), 0.0, 1.0);
    }
    return result;
  }

  /// A little towards the middle of the patch: for corners where the derivatives are parallel.
  Vector2d inwards(const PatchPoint& point) const {
    Vector2d result;
    for (int k = 0; k < 2; ++k) {
      const auto [low, high] = search_.range(point.patch, k);
      result[k] = point.uv[k] + 0.02 * (0.5 * (low + high) - point.uv[k]);
    }
    return result;
  }

  Vector3d normal(const PatchPoint& point) const {
    Vector3d best = Vector3d::Zero();
    for (const Vector2d& uv : {point.uv, inwards(point)}) {
      const PatchJet s = search_.jet(point.patch, uv);
      const Vector3d cross = s.u.cross(s.v);
      if (cross.norm() > 0) best = cross.normalized();
      if (cross.norm() > 1e-2 * s.u.norm() * s.v.norm()) break;
    }
    return best;
  }

  /// Curvature vector (c'' − (c''·t) t) / |c'|² of the curve c along a side.
  EdgePoint edgePoint(const Edge& edge, double t) const {
    const PatchJet s = search_.jet(edge.patch, uvOf(edge, t));
    const Vector3d& first = edge.direction() == 0 ? s.u : s.v;
    const Vector3d& second = edge.direction() == 0 ? s.uu : s.vv;
    EdgePoint point{s.position, first.normalized()};
    const Vector3d across = second - second.dot(point.tangent) * point.tangent;
    point.curvature = across / first.squaredNorm();
    const double flat = 1e3 * kRounding / size();
    if (!(point.curvature.norm() >= flat))
      point.curvature.setZero();
    else
      point.accuracy = flat / point.curvature.squaredNorm();
    return point;
  }

  /// ∫ |c'| dt by Gauss points on halves and quarters of the spans; the error is the difference.
  std::array<double, 2> lengthOf(const Edge& edge) const {
    const auto& spans = search_.spans(edge.patch, edge.direction());
    const auto sum = [&](int parts) {
      double length = 0;
      for (std::size_t i = 1; i < spans.size(); ++i)
        for (int k = 0; k < parts; ++k) {
          const double step = (spans[i] - spans[i - 1]) / parts;
          for (const auto& [node, weight] : kGauss) {
            const PatchJet s =
                search_.jet(edge.patch, uvOf(edge, spans[i - 1] + (k + node) * step));
            length += weight * step * (edge.direction() == 0 ? s.u : s.v).norm();
          }
        }
      return length;
    };
    const double fine = sum(4);
    return {fine, std::abs(fine - sum(2)) + kRounding * fine};
  }

  /// Length of the chain that continues an edge over its vertices without a corner.
  double chainLength(int first) const {
    std::set<int> chain{first};
    for (const int end : {0, 1}) {
      int edge = first;
      int vertex = solid_.edges()[edge].vertices[end];
      for (std::optional<int> next; (next = continuation(edge, vertex));) {
        if (!chain.insert(*next).second) break;
        edge = *next;
        const auto& ends = solid_.edges()[edge].vertices;
        vertex = ends[0] == vertex ? ends[1] : ends[0];
      }
    }
    double length = 0;
    for (const int edge : chain) {
      const PatchEdge& use = solid_.edges()[edge].uses[0];
      length += lengthOf({use.patch, use.side})[0];
    }
    return length;
  }

  /// Direction of an edge away from one of its vertices.
  Vector3d away(int index, int vertex) const {
    const SolidEdge& edge = solid_.edges()[index];
    const Edge use{edge.uses[0].patch, edge.uses[0].side};
    const auto [low, high] = search_.range(use.patch, use.direction());
    return edge.vertices[0] == vertex ? edgePoint(use, low).tangent
                                      : Vector3d(-edgePoint(use, high).tangent);
  }

  /// The edge that leaves a vertex in the direction in which another one arrives. Nothing for an
  /// edge inside a smooth surface: only sharp edges continue sharp ones.
  std::optional<int> continuation(int edge, int vertex) const {
    const auto& edges = solid_.edges();
    const Vector3d ahead = -away(edge, vertex);
    std::optional<int> best;
    double least = kSmoothTurn;
    for (int other = 0; other < static_cast<int>(edges.size()); ++other) {
      if (other == edge || edges[other].smooth != edges[edge].smooth) continue;
      if (edges[other].vertices[0] != vertex && edges[other].vertices[1] != vertex) continue;
      const Vector3d direction = away(other, vertex);
      const double turn = std::atan2(ahead.cross(direction).norm(), ahead.dot(direction));
      if (turn >= least) continue;
      least = turn;
      best = other;
    }
    return best;
  }

  /// Newton's method in one parameter from the best of many samples in each span.
  PatchPoint nearestOnEdge(const Edge& edge, const Vector3d& x) const {
    const auto& spans = search_.spans(edge.patch, edge.direction());
    PatchPoint best{edge.patch};
    double least = std::numeric_limits<double>::infinity();
    constexpr int kStarts = 4;
    for (std::size_t i = 1; i < spans.size(); ++i)
      for (int k = 0; k < kStarts; ++k) {
        double t = spans[i - 1] + (spans[i] - spans[i - 1]) * (k + 0.5) / kStarts;
        for (int step = 0; step < 40; ++step) {
          const PatchJet s = search_.jet(edge.patch, uvOf(edge, t));
          const Vector3d& first = edge.direction() == 0 ? s.u : s.v;
          const Vector3d& second = edge.direction() == 0 ? s.uu : s.vv;
          const Vector3d r = s.position - x;
          const double gauss = first.squaredNorm();
          const double newton = gauss + r.dot(second);
          const double way = -r.dot(first) / (newton > 1e-3 * gauss ? newton : gauss);
          const double next = std::clamp(t + way, spans.front(), spans.back());
          const double moved = std::abs(next - t) * std::sqrt(gauss);
          t = next;
          if (moved <= 1e-15 * size()) break;
        }
        const Vector2d uv = uvOf(edge, t);
        const Vector3d position = search_.position(edge.patch, uv);
        const double distance = (position - x).norm();
        if (distance >= least) continue;
        least = distance;
        best = {edge.patch, uv, position};
      }
    return best;
  }

  Solid solid_;
  PatchSearch search_;
};

}  // namespace

std::shared_ptr<const MeasuredSurface> makeMeasuredSurface(const Solid& solid) {
  return std::make_shared<MeasuredSolid>(solid);
}

}  // namespace palpa::modeling
