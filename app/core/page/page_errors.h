#pragma once

#include <Eigen/Dense>
#include <vector>

#include "app/core/model/touch_model.h"
#include "app/core/page/page_solutions.h"
#include "app/core/page/page_surface.h"
#include "app/core/page/touch_page.h"
#include "base/job.h"

namespace palpa::app {

/// Compares a page that is complete but for its errors with full solutions at random places that
/// its tables do not contain, and sets `errors` with the model's own, `forceErrors` and
/// `modelErrors`.
///
/// The error of the force of one touch is known in every triangle: it is taken to be proportional
/// to how far the compliance in the middle is from the quadratic function through corners and
/// edges. The largest factor of the samples, with a margin, makes it an error.
///
/// Phase of progress: "touch", from `from` to 1; "estimate errors".
/// Throws Cancelled.
void measurePageErrors(TouchPage& page, const TouchModel& model, const PageSurface& surface,
                       PageSolutions& solutions, double from, const Job& job);

}  // namespace palpa::app
