#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "modeling/body/body.h"
#include "modeling/project/measurement.h"

namespace palpa::modeling {

class MeasuredSurface;

/// Value of a measurement, with the lines of its dimension.
struct MeasuredValue {
  /// mm; rad for an angle. A radius belongs to the strongest curvature: negative where the surface
  /// is hollow, infinite where it is flat.
  double value = 0;
  /// Of a wall thickness: diameter of the largest ball inside the body that touches the place. Of a
  /// radius at a surface point: the other principal radius, with its sign. Of a length: of the
  /// whole chain of edges that continue without a corner, if there are others.
  std::optional<double> second;
  /// Bound or estimate of the error of `value` against the body as it is stored, in its unit: a
  /// solid's patches, or a mesh body's triangles. A radius of a mesh body belongs to the curved
  /// surface through its vertices.
  double accuracy = 0;

  /// Of a fit through the vertices of a mesh body: the shape that fits them.
  enum class Fit { kNone, kSphere, kCylinder, kCircle, kPolynomial };
  Fit fit = Fit::kNone;

  /// mm. Distance and thickness: the two ends. Angle: the corner and the ends of both arms; without
  /// the corner if the faces are parallel. Radius: the place and the centre, or the place alone
  /// where it is flat. Length: along the edge.
  std::vector<Eigen::Vector3d> points;
};

/// Body prepared for measurements: exact on the patches of a solid (Newton's method), on the
/// triangles of a mesh body. Copies what it needs. Const use from several threads is safe.
class MeasuredBody {
 public:
  /// Cost: some milliseconds per thousand spans or hundred thousand triangles.
  explicit MeasuredBody(const Body& body);

  /// Cost: below a millisecond; some milliseconds between two edges or faces, and for a radius.
  /// Throws ModelingError (place – problem – remedy) if a place is gone or if there is no value.
  MeasuredValue measure(const Measurement& measurement) const;

  /// Position of a place on the surface, mm. Throws ModelingError if it is gone.
  Eigen::Vector3d position(const MeasuredPlace& place) const;

  /// Points along the edge of a place, mm. Throws ModelingError if it is gone.
  std::vector<Eigen::Vector3d> edgeLine(const MeasuredPlace& place) const;

  /// The edge of the body that is nearest to a point of the face `patch` (its index), as a place of
  /// kind kEdge; nothing if the face has no edges (a mesh body with one face).
  std::optional<MeasuredPlace> edgeNear(int patch, const Eigen::Vector3d& point) const;

  /// The place of a surface point: of a solid the nearest point of the patch, of a mesh body the
  /// nearest point of the face.
  MeasuredPlace placeNear(int patch, const Eigen::Vector3d& point) const;

 private:
  std::shared_ptr<const MeasuredSurface> surface_;
};

}  // namespace palpa::modeling
