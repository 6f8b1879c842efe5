#include "modeling/project/touch_place.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "modeling/error.h"
#include "modeling/mesh/nearest_point.h"
#include "modeling/project/body_facets.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr int kPiecesPerSize = 80;             // along the diagonal of the body's box
constexpr std::size_t kMaxCandidates = 20000;  // whose distances are computed
constexpr double kEqualHeight = 0.02;          // of the largest height
constexpr double kEqualClearance = 0.05;       // of the largest clearance
constexpr double kOpposed = 0.2;     // length of the mean normal below which the normals cancel
constexpr double kMinRadius = 0.25;  // of the wished one
constexpr double kTurned = 0.5;      // cosine of the angle at which a surface has turned away

struct Candidate {
  Vector3d position, normal;
  double height = 0.0;     ///< above the supports, mm
  double facing = 1.0;     ///< cosine of the angle to the direction away from the supports
  double aside = 0.0;      ///< distance from the axis through the supports' centroid, mm
  double clearance = 0.0;  ///< to sharp edges and supports, mm
};

/// Facets inside and outside of the supports.
struct Held {
  std::vector<std::array<Vector3d, 3>> held;
  std::vector<BodyFacets::Facet> free;
  Vector3d centroid = Vector3d::Zero();
  Vector3d meanNormal = Vector3d::Zero();  ///< of length 1 if the held surface is flat
};

/// Divides large facets into equal pieces.
std::vector<BodyFacets::Facet> refined(const BodyFacets& surface) {
  std::vector<BodyFacets::Facet> pieces;
  const double step = surface.size / kPiecesPerSize;
  for (const BodyFacets::Facet& facet : surface.facets) {
    const auto& [a, b, c] = facet.corners;
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int n = std::clamp(static_cast<int>(std::ceil(longest / step)), 1, kPiecesPerSize);
    const auto at = [&](int i, int j) {
      return Vector3d(a + (b - a) * (double(i) / n) + (c - a) * (double(j) / n));
    };
    BodyFacets::Facet piece{{}, facet.patch, facet.areaNormal / (n * n)};
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        piece.corners = {at(i, j), at(i + 1, j), at(i, j + 1)};
        pieces.push_back(piece);
        if (i + j + 1 == n) continue;
        piece.corners = {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        pieces.push_back(piece);
      }
  }
  return pieces;
}

Held divide(const Body& body, const BodyFacets& surface, const std::vector<Support>& supports) {
  std::vector<BodyFacets::Facet> pieces = refined(surface);
  std::vector<Vector3d> centres;
  std::vector<int> patches;
  for (const BodyFacets::Facet& piece : pieces) {
    centres.push_back(piece.centre());
    patches.push_back(piece.patch);
  }
  std::vector<double> outside(pieces.size(), std::numeric_limits<double>::infinity());
  for (const Support& support : supports) {
    const std::vector<double> field = regionField(support.where, body, centres, patches);
    for (std::size_t i = 0; i < field.size(); ++i) outside[i] = std::min(outside[i], field[i]);
  }
  // Of a support smaller than the pieces, the nearest piece.
  const double limit = std::max(0.0, *std::min_element(outside.begin(), outside.end()));
  Held result;
  double area = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (outside[i] > limit) {
      result.free.push_back(pieces[i]);
      continue;
    }
    result.held.push_back(pieces[i].corners);
    const double pieceArea = pieces[i].areaNormal.norm();
    area += pieceArea;
    result.centroid += pieceArea * centres[i];
    result.meanNormal += pieces[i].areaNormal;
  }
  result.centroid /= area;
  result.meanNormal /= area;
  return result;
}

Vector3d centroidOf(const BodyFacets& surface) {
  Vector3d moment = Vector3d::Zero();
  double area = 0.0;
  for (const BodyFacets::Facet& facet : surface.facets) {
    const double facetArea = facet.areaNormal.norm();
    area += facetArea;
    moment += facetArea * facet.centre();
  }
  return moment / area;
}

/// Unit vector from the supports through the body; zero if they surround it evenly.
Vector3d directionAway(const Held& held, const BodyFacets& surface) {
  if (held.meanNormal.norm() > kOpposed) return -held.meanNormal.normalized();
  const Vector3d through = centroidOf(surface) - held.centroid;
  if (through.norm() < 0.01 * surface.size) return Vector3d::Zero();
  return through.normalized();
}

/// Centres of the free facets, or, of very many, of every n-th.
std::vector<Candidate> spread(const Held& held, const Vector3d& away) {
  std::vector<Candidate> result;
  const std::size_t every = (held.free.size() + kMaxCandidates - 1) / kMaxCandidates;
  for (std::size_t i = 0; i < held.free.size(); i += every) {
    Candidate candidate{held.free[i].centre(), held.free[i].areaNormal.normalized()};
    const Vector3d from = candidate.position - held.centroid;
    candidate.height = away.dot(from);
    candidate.aside = (from - candidate.height * away).norm();
    if (!away.isZero()) candidate.facing = candidate.normal.dot(away);
    result.push_back(candidate);
  }
  return result;
}

/// Limits the clearances to the distances of candidates that look in quite another direction, but
/// not in the opposite one: the sides of a pin, not the other face of a plate.
void limitToSmoothParts(std::vector<Candidate>& candidates, double radius) {
  std::vector<const Candidate*> alongX;
  for (const Candidate& each : candidates) alongX.push_back(&each);
  const auto x = [](const Candidate* each) { return each->position.x(); };
  std::sort(alongX.begin(), alongX.end(),
            [&](const Candidate* a, const Candidate* b) { return x(a) < x(b); });
  std::vector<double> limits;
  for (const Candidate& each : candidates) {
    double limit = std::min(each.clearance, radius);
    auto near =
        std::lower_bound(alongX.begin(), alongX.end(), each.position.x() - limit,
                         [&](const Candidate* other, double value) { return x(other) < value; });
    for (; near != alongX.end() && x(*near) < each.position.x() + limit; ++near)
      if (std::abs((*near)->normal.dot(each.normal)) < kTurned)
        limit = std::min(limit, ((*near)->position - each.position).norm());
    limits.push_back(limit < radius ? limit : each.clearance);
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) candidates[i].clearance = limits[i];
}

/// The highest candidate that fulfils the limits; of equally high ones the clearest, of equally
/// clear ones the one nearest to the axis through the supports' centroid.
const Candidate* highest(const std::vector<Candidate>& candidates, double leastClearance,
                         double leastFacing, double leastHeight, double size) {
  const auto isAllowed = [&](const Candidate& each) {
    return each.clearance >= leastClearance && each.facing >= leastFacing &&
           each.height >= leastHeight;
  };
  double top = -std::numeric_limits<double>::infinity();
  for (const Candidate& each : candidates)
    if (isAllowed(each)) top = std::max(top, each.height);
  const auto isHigh = [&](const Candidate& each) {
    return isAllowed(each) && each.height >= top - kEqualHeight * std::abs(top);
  };
  double clearest = 0.0;
  for (const Candidate& each : candidates)
    if (isHigh(each)) clearest = std::max(clearest, each.clearance);
  const Candidate* best = nullptr;
  for (const Candidate& each : candidates) {
    if (!isHigh(each) || each.clearance < (1.0 - kEqualClearance) * clearest) continue;
    if (!best || each.aside < best->aside - 1e-9 * size) best = &each;
  }
  return best;
}

const Candidate* choose(const std::vector<Candidate>& candidates, double radius, double size) {
  double top = 0.0;
  for (const Candidate& each : candidates)
    if (each.facing >= 0.0) top = std::max(top, each.height);
  for (const double leastHeight : {0.5 * top, 0.0})
    for (const double share : {1.0, 0.5, 0.25, 0.125})
      for (const double facing : {0.5, 0.0})
        if (const auto* best = highest(candidates, share * radius, facing, leastHeight, size))
          return best;
  const double any = -std::numeric_limits<double>::infinity();
  for (const double facing : {0.5, 0.0, -1.0})
    if (const auto* best = highest(candidates, 0.0, facing, any, size)) return best;
  return candidates.empty() ? nullptr : &candidates.front();
}

double twoDigits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  return std::strtod(text, nullptr);
}

}  // namespace

TouchPlace placeOppositeToSupports(const Body& body, const std::vector<Support>& supports,
                                   double radius) {
  if (supports.empty()) throw ModelingError("supports: there is none; add one");
  const BodyFacets surface = bodyFacets(body);
  const Held held = divide(body, surface, supports);
  if (held.free.empty())
    throw ModelingError(
        "supports: they hold the whole surface, so no place is free to be touched; reduce them");
  const Vector3d away = directionAway(held, surface);
  std::vector<Candidate> candidates = spread(held, away);
  const NearestOnSegments edges(surface.sharpEdges);
  const NearestOnTriangles heldSurface(held.held);
  for (Candidate& each : candidates) {
    const double toSupport = (heldSurface.nearest(each.position) - each.position).norm();
    each.clearance = std::min(edges.distance(each.position), toSupport);
    if (away.isZero()) each.height = toSupport;
  }
  limitToSmoothParts(candidates, radius);
  const Candidate* best = choose(candidates, radius, surface.size);
  return {best->position, best->normal,
          twoDigits(std::clamp(best->clearance, kMinRadius * radius, radius))};
}

}  // namespace palpa::modeling
