#include <algorithm>

#include "modeling/editing/apply_command.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"

namespace palpa::modeling {
namespace {

/// Iterator to the element with this name in a list of named parts of a project.
template <class List>
auto find(List& list, const std::string& name, const std::string& what) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  if (found != list.end()) return found;
  std::string names;
  for (const auto& one : list) names += (names.empty() ? "\"" : ", \"") + one.name + "\"";
  throw ModelingError("name: no " + what + " is named \"" + name + "\"; " +
                      (names.empty() ? "there are none" : "there are " + names));
}

template <class One>
Edited added(const Project& project, std::vector<One> Project::*list, const One& one) {
  Edited result{project, 0.0};
  (result.project.*list).push_back(one);
  return result;
}

template <class One>
Edited replaced(const Project& project, std::vector<One> Project::*list, const std::string& name,
                const One& one, const std::string& what) {
  Edited result{project, 0.0};
  *find(result.project.*list, name, what) = one;
  return result;
}

template <class One>
Edited removed(const Project& project, std::vector<One> Project::*list, const std::string& name,
               const std::string& what) {
  Edited result{project, 0.0};
  auto& all = result.project.*list;
  all.erase(find(all, name, what));
  return result;
}

void rename(Region& region, const std::string& from, const std::string& to) {
  for (auto* parts : {&region.parts, &region.except})
    for (RegionPart& part : *parts)
      if (auto* set = std::get_if<PatchSet>(&part))
        std::replace(set->patches.begin(), set->patches.end(), from, to);
}

Body renamed(const Solid& solid, const std::string& from, const std::string& to) {
  const int index = requirePatch(solid, from, "patch");
  std::vector<Patch> patches = solid.patches();
  patches[index].name = to;
  std::vector<PatchEdge> smooth;
  for (const SolidEdge& edge : solid.edges())
    if (edge.smooth) smooth.push_back(edge.uses[0]);
  return Solid(solid.controlPoints(), std::move(patches), smooth);
}

Body renamed(const MeshBody& body, const std::string& from, const std::string& to) {
  const auto index = body.findFace(from);
  if (!index)
    throw ModelingError("patch: no face is named \"" + from + "\"; the body has " +
                        quotedPatchNames(body));
  MeshBody::Data data{body.positions(), body.triangles(), body.faceOfTriangle(), body.faceNames()};
  data.faceNames[*index] = to;
  return MeshBody(std::move(data));
}

}  // namespace

Edited applyTo(const AddSupport& command, const Project& project) {
  return added(project, &Project::supports, command.support);
}
Edited applyTo(const SetSupport& command, const Project& project) {
  return replaced(project, &Project::supports, command.name, command.support, "support");
}
Edited applyTo(const RemoveSupport& command, const Project& project) {
  return removed(project, &Project::supports, command.name, "support");
}

Edited applyTo(const AddLoad& command, const Project& project) {
  return added(project, &Project::loads, command.load);
}
Edited applyTo(const SetLoad& command, const Project& project) {
  return replaced(project, &Project::loads, command.name, command.load, "load");
}
Edited applyTo(const RemoveLoad& command, const Project& project) {
  return removed(project, &Project::loads, command.name, "load");
}

Edited applyTo(const AddTouch& command, const Project& project) {
  return added(project, &Project::touches, command.touch);
}
Edited applyTo(const SetTouch& command, const Project& project) {
  Edited result = replaced(project, &Project::touches, command.name, command.touch, "touch");
  if (result.project.design)
    for (DesignTarget& target : result.project.design->targets)
      if (target.touch == command.name) target.touch = command.touch.name;
  return result;
}
Edited applyTo(const RemoveTouch& command, const Project& project) {
  Edited result = removed(project, &Project::touches, command.name, "touch");
  if (result.project.design)
    std::erase_if(result.project.design->targets,
                  [&](const DesignTarget& target) { return target.touch == command.name; });
  return result;
}

Edited applyTo(const AddMeasurement& command, const Project& project) {
  return added(project, &Project::measurements, command.measurement);
}
Edited applyTo(const SetMeasurement& command, const Project& project) {
  return replaced(project, &Project::measurements, command.name, command.measurement,
                  "measurement");
}
Edited applyTo(const RemoveMeasurement& command, const Project& project) {
  return removed(project, &Project::measurements, command.name, "measurement");
}

Edited applyTo(const SetMaterial& command, const Project& project) {
  Edited result{project, 0.0};
  result.project.material = command.material;
  return result;
}

Edited applyTo(const SetMesh& command, const Project& project) {
  Edited result{project, 0.0};
  result.project.mesh = command.mesh;
  return result;
}

Edited applyTo(const SetDesign& command, const Project& project) {
  Edited result{project, 0.0};
  result.project.design = command.design;
  return result;
}

Edited applyTo(const RenameProject& command, const Project& project) {
  Edited result{project, 0.0};
  result.project.name = command.name;
  return result;
}

Edited applyTo(const RenamePatch& command, const Project& project) {
  const std::string& from = command.patch;
  const std::string& to = command.name;
  if (to.empty()) throw ModelingError("name: is empty");
  const auto taken = findPatch(project.body, to);
  if (taken && from != to)
    throw ModelingError("name: \"" + to + "\" is already the name of a patch");
  Edited result{project, 0.0};
  result.project.body =
      std::visit([&](const auto& body) { return renamed(body, from, to); }, project.body);
  if (from == to) return {project, 0.0};
  for (Support& support : result.project.supports) rename(support.where, from, to);
  for (Load& load : result.project.loads)
    if (Region* where = regionOf(load)) rename(*where, from, to);
  for (Measurement& measurement : result.project.measurements)
    for (MeasuredPlace& place : measurement.places)
      for (std::string* name : {&place.patch, &place.other})
        if (*name == from) *name = to;
  if (result.project.design && result.project.design->points)
    renamePatch(*result.project.design->points, from, to);
  auto factor = result.project.mesh.patchFactors.extract(from);
  if (!factor.empty()) {
    factor.key() = to;
    result.project.mesh.patchFactors.insert(std::move(factor));
  }
  // The primitive would give the patch its original name.
  result.project.primitive.reset();
  return result;
}

}  // namespace palpa::modeling
