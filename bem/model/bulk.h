#pragma once

#include <Eigen/Core>
#include <utility>

#include "bem/model/material.h"

namespace palpa::bem {

/// Inside of a homogeneous body: its material and a uniform force per volume, such as its weight.
/// They are the coefficients of Navier's equations, G ∇²u + G / (1 - 2 nu) ∇(∇·u) + b = 0. A
/// material alone stands for a body without a body force.
struct Bulk {
  Material material;
  Eigen::Vector3d bodyForce = Eigen::Vector3d::Zero();  ///< b, N/mm^3

  Bulk(const Material& of) : material(of) {}  // NOLINT: implicit
  Bulk(const Material& of, Eigen::Vector3d force) : material(of), bodyForce(std::move(force)) {}

  bool hasBodyForce() const { return !bodyForce.isZero(0); }
};

}  // namespace palpa::bem
