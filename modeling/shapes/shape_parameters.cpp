#include "modeling/shapes/shape_parameters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"

namespace palpa::modeling {

double checkLengths(const std::string& shape, const std::vector<NamedLength>& lengths) {
  for (const NamedLength& length : lengths) {
    if (std::isfinite(length.value) && length.value >= kMinLength && length.value <= kMaxLength)
      continue;
    throw ModelingError(shape + ": " + length.name + " is " + numberText(length.value) +
                        " mm; expected " + numberText(kMinLength) + " … " + numberText(kMaxLength) +
                        " mm");
  }
  const auto [least, most] = std::minmax_element(
      lengths.begin(), lengths.end(),
      [](const NamedLength& a, const NamedLength& b) { return a.value < b.value; });
  if (most->value > kMaxEdgeRatio * least->value)
    throw ModelingError(shape + ": " + most->name + " is " + numberText(most->value) + " mm and " +
                        least->name + " " + numberText(least->value) +
                        " mm; none may be more than " + numberText(kMaxEdgeRatio) +
                        " times the other");
  return least->value;
}

int NetSize::aroundQuarter() const {
  constexpr std::array<int, 6> kPreferred{0, 17, 9, 7, 8, 8};
  return countOr(kPreferred[degree]);
}

SplineBasis NetSize::fromApex() const {
  constexpr std::array<int, 6> kPreferred{0, 17, 10, 9, 10, 10};
  // The tip is a hundredth of the whole, or larger, at a ratio of 0.4, with few spans.
  const int count = countOr(kPreferred[degree]);
  const double ratio = std::max(0.4, std::pow(0.01, 1.0 / std::max(1, count - degree - 1)));
  return gradedBasis(degree, count, ratio);
}

SplineBasis NetSize::fitted(const std::string& shape, const SplineBasis& needed,
                            int degreeOfShape) const {
  if (controlPoints > 0 && needed.count() > controlPoints)
    throw ModelingError(shape + ": " + std::to_string(controlPoints) +
                        " control points per direction; degree " + std::to_string(degree) +
                        " needs at least " + std::to_string(needed.count()) +
                        " for the curves and sections given (0: as many as needed)");
  const bool exact = degreeOfShape <= degree;
  return refined(needed, exact ? alongLine() : countOr(degree + 4 * needed.spanCount()));
}

NetSize checkNetSize(const std::string& shape, const Primitive& primitive) {
  const int degree = primitive.degree;
  if (degree < 1 || degree > 5)
    throw ModelingError(shape + ": the degree is " + std::to_string(degree) + "; expected 1 … 5");
  const int count = primitive.controlPoints;
  if (count != 0 && (count <= degree || count > kMaxControlPoints))
    throw ModelingError(shape + ": " + std::to_string(count) +
                        " control points per direction; expected " + std::to_string(degree + 1) +
                        " … " + std::to_string(kMaxControlPoints) + " for degree " +
                        std::to_string(degree));
  return {degree, count};
}

}  // namespace palpa::modeling
