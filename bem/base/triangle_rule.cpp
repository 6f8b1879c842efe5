#include "bem/base/triangle_rule.h"

#include <array>

namespace palpa::bem {
namespace {

/// Fills the orbit of three points (a, a, 1 - 2a).
constexpr void orbit3(TrianglePoint* out, double a, double weight) {
  const double b = 1 - 2 * a;
  out[0] = {{b, a, a}, weight};
  out[1] = {{a, b, a}, weight};
  out[2] = {{a, a, b}, weight};
}

/// Fills the orbit of six points (a, b, 1 - a - b).
constexpr void orbit6(TrianglePoint* out, double a, double b, double weight) {
  const double c = 1 - a - b;
  out[0] = {{a, b, c}, weight};
  out[1] = {{b, c, a}, weight};
  out[2] = {{c, a, b}, weight};
  out[3] = {{a, c, b}, weight};
  out[4] = {{c, b, a}, weight};
  out[5] = {{b, a, c}, weight};
}

constexpr double kThird = 1.0 / 3.0;

constexpr std::array<TrianglePoint, 3> kRule3 = [] {
  std::array<TrianglePoint, 3> rule{};
  orbit3(&rule[0], 1.0 / 6, kThird);
  return rule;
}();

constexpr std::array<TrianglePoint, 7> kRule7 = [] {
  std::array<TrianglePoint, 7> rule{};
  rule[0] = {{kThird, kThird, kThird}, 0.225};
  orbit3(&rule[1], 0.470142064105115, 0.132394152788506);
  orbit3(&rule[4], 0.101286507323456, 0.125939180544827);
  return rule;
}();

constexpr std::array<TrianglePoint, 16> kRule16 = [] {
  std::array<TrianglePoint, 16> rule{};
  rule[0] = {{kThird, kThird, kThird}, 0.144315607677787};
  orbit3(&rule[1], 0.459292588292723, 0.095091634267285);
  orbit3(&rule[4], 0.170569307751760, 0.103217370534718);
  orbit3(&rule[7], 0.050547228317031, 0.032458497623198);
  orbit6(&rule[10], 0.263112829634638, 0.008394777409958, 0.027230314174435);
  return rule;
}();

}  // namespace

std::span<const TrianglePoint> triangleRule3() {
  return kRule3;
}
std::span<const TrianglePoint> triangleRule7() {
  return kRule7;
}
std::span<const TrianglePoint> triangleRule16() {
  return kRule16;
}

}  // namespace palpa::bem
