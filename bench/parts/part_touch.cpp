#include "bench/parts/part_touch.h"

#include <algorithm>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/touch.h"
#include "app/core/session/import_project.h"
#include "app/core/setup/project_geometry.h"
#include "bench/timing.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/project/touch_place.h"
#include "modeling/solid/surface_evaluator.h"

namespace palpa::bench {
namespace {

using Eigen::Vector3d;

constexpr double kDepth = 0.01;  // of the diagonal, as --depth 1%
constexpr int kPieces = 12;      // of a patch in each direction

/// Triangles of the surface with the index of their patch or face.
void addFacets(const modeling::Body& body, const std::vector<bool>& isSupported, PartTouch& part) {
  if (const auto* mesh = std::get_if<modeling::MeshBody>(&body)) {
    for (std::size_t t = 0; t < mesh->triangles().size(); ++t) {
      const auto [a, b, c] = mesh->triangles()[t];
      const auto& p = mesh->positions();
      part.facets.push_back({{p[a], p[b], p[c]}, isSupported[mesh->faceOfTriangle()[t]]});
    }
    return;
  }
  const modeling::SurfaceEvaluator surface(std::get<modeling::Solid>(body));
  for (int patch = 0; patch < surface.patchCount(); ++patch) {
    const auto [uLow, uHigh] = surface.range(patch, 0);
    const auto [vLow, vHigh] = surface.range(patch, 1);
    const auto at = [&, uLow = uLow, uHigh = uHigh, vLow = vLow, vHigh = vHigh](int i, int j) {
      return surface
          .evaluate(patch, uLow + (uHigh - uLow) * i / kPieces, vLow + (vHigh - vLow) * j / kPieces)
          .position;
    };
    for (int i = 0; i < kPieces; ++i)
      for (int j = 0; j < kPieces; ++j) {
        const Vector3d a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        part.facets.push_back({{a, b, c}, isSupported[patch]});
        part.facets.push_back({{a, c, d}, isSupported[patch]});
      }
  }
}

/// The touch of --place auto --depth 1%.
modeling::Touch placedTouch(const modeling::Project& project, PartTouch& part) {
  const modeling::TouchPlace place = modeling::placeOppositeToSupports(
      project.body, project.supports, app::radiusOfFirstTouch(part.size));
  modeling::Touch touch;
  touch.name = "touch";
  touch.at = place.position;
  touch.radius = place.radius;
  touch.vector = -kDepth * part.size * place.normal;
  part.normal = place.normal;
  part.wishedRadius = place.radius;
  return touch;
}

}  // namespace

PartTouch touchPart(const std::filesystem::path& file, int maxNodes) {
  PartTouch part;
  part.seconds = secondsFor([&] {
    app::ImportedProject imported = app::importProject(file);
    modeling::Project& project = imported.project;
    const std::vector<std::string> names = modeling::patchNames(project.body);
    part.faces = static_cast<int>(names.size());
    if (imported.held.flatFace.empty()) throw LeftOut("has no flat face that could be held");
    std::vector<bool> isSupported(names.size(), false);
    for (const std::string& name : imported.held.flatFace) {
      isSupported[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                           names.begin())] = true;
      part.support += (part.support.empty() ? "" : ", ") + name;
    }
    const auto [low, high] = modeling::boundingBox(project.body);
    part.size = (high - low).norm();
    part.volume = modeling::volume(project.body);
    addFacets(project.body, isSupported, part);
    for (const auto& [corners, isHeld] : part.facets)
      part.area += 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
    project.touches = {placedTouch(project, part)};
    const auto regions = modeling::meshRegions(project);
    const auto foci = modeling::meshFoci(project);
    const auto tooMany = [&](double nodes) {
      if (nodes > maxNodes)
        throw LeftOut("has about " + std::to_string(static_cast<int>(nodes)) + " nodes");
    };
    if (!app::usesSplines(project))
      tooMany(static_cast<double>(
          modeling::mesh(project.body, project.mesh, regions, {}, foci).positions.size()));
    const auto model = app::buildTouchModel(project, {}, {});
    app::TouchState state = app::playTouches(*model, project.touches);
    app::addErrors(*model, state);
    const app::TouchState::Contact& contact = state.contacts.front();
    part.material = model->setup().material;
    part.at = contact.at;
    part.radius = contact.radius;
    part.displacement = project.touches.front().vector;
    part.force = contact.force;
    part.error = contact.errorEstimate.value_or(0);
    part.nodes = model->report().nodes;
    part.engine = model->setup().engine == modeling::Engine::kSplines     ? "splines"
                  : model->setup().engine == modeling::Engine::kQuadratic ? "quadratic"
                                                                          : "triangles";
    tooMany(part.nodes);
  });
  return part;
}

}  // namespace palpa::bench
