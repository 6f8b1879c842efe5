#include "bem/spline/element_cutter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpa::bem {
namespace {

constexpr int kMaxDepth = 6;     ///< halvings of a knot rectangle
constexpr double kSteepest = 2;  ///< maximum slope of a graph, in units of its rectangle

/// Cuts the knot rectangle of one element into pieces.
class Cutter {
 public:
  using Piece = ElementPiece;
  using Rectangle = ElementPiece::Rectangle;

  Cutter(const SplineSurface& surface, int element, const LevelFunction& level, bool hasRoots)
      : surface_(surface), element_(element), level_(level), hasRoots_(hasRoots) {}

  std::vector<Piece> cut() {
    const SplineElement& e = surface_.elements()[element_];
    divide({e.lower, e.upper}, 0);
    return std::move(pieces_);
  }

 private:
  double level(double u, double v) const {
    return level_(surface_.evaluate({element_, u, v}).position);
  }
  double level(int axis, double along, double across) const {
    return axis == 0 ? level(along, across) : level(across, along);
  }

  void divide(const Rectangle& r, int depth) {
    const auto inner = [](int k) {
      return kThinnestSlice + (1 - 2 * kThinnestSlice) * k / (kBorderSamples - 1);
    };
    int inside = 0;
    for (int i = 0; i < kBorderSamples; ++i)
      for (int j = 0; j < kBorderSamples; ++j)
        inside += level(r.at(0, inner(i)), r.at(1, inner(j))) < 0 ? 1 : 0;
    if (inside == 0 || inside == kBorderSamples * kBorderSamples) {
      pieces_.push_back({r, {}, inside > 0});
      return;
    }
    if (addGraph(r, 0) || addGraph(r, 1)) return;
    if (depth == kMaxDepth) {
      pieces_.push_back({r, {}, level(r.at(0, 0.5), r.at(1, 0.5)) < 0});
      return;
    }
    for (int k = 0; k < 4; ++k) {
      Rectangle quarter = r;
      for (int d = 0; d < 2; ++d) {
        const bool isUpper = ((k >> d) & 1) != 0;
        (isUpper ? quarter.lower : quarter.upper)[d] = r.at(d, 0.5);
      }
      divide(quarter, depth + 1);
    }
  }

  /// True if the border crosses the line at `along` between both ends of the rectangle.
  bool crosses(const Rectangle& r, int axis, double along) const {
    return (level(axis, along, r.lower[1 - axis]) < 0) !=
           (level(axis, along, r.upper[1 - axis]) < 0);
  }

  /// Adds pieces if the border is a graph over an interval of `axis` that begins or ends at an end
  /// of the rectangle, and does not cross the rectangle elsewhere.
  bool addGraph(const Rectangle& r, int axis) {
    std::array<bool, kBorderSamples> has{};
    for (int k = 0; k < kBorderSamples; ++k)
      has[k] = crosses(r, axis, r.at(axis, k / (kBorderSamples - 1.0)));
    int changes = 0;
    for (int k = 1; k < kBorderSamples; ++k) changes += has[k] != has[k - 1] ? 1 : 0;
    if (changes > 1 || (changes == 0 && !has[0])) return false;
    Rectangle part = r, rest = r;
    if (changes == 1) {
      int k = 1;
      while (has[k] == has[k - 1]) ++k;
      double low = r.at(axis, (k - 1) / (kBorderSamples - 1.0)),
             high = r.at(axis, k / (kBorderSamples - 1.0));
      for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (crosses(r, axis, middle) == has[0] ? low : high) = middle;
      }
      // A crossing at either end must be on the same side as the graph.
      const double border = has[0] ? low : high;
      (has[0] ? part.upper : part.lower)[axis] = border;
      (has[0] ? rest.lower : rest.upper)[axis] = border;
      if (std::min(part.size(axis), rest.size(axis)) < 1e-6 * r.size(axis)) return false;
    }
    CutMap::Values border{}, lower{}, upper{};
    for (int k = 0; k < CutMap::kPoints; ++k) {
      const double along = part.at(axis, (1 + CutMap::node(k)) / 2);
      const auto root = rootOn(part, axis, along);
      if (!root) return false;
      border[k] = *root;
      lower[k] = part.lower[1 - axis];
      upper[k] = part.upper[1 - axis];
    }
    for (int k = 1; k < CutMap::kPoints; ++k) {
      const double step = (CutMap::node(k) - CutMap::node(k - 1)) / 2;
      if (std::abs(border[k] - border[k - 1]) > kSteepest * step * r.size(1 - axis)) return false;
    }
    if (changes == 1 && !isOneSided(rest)) return false;
    const bool lowerInside = level(axis, part.at(axis, 0.5), part.lower[1 - axis]) < 0;
    const double begin = part.lower[axis], end = part.upper[axis];
    using Root = CutMap::Root;
    pieces_.push_back(
        {part, CutMap(axis, begin, end, lower, border, hasRoots_ ? Root::kUpper : Root::kNone),
         lowerInside});
    pieces_.push_back(
        {part, CutMap(axis, begin, end, border, upper, hasRoots_ ? Root::kLower : Root::kNone),
         !lowerInside});
    if (changes == 1) pieces_.push_back({rest, {}, level(rest.at(0, 0.5), rest.at(1, 0.5)) < 0});
    return true;
  }

  bool isOneSided(const Rectangle& r) const {
    const bool isInside = level(r.at(0, 0.5), r.at(1, 0.5)) < 0;
    for (int i = 1; i < kBorderSamples - 1; ++i)
      for (int j = 1; j < kBorderSamples - 1; ++j)
        if ((level(r.at(0, i / (kBorderSamples - 1.0)), r.at(1, j / (kBorderSamples - 1.0))) < 0) !=
            isInside)
          return false;
    return true;
  }

  /// Crossing of the border and the line at `along`; none if it is not unique.
  std::optional<double> rootOn(const Rectangle& r, int axis, double along) const {
    double low = r.lower[1 - axis], high = r.upper[1 - axis];
    const bool first = level(axis, along, low) < 0, last = level(axis, along, high) < 0;
    int changes = 0;
    bool before = first;
    for (int k = 1; k < kBorderSamples; ++k) {
      const bool here = level(axis, along, r.at(1 - axis, k / (kBorderSamples - 1.0))) < 0;
      changes += here != before ? 1 : 0;
      before = here;
    }
    if (changes > 1) return {};
    if (first == last) {  // the border meets a corner of the rectangle at the end of the graph
      const double a = std::abs(level(axis, along, low)), b = std::abs(level(axis, along, high));
      return a < b ? low : high;
    }
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      ((level(axis, along, middle) < 0) == first ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  const SplineSurface& surface_;
  int element_;
  const LevelFunction& level_;
  bool hasRoots_;
  std::vector<Piece> pieces_;
};

}  // namespace

std::vector<ElementPiece> cutElement(const SplineSurface& surface, int element,
                                     const LevelFunction& level, bool hasRoots) {
  return Cutter(surface, element, level, hasRoots).cut();
}

}  // namespace palpa::bem
