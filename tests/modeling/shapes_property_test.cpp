// Random parameters, sensible or not: a solid that satisfies all invariants, or a ModelingError.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "modeling/error.h"
#include "modeling/solid/surface_properties.h"
#include "shape_checks.h"

namespace palpa::modeling {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : generator_(seed) {}

  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(generator_); }
  double real(double low, double high) {
    return std::uniform_real_distribution(low, high)(generator_);
  }
  bool rarely() { return whole(0, 19) == 0; }

  /// Mostly a few millimetres; sometimes a nonsensical length.
  double length() {
    constexpr std::array<double, 8> kOdd{0.0, -1.0, 1e-3, 1e6, 1e300, 1e-300, NAN, INFINITY};
    return rarely() ? kOdd[whole(0, 7)] : std::pow(10.0, real(-1.0, 2.5));
  }
  Eigen::Vector3d lengths() { return {length(), length(), length()}; }

  /// Roughly round curve around the origin, of any degree; sometimes invalid.
  ProfileCurve curve(bool closed) {
    ProfileCurve curve;
    curve.degree = whole(1, 5);
    const int count = whole(curve.degree + 3, 12);
    const double wildness = real(0.0, 0.5);
    for (int i = 0; i <= count; ++i) {
      const double radius = 10.0 * (1.0 + wildness * real(-1.0, 1.0));
      const double angle =
          (closed ? 6.2831853 : 3.1415926) * i / count - (closed ? 0.0 : 1.5707963);
      curve.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    if (closed) curve.points.back() = curve.points.front();
    if (!closed && whole(0, 1) == 0) curve.points.front().x() = curve.points.back().x() = 0.0;
    double knot = 0.0;
    const int knots = count + 1 + curve.degree + 1;
    for (int i = 0; i < knots; ++i) {
      const bool inner = i > curve.degree && i <= count + 1;
      if (inner) knot += whole(0, 4) == 0 && i <= count ? 0.0 : real(0.1, 1.0);
      curve.knots.push_back(knot);
    }
    if (rarely()) curve.knots[whole(0, knots - 1)] = NAN;
    if (rarely()) curve.points[whole(0, count)] *= 1e9;
    return curve;
  }

 private:
  std::mt19937 generator_;
};

Primitive randomPrimitive(Dice& dice) {
  Primitive primitive;
  primitive.degree = dice.rarely() ? dice.whole(-1, 7) : dice.whole(1, 5);
  primitive.controlPoints = dice.whole(0, 2) > 0 ? 0 : dice.whole(-1, 20);
  switch (dice.whole(0, 9)) {
    case 0:
      primitive.shape = BoxShape{dice.lengths()};
      break;
    case 1:
      primitive.shape = SphereShape{dice.length()};
      break;
    case 2:
      primitive.shape = EllipsoidShape{dice.lengths()};
      break;
    case 3:
      primitive.shape = CylinderShape{dice.length(), dice.length()};
      break;
    case 4:
      primitive.shape =
          ConeShape{dice.length(), dice.whole(0, 1) == 0 ? 0.0 : dice.length(), dice.length()};
      break;
    case 5:
      primitive.shape = CapsuleShape{dice.length(), dice.length()};
      break;
    case 6:
      primitive.shape = TorusShape{dice.length(), dice.length()};
      break;
    case 7:
      primitive.shape = RevolveShape{dice.curve(dice.whole(0, 4) == 0)};
      break;
    case 8:
      primitive.shape = ExtrudeShape{dice.curve(!dice.rarely()), dice.length()};
      break;
    default: {
      LoftShape loft;
      double z = 0.0;
      for (int i = dice.whole(0, 4); i >= 0; --i) {
        loft.sections.push_back({z, dice.curve(true)});
        z += dice.rarely() ? dice.length() : dice.real(2.0, 20.0);
      }
      primitive.shape = loft;
    }
  }
  return primitive;
}

TEST(ShapesProperty, RandomParametersGiveASolidOrAClearError) {
  int made = 0;
  std::array<int, 10> madeOfKind{};
  for (unsigned seed = 0; seed < 600; ++seed) {
    Dice dice(seed);
    const Primitive primitive = randomPrimitive(dice);
    try {
      const Solid solid = makePrimitive(primitive);
      EXPECT_GT(volume(SurfaceEvaluator(solid)), 0.0) << seed;
      if (seed % 8 == 0) {
        const auto [low, high] = boundingBox(solid);
        const double deviation = makeMeasuredPrimitive(primitive).deviation;
        EXPECT_TRUE(std::isfinite(deviation)) << seed;
        EXPECT_LE(deviation, (high - low).norm()) << seed;
      }
      ++made;
      ++madeOfKind[primitive.shape.index()];
    } catch (const ModelingError& error) {
      // The parameters are invalid: the message begins with the shape. A violated invariant of
      // Solid would begin with another path.
      EXPECT_EQ(std::string(error.what()).find(shapeName(primitive) + ": "), 0U)
          << seed << ' ' << error.what();
    }
  }
  EXPECT_GT(made, 200);
  for (std::size_t kind = 0; kind < madeOfKind.size(); ++kind)
    EXPECT_GT(madeOfKind[kind], 3) << kind;
}

TEST(ShapesProperty, TheSamePrimitiveGivesTheSameBits) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    Dice first(seed), second(seed);
    try {
      const Solid a = makePrimitive(randomPrimitive(first));
      const Solid b = makePrimitive(randomPrimitive(second));
      EXPECT_EQ(a.controlPoints(), b.controlPoints()) << seed;
    } catch (const ModelingError&) {
      continue;  // the other test covers errors
    }
  }
}

}  // namespace
}  // namespace palpa::modeling
