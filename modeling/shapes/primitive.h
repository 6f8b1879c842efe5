#pragma once

#include <Eigen/Core>
#include <string>
#include <variant>
#include <vector>

#include "modeling/solid/solid.h"

namespace palpa::modeling {

// Shapes from which a solid can be made. Lengths in mm. Axes of symmetry are z; boxes, cylinders,
// cones, extrusions and lofts stand on z = 0, all others are centred at the origin.

struct BoxShape {
  Eigen::Vector3d size{40.0, 30.0, 20.0};

  bool operator==(const BoxShape&) const = default;
};

struct SphereShape {
  double radius = 25.0;

  bool operator==(const SphereShape&) const = default;
};

struct EllipsoidShape {
  Eigen::Vector3d radii{30.0, 20.0, 15.0};

  bool operator==(const EllipsoidShape&) const = default;
};

struct CylinderShape {
  double radius = 15.0;
  double height = 40.0;

  bool operator==(const CylinderShape&) const = default;
};

/// Frustum, or cone with an apex if the top radius is 0.
struct ConeShape {
  double bottomRadius = 20.0;
  double topRadius = 10.0;
  double height = 30.0;

  bool operator==(const ConeShape&) const = default;
};

/// Cylinder of the given length between two half spheres.
struct CapsuleShape {
  double radius = 10.0;
  double length = 30.0;

  bool operator==(const CapsuleShape&) const = default;
};

struct TorusShape {
  double majorRadius = 25.0;
  double minorRadius = 8.0;

  bool operator==(const TorusShape&) const = default;
};

/// Plane NUBS curve with points + degree + 1 clamped knots. It is closed if its first and last
/// points are equal.
struct ProfileCurve {
  int degree = 3;
  std::vector<double> knots;
  std::vector<Eigen::Vector2d> points;  ///< mm

  bool operator==(const ProfileCurve&) const = default;
};

/// Open profile (r, z) revolved around the z axis. An end on the axis (r = 0) closes the solid
/// there; any other end gets a flat cap.
struct RevolveShape {
  ProfileCurve profile;

  bool operator==(const RevolveShape&) const = default;
};

/// Closed profile (x, y) extruded along z.
struct ExtrudeShape {
  ProfileCurve profile;
  double height = 20.0;

  bool operator==(const ExtrudeShape&) const = default;
};

/// Surface through closed profiles (x, y) at increasing heights.
struct LoftShape {
  struct Section {
    double z = 0.0;
    ProfileCurve profile;

    bool operator==(const Section&) const = default;
  };
  std::vector<Section> sections;

  bool operator==(const LoftShape&) const = default;
};

/// Shape with the size of its control nets: the input of "new solid" and of the command
/// make_primitive. A project stores it until its solid is edited by other means.
struct Primitive {
  std::variant<BoxShape, SphereShape, EllipsoidShape, CylinderShape, ConeShape, CapsuleShape,
               TorusShape, RevolveShape, ExtrudeShape, LoftShape>
      shape;
  int degree = 3;         ///< 1 … 5, in both directions of every patch
  int controlPoints = 0;  ///< per direction and patch, degree + 1 … 64; 0: the shape's default

  bool operator==(const Primitive&) const = default;
};

}  // namespace palpa::modeling
