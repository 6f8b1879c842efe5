#include "modeling/mesh/geometry_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <unordered_map>

#include "base/text.h"
#include "modeling/mesh/node_place.h"
#include "modeling/mesh/patch_folds.h"
#include "modeling/mesh/triangle_crossings.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr double kNoHeight = 1e-8;         // of the longest edge
constexpr std::size_t kCheckpoint = 1000;  // triangles between checks of the stop token

/// Fault of one or two triangles. Connected faults become one finding.
struct LocalFault {
  std::vector<int> triangles;
  Vector3d at;
  bool isSevere = true;
};

class GeometryCheck {
 public:
  GeometryCheck(const SurfaceMesh& mesh, const Body& body, const Job& job)
      : mesh_(mesh), body_(body), names_(patchNames(body)), job_(job) {}

  std::vector<GeometryFinding> run() {
    checkEdges();
    checkAreas();
    job_.report(Phase::kCheck, 0.1);
    if (const auto* solid = std::get_if<Solid>(&body_); solid && !mesh_.parameters.empty()) {
      const SurfaceEvaluator surface(*solid);
      checkFolds(surface);
      job_.report(Phase::kCheck, 0.3);
      checkNormals(*solid, surface);
    }
    job_.report(Phase::kCheck, 0.6);
    checkCrossings();
    if (!isOpen_) checkVolume();
    std::stable_partition(findings_.begin(), findings_.end(),
                          [](const GeometryFinding& f) { return f.isError; });
    return std::move(findings_);
  }

 private:
  const Vector3d& corner(std::size_t t, int k) const {
    return mesh_.positions[mesh_.triangles[t][k]];
  }
  Vector3d middle(std::size_t t) const {
    return (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0;
  }
  Vector3d doubleArea(std::size_t t) const {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
  }

  void checkEdges() {
    std::unordered_map<std::uint64_t, int> triangleOf;
    triangleOf.reserve(3 * mesh_.triangles.size());
    const auto key = [](int a, int b) {
      return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    };
    std::vector<LocalFault> open;
    std::vector<LocalFault> twice;
    const auto ends = [&](std::size_t t, int k) {
      return std::array<int, 2>{mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]};
    };
    const auto edgeMiddle = [&](const std::array<int, 2>& e) {
      return Vector3d(0.5 * (mesh_.positions[e[0]] + mesh_.positions[e[1]]));
    };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const auto e = ends(t, k);
        const auto [entry, isNew] = triangleOf.emplace(key(e[0], e[1]), static_cast<int>(t));
        if (!isNew) twice.push_back({{entry->second, static_cast<int>(t)}, edgeMiddle(e)});
      }
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const auto e = ends(t, k);
        if (!triangleOf.contains(key(e[1], e[0])))
          open.push_back({{static_cast<int>(t)}, edgeMiddle(e)});
      }
    isOpen_ = !open.empty() || !twice.empty();
    add(GeometryFault::kWrongOrientation, twice);
    // Triangles beside an inverted one also seem open; they are already reported.
    if (twice.empty()) add(GeometryFault::kOpenEdge, open);
  }

  void checkAreas() {
    std::vector<LocalFault> faults;
    hasNoArea_.assign(mesh_.triangles.size(), false);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      double longest = 0.0;
      for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (corner(t, k) - corner(t, (k + 1) % 3)).squaredNorm());
      if (doubleArea(t).norm() > kNoHeight * longest) continue;
      hasNoArea_[t] = true;
      faults.push_back({{static_cast<int>(t)}, middle(t)});
    }
    add(GeometryFault::kZeroArea, faults);
  }

  void checkFolds(const SurfaceEvaluator& surface) {
    for (const PatchFold& fold : patchFolds(surface, job_)) {
      GeometryFinding finding;
      finding.fault = GeometryFault::kFoldedPatch;
      finding.patches = {names_[fold.at.patch]};
      finding.at = surface.position(fold.at.patch, fold.at.u, fold.at.v);
      finding.message = "the patch \"" + names_[fold.at.patch] +
                        (fold.isFlat ? "\" shrinks to a line or a point near "
                                     : "\" is folded over itself near ") +
                        placeText(finding.at);
      findings_.push_back(std::move(finding));
    }
  }

  void checkNormals(const Solid& solid, const SurfaceEvaluator& surface) {
    std::vector<NodePlace> places;
    for (std::size_t i = 0; i < mesh_.parameters.size(); ++i) {
      if (i % kCheckpoint == 0) job_.throwIfCancelled();
      places.push_back(placeOf(solid, surface, mesh_.parameters[i]));
    }
    // The quarters of a curved triangle only identify places: they may be thin, and lean. The last
    // one is in the middle.
    const std::size_t each = mesh_.isQuadratic ? 4 : 1;
    std::vector<LocalFault> faults;
    for (std::size_t t = each - 1; t < mesh_.triangles.size(); t += each) {
      if (t / each % kCheckpoint == 0) job_.throwIfCancelled();
      if (hasNoArea_[t]) continue;
      Vector3d area = Vector3d::Zero();
      for (std::size_t k = 0; k < each; ++k) area += doubleArea(t - k);
      const auto& n = mesh_.triangles[t];
      const int patch = mesh_.patchOfTriangle[t];
      const auto [a, b, c] =
          cornersIn(surface, patch, {&places[n[0]], &places[n[1]], &places[n[2]]});
      const Vector3d normal =
          surface.normal(patch, (a.u + b.u + c.u) / 3.0, (a.v + b.v + c.v) / 3.0);
      if (normal.dot(area) < 0.0) faults.push_back({{static_cast<int>(t)}, middle(t)});
    }
    add(GeometryFault::kInvertedTriangle, faults);
  }

  void checkCrossings() {
    std::vector<LocalFault> faults;
    for (const TriangleCrossing& crossing :
         triangleCrossings(mesh_.positions, mesh_.triangles, 10000, job_)) {
      // A triangle without area lies in its neighbour; it is already reported.
      if (hasNoArea_[crossing.a] || hasNoArea_[crossing.b]) continue;
      faults.push_back({{crossing.a, crossing.b}, crossing.at, crossing.isThrough});
    }
    add(GeometryFault::kSelfIntersection, faults);
  }

  void checkVolume() {
    double volume = 0.0;
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& x : mesh_.positions) sum += x;
    const Vector3d center =
        sum / std::max<double>(1.0, static_cast<double>(mesh_.positions.size()));
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      volume += doubleArea(t).dot(corner(t, 0) - center) / 6.0;
    if (volume > 0.0 || mesh_.triangles.empty()) return;
    GeometryFinding finding;
    finding.fault = GeometryFault::kInsideOut;
    finding.at = center;
    finding.message = "the enclosed volume is " + roundedText(volume) +
                      " mm³: all or most of the surface is inside out";
    findings_.push_back(std::move(finding));
  }

  /// Adds one finding per group of faults whose triangles have common nodes.
  void add(GeometryFault fault, const std::vector<LocalFault>& faults) {
    std::vector<int> group(faults.size());
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&](int i) {
      while (group[i] != i) i = group[i] = group[group[i]];
      return i;
    };
    std::unordered_map<int, int> faultOfNode;
    for (std::size_t i = 0; i < faults.size(); ++i)
      for (int t : faults[i].triangles)
        for (int node : mesh_.triangles[t]) {
          const int other = faultOfNode.emplace(node, static_cast<int>(i)).first->second;
          // The smallest number becomes the root, so that findings are in the order of triangles.
          const int first = root(static_cast<int>(i));
          const int second = root(other);
          group[std::max(first, second)] = std::min(first, second);
        }
    std::map<int, std::vector<int>> members;
    for (std::size_t i = 0; i < faults.size(); ++i)
      members[root(static_cast<int>(i))].push_back(static_cast<int>(i));
    for (const auto& [first, list] : members) {
      const auto severe =
          std::find_if(list.begin(), list.end(), [&](int i) { return faults[i].isSevere; });
      std::set<int> triangles;
      std::set<int> patches;
      for (int i : list)
        for (int t : faults[i].triangles) {
          triangles.insert(t);
          patches.insert(mesh_.patchOfTriangle[t]);
        }
      GeometryFinding finding;
      finding.fault = severe == list.end() ? GeometryFault::kTouching : fault;
      finding.isError = severe != list.end();
      finding.at = faults[severe == list.end() ? list.front() : *severe].at;
      finding.triangles.assign(triangles.begin(), triangles.end());
      for (int patch : patches) finding.patches.push_back(names_[patch]);
      finding.message = sentence(finding);
      findings_.push_back(std::move(finding));
    }
  }

  static std::string sentence(const GeometryFinding& finding) {
    const std::size_t count = finding.triangles.size();
    const bool one = count == 1;
    const std::string number = one ? "a triangle" : std::to_string(count) + " triangles";
    constexpr std::size_t kMaxNames = 6;
    std::string names;
    for (const std::string& name : finding.patches) {
      if (&name - finding.patches.data() == kMaxNames) {
        names += " and " + std::to_string(finding.patches.size() - kMaxNames) + " more";
        break;
      }
      names += (names.empty() ? "\"" : ", \"") + name + "\"";
    }
    const std::string where = " near " + placeText(finding.at) +
                              (finding.patches.size() == 1 ? ", patch " : ", patches ") + names;
    switch (finding.fault) {
      case GeometryFault::kSelfIntersection:
        return "the surface intersects itself" + where + " (" + number + ")";
      case GeometryFault::kTouching:
        return "parts of the surface touch each other" + where + " (" + number + ")";
      case GeometryFault::kInvertedTriangle:
        return number + (one ? " points" : " point") + " into the body" + where;
      case GeometryFault::kZeroArea:
        return number + (one ? " has" : " have") + " no area" + where;
      case GeometryFault::kOpenEdge:
        return "the surface has a hole or a gap" + where + " (" + number + " at its edge)";
      case GeometryFault::kWrongOrientation:
        return "adjacent triangles have opposite orientations" + where + " (" + number + ")";
      case GeometryFault::kInsideOut:
      case GeometryFault::kFoldedPatch:
        break;
    }
    return std::string(faultName(finding.fault)) + where;
  }

  const SurfaceMesh& mesh_;
  const Body& body_;
  std::vector<std::string> names_;
  const Job& job_;
  bool isOpen_ = false;
  std::vector<bool> hasNoArea_;
  std::vector<GeometryFinding> findings_;
};

}  // namespace

std::string_view faultName(GeometryFault fault) {
  switch (fault) {
    case GeometryFault::kSelfIntersection:
      return "self_intersection";
    case GeometryFault::kTouching:
      return "touching";
    case GeometryFault::kInvertedTriangle:
      return "inverted_triangle";
    case GeometryFault::kZeroArea:
      return "zero_area";
    case GeometryFault::kOpenEdge:
      return "open_edge";
    case GeometryFault::kWrongOrientation:
      return "wrong_orientation";
    case GeometryFault::kInsideOut:
      return "inside_out";
    case GeometryFault::kFoldedPatch:
      return "folded_patch";
  }
  return "unknown";
}

std::vector<GeometryFinding> checkGeometry(const SurfaceMesh& mesh, const Body& body,
                                           const Job& job) {
  job.throwIfCancelled();
  const std::size_t patches = patchNames(body).size();
  for (int patch : mesh.patchOfTriangle)
    if (patch < 0 || patch >= static_cast<int>(patches))
      throw std::invalid_argument("checkGeometry: the mesh has patches that are not in the body");
  return GeometryCheck(mesh, body, job).run();
}

}  // namespace palpa::modeling
