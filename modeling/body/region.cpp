#include "modeling/body/region.h"

#include <cmath>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

void checkPart(const PatchSet& part, const Body& body, const std::set<std::string>& names,
               const std::string& path) {
  if (part.patches.empty()) throw ModelingError(path + ".patches: is empty");
  for (std::size_t i = 0; i < part.patches.size(); ++i)
    if (!names.contains(part.patches[i]))
      throw ModelingError(path + ".patches[" + std::to_string(i) + "]: no patch is named \"" +
                          part.patches[i] + "\"; the body has " + quotedPatchNames(body));
}

void checkPart(const HalfSpace& part, const Body&, const std::set<std::string>&,
               const std::string& path) {
  if (!part.normal.allFinite() || part.normal.norm() < 1e-9)
    throw ModelingError(path + ".half_space.normal: must be finite and not zero");
  if (!std::isfinite(part.below))
    throw ModelingError(path + ".half_space.below_mm: must be finite");
}

}  // namespace

void checkRegion(const Region& region, const Body& body, const std::string& path) {
  const std::vector<std::string> names = patchNames(body);
  checkRegion(region, body, {names.begin(), names.end()}, path);
}

void checkRegion(const Region& region, const Body& body, const std::set<std::string>& names,
                 const std::string& path) {
  if (region.parts.empty()) throw ModelingError(path + ": is empty");
  for (std::size_t i = 0; i < region.parts.size(); ++i) {
    const std::string partPath =
        region.parts.size() == 1 ? path : path + "[" + std::to_string(i) + "]";
    std::visit([&](const auto& part) { checkPart(part, body, names, partPath); }, region.parts[i]);
  }
}

}  // namespace palpa::modeling
