#include "modeling/editing/change.h"

namespace palpa::modeling {
namespace {

void compareBodies(const Solid& before, const Solid& after, Change& change) {
  if (before.controlPoints().size() != after.controlPoints().size() ||
      before.patches().size() != after.patches().size()) {
    change.topology = true;
    return;
  }
  if (!before.sharesTopologyWith(after)) {
    for (std::size_t p = 0; p < before.patches().size(); ++p) {
      const Patch& a = before.patches()[p];
      const Patch& b = after.patches()[p];
      change.patchNames = change.patchNames || a.name != b.name;
      change.topology =
          change.topology || a.degree != b.degree || a.knots != b.knots || a.net != b.net;
    }
    if (change.topology) {
      change.patchNames = false;
      return;
    }
    for (std::size_t e = 0; e < before.edges().size(); ++e)
      change.edges = change.edges || before.edges()[e].smooth != after.edges()[e].smooth;
  }
  std::vector<char> moved(before.controlPoints().size(), 0);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (before.controlPoints()[i] == after.controlPoints()[i]) continue;
    moved[i] = 1;
    change.movedPoints.push_back(static_cast<int>(i));
  }
  if (change.movedPoints.empty()) return;
  for (std::size_t p = 0; p < after.patches().size(); ++p) {
    bool uses = false;
    for (const auto& row : after.patches()[p].net)
      for (int index : row) uses = uses || moved[index];
    if (uses) change.changedPatches.push_back(static_cast<int>(p));
  }
}

void compareBodies(const MeshBody& before, const MeshBody& after, Change& change) {
  if (&before.positions() == &after.positions()) return;  // shared
  change.topology = before.positions() != after.positions() ||
                    before.triangles() != after.triangles() ||
                    before.faceOfTriangle() != after.faceOfTriangle() ||
                    before.faceNames().size() != after.faceNames().size();
  change.patchNames = !change.topology && before.faceNames() != after.faceNames();
}

}  // namespace

Change compare(const Project& before, const Project& after) {
  Change change;
  if (before.body.index() != after.body.index())
    change.topology = true;
  else if (const auto* solid = std::get_if<Solid>(&before.body))
    compareBodies(*solid, std::get<Solid>(after.body), change);
  else
    compareBodies(std::get<MeshBody>(before.body), std::get<MeshBody>(after.body), change);
  change.primitive = before.primitive != after.primitive;
  change.name = before.name != after.name;
  change.material = before.material != after.material;
  change.supports = before.supports != after.supports;
  change.loads = before.loads != after.loads;
  change.touches = before.touches != after.touches;
  change.measurements = before.measurements != after.measurements;
  change.design = before.design != after.design;
  change.mesh = before.mesh != after.mesh;
  change.view = before.view != after.view;
  return change;
}

}  // namespace palpa::modeling
