#pragma once

#include <span>

namespace palpa::bem {

/// Point of a symmetric quadrature rule on a triangle.
struct TrianglePoint {
  double barycentric[3];
  double weight;  ///< the weights of a rule sum to 1
};

/// Gauss-type rules on the triangle after D. A. Dunavant, High degree efficient symmetrical
/// Gaussian quadrature rules for the triangle, IJNME 21 (1985) 1129-1148. All points inside, all
/// weights positive.
std::span<const TrianglePoint> triangleRule3();   ///< exact for polynomials of degree 2
std::span<const TrianglePoint> triangleRule7();   ///< exact for polynomials of degree 5
std::span<const TrianglePoint> triangleRule16();  ///< exact for polynomials of degree 8

}  // namespace palpa::bem
