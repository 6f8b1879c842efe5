#include "bem/spline/function_sides.h"

#include <algorithm>
#include <limits>
#include <map>

#include "bem/spline/spline_projection.h"

namespace palpa::bem {
namespace {

/// Integral of each function over a side of a patch, mm^2, by coefficient.
using Parts = std::map<int, double>;

/// The parts of the functions in all sides of patches to which none of their functions belongs, by
/// patch and side.
std::map<std::pair<int, int>, Parts> partsWithoutFunction(const SplineSurface& surface,
                                                          const std::vector<int>& owners) {
  std::map<std::pair<int, int>, Parts> missing;
  for (int e = 0; e < surface.elementCount(); ++e) {
    const auto& net = surface.patches()[surface.elements()[e].patch].net;
    if (std::none_of(net.begin(), net.end(),
                     [&](int k) { return isUsable(owners[k], surface.side(e)); }))
      missing[{surface.elements()[e].patch, surface.side(e)}];
  }
  std::vector<double> basis;
  for (int e = 0; e < surface.elementCount(); ++e) {
    const auto found = missing.find({surface.elements()[e].patch, surface.side(e)});
    if (found == missing.end()) continue;
    visitSplinePoints(surface, {e}, 4, std::numeric_limits<double>::infinity(),
                      [&](const ElementPlace& place, const SurfaceJet&, double area) {
                        surface.evaluateNet(e, surface.parameters(place).parameters, basis);
                        for (std::size_t f = 0; f < basis.size(); ++f)
                          found->second[surface.net(e)[f]] += area * basis[f];
                      });
  }
  return missing;
}

}  // namespace

std::vector<int> sidesOfFunctions(const SplineSurface& surface,
                                  const std::vector<std::vector<SplineOccurrence>>& places) {
  std::vector<int> owners(static_cast<std::size_t>(surface.coefficientCount()),
                          SplineSurface::kFree);
  for (int k = 0; k < surface.coefficientCount(); ++k)
    owners[k] = surface.side(grevillePlaces(surface, places[k].front()).front().element);
  for (int e = 0; e < surface.elementCount(); ++e)
    if (surface.side(e) == SplineSurface::kFixedPatch)
      for (const int k : surface.net(e)) owners[k] = SplineSurface::kFixedPatch;
  for (const auto& [where, parts] : partsWithoutFunction(surface, owners))
    owners[std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
             return a.second < b.second;
           })->first] = where.second;
  return owners;
}

}  // namespace palpa::bem
