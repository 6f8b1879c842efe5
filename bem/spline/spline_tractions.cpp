#include "bem/spline/spline_tractions.h"

#include <map>
#include <span>
#include <tuple>

namespace palpa::bem {

using Eigen::Vector3d;

std::vector<std::vector<SplineOccurrence>> occurrences(const SplineSurface& surface) {
  std::vector<std::vector<SplineOccurrence>> all(surface.controlPoints().size());
  for (std::size_t p = 0; p < surface.patches().size(); ++p) {
    const SplinePatch& patch = surface.patches()[p];
    const int count = patch.basis[0].count();
    for (std::size_t k = 0; k < patch.net.size(); ++k)
      all[patch.net[k]].push_back(
          {static_cast<int>(p), static_cast<int>(k) % count, static_cast<int>(k) / count});
  }
  for (int k = 0; k < surface.coefficientCount(); ++k)
    if (surface.tornFrom(k) != k) all[k] = all[surface.tornFrom(k)];
  return all;
}

std::vector<ElementPlace> placesInPatch(const SplineSurface& surface, int patch, double u,
                                        double v) {
  const std::array<double, 2> parameter{u, v};
  std::array<std::vector<int>, 2> spans;
  for (int d = 0; d < 2; ++d) {
    const auto& list = surface.patches()[patch].basis[d].spans();
    const double slack = 1e-10 * (list.back().upper - list.front().lower);
    for (std::size_t s = 0; s < list.size(); ++s)
      if (parameter[d] >= list[s].lower - slack && parameter[d] <= list[s].upper + slack)
        spans[d].push_back(static_cast<int>(s));
  }
  std::vector<ElementPlace> places;
  for (const int j : spans[1])
    for (const int i : spans[0])
      for (const int element : surface.elementsAt(patch, i, j))
        if (const auto place = surface.placeIn(element, u, v)) places.push_back(*place);
  return places;
}

std::vector<ElementPlace> grevillePlaces(const SplineSurface& surface, const SplineOccurrence& at) {
  const SplinePatch& patch = surface.patches()[at.patch];
  return placesInPatch(surface, at.patch, patch.basis[0].greville(at.i),
                       patch.basis[1].greville(at.j));
}

SplineTractions::SplineTractions(const SplineSurface& surface) {
  std::map<std::tuple<int, int, int>, int> index;
  // Functions of a support's displacements on free elements carry no tractions.
  const auto carriersOf = [&](int e) {
    const BorderFunctions* beside = surface.borderFunctions(e);
    return std::span(surface.functions(e))
        .first(beside ? beside->ownCount() : surface.functions(e).size());
  };
  for (int e = 0; e < surface.elementCount(); ++e)
    for (const int coefficient : carriersOf(e))
      index[{coefficient, surface.smoothingGroup(e), surface.elements()[e].tag}] = 0;
  slots.firstOfNode.assign(surface.controlPoints().size() + 1, 0);
  for (auto& [key, slot] : index) {
    const auto& [coefficient, group, tag] = key;
    slot = slots.count();
    slots.slots.push_back({coefficient, group, tag, Vector3d::Zero()});
    ++slots.firstOfNode[coefficient + 1];
  }
  for (int k = 0; k < surface.coefficientCount(); ++k)
    slots.firstOfNode[k + 1] += slots.firstOfNode[k];

  for (int e = 0; e < surface.elementCount(); ++e) {
    std::vector<int>& list = ofFunction.emplace_back();
    for (const int coefficient : carriersOf(e))
      list.push_back(index[{coefficient, surface.smoothingGroup(e), surface.elements()[e].tag}]);
    for (std::size_t f = list.size(); f < surface.functions(e).size(); ++f)
      list.push_back(slots.firstOfNode[surface.functions(e)[f]]);
  }
  // The normal of a function is the surface normal at its Greville point. Functions whose point
  // lies in the part of another tag use their nearest element.
  const auto all = occurrences(surface);
  for (int k = 0; k < surface.coefficientCount(); ++k)
    for (const SplineOccurrence& at : all[k])
      for (const ElementPlace& place : grevillePlaces(surface, at)) {
        const auto found = index.find(
            {k, surface.smoothingGroup(place.element), surface.elements()[place.element].tag});
        if (found != index.end()) slots.slots[found->second].normal += surface.normal(place);
      }
  for (int e = 0; e < surface.elementCount(); ++e)
    for (const int slot : ofFunction[e]) {
      const SplineElement& element = surface.elements()[e];
      if (slots.slots[slot].normal.isZero())
        slots.slots[slot].normal = surface.normal({e, (element.lower[0] + element.upper[0]) / 2,
                                                   (element.lower[1] + element.upper[1]) / 2});
    }
  for (auto& slot : slots.slots) slot.normal.normalize();
}

}  // namespace palpa::bem
