#include "modeling/mesh/mesh_follow.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "base/support_border.h"
#include "base/text.h"
#include "modeling/error.h"
#include "modeling/mesh/border_slide.h"
#include "modeling/mesh/mesh_regions.h"
#include "modeling/mesh/node_place.h"
#include "modeling/mesh/triangle_shape.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

constexpr double kOnBorder = 2e-9;         // of the diagonal: nearer nodes lie on the border
constexpr double kConverged = 1e-11;       // of the diagonal: tolerance after sliding
constexpr double kNearBorder = 0.1;        // of a triangle's longest edge: tolerance of its middle
constexpr double kCountsAsOn = 0.1;        // of the shortest edge at a node that cannot slide
constexpr std::size_t kCheckpoint = 1000;  // nodes or triangles between checks of the job

/// Exception that ends the update. `why` becomes FollowResult::remeshReason.
struct RemeshNeeded {
  std::string why;
};

bool sameBits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

bool samePatches(const Solid& a, const Solid& b) {
  if (a.sharesTopologyWith(b)) return true;
  return a.controlPoints().size() == b.controlPoints().size() &&
         std::equal(a.patches().begin(), a.patches().end(), b.patches().begin(), b.patches().end(),
                    [](const Patch& p, const Patch& q) {
                      return p.name == q.name && p.degree == q.degree && p.knots == q.knots &&
                             p.net == q.net;
                    });
}

class Follower {
 public:
  Follower(const SurfaceMesh& previous, const Solid& meshed, const Solid& solid,
           const FollowLimits& limits, const Job& job)
      : previous_(previous),
        meshed_(meshed),
        solid_(solid),
        surface_(solid),
        limits_(limits),
        job_(job),
        result_(previous) {
    if (previous.parameters.size() != previous.positions.size())
      throw std::invalid_argument("followSolid: the mesh has no parameters; it is of a mesh body");
    const auto [low, high] = boundingBox(solid);
    diagonal_ = (high - low).norm();
  }

  MeshUpdate run(std::span<const MeshRegion> regions) {
    checkRegions(regions);
    gatherBorders();
    for (std::size_t i = 0; i < result_.positions.size(); ++i) {
      if (i % kCheckpoint == 0) job_.throwIfCancelled();
      moveNode(static_cast<int>(i));
    }
    std::vector<int> moved = differingNodes(previous_, result_);
    std::vector<int> concerned = moved;
    if (paintMoved_) {
      concerned.resize(result_.positions.size());
      std::iota(concerned.begin(), concerned.end(), 0);
    }
    checkSides(concerned);
    checkTriangles(concerned);
    if (!moved.empty()) checkGroups();
    return {std::move(result_), std::move(moved)};
  }

 private:
  void checkRegions(std::span<const MeshRegion> regions) {
    const RemeshNeeded changed{"the supports, the loads or the borders in the mesh have changed"};
    const std::vector<RegionBorder> borders = distinctBorders(regions);
    if (!std::equal(borders.begin(), borders.end(), previous_.borders.begin(),
                    previous_.borders.end(),
                    [](const RegionBorder& a, const RegionBorder& b) { return a.isLike(b); }) ||
        regions.size() != previous_.trianglesOfRegion.size())
      throw changed;
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (trianglesOf(regions[r], solid_, previous_.patchOfTriangle, previous_.bordersOfTriangle,
                      borders) != previous_.trianglesOfRegion[r])
        throw changed;
    paintMoved_ = borders != previous_.borders;
    result_.borders = borders;
  }

  /// Sets all_ and some_.
  void gatherBorders() {
    all_.assign(result_.positions.size(), ~std::uint64_t{0});
    some_.assign(result_.positions.size(), 0);
    if (previous_.borders.empty()) return;
    for (std::size_t t = 0; t < previous_.triangles.size(); ++t)
      for (int node : previous_.triangles[t]) {
        all_[node] &= previous_.bordersOfTriangle[t];
        some_[node] |= previous_.bordersOfTriangle[t];
      }
  }

  double tolerance(const RegionBorder& border, double part) const {
    return part * diagonal_ * border.slope();
  }

  /// New versions of the borders that a node lies on: it has triangles on both sides of them and
  /// lay exactly on the previous ones.
  std::vector<const RegionBorder*> slidingBorders(int node) const {
    std::vector<const RegionBorder*> borders;
    for (std::uint64_t bits = some_[node] & ~all_[node]; bits != 0; bits &= bits - 1) {
      const RegionBorder& border = previous_.borders[std::countr_zero(bits)];
      if (std::abs(border.value(previous_.positions[node])) <= tolerance(border, kOnBorder))
        borders.push_back(&result_.borders[std::countr_zero(bits)]);
    }
    return borders;
  }

  void moveNode(int node) {
    const SurfaceParameter& at = result_.parameters[node];
    if (!patchMoved(at.patch) && !paintMoved_) return;
    const NodePlace place = placeOf(solid_, surface_, at);
    if (place.vertex >= 0) {
      result_.positions[node] = solid_.controlPoints()[place.vertex];
      return;
    }
    result_.positions[node] = surface_.position(at.patch, at.u, at.v);
    if (sameBits(result_.positions[node], previous_.positions[node]) && !paintMoved_) return;
    const std::vector<const RegionBorder*> borders = slidingBorders(node);
    if (!borders.empty()) slide(node, place, borders);
  }

  bool patchMoved(int patch) {
    if (patchMoved_.empty()) {
      for (const Patch& p : solid_.patches()) {
        bool moved = false;
        for (const std::vector<int>& row : p.net)
          for (int point : row)
            moved =
                moved || !sameBits(meshed_.controlPoints()[point], solid_.controlPoints()[point]);
        patchMoved_.push_back(moved);
      }
    }
    return patchMoved_[patch];
  }

  void slide(int node, const NodePlace& place, const std::vector<const RegionBorder*>& borders) {
    SurfaceParameter& at = result_.parameters[node];
    if (!slideOntoBorders(surface_, place.edge >= 0, borders, kConverged * diagonal_, at))
      throw RemeshNeeded{"the border of a region near " + placeText(previous_.positions[node]) +
                         " has moved to another patch or edge, or away from the surface"};
    result_.positions[node] = surface_.position(at.patch, at.u, at.v);
  }

  /// Throws RemeshNeeded if a moved node and its triangles are on different sides of a border.
  void checkSides(const std::vector<int>& moved) const {
    if (previous_.borders.empty()) return;
    std::vector<double> shortest(result_.positions.size(), HUGE_VAL);
    for (const auto& n : previous_.triangles)
      for (int k = 0; k < 3; ++k) {
        const double length =
            (previous_.positions[n[k]] - previous_.positions[n[(k + 1) % 3]]).norm();
        shortest[n[k]] = std::min(shortest[n[k]], length);
        shortest[n[(k + 1) % 3]] = std::min(shortest[n[(k + 1) % 3]], length);
      }
    for (int node : moved)
      for (std::size_t k = 0; k < previous_.borders.size(); ++k) {
        const RegionBorder& border = previous_.borders[k];
        const bool inside = (all_[node] >> k) & 1;
        const bool outside = !((some_[node] >> k) & 1);
        const double value = result_.borders[k].value(result_.positions[node]);
        const double before = std::abs(border.value(previous_.positions[node]));
        const double allowed = inside || outside
                                   ? tolerance(border, kOnBorder)
                                   : std::max({tolerance(border, kOnBorder), 1.5 * before,
                                               kCountsAsOn * shortest[node] * border.slope()});
        if ((!outside && value > allowed) || (!inside && value < -allowed))
          throw RemeshNeeded{"the surface near " + placeText(result_.positions[node]) +
                             " has crossed the border of a region"};
      }
  }

  void checkTriangles(const std::vector<int>& moved) const {
    std::vector<bool> isMoved(result_.positions.size(), false);
    for (int node : moved) isMoved[node] = true;
    for (std::size_t t = 0; t < result_.triangles.size(); ++t) {
      if (t % kCheckpoint == 0) job_.throwIfCancelled();
      const auto& n = result_.triangles[t];
      if (isMoved[n[0]] || isMoved[n[1]] || isMoved[n[2]]) checkTriangle(t);
    }
  }

  void checkTriangle(std::size_t t) const {
    const auto& n = result_.triangles[t];
    const auto& x = result_.positions;
    const auto& old = previous_.positions;
    const std::string near = " near " + placeText(x[n[0]]);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double length = (x[n[k]] - x[n[(k + 1) % 3]]).norm();
      const double before = (old[n[k]] - old[n[(k + 1) % 3]]).norm();
      longest = std::max(longest, length);
      if (length > limits_.edgeRatio * before || before > limits_.edgeRatio * length)
        throw RemeshNeeded{"an edge" + near + " has become " + roundedText(length) +
                           " mm long, from " + roundedText(before) + " mm"};
    }
    const double angle = smallestAngle(x[n[0]], x[n[1]], x[n[2]]);
    if (angle < limits_.smallestAngle * std::numbers::pi / 180.0 &&
        angle < smallestAngle(old[n[0]], old[n[1]], old[n[2]]))
      throw RemeshNeeded{"a triangle" + near + " has become too thin"};

    const int patch = result_.patchOfTriangle[t];
    const std::array<NodePlace, 3> places{placeOf(solid_, surface_, result_.parameters[n[0]]),
                                          placeOf(solid_, surface_, result_.parameters[n[1]]),
                                          placeOf(solid_, surface_, result_.parameters[n[2]])};
    const auto [a, b, c] = cornersIn(surface_, patch, {&places[0], &places[1], &places[2]});
    const double u = (a.u + b.u + c.u) / 3.0;
    const double v = (a.v + b.v + c.v) / 3.0;
    const Eigen::Vector3d normal = (x[n[1]] - x[n[0]]).cross(x[n[2]] - x[n[0]]);
    if (!(normal.dot(surface_.normal(patch, u, v)) > limits_.leastAlongNormal * normal.norm()))
      throw RemeshNeeded{"a triangle" + near + " has turned away from the surface"};
    for (std::size_t k = 0; k < previous_.borders.size(); ++k) {
      const RegionBorder& border = result_.borders[k];
      const bool inside = (previous_.bordersOfTriangle[t] >> k) & 1;
      const double value = border.value(surface_.position(patch, u, v)) * (inside ? 1.0 : -1.0);
      if (value > kNearBorder * longest * border.slope())
        throw RemeshNeeded{"the surface" + near + " has crossed the border of a region"};
    }
  }

  void checkGroups() const {
    const std::vector<int> groups = smoothingGroups(solid_, sharpEdges(solid_, surface_));
    for (std::size_t t = 0; t < result_.triangles.size(); ++t)
      if (groups[result_.patchOfTriangle[t]] != result_.smoothingGroupOfTriangle[t])
        throw RemeshNeeded{"an edge has become sharp or smooth"};
    // Elements beside notches have other middle nodes.
    if (result_.isQuadratic && notchesOf(previous_.positions) != notchesOf(result_.positions))
      throw RemeshNeeded{"an edge has become a notch or ceased to be one"};
  }

  std::vector<std::array<bool, 3>> notchesOf(const std::vector<Eigen::Vector3d>& positions) const {
    std::vector<std::array<int, 3>> corners;
    std::vector<int> groups;
    for (std::size_t t = 0; t < result_.triangles.size(); t += 4) {
      corners.push_back(
          {result_.triangles[t][0], result_.triangles[t + 1][1], result_.triangles[t + 2][2]});
      groups.push_back(result_.smoothingGroupOfTriangle[t]);
    }
    return notchEdges(corners, positions, groups, std::vector<bool>(corners.size(), false));
  }

  const SurfaceMesh& previous_;
  const Solid& meshed_;
  const Solid& solid_;
  SurfaceEvaluator surface_;
  const FollowLimits& limits_;
  const Job& job_;
  SurfaceMesh result_;
  double diagonal_ = 0.0;
  std::vector<bool> patchMoved_;
  bool paintMoved_ = false;          // strokes moved with the surface
  std::vector<std::uint64_t> all_;   // per node: borders around all its triangles
  std::vector<std::uint64_t> some_;  // per node: borders around at least one of its triangles
};

}  // namespace

std::vector<int> differingNodes(const SurfaceMesh& a, const SurfaceMesh& b) {
  if (a.positions.size() != b.positions.size())
    throw std::invalid_argument("differingNodes: the meshes have different numbers of nodes");
  std::vector<int> nodes;
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    if (!sameBits(a.positions[i], b.positions[i])) nodes.push_back(static_cast<int>(i));
  return nodes;
}

FollowResult followSolid(const SurfaceMesh& previous, const Solid& meshed, const Solid& solid,
                         std::span<const MeshRegion> regions, const FollowLimits& limits,
                         const Job& job) {
  job.throwIfCancelled();
  if (!samePatches(meshed, solid)) return {std::nullopt, "the patches or their knots have changed"};
  try {
    return {Follower(previous, meshed, solid, limits, job).run(regions), ""};
  } catch (const RemeshNeeded& needed) {
    return {std::nullopt, needed.why};
  } catch (const ModelingError& error) {
    return {std::nullopt, error.what()};
  }
}

}  // namespace palpa::modeling
