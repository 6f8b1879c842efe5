#pragma once

#include <string>
#include <vector>

#include "bem/model/material.h"
#include "bench/peers/tetrahedra.h"
#include "modeling/project/project.h"

namespace palpa::bench {

/// A body with one boundary value problem that everybody solves: held at its base, with two
/// solutions that are known. One is the field of a point force outside the body (Kelvin's), exact
/// on whatever shape the elements give the body. The other is a touch at one place with the bump
/// that masks are made of, from the finite element solutions of resources/reference/fem.json.
struct PeerCase {
  modeling::Project project;  ///< without mesh settings
  bem::Material material;
  Eigen::Vector3d source, force;  ///< mm, N

  struct Reference {
    Eigen::Vector3d at, direction;  ///< mm; unit
    double radius;                  ///< mm, of the mask
    double compliance;              ///< mm/N, along the direction
  } reference;

  std::vector<Eigen::Vector3d> places;  ///< where new touches begin, far from each other
  std::vector<Eigen::Vector3d> path;    ///< of a moving touch, steps of 0.25 mm from reference.at
  EdgeMiddle middle;                    ///< on the true surface

  Eigen::Vector3d exactDisplacement(const Eigen::Vector3d& x) const;
  Eigen::Vector3d exactTraction(const Eigen::Vector3d& x, const Eigen::Vector3d& normal) const;
};

/// "sphere" (pushed at its pole) or "cylinder" (at its side). `references`:
/// resources/reference/fem.json. std::runtime_error when there is no such body or file.
PeerCase makePeerCase(const std::string& body, const std::string& references);

}  // namespace palpa::bench
