#include "app/core/model/model_memory.h"

#include <cmath>
#include <string>

#include "app/core/system/memory.h"
#include "base/count_text.h"
#include "base/text.h"

namespace palpa::app {
namespace {

std::string fittingLength(double length, double factor) {
  return roundedText(length * factor * 1.05, 2) + " mm";
}

/// Advice for a model that fits with `factor` times the length of its elements.
std::string advice(const modeling::MeshSettings& settings, bool hasSplines, double factor) {
  if (!hasSplines)
    return "take a longer edge length than " + roundedText(settings.edgeLength) + " mm, about " +
           fittingLength(settings.edgeLength, factor);
  if (settings.elementLength)
    return "take longer spline elements than " + roundedText(*settings.elementLength) +
           " mm, about " + fittingLength(*settings.elementLength, factor);
  return "choose a coarser accuracy than " + roundedText(100 * settings.accuracy) +
         " %, or set the size of the elements";
}

}  // namespace

double usableMemory(double limit) {
  return limit > 0 ? limit : 0.85 * availableMemory();
}

double expectedBytes(const bem::ProblemSize& size, modeling::Engine engine,
                     bem::Precision precision) {
  return bem::expectedBytes(size, engine == modeling::Engine::kQuadratic, precision);
}

bool choosesCompressed(const bem::ProblemSize& size, modeling::Engine engine,
                       std::optional<int> from) {
  // Small residuals of compressed operators turn the ends of leads: the force on a capacitor's
  // leads was 5 % too large (decision 056).
  constexpr double kMaxThinShare = 0.6;
  if (engine != modeling::Engine::kQuadratic) return false;
  return size.nodes >= bem::kCompressedFrom ||
         (from && size.nodes >= *from && size.thinShare <= kMaxThinShare);
}

bem::Precision fittingPrecision(const bem::ProblemSize& size, modeling::Engine engine,
                                bem::Precision wanted, double limit) {
  const double usable = usableMemory(limit);
  if (usable <= 0 || wanted != bem::Precision::kAutomatic || engine != modeling::Engine::kQuadratic)
    return wanted;
  const auto fits = [&](bem::Precision precision) {
    return expectedBytes(size, engine, precision) <= usable;
  };
  const bool needsCompression = !fits(wanted) && fits(bem::Precision::kCompressed);
  return needsCompression ? bem::Precision::kCompressed : wanted;
}

void checkMemory(const modeling::MeshSettings& settings, modeling::Engine engine,
                 const bem::ProblemSize& size, bem::Precision precision, double requestedLimit) {
  const double limit = usableMemory(requestedLimit);
  if (limit <= 0) return;
  const double bytes = expectedBytes(size, engine, precision);
  if (bytes <= limit) return;
  const double excess = bytes / limit;
  const bool hasSplines = engine == modeling::Engine::kSplines;
  // Memory grows with the square of the number of unknowns, compressed with the number itself.
  const double power =
      bem::isCompressed(precision, engine == modeling::Engine::kQuadratic, size.nodes) ? 0.5 : 0.25;
  throw ModelTooLarge(
      "the model needs " + formatBytes(bytes) + " of memory for " + estimateText(size.nodes) +
          (hasSplines ? " spline coefficients, and " : " nodes, and ") + formatBytes(limit) +
          " can be used; " + advice(settings, hasSplines, std::pow(excess, power)),
      excess);
}

}  // namespace palpa::app
