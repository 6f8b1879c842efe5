#include "modeling/mesh/node_place.h"

#include <limits>
#include <stdexcept>

namespace palpa::modeling {

NodePlace placeOf(const Solid& solid, const SurfaceEvaluator& surface, const SurfaceParameter& at) {
  NodePlace place{{at}, -1, 0.0, -1};
  const auto [uLow, uHigh] = surface.range(at.patch, 0);
  const auto [vLow, vHigh] = surface.range(at.patch, 1);
  const bool onU = at.u == uLow || at.u == uHigh;
  const bool onV = at.v == vLow || at.v == vHigh;
  if (!onU && !onV) return place;
  if (onU && onV) {
    const Side side = at.v == vLow ? Side::kVMin : Side::kVMax;
    place.vertex = solid.verticesOf(at.patch, side)[at.u == uLow ? 0 : 1];
    for (int p = 0; p < surface.patchCount(); ++p)
      for (Side other : {Side::kVMin, Side::kVMax}) {
        const std::array<int, 2> ends = solid.verticesOf(p, other);
        for (int end : {0, 1}) {
          if (ends[end] != place.vertex) continue;
          const SurfaceParameter name = onSide(surface, {p, other}, end);
          if (p != at.patch || name.u != at.u || name.v != at.v) place.at.push_back(name);
        }
      }
    return place;
  }
  const Side side =
      onV ? (at.v == vLow ? Side::kVMin : Side::kVMax) : (at.u == uLow ? Side::kUMin : Side::kUMax);
  place.edge = solid.edgeOf(at.patch, side);
  const SolidEdge& edge = solid.edges()[place.edge];
  const int use = edge.uses[0].patch == at.patch && edge.uses[0].side == side ? 0 : 1;
  const double t = onV ? (at.u - uLow) / (uHigh - uLow) : (at.v - vLow) / (vHigh - vLow);
  place.edgeFraction = use == 1 && edge.reversed ? 1.0 - t : t;
  place.at.push_back(onEdge(surface, edge, 1 - use, place.edgeFraction));
  return place;
}

std::array<SurfaceParameter, 3> cornersIn(const SurfaceEvaluator& surface, int patch,
                                          const std::array<const NodePlace*, 3>& corners) {
  std::array<std::vector<SurfaceParameter>, 3> names;
  for (int k = 0; k < 3; ++k) {
    for (const SurfaceParameter& name : corners[k]->at)
      if (name.patch == patch) names[k].push_back(name);
    if (names[k].empty())
      throw std::invalid_argument("cornersIn: a corner of the triangle is not in its patch");
  }
  const auto [uLow, uHigh] = surface.range(patch, 0);
  const auto [vLow, vHigh] = surface.range(patch, 1);
  const auto distance = [&, width = uHigh - uLow, height = vHigh - vLow](
                            const SurfaceParameter& a, const SurfaceParameter& b) {
    const double u = (a.u - b.u) / width;
    const double v = (a.v - b.v) / height;
    return u * u + v * v;
  };
  std::array<SurfaceParameter, 3> best;
  double smallest = std::numeric_limits<double>::infinity();
  for (const SurfaceParameter& a : names[0])
    for (const SurfaceParameter& b : names[1])
      for (const SurfaceParameter& c : names[2]) {
        const double size = distance(a, b) + distance(b, c) + distance(c, a);
        if (size >= smallest) continue;
        smallest = size;
        best = {a, b, c};
      }
  return best;
}

}  // namespace palpa::modeling
