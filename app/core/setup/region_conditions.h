#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "bem/model/traction_projection.h"
#include "modeling/mesh/surface_mesh.h"
#include "modeling/project/project.h"

// Conditions of supports and loads, for both engines. Regions are numbered as in meshRegions(): the
// supports' first, then the regions of the loads that have one.
namespace palpa::app {

/// Tags of boundary elements: one per combination of regions that occurs, 0 for none. A combination
/// has at most one support: of supports that share a place, a fixed one has it, otherwise the first
/// of the list.
class RegionTags {
 public:
  /// Numbers the combinations in the order of the mesh's triangles.
  RegionTags(const modeling::Project& project, const modeling::SurfaceMesh& mesh);

  const std::vector<int>& ofTriangle() const { return ofTriangle_; }
  /// The tag of the regions of `tag` and `region` together; a combination that no triangle has gets
  /// a new tag.
  int with(int tag, int region);
  /// Regions of a tag, ascending.
  const std::vector<int>& regions(int tag) const { return combinations_[tag]; }
  bool isIn(int tag, int region) const;
  /// The support of a tag; none if the place is free.
  std::optional<int> supportOf(int tag) const;
  /// Tags with a support, ascending.
  std::vector<int> ofSupports() const;
  /// Triangles with this region, ascending.
  std::vector<int> trianglesIn(int region) const;

 private:
  int tagOf(const std::vector<int>& combination);
  std::vector<int> united(std::vector<int> combination, int region) const;

  std::vector<bool> isFixed_;  // per support
  std::vector<std::vector<int>> combinations_{{}};
  std::map<std::vector<int>, int> tags_{{{}, 0}};
  std::vector<int> ofTriangle_;
};

/// The project's mesh with tags, checked.
bem::BoundaryMesh boundaryMesh(const modeling::SurfaceMesh& surface, std::vector<int> tags);

/// Throws SupportConflictError if two supports prescribe different displacements where they overlap
/// (normal components, if one is a roller), or if two fixed ones do where they meet. It looks at
/// the mesh, so that both engines give the same message.
void checkSupports(const modeling::Project& project, const RegionTags& tags,
                   const modeling::SurfaceMesh& mesh);

/// The displacement that the supports meeting at a place prescribe: the displacement of a fixed
/// one, otherwise the shortest vector with the normal components of all rollers.
class PrescribedDisplacement {
 public:
  /// `position`: mm, for the message. Throws SupportConflictError if another support prescribes a
  /// different displacement.
  void addFixed(const modeling::Support& support, const Eigen::Vector3d& position);
  void addRoller(const modeling::Support& support, const Eigen::Vector3d& normal);
  Eigen::Vector3d value() const;  ///< mm

 private:
  const modeling::Support* fixed_ = nullptr;
  std::vector<std::pair<Eigen::Vector3d, double>> rows_;
};

/// The traction of a pressure, uniform traction or bump on the surface of its region; a bump is
/// zero outside its radius. Other loads need the region as well: see load_setup.h.
struct LoadTraction {
  bem::TractionFunction traction;
  /// Length over which it varies, mm; infinite where it is smooth at the size of an element.
  double featureLength;
};
LoadTraction loadTraction(const modeling::Load& load);

}  // namespace palpa::app
