#pragma once

#include "bem/model/material.h"

/// Inner loop of Somigliana's identities at interior points, compiled once per instruction set.
namespace palpa::bem {

/// Material constants of the kernels of interior displacements and stresses.
struct InteriorConstants {
  double weightU;  ///< 1 / (16 pi G (1 - nu))
  double weightT;  ///< 1 / (8 pi (1 - nu)): of T and D
  double weightS;  ///< G / (4 pi (1 - nu))
  double poissonRatio;

  explicit InteriorConstants(const Material& material);
};

/// A linear field u = shift + gradient y with its constant stress: it satisfies the identities
/// exactly, so it may be subtracted from a field.
struct LinearState {
  double shift[3] = {};        ///< mm, at the origin
  double gradient[3][3] = {};  ///< [component][axis]
  double stress[3][3] = {};    ///< MPa
};

/// Numbers per source: position (mm), outward area vector (mm^2), displacement (mm), and traction
/// times area (N).
inline constexpr int kSourceValues = 12;

/// Sums over quadrature points ("sources") of a field minus a linear field:
///   displacement: Σ U p - Σ T u,  stress: Σ D p - Σ S u,
/// in the order 00, 01, 11, 02, 12, 22 for the stress. Equations in kelvin.h.
struct InteriorSumTask {
  InteriorConstants constants;
  const double* x;        ///< interior point, 3 coordinates in mm; not one of the sources
  const double* sources;  ///< [kSourceValues][stride]; kSourcePadding numbers beyond are readable
  long stride;
  int count;
  const LinearState* linear;
  double* displacement;  ///< 3 sums, added to
  double* stress;        ///< 6 sums, added to
};
inline constexpr int kSourcePadding = 8;

void sumInteriorBaseline(const InteriorSumTask& task);
void sumInteriorAvx2(const InteriorSumTask& task);
void sumInteriorAvx512(const InteriorSumTask& task);

using SumInterior = void (*)(const InteriorSumTask& task);
/// Fastest variant of the loop that this processor supports.
SumInterior sumInteriorForThisProcessor();

}  // namespace palpa::bem
