#pragma once

#include <filesystem>

#include "bench/parts/part_touch.h"
#include "bench/peers/external_program.h"
#include "bench/peers/tetrahedra.h"

namespace palpa::bench {

/// Sizes of the elements of a mesh for a touch, mm.
struct PartSizes {
  double largest = 0;  ///< far from the support and the touch
  double support = 0;  ///< at the border of the support
  double touch = 0;    ///< under the touch
};

/// Gmsh's model of a part: finds the surfaces of the support, then meshes at several sizes.
class GmshPart {
 public:
  /// Reads the file by Gmsh (C. Geuzaine, J.-F. Remacle, Int. J. Numer. Meth. Eng. 79, 2009) with
  /// its OpenCASCADE kernel, in mm. Throws LeftOut if Gmsh fails or finds no surface in the plane
  /// of the support.
  GmshPart(const std::filesystem::path& file, const PartTouch& part);

  /// Curved quadratic tetrahedra, independent of Palpa's triangles; faces on the support have the
  /// tag 1. Throws LeftOut if Gmsh fails.
  TetrahedralMesh mesh(const PartSizes& sizes) const;

  int supportSurfaces() const { return static_cast<int>(support_.size()); }

 private:
  std::filesystem::path file_;
  const PartTouch& part_;
  std::vector<int> support_;  // tags of surfaces
};

}  // namespace palpa::bench
