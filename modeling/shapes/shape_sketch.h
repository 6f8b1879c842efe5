#pragma once

#include <string>
#include <vector>

#include "modeling/shapes/profile_sketch.h"

// The curves of a revolved, extruded or lofted shape while they are edited.
namespace palpa::modeling {

/// Section of a sketched shape; revolved and extruded shapes have one.
struct SketchSection {
  double z = 0.0;  ///< mm; without meaning if there is only one section
  ProfileSketch profile;

  bool operator==(const SketchSection&) const = default;
};

enum class SketchUse { kRevolve, kExtrude, kLoft };

/// True for shapes that consist of profiles.
bool hasProfile(const Primitive& primitive);

/// Use of the profiles of a shape for which hasProfile() is true.
SketchUse sketchUseOf(const Primitive& primitive);

/// Sections of a shape for which hasProfile() is true. Throws ModelingError if a curve has an
/// invalid structure.
std::vector<SketchSection> sectionsOf(const Primitive& primitive);

/// Primitive with other sections. A section whose curve did not change keeps its knots.
/// Throws ModelingError if a section has too few points for a curve.
Primitive withSections(const Primitive& primitive, const std::vector<SketchSection>& sections);

/// Checks one section with the rules and messages of makePrimitive(); see profile_check.h. Throws
/// ModelingError, as ProfileError where the location is known.
void checkSection(SketchUse use, const std::vector<SketchSection>& sections, std::size_t index);

}  // namespace palpa::modeling
