#include "modeling/mesh/border_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "modeling/mesh/mesh_refine.h"

namespace palpa::modeling {
namespace {

constexpr double kMoveWithin = 0.35;  // of a crossed edge, measured from the node
constexpr double kCountsAsOn = 0.5;   // of the tolerance, for nodes that cannot move
// Beside a half space no edge of such a node is crossed farther from it; strokes, whose borders
// bend, would get slivers.
constexpr double kEdgesCountAsOn = 0.25;
constexpr double kArch = 0.25;  // largest rise of the surface over a triangle, of its longest edge
// Largest drop of the distance from strokes along an edge below its end values, of the edge length.
constexpr double kSteepest = 0.5;
constexpr double kRounding = 1e-9;  // of the longest extent; below, a node lies on the border

constexpr std::size_t kCheckpoint = 1000;  // nodes or triangles between checks of the stop token

class BorderFit {
 public:
  BorderFit(MeshEditor& editor, int k, double tolerance)
      : editor_(editor), k_(k), border_(editor.borders()[k]), tolerance_(tolerance) {
    Eigen::Vector3d low = editor.position(0);
    Eigen::Vector3d high = low;
    for (const WorkNode& node : editor.mesh().nodes) {
      low = low.cwiseMin(node.position);
      high = high.cwiseMax(node.position);
    }
    rounding_ = kRounding * (high - low).norm() * border_.slope();
  }

  void run() {
    if (border_.isPainted())
      resolveStrokes();
    else
      resolveSmallRegion();
    values_.clear();
    for (std::size_t node = 0; node < editor_.mesh().nodes.size(); ++node)
      values_.push_back(clean(border_.value(editor_.position(static_cast<int>(node)))));
    resolveStrips();
    moveNodes();
    resolveStrips();
    cutEdges();
    setSides();
  }

 private:
  struct Crossing {
    double part;  // of the edge, from node
    int node;
    int other;
  };

  double clean(double value) const { return std::abs(value) <= rounding_ ? 0.0 : value; }

  bool isCrossed(int a, int b) const { return values_[a] * values_[b] < 0.0; }

  /// Fraction of the mesh edge a–b at which the true surface crosses the border, by regula falsi
  /// with bisection as a guard.
  double crossing(int a, int b) const {
    double low = 0.0;
    double high = 1.0;
    double lowValue = values_[a];
    double highValue = values_[b];
    for (int i = 0; i < 60 && high - low > 1e-14; ++i) {
      const double s = i % 3 == 2 ? 0.5 * (low + high)
                                  : (low * highValue - high * lowValue) / (highValue - lowValue);
      const double value = border_.value(editor_.between(a, b, s).position);
      if (value == 0.0) return s;
      if (value * lowValue > 0.0) {
        low = s;
        lowValue = value;
      } else {
        high = s;
        highValue = value;
      }
    }
    return 0.5 * (low + high);
  }

  /// Fraction of the edge a–b (on one side of the border) where the value on the true surface comes
  /// nearest to the other side, and the value there, by samples and bisection.
  std::pair<double, double> extreme(int a, int b, double sign) const {
    constexpr int kSamples = 8;
    const auto value = [&](double s) {
      return sign * border_.value(editor_.between(a, b, s).position);
    };
    double best = 0.5;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 1; i < kSamples; ++i)
      if (const double v = value(static_cast<double>(i) / kSamples); v < least) {
        least = v;
        best = static_cast<double>(i) / kSamples;
      }
    for (double step = 0.5 / kSamples; step > 1e-3; step *= 0.5)
      for (const double s : {best - step, best + step})
        if (const double v = value(s); v < least) {
          least = v;
          best = s;
        }
    return {best, sign * least};
  }

  /// Largest distance by which a border may bulge over an edge that is not split. `s` is where the
  /// border is farthest from the edge, `width` the length of the crossed part, `length` the edge's.
  double allowedBulge(int a, int b, double s, double width, double length) const {
    constexpr double kOfWidth = 0.4;
    // Where the added node cannot move onto the border, a flatter segment would be a sliver.
    constexpr double kOfWidthOnRails = 0.12;
    constexpr double kAtAnEnd = 0.02;  // there it is an end that counts as on the border
    // Strokes are followed by finer triangles instead.
    if (border_.isPainted() || s < kAtAnEnd || s > 1.0 - kAtAnEnd) return kOfWidth * width;
    // With kOfWidth alone, a plane that grazed a torus lost 3 % of its support and the forces
    // changed by 3 %.
    if (editor_.isInterface(a, b)) return kOfWidthOnRails * width;
    return std::min(kOfWidth * width, tolerance_ * length);
  }

  /// Inserts a node into every edge that crosses a strip, because a strip between the nodes would
  /// be lost, as would the bulge of a border over an edge. Such an edge has both ends on one side
  /// or one end on the border.
  void resolveStrips() {
    constexpr double kWide = 0.15;  // of the edge length; narrower strips are lost
    std::vector<std::tuple<int, int, double, double>> cuts;
    for (std::size_t a = 0; a < values_.size(); ++a)
      for (int b : neighbours(a)) {
        const int node = static_cast<int>(a);
        if (node > b || isCrossed(node, b) || (values_[a] == 0.0 && values_[b] == 0.0)) continue;
        const double length = (editor_.position(node) - editor_.position(b)).norm();
        if (std::min(std::abs(values_[a]), std::abs(values_[b])) >
            (border_.isPainted() ? kSteepest : kArch) * length * border_.slope())
          continue;
        const double sign = values_[a] + values_[b] > 0.0 ? 1.0 : -1.0;
        const auto [s, value] = extreme(node, b, sign);
        if (sign * clean(value) >= 0.0) continue;
        const WorkNode middle = editor_.between(node, b, s);
        const Eigen::Vector3d normal =
            editor_.mesh().surface->normal(middle.at[0].patch, middle.at[0].u, middle.at[0].v);
        const Eigen::Vector3d gradient = border_.gradient(middle.position);
        const double slope = (gradient - gradient.dot(normal) * normal).norm();
        // Width of a parabola through the three values.
        const double width = length * (s * std::sqrt(value / (value - values_[a])) +
                                       (1.0 - s) * std::sqrt(value / (value - values_[b])));
        if (width > kWide * length &&
            std::abs(value) > slope * allowedBulge(node, b, s, width, length))
          cuts.emplace_back(node, b, s, value);
      }
    for (const auto& [a, b, s, value] : cuts) {
      editor_.split(a, b, editor_.between(a, b, s));
      values_.push_back(value);
    }
  }

  /// True if the border runs on both sides of the node, so that without the node the region (or its
  /// complement) would end between the neighbours.
  bool isNarrowAt(int node) const {
    const std::vector<int> ring = editor_.neighbours(node);
    const auto direction = [&](int other) {
      return (editor_.position(other) - editor_.position(node)).normalized();
    };
    // Beside a plain border the values on both sides of the node have about the same magnitude.
    double own = 0.0;
    double opposite = 0.0;
    for (int other : ring)
      if (isCrossed(node, other))
        opposite = std::max(opposite, std::abs(values_[other]));
      else
        own = std::max(own, std::abs(values_[other]));
    if (own > 0.5 * opposite) return false;
    for (int one : ring)
      for (int two : ring)
        if (isCrossed(node, one) && isCrossed(node, two) &&
            direction(one).dot(direction(two)) < -0.5)
          return true;
    return false;
  }

  /// True if the node can slide along the edge to `other` without leaving a patch edge or another
  /// border.
  bool mayMove(int node, int other) const {
    if (editor_.mesh().nodes[node].isCorner()) return false;
    const std::vector<int> rails = editor_.interfaceNeighbours(node);
    if (rails.empty()) return true;
    return rails.size() == 2 && editor_.mesh().nodes[node].edge >= 0 &&
           std::find(rails.begin(), rails.end(), other) != rails.end();
  }

  /// Largest part of an edge of a node between the node and the border. Where a border meets a
  /// patch edge at a small angle, it is close to a node and yet crosses the patch edge far from it.
  double farthestCrossing(int node) const {
    double farthest = 0.0;
    for (int other : editor_.neighbours(node))
      if (isCrossed(node, other)) farthest = std::max(farthest, crossing(node, other));
    return farthest;
  }

  void moveNodes() {
    std::vector<Crossing> crossings;
    for (std::size_t a = 0; a < values_.size(); ++a)
      for (int b : neighbours(a)) {
        const int node = static_cast<int>(a);
        if (node > b || !isCrossed(node, b)) continue;
        const double s = crossing(node, b);
        crossings.push_back({s, node, b});
        crossings.push_back({1.0 - s, b, node});
      }
    std::erase_if(crossings, [](const Crossing& c) { return c.part > kMoveWithin; });
    std::vector<bool> stays(values_.size());
    for (const Crossing& c : crossings) stays[c.node] = stays[c.node] || isNarrowAt(c.node);
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
      return std::tuple(a.part, a.node, a.other) < std::tuple(b.part, b.node, b.other);
    });
    for (const Crossing& c : crossings) {
      if (!isCrossed(c.node, c.other)) continue;
      if (!stays[c.node] && mayMove(c.node, c.other)) {
        WorkNode target = editor_.between(c.node, c.other, c.part);
        if (editor_.move(c.node, std::move(target))) {
          values_[c.node] = 0.0;
          continue;
        }
      }
      const bool isCorner = editor_.mesh().nodes[c.node].isCorner();
      if (c.part <= (isCorner ? tolerance_ : kCountsAsOn * tolerance_) &&
          (border_.isPainted() || farthestCrossing(c.node) <= kEdgesCountAsOn))
        values_[c.node] = 0.0;
    }
  }

  void cutEdges() {
    std::vector<std::pair<int, int>> crossed;
    for (std::size_t a = 0; a < values_.size(); ++a)
      for (int b : neighbours(a))
        if (static_cast<int>(a) < b && isCrossed(static_cast<int>(a), b))
          crossed.emplace_back(static_cast<int>(a), b);
    // A cut does not change the other crossed edges, and its new edges start on the border.
    for (const auto& [a, b] : crossed) {
      editor_.split(a, b, editor_.between(a, b, crossing(a, b)));
      values_.push_back(0.0);
    }
  }

  std::vector<int> neighbours(std::size_t node) const {
    if (node % kCheckpoint == 0) editor_.checkpoint();
    return editor_.neighbours(static_cast<int>(node));
  }

  double valueInside(int t, double wa, double wb, double wc) const {
    const WorkTriangle& triangle = editor_.mesh().triangles[t];
    const SurfaceParameter& a = editor_.mesh().in(triangle.nodes[0], triangle.patch);
    const SurfaceParameter& b = editor_.mesh().in(triangle.nodes[1], triangle.patch);
    const SurfaceParameter& c = editor_.mesh().in(triangle.nodes[2], triangle.patch);
    return clean(border_.value(editor_.mesh().surface->position(
        triangle.patch, wa * a.u + wb * b.u + wc * c.u, wa * a.v + wb * b.v + wc * c.v)));
  }

  void setSides() {
    for (std::size_t t = 0; t < editor_.mesh().triangles.size(); ++t) {
      if (t % kCheckpoint == 0) editor_.checkpoint();
      const WorkTriangle& triangle = editor_.mesh().triangles[t];
      double sum = 0.0;
      for (int node : triangle.nodes) sum += values_[node];
      if (sum == 0.0) sum = valueInside(static_cast<int>(t), 1 / 3.0, 1 / 3.0, 1 / 3.0);
      const std::uint64_t bit = std::uint64_t{1} << k_;
      editor_.setSides(static_cast<int>(t), sum < 0.0 ? triangle.sides | bit : triangle.sides);
    }
  }

  /// Bisects the triangles that a small region touches until enough nodes lie in it: a region
  /// between the nodes would be lost, and a region with few nodes would be a coarse polygon. The
  /// same for the part outside the region.
  void resolveSmallRegion() {
    constexpr int kRounds = 14;
    constexpr int kEnoughNodes = 8;
    for (const double sign : {-1.0, 1.0})
      for (int round = 0; round < kRounds; ++round) {
        const auto& nodes = editor_.mesh().nodes;
        const auto inside = std::count_if(nodes.begin(), nodes.end(), [&](const WorkNode& node) {
          return sign * clean(border_.value(node.position)) > 0.0;
        });
        if (inside >= kEnoughNodes) break;
        std::vector<int> hiding;
        for (std::size_t t = 0; t < editor_.mesh().triangles.size(); ++t)
          if (hides(static_cast<int>(t), sign)) hiding.push_back(static_cast<int>(t));
        if (hiding.empty()) break;
        for (int t : hiding) bisect(editor_, t);
      }
  }

  /// Bisects triangles that the border of strokes may cross until their edges are as short as
  /// edgeAt(): strokes narrower than the triangles would be lost or become coarse polygons.
  void resolveStrokes() {
    constexpr int kRounds = 40;
    double longestEdge = 0.0;
    for (std::size_t t = 0; t < editor_.mesh().triangles.size(); ++t)
      longestEdge = std::max(longestEdge, longest(static_cast<int>(t)));
    for (int round = 0; round < kRounds; ++round) {
      std::vector<int> coarse;
      for (std::size_t i = 0; i < editor_.mesh().triangles.size(); ++i) {
        if (i % kCheckpoint == 0) editor_.checkpoint();
        const int t = static_cast<int>(i);
        const double length = longest(t);
        const auto& [a, b, c] = editor_.mesh().triangles[i].nodes;
        const Eigen::Vector3d middle =
            (editor_.position(a) + editor_.position(b) + editor_.position(c)) / 3.0;
        if (std::abs(border_.value(middle)) > length) continue;
        if (length > border_.edgeAt(middle, longestEdge)) coarse.push_back(t);
      }
      if (coarse.empty()) return;
      for (int t : coarse) bisect(editor_, t);
    }
  }

  double longest(int t) const {
    const std::array<int, 3>& n = editor_.mesh().triangles[t].nodes;
    double length = 0.0;
    for (int k = 0; k < 3; ++k)
      length = std::max(length, (editor_.position(n[(k + 1) % 3]) - editor_.position(n[k])).norm());
    return length;
  }

  bool hides(int t, double sign) const {
    if (t % 100 == 0) editor_.checkpoint();
    const std::array<int, 3>& n = editor_.mesh().triangles[t].nodes;
    double nearest = std::numeric_limits<double>::infinity();
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& x = editor_.position(n[k]);
      nearest = std::min(nearest, -sign * border_.value(x));
      longest = std::max(longest, (editor_.position(n[(k + 1) % 3]) - x).norm());
    }
    if (nearest > kArch * longest * border_.slope()) return false;
    constexpr int kSteps = 10;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j)
        if (sign * valueInside(t, static_cast<double>(i) / kSteps, static_cast<double>(j) / kSteps,
                               static_cast<double>(kSteps - i - j) / kSteps) >
            0.0)
          return true;
    return false;
  }

  MeshEditor& editor_;
  int k_;
  RegionBorder border_;
  double tolerance_;  // of the edge length
  double rounding_;
  std::vector<double> values_;  // border value per node; exactly 0 on the border
};

}  // namespace

void fitToBorder(MeshEditor& editor, int k, double tolerance) {
  BorderFit(editor, k, tolerance).run();
}

}  // namespace palpa::modeling
