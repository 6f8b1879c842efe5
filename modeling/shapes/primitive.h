#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

// The shapes a solid can be made from. Lengths in mm. Axes of symmetry are z; boxes, cylinders,
// cones, extrusions and lofts stand on z = 0, the others are centred at the origin.

struct BoxShape {
  Eigen::Vector3d size{40.0, 30.0, 20.0};
};

struct SphereShape {
  double radius = 25.0;
};

struct EllipsoidShape {
  Eigen::Vector3d radii{30.0, 20.0, 15.0};
};

struct CylinderShape {
  double radius = 15.0;
  double height = 40.0;
};

/// A frustum, or a cone with an apex when the top radius is 0.
struct ConeShape {
  double bottomRadius = 20.0;
  double topRadius = 10.0;
  double height = 30.0;
};

/// A cylinder of the given length between two half spheres.
struct CapsuleShape {
  double radius = 10.0;
  double length = 30.0;
};

struct TorusShape {
  double majorRadius = 25.0;
  double minorRadius = 8.0;
};

/// A plane NUBS curve: clamped knots, as many as points + degree + 1. Closed when its first and
/// last points agree.
struct ProfileCurve {
  int degree = 3;
  std::vector<double> knots;
  std::vector<Eigen::Vector2d> points;  ///< mm
};

/// An open profile (r, z) turned around the z axis. An end on the axis (r = 0) closes the solid
/// there; any other end gets a flat cap.
struct RevolveShape {
  ProfileCurve profile;
};

/// A closed profile (x, y) moved along z.
struct ExtrudeShape {
  ProfileCurve profile;
  double height = 20.0;
};

/// Closed profiles (x, y) at increasing heights with a surface through all of them.
struct LoftShape {
  struct Section {
    double z = 0.0;
    ProfileCurve profile;
  };
  std::vector<Section> sections;
};

/// A shape with the size of its control nets: what "new solid" and the command make_primitive take,
/// and what a project remembers as long as its solid was not edited otherwise.
struct Primitive {
  std::variant<BoxShape, SphereShape, EllipsoidShape, CylinderShape, ConeShape, CapsuleShape,
               TorusShape, RevolveShape, ExtrudeShape, LoftShape>
      shape;
  int degree = 3;         ///< 1 … 5 in both directions of every patch
  int controlPoints = 0;  ///< per direction and patch, degree + 1 … 64; 0: the shape's default
};

}  // namespace palpa::modeling
