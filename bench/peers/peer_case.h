#pragma once

#include <string>
#include <vector>

#include "bem/model/material.h"
#include "bench/peers/tetrahedra.h"
#include "modeling/project/project.h"

namespace palpa::bench {

/// A body with a boundary value problem that all methods solve: fixed at its base, with two known
/// solutions. One is the field of a point force outside the body (Kelvin's solution), exact on any
/// discrete shape of the body. The other is a touch at one place with the bump of a mask, from the
/// finite element solutions of resources/reference/fem.json.
struct PeerCase {
  modeling::Project project;  ///< without mesh settings
  bem::Material material;
  Eigen::Vector3d source, force;  ///< mm, N

  struct Reference {
    Eigen::Vector3d at, direction;  ///< mm; unit
    double radius;                  ///< mm, of the mask
    double compliance;              ///< mm/N, along the direction
  } reference;

  std::vector<Eigen::Vector3d> places;  ///< of new touches, far from each other
  std::vector<Eigen::Vector3d> path;    ///< of a moving touch, steps of 0.25 mm from reference.at
  EdgeMiddle middle;                    ///< on the exact surface

  Eigen::Vector3d exactDisplacement(const Eigen::Vector3d& x) const;
  Eigen::Vector3d exactTraction(const Eigen::Vector3d& x, const Eigen::Vector3d& normal) const;
};

/// "sphere" (pushed at its pole) or "cylinder" (at its side). `references`:
/// resources/reference/fem.json. Throws std::runtime_error without such a body or file.
PeerCase makePeerCase(const std::string& body, const std::string& references);

}  // namespace palpa::bench
