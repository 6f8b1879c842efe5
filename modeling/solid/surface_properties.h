#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "modeling/solid/surface_evaluator.h"

// Properties of a solid's surface: volume, area, bounding box, sharp edges.
namespace palpa::modeling {

/// Smallest angle (rad) between the normals of two patches at which their common edge is sharp.
inline constexpr double kSharpAngle = std::numbers::pi / 6;

/// Enclosed volume in mm³, ∫ x · (du × dv) / 3 (divergence theorem) by Gauss points per polynomial
/// span. Exact up to rounding, because the integrand is a polynomial.
double volume(const SurfaceEvaluator& surface);

/// Enclosed volume in mm³ for patches that pass checkPatches(), several times faster: a third of a
/// millisecond for a thousand control points.
double volume(const std::vector<Eigen::Vector3d>& points, const std::vector<Patch>& patches);

/// Surface area in mm², by the same Gauss points. The integrand is not a polynomial, so the result
/// has a small quadrature error (about 1e-6 of the area for the primitives).
double area(const SurfaceEvaluator& surface);

/// Minimum and maximum corner of the axis-parallel box around all control points, mm; it contains
/// the surface.
std::array<Eigen::Vector3d, 2> boundingBox(const Solid& solid);

/// One flag per edge in solid.edges(): true if the surface normal turns by more than `angle` (rad,
/// 0 … pi) across the edge at any sample.
std::vector<bool> sharpEdges(const Solid& solid, const SurfaceEvaluator& surface,
                             double angle = kSharpAngle);

/// Smoothing group of each patch, numbered from 0 in patch order. Patches belong to one group if a
/// chain of edges that are not sharp connects them.
std::vector<int> smoothingGroups(const Solid& solid, const std::vector<bool>& sharp);

}  // namespace palpa::modeling
