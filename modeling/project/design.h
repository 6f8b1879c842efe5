#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modeling/project/point_selection.h"
#include "modeling/solid/mirror_plane.h"

namespace palpa::modeling {

/// What a touch of the project should feel like.
struct DesignTarget {
  enum class Kind {
    kStiffness,  ///< N/mm, as `palpa-cli touch` reports it
    kForce,      ///< N, norm of the force of the touch
  };
  std::string touch;  ///< its name
  Kind kind = Kind::kStiffness;
  double value = 1.0;             ///< > 0
  std::optional<double> depth{};  ///< mm, > 0, of a force; by default the touch's own displacement
  double weight = 1.0;            ///< > 0; counts if not all targets can be reached

  bool operator==(const DesignTarget&) const = default;
};

/// Settings of the search for a shape (docs/project-file.md, "Design").
struct Design {
  enum class Along { kNormal, kAny, kDirection };
  enum class Volume { kFree, kKept, kNotLarger, kMinimised };

  std::vector<DesignTarget> targets;
  /// Control points that may move; by default all outside patches that supports fix as a whole.
  std::optional<PointSelection> points{};
  Along along = Along::kNormal;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< of Along::kDirection
  /// mm, > 0, of a control point; by default a tenth of the diagonal of the body's box.
  std::optional<double> largestMovement{};
  std::vector<MirrorPlane> mirrors{};  ///< the shape stays symmetric; up to kMaxMirrors
  Volume volume = Volume::kFree;
  std::optional<double> smallestThickness{};  ///< mm, > 0, of walls
  double smoothness = 1.0;                    ///< 0 … kMaxSmoothness
  double tolerance = 0.005;                   ///< relative, kMinTolerance … kMaxTolerance
  int steps = 20;                             ///< 1 … kMaxSteps

  static constexpr std::size_t kMaxMirrors = 3;
  static constexpr double kMaxSmoothness = 100.0;
  static constexpr double kMinTolerance = 1e-4, kMaxTolerance = 0.1;
  static constexpr int kMaxSteps = 200;

  bool operator==(const Design&) const = default;
};

/// Names of Design::Volume in files and options, in its order.
inline constexpr std::array<const char*, 4> kVolumeNames{"free", "kept", "not_larger", "minimised"};

/// The rule with this name; none if there is no such rule.
std::optional<Design::Volume> volumeNamed(std::string_view name);

/// Checks ranges and the names of touches; the selection of points is checked by the search.
/// Throws ModelingError that begins with `path`: `design.targets[0].touch: no touch is named …`.
void checkDesign(const Design& design, const std::vector<std::string>& touchNames,
                 const std::string& path);

/// Renames a patch in a selection.
void renamePatch(PointSelection& selection, const std::string& from, const std::string& to);
/// True if a part of the selection depends on where points are.
bool selectsByPosition(const PointSelection& selection);

}  // namespace palpa::modeling
