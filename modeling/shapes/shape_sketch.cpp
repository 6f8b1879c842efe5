#include "modeling/shapes/shape_sketch.h"

#include <variant>

#include "modeling/error.h"
#include "modeling/shapes/profile_check.h"

namespace palpa::modeling {
namespace {

std::string pathOf(SketchUse use, std::size_t index) {
  if (use == SketchUse::kRevolve) return "revolve: profile";
  if (use == SketchUse::kExtrude) return "extrude: profile";
  return "loft: sections[" + std::to_string(index) + "].profile";
}

ProfileCurve curveOf(SketchUse use, const SketchSection& section, std::size_t index) {
  if (section.profile.isCurve()) return section.profile.curve();
  throw ModelingError(pathOf(use, index) + ": there is no curve yet; place at least " +
                      (use == SketchUse::kRevolve ? "two" : "three") + " points");
}

/// The old curve if the sketch shows the same.
ProfileCurve kept(const ProfileCurve& old, const ProfileSketch& sketch, ProfileCurve made) {
  return ProfileSketch(old) == sketch ? old : made;
}

}  // namespace

bool hasProfile(const Primitive& primitive) {
  return std::holds_alternative<RevolveShape>(primitive.shape) ||
         std::holds_alternative<ExtrudeShape>(primitive.shape) ||
         std::holds_alternative<LoftShape>(primitive.shape);
}

SketchUse sketchUseOf(const Primitive& primitive) {
  if (std::holds_alternative<RevolveShape>(primitive.shape)) return SketchUse::kRevolve;
  if (std::holds_alternative<ExtrudeShape>(primitive.shape)) return SketchUse::kExtrude;
  return SketchUse::kLoft;
}

std::vector<SketchSection> sectionsOf(const Primitive& primitive) {
  if (const auto* revolve = std::get_if<RevolveShape>(&primitive.shape))
    return {{0.0, ProfileSketch(revolve->profile)}};
  if (const auto* extrude = std::get_if<ExtrudeShape>(&primitive.shape))
    return {{0.0, ProfileSketch(extrude->profile)}};
  std::vector<SketchSection> sections;
  for (const LoftShape::Section& section : std::get<LoftShape>(primitive.shape).sections)
    sections.push_back({section.z, ProfileSketch(section.profile)});
  return sections;
}

Primitive withSections(const Primitive& primitive, const std::vector<SketchSection>& sections) {
  Primitive result = primitive;
  const SketchUse use = sketchUseOf(primitive);
  if (auto* revolve = std::get_if<RevolveShape>(&result.shape)) {
    const auto& sketch = sections.at(0).profile;
    revolve->profile = kept(revolve->profile, sketch, curveOf(use, sections[0], 0));
    return result;
  }
  if (auto* extrude = std::get_if<ExtrudeShape>(&result.shape)) {
    const auto& sketch = sections.at(0).profile;
    extrude->profile = kept(extrude->profile, sketch, curveOf(use, sections[0], 0));
    return result;
  }
  LoftShape loft;
  const auto& old = std::get<LoftShape>(primitive.shape).sections;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    LoftShape::Section section{sections[i].z, curveOf(use, sections[i], i)};
    for (const LoftShape::Section& before : old)
      if (before.z == section.z)
        section.profile = kept(before.profile, sections[i].profile, std::move(section.profile));
    loft.sections.push_back(std::move(section));
  }
  result.shape = std::move(loft);
  return result;
}

void checkSection(SketchUse use, const std::vector<SketchSection>& sections, std::size_t index) {
  const ProfileCurve curve = curveOf(use, sections.at(index), index);
  if (use == SketchUse::kRevolve)
    checkRevolvedProfile(curve);
  else
    checkClosedProfile(curve, pathOf(use, index));
}

}  // namespace palpa::modeling
