#pragma once

#include <filesystem>

#include "modeling/shapes/primitive.h"

// Separate files with profile curves, for `palpa-cli new` and for import in the window:
// {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 1], "points_mm": [[0, 0], [10, 0], …]}, and lists of
// sections [{"z_mm": 0, "profile": {…}}, …] for lofts.
namespace palpa::modeling {

inline constexpr std::size_t kMaxProfileFile = 1UL << 20;  // bytes

/// Reads a curve and checks its structure; the numbers are checked when a solid is made from it.
/// Throws ModelingError with the file's name and the JSON path:
/// `curve.json: points_mm[2][0]: found "a", expected a number`.
ProfileCurve readProfileCurve(const std::filesystem::path& path);

/// The same for a list of sections.
std::vector<LoftShape::Section> readSections(const std::filesystem::path& path);

}  // namespace palpa::modeling
