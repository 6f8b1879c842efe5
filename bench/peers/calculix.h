#pragma once

#include "bem/model/material.h"
#include "bench/peers/tetrahedra.h"

namespace palpa::bench {

struct CalculixResult {
  double compliance = 0;  ///< mm/N, of the touched place along the direction of the force
  int unknowns = 0;
  double seconds = 0;    ///< to write the input, run, and read the result
  double peakBytes = 0;  ///< of the program
};

/// Pushes a body of quadratic tetrahedra, fixed at its tagged faces, with a force of 1 N in the
/// shape of a contact's mask, computed by CalculiX (G. Dhondt, The Finite Element Method for
/// Three-Dimensional Thermomechanical Applications, 2004), the program ccx. Throws
/// std::runtime_error if it is not installed or fails.
CalculixResult pushWithCalculix(const TetrahedralMesh& mesh, const bem::Material& material,
                                const Eigen::Vector3d& at, double radius,
                                const Eigen::Vector3d& direction);

}  // namespace palpa::bench
