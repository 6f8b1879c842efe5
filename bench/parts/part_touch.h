#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bem/model/material.h"

namespace palpa::bench {

/// A part that is left out of the comparison, with the reason.
struct LeftOut : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What Palpa answers to a touch of a part, `palpa-cli touch FILE --place auto --depth 1%`, and
/// what another program needs for the same touch. Lengths in mm, forces in N.
struct PartTouch {
  bem::Material material;
  Eigen::Vector3d at, normal;    ///< the place; outward unit normal
  double radius = 0;             ///< of the mask that Palpa used
  double wishedRadius = 0;       ///< of the touch
  Eigen::Vector3d displacement;  ///< mean of the mask
  Eigen::Vector3d force;         ///< on the body
  double error = 0;              ///< estimated, relative to |force|
  std::string engine;
  int faces = 0;
  int nodes = 0;       ///< of the mesh
  double seconds = 0;  ///< from the file to the force

  /// The surface as triangles, true on the support.
  struct Facet {
    std::array<Eigen::Vector3d, 3> corners;
    bool isSupported = false;
  };
  std::vector<Facet> facets;
  std::string support;  ///< its faces
  double size = 0;      ///< diagonal of the box
  double volume = 0, area = 0;
};

/// Imports, supports and touches the only solid of a CAD file. Throws LeftOut if the support is not
/// a flat face or the mesh has more than `maxNodes` nodes; the errors of importing and solving.
PartTouch touchPart(const std::filesystem::path& file, int maxNodes);

}  // namespace palpa::bench
