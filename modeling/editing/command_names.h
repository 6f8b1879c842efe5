#pragma once

#include <array>
#include <string_view>

#include "modeling/editing/command.h"

namespace palpa::modeling {

/// Names of commands in JSON, in the order of the variant Command.
inline constexpr std::array<std::string_view, std::variant_size_v<Command>> kCommandNames{
    "move_points",     "scale_points",    "rotate_points",      "align_points",   "insert_knot",
    "remove_knot",     "elevate_degree",  "transform_solid",    "make_primitive", "set_edge",
    "add_support",     "set_support",     "remove_support",     "take_overlap",   "add_load",
    "set_load",        "remove_load",     "add_touch",          "set_touch",      "remove_touch",
    "add_measurement", "set_measurement", "remove_measurement", "set_material",   "set_mesh",
    "set_design",      "rename_project",  "rename_patch"};

}  // namespace palpa::modeling
