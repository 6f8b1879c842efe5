#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpa::modeling {

/// NUBS patch: a tensor-product B-spline surface whose control points are indices into the shared
/// list of the solid. Direction 0 is u, direction 1 is v.
struct Patch {
  std::string name;
  std::array<int, 2> degree{};               ///< 1 … 5 in each direction
  std::array<std::vector<double>, 2> knots;  ///< clamped; size = net size + degree + 1
  std::vector<std::vector<int>> net;         ///< net[i][j]: i along u, j along v

  /// First and last knot of a direction.
  std::array<double, 2> range(int direction) const {
    return {knots[direction].front(), knots[direction].back()};
  }
};

/// Sides of a patch, counter-clockwise in the (u, v) plane.
enum class Side { kVMin = 0, kUMax = 1, kVMax = 2, kUMin = 3 };

inline constexpr std::array<Side, 4> kSides{Side::kVMin, Side::kUMax, Side::kVMax, Side::kUMin};

/// Direction of the varying parameter along a side: 0 (u) for kVMin and kVMax, 1 (v) otherwise.
constexpr int directionOf(Side side) {
  return side == Side::kVMin || side == Side::kVMax ? 0 : 1;
}

/// True if the counter-clockwise walk around the patch follows the growing parameter on this side.
constexpr bool isForward(Side side) {
  return side == Side::kVMin || side == Side::kUMax;
}

/// Name of a side in messages: "v-min", "u-max", "v-max" or "u-min".
std::string_view sideName(Side side);

/// Side of a patch.
struct PatchEdge {
  int patch = -1;
  Side side = Side::kVMin;
};

/// Edge of the solid: two patch sides glued together.
struct SolidEdge {
  std::array<PatchEdge, 2> uses;
  bool reversed = false;          ///< the parameters of the two sides run in opposite directions
  bool smooth = false;            ///< editing keeps the tangent plane continuous across the edge
  std::array<int, 2> vertices{};  ///< control points at the start and end of uses[0]'s parameter
};

/// Closed body bounded by NUBS patches that share control points (positions in mm).
///
/// Invariants, checked by the constructor: degrees 1 … 5; knots finite, non-decreasing, clamped,
/// interior multiplicity at most the degree; net sizes match the knots; indices in range; points
/// finite; patch names unique; every patch side is glued to exactly one other side with the same
/// points, degree and (after affine normalisation) knots; around every vertex the patches form one
/// fan; neighbours agree in orientation and the normals du × dv point outwards (volume > 0).
///
/// Value type; const access from several threads is safe. Copies share patches and edges, and so
/// does withControlPoints(): a copy costs 24 bytes per control point.
class Solid {
 public:
  /// Empty solid without patches: the only solid that violates the invariants.
  Solid();

  /// Solid of the given patches. `smoothEdges` names edges by either of their two sides; all other
  /// edges are sharp. Throws ModelingError if an invariant is violated; the message names the
  /// location as in the project file, for example `solid.patches[2].knots[0][5]: 0.4 is smaller
  /// than the knot before it (0.5)`.
  Solid(std::vector<Eigen::Vector3d> controlPoints, std::vector<Patch> patches,
        const std::vector<PatchEdge>& smoothEdges = {});

  /// Solid with the same patches and other control points, mm. Throws ModelingError if a point is
  /// not finite or the volume is not positive; std::invalid_argument if the number of points
  /// differs.
  Solid withControlPoints(std::vector<Eigen::Vector3d> controlPoints) const;

  /// Same solid with the given edges (indices into edges()) smooth or sharp.
  Solid withSmoothEdges(const std::vector<int>& edges, bool smooth) const;

  const std::vector<Eigen::Vector3d>& controlPoints() const { return controlPoints_; }
  const std::vector<Patch>& patches() const { return topology_->patches; }
  const std::vector<SolidEdge>& edges() const { return topology_->edges; }

  /// True if both solids share patches and edges, so that only control points can differ.
  bool sharesTopologyWith(const Solid& other) const { return topology_ == other.topology_; }

  /// Index into edges() of the edge that contains a patch side.
  int edgeOf(int patch, Side side) const {
    return topology_->edgeOfSide[patch][static_cast<int>(side)];
  }

  /// Control points at the start and the end (in growing parameter) of a side: vertices of the
  /// solid.
  std::array<int, 2> verticesOf(int patch, Side side) const;

  /// Index of the patch with this name, if any.
  std::optional<int> findPatch(std::string_view name) const;

 private:
  struct Topology {
    std::vector<Patch> patches;
    std::vector<SolidEdge> edges;
    std::vector<std::array<int, 4>> edgeOfSide;
  };

  std::vector<Eigen::Vector3d> controlPoints_;
  std::shared_ptr<const Topology> topology_;
};

}  // namespace palpa::modeling
