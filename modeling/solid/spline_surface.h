#pragma once

#include <Geom_BSplineSurface.hxx>
#include <vector>

#include "modeling/solid/solid.h"

// A patch as OpenCASCADE sees it. Internal to modeling/: only .cpp files include this header.
namespace palpa::modeling {

/// The patch over the given points, with the same degrees, knots and net. The patch must pass
/// checkPatches(). @throws Standard_Failure when OpenCASCADE refuses it.
Handle(Geom_BSplineSurface)
    makeSplineSurface(const std::vector<Eigen::Vector3d>& points, const Patch& patch);

}  // namespace palpa::modeling
