#include "modeling/project/proposed_support.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "modeling/project/body_facets.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;

constexpr double kFlatness = 1e-4;    // distance from the plane over the size of the body
constexpr double kParallel = 1e-3;    // between the normals of faces in one plane, rad
constexpr double kMinShare = 0.02;    // of the surface
constexpr double kSimilarArea = 0.9;  // of the largest face
constexpr std::size_t kMaxNames = 3;  // in a message

/// A patch, or several adjacent ones in one plane.
struct FlatFace {
  std::vector<int> patches;
  double area = 0.0;
  Vector3d areaNormal = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();  ///< area times centroid
  bool isFlat = true;

  Vector3d normal() const { return areaNormal.normalized(); }
  Vector3d centroid() const { return moment / area; }
};

std::vector<FlatFace> facesOf(const Body& body, const BodyFacets& surface) {
  std::vector<FlatFace> faces(patchNames(body).size());
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i].patches = {static_cast<int>(i)};
  for (const BodyFacets::Facet& facet : surface.facets) {
    FlatFace& face = faces[facet.patch];
    const double area = facet.areaNormal.norm();
    face.area += area;
    face.areaNormal += facet.areaNormal;
    face.moment += area * facet.centre();
  }
  for (FlatFace& face : faces) face.isFlat = face.areaNormal.norm() > 0.999 * face.area;
  for (const BodyFacets::Facet& facet : surface.facets) {
    FlatFace& face = faces[facet.patch];
    if (!face.isFlat) continue;
    const Vector3d normal = face.normal(), centroid = face.centroid();
    face.isFlat =
        std::all_of(facet.corners.begin(), facet.corners.end(), [&](const Vector3d& corner) {
          return std::abs(normal.dot(corner - centroid)) <= kFlatness * surface.size;
        });
  }
  return faces;
}

/// Adjacent flat patches in one plane become one face.
std::vector<FlatFace> unite(const std::vector<FlatFace>& patches, const BodyFacets& surface) {
  std::vector<int> parent(patches.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int patch) {
    while (parent[patch] != patch) patch = parent[patch];
    return patch;
  };
  for (const auto& [a, b] : surface.neighbours) {
    const FlatFace &first = patches[a], &second = patches[b];
    if (!first.isFlat || !second.isFlat) continue;
    if ((first.normal() - second.normal()).norm() > kParallel) continue;
    const double step = first.normal().dot(second.centroid() - first.centroid());
    if (std::abs(step) > kFlatness * surface.size) continue;
    const auto [least, other] = std::minmax({root(a), root(b)});
    parent[other] = least;
  }
  std::vector<FlatFace> united(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches[i].isFlat) continue;
    FlatFace& face = united[root(static_cast<int>(i))];
    face.patches.push_back(static_cast<int>(i));
    face.area += patches[i].area;
    face.areaNormal += patches[i].areaNormal;
    face.moment += patches[i].moment;
  }
  std::erase_if(united, [](const FlatFace& face) { return face.patches.empty(); });
  return united;
}

/// Rounded, so that rounding errors do not decide between faces.
std::array<double, 2> downwards(const FlatFace& face, double size) {
  return {std::round(1e3 * face.normal().z()), std::round(1e3 * face.centroid().z() / size)};
}

}  // namespace

std::string ProposedSupport::description() const {
  if (flatFace.empty()) return "the lowest tenth";
  std::string names;
  for (std::size_t i = 0; i < std::min(flatFace.size(), kMaxNames); ++i)
    names += (i ? ", \"" : "\"") + flatFace[i] + "\"";
  if (flatFace.size() > kMaxNames)
    names += " and " + std::to_string(flatFace.size() - kMaxNames) + " more";
  return "the largest flat face, " + names;
}

Support supportOfLowestTenth(const Body& body) {
  const auto [low, high] = boundingBox(body);
  Support base;
  base.name = "base";
  base.where = Region::below(Vector3d::UnitZ(), low.z() + 0.1 * (high.z() - low.z()));
  return base;
}

ProposedSupport proposeSupport(const Body& body) {
  const BodyFacets surface = bodyFacets(body);
  const std::vector<FlatFace> faces = unite(facesOf(body, surface), surface);
  double largest = 0.0, whole = 0.0;
  for (const FlatFace& face : faces) largest = std::max(largest, face.area);
  for (const BodyFacets::Facet& facet : surface.facets) whole += facet.areaNormal.norm();
  if (largest < kMinShare * whole || faces.empty()) return {supportOfLowestTenth(body), {}};
  const FlatFace* best = nullptr;
  for (const FlatFace& face : faces) {
    if (face.area < kSimilarArea * largest) continue;
    if (!best || downwards(face, surface.size) < downwards(*best, surface.size)) best = &face;
  }
  ProposedSupport proposed;
  const std::vector<std::string> names = patchNames(body);
  for (const int patch : best->patches) proposed.flatFace.push_back(names[patch]);
  proposed.support.name = "base";
  proposed.support.where = Region::ofPatches(proposed.flatFace);
  return proposed;
}

}  // namespace palpa::modeling
