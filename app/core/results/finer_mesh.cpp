#include "app/core/results/finer_mesh.h"

#include <algorithm>
#include <cmath>

#include "app/core/setup/project_geometry.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"

namespace palpa::app {

using modeling::MeshSettings;

double usualOrder(bool hasSplines) {
  return hasSplines ? 3 : 2;
}

double observedOrder(double formerError, double error, double refinement, bool hasSplines) {
  constexpr double kMinOrder = 1, kMaxOrder = 6;
  if (!(std::abs(std::log(refinement)) > 0.05)) return usualOrder(hasSplines);
  const double order = std::log(formerError / error) / std::log(refinement);
  return std::isfinite(order) ? std::clamp(order, kMinOrder, kMaxOrder) : usualOrder(hasSplines);
}

double refinement(const MeshSettings& mesh, const MeshSettings& finer, bool hasSplines) {
  if (!hasSplines) return mesh.edgeLength / finer.edgeLength;
  if (mesh.elementLength && finer.elementLength) return *mesh.elementLength / *finer.elementLength;
  return finer.splineDensity / mesh.splineDensity;
}

MeshSettings finerMesh(MeshSettings mesh, bool hasSplines, double factor) {
  // Three digits, so that fields show the number.
  const auto rounded = [](double value, auto round) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
    return round(value / unit) * unit;
  };
  const auto down = [&](double value) {
    return rounded(value, [](double x) { return std::floor(x); });
  };
  if (!hasSplines)
    mesh.edgeLength = down(mesh.edgeLength / factor);
  else if (mesh.elementLength)
    mesh.elementLength = down(*mesh.elementLength / factor);
  else
    mesh.splineDensity =
        std::min(rounded(mesh.splineDensity * factor, [](double x) { return std::ceil(x); }),
                 MeshSettings::kMaxSplineDensity);
  return mesh;
}

double estimateCoefficients(const modeling::Project& project, const MeshSettings& mesh,
                            const Job& job) {
  modeling::Project other = project;
  Job quiet = job;
  quiet.progress = nullptr;
  other.mesh = mesh;
  try {
    if (usesSplines(other)) return ProjectGeometry(other).refinement().coefficients;
    return modeling::estimateNodeCount(other.body, mesh, modeling::meshRegions(other),
                                       modeling::meshFoci(other), quiet);
  } catch (const modeling::ModelingError&) {
    return INFINITY;
  }
}

}  // namespace palpa::app
