#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

namespace palpa::gui {

/// Place on the surface of the body.
struct SurfacePlace {
  int patch = -1;                                      ///< index of patchNames(body)
  std::optional<Eigen::Vector2d> parameters;           ///< u, v; for solids only
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mm
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, outwards
};

/// The drawn triangles; valid until the next edit.
struct ShownSurface {
  std::span<const Eigen::Vector3d> positions;  ///< mm
  std::span<const std::array<int, 3>> triangles;
  std::span<const int> patchOfTriangle;

  Eigen::Vector3d middle(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle];
    return (positions[a] + positions[b] + positions[c]) / 3.0;
  }
};

}  // namespace palpa::gui
