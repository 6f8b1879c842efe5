#pragma once

#include "base/job.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// The project whose model a page is made of, for touches of one radius anywhere.
struct PageProject {
  modeling::Project project;
  double radius = 0;  ///< mm
};

/// Replaces the touches of a project, around which its mesh is finer, by a mesh that carries
/// touches of `radius` (mm) everywhere. A radius of 0 means defaultTouchRadius(), or with triangles
/// the least radius that the project's own mesh carries, if that is larger: then the model is the
/// one that palpa-cli touch solves for a touch of this radius anywhere. Throws Cancelled.
PageProject pageProject(const modeling::Project& project, double radius, const Job& job);

}  // namespace palpa::app
