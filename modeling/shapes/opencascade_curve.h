#pragma once

#include <Geom2d_BSplineCurve.hxx>

#include "modeling/shapes/primitive.h"

// Profile curves as OpenCASCADE curves, for the files of modeling/ that use its spline algebra. No
// public header includes this one.
namespace palpa::modeling {

/// OpenCASCADE curve of a profile curve that passes checkProfileCurve(). Throws Standard_Failure if
/// OpenCASCADE rejects it.
Handle(Geom2d_BSplineCurve) makeCurve(const ProfileCurve& curve);

/// Profile curve with the poles and knots of a polynomial OpenCASCADE curve.
ProfileCurve toProfileCurve(const Geom2d_BSplineCurve& curve);

}  // namespace palpa::modeling
