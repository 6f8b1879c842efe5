#pragma once

#include <filesystem>

namespace palpa::render_tests {

/// Draws a body of 145,000 triangles at rest, moving and at rest again. Returns 0 if the moving one
/// has fewer triangles and looks about the same, a small body looks the same, and nothing of it is
/// left afterwards.
int requireFewerTrianglesWhileMoving(const std::filesystem::path& output);

}  // namespace palpa::render_tests
