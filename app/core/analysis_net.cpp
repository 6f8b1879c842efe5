#include "app/core/analysis_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "app/core/support_borders.h"
#include "modeling/error.h"
#include "modeling/text.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

constexpr int kDegree = 3;
/// Of one element to the next, from an edge where a support ends.
constexpr double kMostGrowth = 2.5;
/// Sizes grow by so much per mm of distance from a border that cuts elements.
constexpr double kGrowthPerLength = 0.8;
/// Absolute cosine from which a border counts as running across a direction.
constexpr double kAcross = 0.75;
constexpr double kLongest = 10;  ///< length of an element over the width of its patch
constexpr int kMostHalvings = 6;
/// Coefficients that are torn per element that a border cuts: 4 functions along it are cut, of
/// which some barely reach across.
constexpr double kTornPerElement = 2.6;
/// Sizes grow by this until the budget is kept, at most so often (to 16 times the wish).
const double kStep = std::pow(2.0, 0.25);
constexpr int kMostSteps = 16;
/// Size of the elements over the radius of a bump for an error of 1e-2. Measured on a box of 40 x
/// 40 x 20 mm held at its base, bump of 8 mm on a knot and beside it, nu = 0.3 and 0.48, cubic,
/// even elements (largest of four errors against h/r = 0.28):
///   h/r            1.0   0.83   0.71   0.63    0.50    0.42    0.36
///   u at the top   0.26  0.10   0.10   0.031   9e-3    2.5e-3  3e-3
///   mean u below   0.13  0.04   0.03   0.012   5e-3    1.7e-3  8e-4
/// so the error falls like its sixth power.
constexpr double kOfRadius = 0.54;
/// Of an element that may be left over: a length that is a whole number of elements but for
/// rounding, or a hair's breadth more, shall not take one more.
constexpr double kSlack = 0.1;

/// One strip of patches, all of whose directions share knots.
struct Strip {
  std::vector<modeling::ChainLink> links;
  /// Of each link (in the order of the first one's spans): length (mm) and turn (rad) of each span.
  struct Span {
    double length = 0, turn = 0;
  };
  std::vector<std::vector<Span>> spans;
  int spanCount() const { return static_cast<int>(spans.front().size()); }
};

/// The longest and the most curved of seven lines along a span.
Strip::Span measure(const modeling::SurfaceEvaluator& surface, modeling::PatchDirection at,
                    double low, double high) {
  constexpr int kPieces = 8;
  const auto [first, last] = surface.range(at.patch, 1 - at.direction);
  Strip::Span span;
  for (const double across : {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95}) {
    const double other = first + across * (last - first);
    double length = 0, turn = 0;
    Vector3d before = Vector3d::Zero(), direction = Vector3d::Zero();
    for (int k = 0; k <= kPieces; ++k) {
      const double t = low + (high - low) * k / kPieces;
      const Vector3d x = at.direction == 0 ? surface.position(at.patch, t, other)
                                           : surface.position(at.patch, other, t);
      if (k > 0) {
        const Vector3d chord = x - before;
        length += chord.norm();
        if (k > 1) turn += std::atan2(direction.cross(chord).norm(), direction.dot(chord));
        direction = chord;
      }
      before = x;
    }
    span.length = std::max(span.length, length);
    span.turn = std::max(span.turn, turn * kPieces / (kPieces - 1));
  }
  return span;
}

/// Sizes of the elements that replace the outermost one along an edge, as parts of it: geometric,
/// the first `rim`, together 1.
std::vector<double> rimSizes(double rim) {
  for (int count = 1;; ++count) {
    const auto sum = [&](double growth) {
      double total = 0, size = rim;
      for (int k = 0; k < count; ++k, size *= growth) total += size;
      return total;
    };
    if (sum(kMostGrowth) < 1) continue;
    double low = 1, high = kMostGrowth;
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      (sum(middle) < 1 ? low : high) = middle;
    }
    std::vector<double> sizes;
    double total = 0, size = rim;
    for (int k = 0; k < count; ++k, size *= high) {
      sizes.push_back(size);
      total += size;
    }
    for (double& each : sizes) each /= total;
    return sizes;
  }
}

/// A place on a patch near the centre of a bump.
struct BumpPlace {
  int patch;
  std::array<double, 2> parameters;
  double radius;  ///< of the bump, mm
};

/// Places within half of a bump's radius, where most of it acts, on a grid of samples.
std::vector<BumpPlace> placesUnder(const modeling::SurfaceEvaluator& surface,
                                   const Vector3d& center, double radius) {
  constexpr int kSamples = 24;
  std::vector<BumpPlace> places;
  for (int patch = 0; patch < surface.patchCount(); ++patch)
    for (int j = 0; j <= kSamples; ++j)
      for (int i = 0; i <= kSamples; ++i) {
        const auto [u0, u1] = surface.range(patch, 0);
        const auto [v0, v1] = surface.range(patch, 1);
        const double u = u0 + (u1 - u0) * i / kSamples, v = v0 + (v1 - v0) * j / kSamples;
        if ((surface.position(patch, u, v) - center).norm() < 0.5 * radius)
          places.push_back({patch, {u, v}, radius});
      }
  return places;
}

class NetMaker {
 public:
  explicit NetMaker(const modeling::Project& project)
      : solid_(std::get<modeling::Solid>(project.body)),
        surface_(solid_),
        borders_(bordersOf(project, solid_, surface_)) {
    factors_.resize(solid_.patches().size(), 1.0);
    for (const auto& [name, factor] : project.mesh.patchFactors)
      if (const auto patch = solid_.findPatch(name)) factors_[*patch] = factor;
    for (const modeling::Load& load : project.loads)
      if (const auto* bump = std::get_if<modeling::Bump>(&load.what))
        bumpPlaces_.push_back(placesUnder(surface_, bump->center, bump->radius));
    stripOf_.resize(solid_.patches().size(), {-1, -1});
    for (int patch = 0; patch < surface_.patchCount(); ++patch)
      for (int direction = 0; direction < 2; ++direction)
        if (stripOf_[patch][direction] < 0) addStrip({patch, direction});
  }

  AnalysisNet make(const ElementSizes& sizes) {
    sizes_ = sizes;
    AnalysisNet net;
    net.interior = sizes.interior;
    ends_.clear();
    std::vector<double> rows;
    for (const Strip& strip : strips_) {
      net.chains.push_back(chainOf(strip));
      rows.push_back(rowsOf(net.chains.back()));
    }
    // Inner points of patches and edges, and vertices.
    std::vector<int> vertices;
    for (std::size_t p = 0; p < stripOf_.size(); ++p)
      net.coefficients += (rows[stripOf_[p][0]] - 2) * (rows[stripOf_[p][1]] - 2);
    for (const modeling::SolidEdge& edge : solid_.edges()) {
      const modeling::PatchEdge& at = edge.uses[0];
      net.coefficients += rows[stripOf_[at.patch][directionOf(at.side)]] - 2;
      vertices.insert(vertices.end(), edge.vertices.begin(), edge.vertices.end());
    }
    std::sort(vertices.begin(), vertices.end());
    net.coefficients +=
        static_cast<double>(std::unique(vertices.begin(), vertices.end()) - vertices.begin());
    net.coefficients += kTornPerElement * cutElements();
    return net;
  }

 private:
  static SupportBorders bordersOf(const modeling::Project& project, const modeling::Solid& solid,
                                  const modeling::SurfaceEvaluator& surface) {
    std::vector<modeling::Region> regions;
    for (const modeling::Support& support : project.supports) regions.push_back(support.where);
    return supportBorders(solid, surface, regions);
  }

  void addStrip(modeling::PatchDirection first) {
    Strip strip{modeling::chainOf(solid_, first), {}};
    for (const modeling::ChainLink& link : strip.links) {
      stripOf_[link.at.patch][link.at.direction] = static_cast<int>(strips_.size());
      const auto& knots = surface_.spans(link.at.patch, link.at.direction);
      std::vector<Strip::Span> spans;
      for (std::size_t k = 1; k < knots.size(); ++k)
        spans.push_back(measure(surface_, link.at, knots[k - 1], knots[k]));
      if (link.reversed) std::reverse(spans.begin(), spans.end());
      strip.spans.push_back(std::move(spans));
    }
    strips_.push_back(std::move(strip));
  }

  /// Largest extent of a patch in a direction, mm.
  double extent(modeling::PatchDirection at) const {
    const Strip& strip = strips_[stripOf_[at.patch][at.direction]];
    for (std::size_t l = 0; l < strip.links.size(); ++l) {
      if (strip.links[l].at.patch != at.patch || strip.links[l].at.direction != at.direction)
        continue;
      double length = 0;
      for (const Strip::Span& span : strip.spans[l]) length += span.length;
      return length;
    }
    return 0;
  }

  /// Elements that a span needs, before borders of supports.
  std::vector<int> piecesOf(const Strip& strip) const {
    std::vector<double> need(strip.spanCount(), 0);
    for (std::size_t l = 0; l < strip.links.size(); ++l) {
      const modeling::PatchDirection at = strip.links[l].at;
      const double size = std::min(sizes_.interior * factors_[at.patch],
                                   kLongest * extent({at.patch, 1 - at.direction}));
      for (int k = 0; k < strip.spanCount(); ++k)
        need[k] = std::max({need[k], strip.spans[l][k].length / size,
                            strip.spans[l][k].turn / (sizes_.turn * factors_[at.patch])});
    }
    double total = 0;
    for (const double each : need) total += each;
    if (!(total < modeling::kMostNetRows / 4.0))
      throw modeling::ModelingError(
          "spline elements of " + modeling::numberText(sizes_.interior) +
              " mm are too small for this body: a patch would get about " +
              modeling::numberText(std::round(total)) + " in one direction; at most " +
              modeling::numberText(modeling::kMostNetRows / 4.0) + " are possible",
          modeling::ModelingError::Kind::tooLarge);
    std::vector<int> pieces;
    for (const double each : need)
      pieces.push_back(std::max(1, static_cast<int>(std::ceil(each - kSlack))));
    return pieces;
  }

  /// Does a support end along the lower or upper sides of a strip?
  bool endsAt(const Strip& strip, bool upper) const {
    return std::any_of(strip.links.begin(), strip.links.end(), [&](const auto& link) {
      const bool isUpper = upper != link.reversed;
      using modeling::Side;
      const Side side = link.at.direction == 0 ? (isUpper ? Side::uMax : Side::uMin)
                                               : (isUpper ? Side::vMax : Side::vMin);
      return borders_.edges[solid_.edgeOf(link.at.patch, side)];
    });
  }

  /// A place on a strip, as number of a span plus a fraction, that a border runs across.
  struct Mark {
    double at, millimetres;  ///< per unit of `at`
    double size;             ///< wanted there, mm
  };
  std::vector<Mark> marksOf(const Strip& strip) const {
    std::vector<Mark> marks;
    for (std::size_t l = 0; l < strip.links.size(); ++l) {
      const modeling::ChainLink& link = strip.links[l];
      const auto add = [&](double parameter, double size) {
        const double at = placeOn(strip, link, parameter);
        const int span = std::clamp(static_cast<int>(at), 0, strip.spanCount() - 1);
        marks.push_back({at, strip.spans[l][span].length, factors_[link.at.patch] * size});
      };
      for (const SupportBorders::Place& place : borders_.places)
        if (place.patch == link.at.patch && place.along[link.at.direction] >= kAcross)
          add(place.parameters[link.at.direction], std::min(sizes_.border, place.radius / 2));
      for (const std::vector<BumpPlace>& places : bumpPlaces_)
        for (const BumpPlace& place : places)
          if (place.patch == link.at.patch)
            add(place.parameters[link.at.direction], sizes_.bump * place.radius);
    }
    return marks;
  }

  /// A parameter of a link as number of a span of its strip plus a fraction.
  double placeOn(const Strip& strip, const modeling::ChainLink& link, double parameter) const {
    const auto& knots = surface_.spans(link.at.patch, link.at.direction);
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, parameter);
    const double at = static_cast<double>(above - knots.begin()) - 1 +
                      (parameter - *(above - 1)) / (*above - *(above - 1));
    return link.reversed ? strip.spanCount() - at : at;
  }

  /// Elements that borders of supports cut, nearly.
  double cutElements() const {
    std::set<std::array<std::ptrdiff_t, 3>> cut;
    for (const SupportBorders::Place& place : borders_.places) {
      std::array<std::ptrdiff_t, 3> element{place.patch, 0, 0};
      for (int d = 0; d < 2; ++d) {
        const int index = stripOf_[place.patch][d];
        const Strip& strip = strips_[index];
        for (const modeling::ChainLink& link : strip.links)
          if (link.at.patch == place.patch && link.at.direction == d)
            element[d + 1] = std::upper_bound(ends_[index].begin(), ends_[index].end(),
                                              placeOn(strip, link, place.parameters[d])) -
                             ends_[index].begin();
      }
      cut.insert(element);
    }
    return static_cast<double>(cut.size());
  }

  static void halve(double low, double high, const std::vector<Mark>& marks, int depth,
                    std::vector<double>& ends) {
    const bool isTooLarge =
        depth < kMostHalvings && std::any_of(marks.begin(), marks.end(), [&](const Mark& mark) {
          const double distance = std::max({0.0, low - mark.at, mark.at - high}) * mark.millimetres;
          return (high - low) * mark.millimetres > mark.size + kGrowthPerLength * distance;
        });
    if (isTooLarge) {
      halve(low, (low + high) / 2, marks, depth + 1, ends);
      halve((low + high) / 2, high, marks, depth + 1, ends);
    } else {
      ends.push_back(high);
    }
  }

  AnalysisNet::Chain chainOf(const Strip& strip) {
    std::vector<int> pieces = piecesOf(strip);
    const bool atLower = endsAt(strip, false), atUpper = endsAt(strip, true);
    if (atLower && atUpper && pieces.size() == 1) pieces[0] = std::max(pieces[0], 2);
    const std::vector<double> rim = rimSizes(sizes_.rim);
    const std::vector<Mark> marks = marksOf(strip);
    std::vector<double> ends;  // of the elements, as number of a span plus a fraction
    for (int k = 0; k < strip.spanCount(); ++k)
      for (int i = 0; i < pieces[k]; ++i) {
        const double low = k + static_cast<double>(i) / pieces[k], size = 1.0 / pieces[k];
        const bool isFirst = atLower && k == 0 && i == 0;
        const bool isLast = atUpper && k + 1 == strip.spanCount() && i + 1 == pieces[k];
        if (!isFirst && !isLast) {
          halve(low, low + size, marks, 0, ends);
          continue;
        }
        double at = low;
        for (std::size_t r = 0; r < rim.size(); ++r) {
          const double next = at + size * (isFirst ? rim[r] : rim[rim.size() - 1 - r]);
          halve(at, r + 1 < rim.size() ? next : low + size, marks, 0, ends);
          at = next;
        }
      }
    ends_.push_back(ends);
    const modeling::ChainLink& first = strip.links.front();
    const auto& knots = surface_.spans(first.at.patch, first.at.direction);
    AnalysisNet::Chain chain{
        first.at, std::max(kDegree, surface_.degree(first.at.patch, first.at.direction)), {}};
    for (const double end : ends) {
      const double span = std::round(end);
      if (std::abs(end - span) < 1e-9) continue;  // a knot of the design
      const auto k = static_cast<std::size_t>(end);
      chain.knots.push_back(knots[k] + (end - static_cast<double>(k)) * (knots[k + 1] - knots[k]));
    }
    return chain;
  }

  double rowsOf(const AnalysisNet::Chain& chain) const {
    const modeling::Patch& patch = solid_.patches()[chain.first.patch];
    const int d = chain.first.direction, degree = patch.degree[d];
    const auto before = static_cast<double>(patch.knots[d].size()) - degree - 1;
    // Each span between knots has so many more functions of its own.
    const double raised = (chain.degree - degree) *
                          static_cast<double>(surface_.spans(chain.first.patch, d).size() - 1);
    return before + raised + static_cast<double>(chain.knots.size());
  }

  const modeling::Solid& solid_;
  modeling::SurfaceEvaluator surface_;
  SupportBorders borders_;
  ElementSizes sizes_;
  std::vector<double> factors_;  ///< per patch
  std::vector<std::vector<BumpPlace>> bumpPlaces_;
  std::vector<std::array<int, 2>> stripOf_;
  std::vector<Strip> strips_;
  std::vector<std::vector<double>> ends_;  ///< per strip: where its elements end
};

}  // namespace

// The rim, measured on the cylinder R = 20 mm, 60 mm high, pressed between bonded plates
// (elements of about 4 mm, nu = 0.45): without grading the reaction is wrong by 2.1e-3, with a
// first element of 0.5 by 1.3e-3, of 0.3 by 1.0e-4. The budget keeps models quick: n = 1,200 at
// 1e-2, 1,450 at 3e-3, 1,730 at 1e-3.
ElementSizes ElementSizes::of(const modeling::MeshSettings& settings, double fingertipRadius) {
  const double wish = settings.accuracy / 1e-2;
  ElementSizes sizes;
  sizes.bump = kOfRadius * std::pow(wish, 1.0 / 6);
  sizes.interior = settings.elementLength.value_or(sizes.bump * fingertipRadius);
  sizes.turn =
      settings.elementLength ? std::numbers::pi / 4 : std::numbers::pi / 6 * std::pow(wish, 0.25);
  sizes.rim = std::min(0.5, 0.5 * std::pow(wish, 0.45));
  sizes.border = sizes.interior;
  sizes.budget = settings.elementLength ? std::numeric_limits<double>::infinity()
                                        : 1600 * std::pow(wish, -0.25);
  return sizes;
}

AnalysisNet analysisNet(const modeling::Project& project, const ElementSizes& sizes) {
  NetMaker maker(project);
  ElementSizes tried = sizes;
  AnalysisNet net = maker.make(tried);
  for (int step = 0; step < kMostSteps && net.coefficients > sizes.budget; ++step) {
    tried.interior *= kStep;
    tried.border *= kStep;
    tried.turn *= kStep;
    AnalysisNet next = maker.make(tried);
    if (next.coefficients < net.coefficients) net = std::move(next);
  }
  return net;
}

modeling::Solid refined(const modeling::Solid& solid, const AnalysisNet& net) {
  modeling::Solid result = solid;
  for (const AnalysisNet::Chain& chain : net.chains) {
    if (result.patches()[chain.first.patch].degree[chain.first.direction] < chain.degree)
      result = modeling::elevateDegree(result, chain.first, chain.degree);
    result = modeling::insertKnots(result, chain.first, chain.knots);
  }
  return result;
}

}  // namespace palpa::app
