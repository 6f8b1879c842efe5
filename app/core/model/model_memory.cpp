#include "app/core/model/model_memory.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/core/system/memory.h"
#include "base/count_text.h"
#include "base/text.h"
#include "bem/dense/make_reference_problem.h"

namespace palpa::app {
namespace {

/// Memory grows with the square of the number of unknowns, which grows with 1 / length squared.
std::string fittingLength(double length, double excess) {
  return roundedText(length * std::pow(excess, 0.25) * 1.05, 2) + " mm";
}

/// Advice for a model that needs `excess` times the memory available.
std::string advice(const modeling::MeshSettings& settings, bool hasSplines, double excess) {
  if (!hasSplines)
    return "take a longer edge length than " + roundedText(settings.edgeLength) + " mm, about " +
           fittingLength(settings.edgeLength, excess);
  if (settings.elementLength)
    return "take longer spline elements than " + roundedText(*settings.elementLength) +
           " mm, about " + fittingLength(*settings.elementLength, excess);
  return "choose a coarser accuracy than " + roundedText(100 * settings.accuracy) +
         " %, or set the size of the elements";
}

}  // namespace

double usableMemory(double limit) {
  return limit > 0 ? limit : 0.85 * availableMemory();
}

double expectedBytes(double coefficients, double slots, bem::Precision precision) {
  // Numbers beyond the range of int are still to be reported.
  const double chosen = std::min(coefficients, 1e8), chosenSlots = std::min(slots, 1e8);
  return bem::estimateBytes(static_cast<int>(chosen), static_cast<int>(chosenSlots), precision) *
         (coefficients / chosen) * (coefficients / chosen);
}

void checkMemory(const modeling::MeshSettings& settings, bool hasSplines, double coefficients,
                 double slots, bem::Precision precision, double requestedLimit) {
  const double limit = usableMemory(requestedLimit);
  if (limit <= 0) return;
  const double bytes = expectedBytes(coefficients, slots, precision);
  if (bytes <= limit) return;
  const double excess = bytes / limit;
  throw ModelTooLarge(
      "the model needs " + formatBytes(bytes) + " of memory for " + estimateText(coefficients) +
          (hasSplines ? " spline coefficients, and " : " nodes, and ") + formatBytes(limit) +
          " can be used; " + advice(settings, hasSplines, excess),
      excess);
}

}  // namespace palpa::app
