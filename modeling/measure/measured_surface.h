#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modeling/body/body.h"
#include "modeling/measure/measured_body.h"

// Geometry of a body for MeasuredBody. Internal to modeling/measure.
namespace palpa::modeling {

/// Relative error of positions and derivatives by rounding.
inline constexpr double kMeasuredRounding = 1e-12;

/// Point of the surface with the outward unit normal.
struct PlacePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mm
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// Point of an edge. With curvature 0 the edge is straight there.
struct EdgePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   ///< mm
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero();    ///< unit
  Eigen::Vector3d curvature = Eigen::Vector3d::Zero();  ///< towards the centre, 1/mm
  double accuracy = 0;                                  ///< of the radius of curvature, mm
  MeasuredValue::Fit fit = MeasuredValue::Fit::kNone;
};

/// An edge as a line, with its length.
struct EdgeLine {
  std::vector<Eigen::Vector3d> points;  ///< mm
  double length = 0;                    ///< mm
  double chainLength = 0;  ///< mm, with the edges that continue it without a corner, if any
  double accuracy = 0;     ///< of `length`, mm
};

/// Principal curvatures, positive where the surface is convex, the larger magnitude first.
struct Curvatures {
  double strong = 0, weak = 0;  ///< 1/mm
  double accuracy = 0;          ///< of the radius 1 / strong, mm
  MeasuredValue::Fit fit = MeasuredValue::Fit::kNone;
};

/// Surface of a body. Points and distances in mm. Functions with a MeasuredPlace throw
/// ModelingError if the body does not have it.
class MeasuredSurface {
 public:
  virtual ~MeasuredSurface() = default;

  /// Largest extent of the body, mm.
  virtual double size() const = 0;
  virtual PlacePoint at(const MeasuredPlace& place) const = 0;
  virtual EdgePoint edgeAt(const MeasuredPlace& place) const = 0;
  virtual EdgeLine edge(const MeasuredPlace& place) const = 0;
  virtual Curvatures curvatures(const MeasuredPlace& place) const = 0;

  /// Nearest point of the edge or face of a place, or the place itself if it is a point.
  virtual Eigen::Vector3d nearestOn(const MeasuredPlace& place, const Eigen::Vector3d& x) const = 0;
  /// Points of the edge or face of a place, at least one per span or triangle, or the place itself
  /// if it is a point.
  virtual std::vector<Eigen::Vector3d> samples(const MeasuredPlace& place) const = 0;

  /// Nearest point of the whole surface.
  virtual Eigen::Vector3d nearest(const Eigen::Vector3d& x) const = 0;
  /// Smallest s > `least` with origin + s direction on the surface; unit direction, mm.
  virtual std::optional<double> firstHit(const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction, double least) const = 0;

  /// Height of the facets of the smooth surface around a place above their neighbours, mm: a ball
  /// that should fit the curved surface may enter them by this. 0 for exact surfaces.
  virtual double facetHeight(const MeasuredPlace& place) const = 0;

  // See MeasuredBody.
  virtual MeasuredPlace placeNear(int patch, const Eigen::Vector3d& x) const = 0;
  virtual std::optional<MeasuredPlace> edgeNear(int patch, const Eigen::Vector3d& x) const = 0;
};

/// Exact patches of a solid. Copies the solid. Cost: about 10 µs per span.
std::shared_ptr<const MeasuredSurface> makeMeasuredSurface(const Solid& solid);
/// Triangles of a mesh body. Copies the body. Cost: some milliseconds per hundred thousand.
std::shared_ptr<const MeasuredSurface> makeMeasuredSurface(const MeshBody& body);

}  // namespace palpa::modeling
