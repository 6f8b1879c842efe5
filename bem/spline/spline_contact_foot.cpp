#include <algorithm>

#include "bem/element/foot_step.h"
#include "bem/spline/spline_contact_surface.h"
#include "bem/triangle/contact_foot.h"

// Geometry of SplineContactSurface: surface points, feet and normals.

namespace palpa::bem {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Overlap of the masks of a lattice, radius over spacing: the masks are never narrower than the
/// splines can represent.
constexpr double kOverlap = 1.7;

struct Basis1d {
  double value[kMaxSplineDegree + 1], slope[kMaxSplineDegree + 1], bend[kMaxSplineDegree + 1];

  Basis1d(const SpanPolynomials& span, double parameter) {
    const double s = (parameter - span.lower) * span.scale - 1;
    const int size = span.degree + 1;
    for (int f = 0; f < size; ++f) {
      double v = 0, first = 0, second = 0;  // `second` is half of the second derivative
      for (int m = span.degree; m >= 0; --m) {
        second = second * s + first;
        first = first * s + v;
        v = v * s + span.coefficients[m * size + f];
      }
      value[f] = v;
      slope[f] = first * span.scale;
      bend[f] = 2 * second * span.scale * span.scale;
    }
  }
};

/// Position and derivatives with respect to the patch parameters.
SurfaceJet2 evaluate(const SplineSurface& surface, const SplineMesh::Point& at) {
  const SplineElement& element = surface.elements()[at.element];
  const auto& basis = surface.patches()[element.patch].basis;
  const Basis1d a(basis[0].polynomials(element.span[0]), at.parameters[0]);
  const Basis1d b(basis[1].polynomials(element.span[1]), at.parameters[1]);
  SurfaceJet2 jet;
  const int* function = surface.net(at.element).data();
  for (int j = 0; j <= basis[1].degree(); ++j)
    for (int i = 0; i <= basis[0].degree(); ++i) {
      const Vector3d& point = surface.controlPoints()[*function++];
      jet.position += a.value[i] * b.value[j] * point;
      jet.u += a.slope[i] * b.value[j] * point;
      jet.v += a.value[i] * b.slope[j] * point;
      jet.uu += a.bend[i] * b.value[j] * point;
      jet.uv += a.slope[i] * b.slope[j] * point;
      jet.vv += a.value[i] * b.bend[j] * point;
    }
  return jet;
}

}  // namespace

SurfacePoint SplineContactSurface::at(int triangle, const Vector3d& weights) const {
  SurfacePoint point{triangle, weights, Vector3d::Zero(), 0.0};
  point.position = smoothPosition(point);
  return point;
}

SurfacePoint SplineContactSurface::foot(const Vector3d& tool, const SurfacePoint& start) const {
  const BoundaryMesh& triangles = mesh();
  SurfacePoint onMesh = start;
  onMesh.position = triangles.point(start.triangle, start.weights);
  // Steps are limited to the narrowest mask, which exceeds the error of the nearest mesh point.
  onMesh =
      walkToFoot(triangles, tree(), onMesh, narrowestMask(start), [&](const SurfacePoint& from) {
        const SurfaceJet2 jet = evaluate(mesh_.surface(), mesh_.at(from));
        const auto& corners = mesh_.triangle(from.triangle).corners;
        Matrix2d edges;
        edges << corners[1] - corners[0], corners[2] - corners[0];
        return Vector2d(edges.inverse() * stepToFoot(jet, tool));
      });
  SurfacePoint found = at(onMesh.triangle, onMesh.weights);
  found.distance = (found.position - tool).norm();
  return found;
}

Vector3d SplineContactSurface::normal(const SurfacePoint& point) const {
  // Slightly inside the triangle where the derivatives are parallel.
  for (const double inwards : {0.0, 1e-3, 1e-2}) {
    const Vector3d weights = (1 - inwards) * point.weights + Vector3d::Constant(inwards / 3);
    const SurfaceJet2 jet = evaluate(mesh_.surface(), mesh_.at(point.triangle, weights));
    const Vector3d area = jet.u.cross(jet.v);
    if (area.norm() > 1e-9 * jet.u.norm() * jet.v.norm()) return area.normalized();
  }
  return mesh().normal(point.triangle);
}

Vector3d SplineContactSurface::smoothPosition(const SurfacePoint& point) const {
  return evaluate(mesh_.surface(), mesh_.at(point)).position;
}

double SplineContactSurface::narrowestMask(const SurfacePoint& point) const {
  return widths_.at(mesh_.at(point).element, smoothPosition(point));
}

double SplineContactSurface::maskSpacing(const SurfacePoint& point) const {
  return narrowestMask(point) / kOverlap;
}

}  // namespace palpa::bem
