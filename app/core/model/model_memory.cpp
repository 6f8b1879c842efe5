#include "app/core/model/model_memory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/core/system/memory.h"
#include "bem/base/error.h"
#include "bem/dense/make_reference_problem.h"

namespace palpa::app {
namespace {

/// Memory grows with the square of the number of unknowns, which grows with 1 / length squared.
double fittingLength(double length, double excess) {
  return length * std::pow(excess, 0.25) * 1.05;
}

/// Advice for a model that needs `excess` times the memory available.
std::string advice(const modeling::MeshSettings& settings, bool hasSplines, double excess,
                   double count) {
  char text[200];
  if (!hasSplines)
    std::snprintf(text, sizeof text,
                  "an edge length of %.4g mm needs about %.3g nodes; take %.2g mm or more",
                  settings.edgeLength, count, fittingLength(settings.edgeLength, excess));
  else if (settings.elementLength)
    std::snprintf(text, sizeof text,
                  "spline elements of %.4g mm need about %.3g coefficients; take %.2g mm or more",
                  *settings.elementLength, count, fittingLength(*settings.elementLength, excess));
  else
    std::snprintf(text, sizeof text,
                  "an accuracy of %.2g %% needs about %.3g spline coefficients; wish for less, or "
                  "set the size of the elements",
                  100 * settings.accuracy, count);
  return text;
}

}  // namespace

void checkMemory(const modeling::MeshSettings& settings, bool hasSplines, double coefficients,
                 double slots, bem::Precision precision, double requestedLimit) {
  const double limit = requestedLimit > 0 ? requestedLimit : 0.85 * availableMemory();
  if (limit <= 0) return;
  // Numbers beyond the range of int are still to be reported.
  const double chosen = std::min(coefficients, 1e8), chosenSlots = std::min(slots, 1e8);
  const double bytes =
      bem::estimateBytes(static_cast<int>(chosen), static_cast<int>(chosenSlots), precision) *
      (coefficients / chosen) * (coefficients / chosen);
  if (bytes <= limit) return;
  throw bem::SolverError(
      bem::SolverError::Kind::kTooLarge,
      "the model needs " + formatBytes(bytes) + " of memory, and " + formatBytes(limit) +
          " can be used: " + advice(settings, hasSplines, bytes / limit, coefficients));
}

}  // namespace palpa::app
