#include "app/core/setup/knot_chains.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// Maxima over seven lines along a span.
KnotChain::Span measure(const modeling::SurfaceEvaluator& surface, modeling::PatchDirection at,
                        double low, double high) {
  constexpr int kPieces = 8;
  const auto [first, last] = surface.range(at.patch, 1 - at.direction);
  KnotChain::Span span;
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

}  // namespace

KnotChains::KnotChains(const modeling::Solid& solid, const modeling::SurfaceEvaluator& surface)
    : surface_(surface), chainOf_(solid.patches().size(), {-1, -1}) {
  for (int patch = 0; patch < surface.patchCount(); ++patch)
    for (int direction = 0; direction < 2; ++direction) {
      if (chainOf_[patch][direction] >= 0) continue;
      KnotChain chain{modeling::chainOf(solid, {patch, direction}), {}};
      for (const modeling::ChainLink& link : chain.links) {
        chainOf_[link.at.patch][link.at.direction] = count();
        const auto& knots = surface.spans(link.at.patch, link.at.direction);
        std::vector<KnotChain::Span> spans;
        for (std::size_t k = 1; k < knots.size(); ++k)
          spans.push_back(measure(surface, link.at, knots[k - 1], knots[k]));
        if (link.reversed) std::reverse(spans.begin(), spans.end());
        chain.spans.push_back(std::move(spans));
      }
      chains_.push_back(std::move(chain));
    }
}

const modeling::ChainLink& KnotChains::linkOf(modeling::PatchDirection at) const {
  const auto& links = chains_[of(at)].links;
  return *std::find_if(links.begin(), links.end(), [&](const modeling::ChainLink& link) {
    return link.at.patch == at.patch && link.at.direction == at.direction;
  });
}

double KnotChains::extent(modeling::PatchDirection at) const {
  const KnotChain& chain = chains_[of(at)];
  double length = 0;
  for (const KnotChain::Span& span : chain.spans[&linkOf(at) - chain.links.data()])
    length += span.length;
  return length;
}

double KnotChains::placeOf(modeling::PatchDirection at, double parameter) const {
  const auto& knots = surface_.spans(at.patch, at.direction);
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, parameter);
  const double place = static_cast<double>(above - knots.begin()) - 1 +
                       (parameter - *(above - 1)) / (*above - *(above - 1));
  return linkOf(at).reversed ? chains_[of(at)].spanCount() - place : place;
}

double KnotChains::parameterOf(modeling::PatchDirection at, double place) const {
  const auto& knots = surface_.spans(at.patch, at.direction);
  const int spans = chains_[of(at)].spanCount();
  if (linkOf(at).reversed) place = spans - place;
  const double nearest = std::round(place);
  if (std::abs(place - nearest) < 1e-9) return knots[static_cast<std::size_t>(nearest)];
  const int span = std::clamp(static_cast<int>(place), 0, spans - 1);
  return knots[span] + (place - span) * (knots[span + 1] - knots[span]);
}

}  // namespace palpa::app
