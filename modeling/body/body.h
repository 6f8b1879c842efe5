#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "modeling/body/mesh_body.h"
#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// What a project is about: a NUBS solid that can be edited, or a mesh body that cannot. The named
/// parts of its surface are its patches or its faces; both are called patches in regions.
using Body = std::variant<Solid, MeshBody>;

/// Index of the patch (or face) with this name.
std::optional<int> findPatch(const Body& body, std::string_view name);

/// All patch (or face) names in order.
std::vector<std::string> patchNames(const Body& body);

/// The same, quoted and separated by commas, for messages.
std::string quotedPatchNames(const Body& body);

/// Corners of the axis-parallel box around all control points (or vertices).
std::array<Eigen::Vector3d, 2> boundingBox(const Body& body);

/// Enclosed volume in mm³ and surface area in mm².
double volume(const Body& body);
double area(const Body& body);

}  // namespace palpa::modeling
