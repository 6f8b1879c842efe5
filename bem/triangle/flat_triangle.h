#pragma once

namespace palpa::bem {

/// Flat triangle in the form that the integrals use: a frame with the first corner as origin, the
/// first edge along the first axis and the outward normal as the third axis. Plain numbers, no
/// Eigen, because code that reads them is compiled for several instruction sets.
struct FlatTriangle {
  double origin[3];       ///< first corner, mm
  double axis[2][3];      ///< unit in-plane axes
  double normal[3];       ///< unit outward normal
  double centroid[3];     ///< mm
  double radius;          ///< largest distance from the centroid to a corner, mm
  double area;            ///< mm^2
  double corner[3][2];    ///< in the frame, mm
  double gradient[3][2];  ///< of the three linear basis functions, in the frame, 1/mm
  double tangent[3][2];   ///< unit direction of the edge from corner k to corner k + 1
  double length[3];       ///< of the same edge, mm
};

/// `corners`: positions, counter-clockwise seen from outside.
FlatTriangle makeFlatTriangle(const double (&positions)[3][3]);

/// Integrals over one element for one basis function N, with r = y - x, R = |r|, d = r.n (a batch
/// holds several collocation points x). Symmetric tensors are stored as xx, xy, yy, xz, yz, zz.
template <class Batch>
struct BasisIntegrals {
  Batch rr3[6];  ///< ∫ N r_i r_j / R^3; its trace is ∫ N / R
  Batch rr5[6];  ///< d ∫ N r_i r_j / R^5; its trace is d ∫ N / R^3
  Batch r3[3];   ///< ∫ N r_i / R^3, up to a multiple of the normal
};

template <class Batch>
using TriangleIntegrals = BasisIntegrals<Batch>[3];

}  // namespace palpa::bem
