#pragma once

#include <map>
#include <optional>
#include <string>

#include "modeling/body/region.h"

namespace palpa::modeling {

/// Kind of the boundary elements of a body: splines on its patches, flat triangles with linear
/// functions, or curved triangles with quadratic functions. Automatic: see engineFor().
enum class Engine { kAutomatic, kSplines, kTriangles, kQuadratic };

/// Settings of meshing and discretisation, as in a project file.
struct MeshSettings {
  /// Target distance of adjacent nodes in mm, > 0: the length of triangle legs, or half of it for
  /// quadratic triangles, which have nodes in the middles of their edges.
  double edgeLength = 5.0;
  int refinementLevels = 0;  ///< 0 … 6: the finest size is edgeLength / 2^levels
  bool refineAtSharpEdges = false;
  bool refineAtBorders = false;  ///< along the borders of regions with isSupport
  /// Factor of edge and element lengths by patch name, 0.05 … 20; 1 for all other patches. The
  /// surrounding patches get as many pieces as needed to fit.
  std::map<std::string, double> patchFactors{};
  /// Features of mesh bodies smaller than this fraction of the edge length there are meshed over,
  /// 0 … 1; 0 keeps all.
  double featureFraction = 0.25;
  Engine engine = Engine::kAutomatic;
  /// Requested relative error of displacements and forces, 1e-4 … 0.1; sets the size of the spline
  /// elements unless elementLength does.
  double accuracy = 0.01;
  /// Number of spline elements per length over the number that `accuracy` leads to, 1 … 16; raised
  /// where that number is not enough. Ignored with elementLength.
  double splineDensity = 1;
  static constexpr double kMaxSplineDensity = 16;
  /// Size of the spline elements away from borders in mm, > 0; multiplied by patchFactors.
  std::optional<double> elementLength{};

  bool operator==(const MeshSettings&) const = default;

  /// Checks all fields except the names in patchFactors. Throws ModelingError that begins with
  /// `path` and names the field.
  void validate(const std::string& path = "mesh") const;
};

/// A region with the mesh fitted to its border. `name` appears in messages
/// ("supports[0] \"base\"").
struct MeshRegion {
  std::string name;
  Region where;
  /// At the border of a support the mesh is refined (MeshSettings::refinementLevels), and quadratic
  /// triangles have unbounded tractions.
  bool isSupport = true;
};

}  // namespace palpa::modeling
