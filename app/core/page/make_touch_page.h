#pragma once

#include <memory>
#include <string>

#include "app/core/model/touch_model.h"
#include "app/core/page/touch_page.h"
#include "base/job.h"
#include "modeling/project/project.h"

namespace palpa::app {

/// What the user chooses for a page that can be touched.
struct TouchPageSettings {
  static constexpr int kMinPlaces = 8, kMaxPlaces = 1000;
  static constexpr double kMinSize = 1, kMaxSize = 100;
  int places = 250;       ///< touch places whose displacements are stored
  double megabytes = 12;  ///< most size of the file, in 10^6 bytes
  double radius = 0;      ///< of every touch, mm; 0: see pageProject()

  /// Throws SolverError (kBadCondition) that names the number out of range.
  void validate() const;
};

/// Bytes of the file for a model of so many nodes, and so many drawn vertices and triangles.
double pageBytes(double nodes, double vertices, double triangles, double places);

/// Builds the model of pageProject() and computes the data: all Green's columns, a solution for
/// each place, and the errors. All touches of a page have one radius: the wanted one, or the
/// narrowest that the model can carry everywhere, if that is larger. If the mesh of the model is
/// too fine for the size, there are fewer places. `notice` says both. Memory beyond the model: the
/// Green's columns, 72 bytes per vertex and place, and three times the size of the file.
///
/// Phases of progress: the phases of buildTouchModel(), "Green's function", "touch", "estimate
/// errors". Throws as buildTouchModel(), SolverError (kBadCondition: settings out of range, or
/// supports cover the whole surface; kTooLarge: the model has too many nodes for the size),
/// Cancelled.
TouchPage makeTouchPage(const modeling::Project& project, const std::string& version,
                        const TouchPageSettings& settings = {}, const Job& job = {});

/// The same for a model that is built, with touches of `settings.radius`, which must not be 0.
TouchPage makeTouchPage(const std::shared_ptr<const TouchModel>& model,
                        const TouchPageSettings& settings, const Job& job = {});

}  // namespace palpa::app
