#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "modeling/body/mesh_body.h"
#include "modeling/solid/solid.h"

namespace palpa::modeling {

/// Body of a project: a NUBS solid, which can be edited, or a mesh body, which cannot. The named
/// parts of its surface are patches or faces; regions call both patches.
using Body = std::variant<Solid, MeshBody>;

/// Index of the patch (or face) with this name; none if there is none.
std::optional<int> findPatch(const Body& body, std::string_view name);

/// All patch (or face) names in order.
std::vector<std::string> patchNames(const Body& body);

/// All patch (or face) names in order, quoted and separated by commas, for messages.
std::string quotedPatchNames(const Body& body);

/// Minimum and maximum corner of the axis-parallel box around all control points (or vertices), mm.
std::array<Eigen::Vector3d, 2> boundingBox(const Body& body);

/// Enclosed volume in mm³, and surface area in mm².
double volume(const Body& body);
double area(const Body& body);

}  // namespace palpa::modeling
