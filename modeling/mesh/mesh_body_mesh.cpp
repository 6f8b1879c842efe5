#include <variant>

#include "modeling/error.h"
#include "modeling/mesh/mesh.h"

namespace palpa::modeling {

SurfaceMesh mesh(const MeshBody&, const MeshSettings&, std::span<const MeshRegion>, const Job&) {
  throw ModelingError("mesh bodies cannot be meshed yet");
}

double estimateNodeCount(const MeshBody&, const MeshSettings&, std::span<const MeshRegion>) {
  throw ModelingError("mesh bodies cannot be meshed yet");
}

SurfaceMesh mesh(const Body& body, const MeshSettings& settings,
                 std::span<const MeshRegion> regions, const Job& job) {
  return std::visit([&](const auto& one) { return mesh(one, settings, regions, job); }, body);
}

double estimateNodeCount(const Body& body, const MeshSettings& settings,
                         std::span<const MeshRegion> regions) {
  return std::visit([&](const auto& one) { return estimateNodeCount(one, settings, regions); },
                    body);
}

}  // namespace palpa::modeling
