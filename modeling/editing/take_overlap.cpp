#include <algorithm>
#include <map>

#include "modeling/editing/apply_command.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"
#include "modeling/solid/edge_curve.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

/// Pieces of the outline of a patch per edge: the chords of a quarter of a circle deviate from it
/// by 0.005 % of its radius.
constexpr int kPiecesPerEdge = 48;

using Polyline = std::vector<Vector3d>;

/// Edges between the chosen patches and the others.
std::vector<Polyline> outline(const Solid& solid, const std::vector<bool>& isChosen) {
  const SurfaceEvaluator surface(solid);
  std::vector<Polyline> lines;
  for (const SolidEdge& edge : solid.edges()) {
    if (isChosen[edge.uses[0].patch] == isChosen[edge.uses[1].patch]) continue;
    Polyline line;
    for (int k = 0; k <= kPiecesPerEdge; ++k) {
      const SurfaceParameter at = onEdge(surface, edge, 0, static_cast<double>(k) / kPiecesPerEdge);
      line.push_back(surface.position(at.patch, at.u, at.v));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// The same for the faces of a mesh body, along the edges of its triangles.
std::vector<Polyline> outline(const MeshBody& body, const std::vector<bool>& isChosen) {
  std::map<std::pair<int, int>, int> chosenUses;
  for (std::size_t t = 0; t < body.triangles().size(); ++t)
    if (isChosen[body.faceOfTriangle()[t]])
      for (int k = 0; k < 3; ++k) {
        const int a = body.triangles()[t][k], b = body.triangles()[t][(k + 1) % 3];
        ++chosenUses[{a, b}];
      }
  std::multimap<int, int> next;  // along the outline, from vertex to vertex
  for (const auto& [edge, count] : chosenUses)
    if (!chosenUses.contains({edge.second, edge.first})) next.insert(edge);
  std::vector<Polyline> lines;
  while (!next.empty()) {
    Polyline line{body.positions()[next.begin()->first]};
    for (auto step = next.begin(); step != next.end() && line.size() < Stroke::kMaxPoints;) {
      const int vertex = step->second;
      line.push_back(body.positions()[vertex]);
      next.erase(step);
      step = next.find(vertex);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

bool hasOnlyPatches(const std::vector<RegionPart>& parts) {
  return std::all_of(parts.begin(), parts.end(),
                     [](const RegionPart& part) { return std::holds_alternative<PatchSet>(part); });
}

/// The parts, larger by `gap` mm in all directions along the surface.
std::vector<RegionPart> enlarged(const std::vector<RegionPart>& parts, double gap,
                                 const Body& body) {
  std::vector<RegionPart> result = parts;
  for (RegionPart& part : result) {
    if (auto* half = std::get_if<HalfSpace>(&part)) half->below += gap * half->normal.norm();
    if (auto* stroke = std::get_if<Stroke>(&part)) stroke->radius += gap;
  }
  if (gap <= 0.0) return result;
  const std::vector<bool> isNamed = namedPatches(parts, body);
  if (std::none_of(isNamed.begin(), isNamed.end(), [](bool is) { return is; })) return result;
  for (Polyline& line : std::visit([&](const auto& any) { return outline(any, isNamed); }, body))
    result.push_back(Stroke{std::move(line), gap});
  return result;
}

/// Removes the patches of `taken` from the parts of a region.
void dropPatches(Region& region, const std::vector<RegionPart>& taken) {
  for (const RegionPart& part : taken)
    if (const auto* names = std::get_if<PatchSet>(&part))
      for (RegionPart& own : region.parts)
        if (auto* set = std::get_if<PatchSet>(&own))
          std::erase_if(set->patches, [&](const std::string& name) {
            return std::find(names->patches.begin(), names->patches.end(), name) !=
                   names->patches.end();
          });
  std::erase_if(region.parts, [](const RegionPart& part) {
    const auto* set = std::get_if<PatchSet>(&part);
    return set && set->patches.empty();
  });
}

const Support& supportNamed(const Project& project, const std::string& name, const char* field) {
  for (const Support& support : project.supports)
    if (support.name == name) return support;
  throw ModelingError(std::string(field) + ": no support is named \"" + name + "\"");
}

}  // namespace

Edited applyTo(const TakeOverlap& command, const Project& project) {
  requireFinite(command.gap, "gap_mm");
  if (command.gap < 0.0) throw ModelingError("gap_mm: must not be negative");
  const Support& taker = supportNamed(project, command.name, "name");
  const Support& giver = supportNamed(project, command.from, "from");
  if (&taker == &giver) throw ModelingError("from: must be another support than \"name\"");
  Region left = giver.where;
  dropPatches(left, taker.where.parts);
  Edited result{project, 0.0};
  const auto index = &giver - project.supports.data();
  if (left.parts.empty()) {
    result.project.supports.erase(result.project.supports.begin() + index);
    return result;
  }
  // Patches that only name other patches than the remaining ones take nothing.
  const bool patchesSuffice = hasOnlyPatches(left.parts);
  for (RegionPart& part : enlarged(taker.where.parts, command.gap, project.body)) {
    if (patchesSuffice && std::holds_alternative<PatchSet>(part)) continue;
    if (std::find(left.except.begin(), left.except.end(), part) == left.except.end())
      left.except.push_back(std::move(part));
  }
  result.project.supports[index].where = std::move(left);
  return result;
}

}  // namespace palpa::modeling
