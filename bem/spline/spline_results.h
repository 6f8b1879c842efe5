#pragma once

#include "bem/element/element_results.h"
#include "bem/spline/spline_elements.h"
#include "bem/spline/spline_quadrature.h"

namespace palpa::bem {

/// The objects that the results of a spline surface need.
struct SplineResultParts {
  SplineElements elements;
  SplineQuadrature quadrature;
};

/// Results of fields in spline coefficients, with their own quadrature. Surface and tractions must
/// outlive it.
class SplineResults : private SplineResultParts, public ElementResults {
 public:
  SplineResults(const SplineSurface& surface, const SplineTractions& tractions, const Job& job = {})
      : SplineResultParts{{surface, tractions}, {surface, kTolerance, job}},
        ElementResults(elements, quadrature) {}
};

}  // namespace palpa::bem
