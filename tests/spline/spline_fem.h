#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "app/verification/analytic_case.h"
#include "app/verification/fem_case.h"
#include "app/verification/reference_data.h"
#include "spline_body.h"

/// The finite element solutions of fem.json with splines with manually chosen knots.
namespace palpa::bem::test {

/// A case of fem.json by its name.
inline const nlohmann::json& femCase(const std::string& id) {
  return ReferenceData::builtIn().finiteElementCase(id);
}

struct FemSolution {
  FemErrors errors;
  int coefficients = 0, elements = 0;
  double size = 0;  ///< mm, root of the mean area of an element
  ReferenceProblemTimes times;
};

/// Solves a case on a surface whose fixed elements have the tag 1 or 2. `given`: their displacement
/// by control point; they take constants.
FemSolution solveFem(const nlohmann::json& reference, const SplineSurface& surface,
                     const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& given,
                     const SplineFunction& load, double loadRadius);

/// The traction of a case's load.
SplineFunction bumpOf(const nlohmann::json& reference);

/// Inserts knots at fractions of the range of one direction of a patch, except where there are
/// some.
modeling::Solid withKnots(modeling::Solid solid, const std::string& patch, int direction,
                          const std::vector<double>& fractions);

/// The cylinder of the cases, R = 20 mm and 60 mm high, with knots of the sides at these heights
/// (mm) and, around and in the caps, at fractions of a quarter.
modeling::Solid cylinderWithKnots(const std::vector<double>& heights,
                                  const std::vector<double>& fractions);
/// The same, fixed at its base (tag 1) and, if asked for, at its top (tag 2).
SplineSurface fixedCylinder(const modeling::Solid& cylinder, bool atTop);

/// The sphere of the cases, R = 25 mm, fixed below z = -20 mm, with a net of this size and knots at
/// fractions of its top and along the bands that begin there.
SplineSurface fixedSphere(int controlPoints, const std::vector<double>& fractions);

}  // namespace palpa::bem::test
