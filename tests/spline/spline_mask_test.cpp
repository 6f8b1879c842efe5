#include <unistd.h>

#include <ctime>
#include <numbers>
#include <random>

#include "allocation_counter.h"
#include "spline_body.h"
#include "touched_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

constexpr Material kMaterial{0.1, 0.45};
constexpr double kRadius = 25;

/// Sphere R = 25 mm of cubic splines, n = 386 and what the support's border tears; elements of 6.5
/// mm.
SplineTouched& sphere() {
  static SplineTouched shared(modeling::makeSphere(kRadius, 9), -20, kMaterial, 5);
  return shared;
}

std::vector<Vector3d> directions(int count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 1);
  std::vector<Vector3d> list;
  while (static_cast<int>(list.size()) < count) {
    const Vector3d direction =
        Vector3d(normal(random), normal(random), normal(random)).normalized();
    if (direction.z() > -0.3) list.push_back(direction);
  }
  return list;
}

/// What a mask is as a field, against the bump: ∫ Φ, height in the middle, L2 error, mean ρ^2; and
/// its mean place, mm.
struct MaskShape {
  double integral = 0, height = 0, error = 0, spread = 0;
  Vector3d place = Vector3d::Zero();
};

MaskShape shapeOf(const SplineTouched& body, const ContactMask& mask) {
  std::vector<double> coefficients(body.splines.controlPoints().size(), 0.0);
  for (std::size_t k = 0; k < mask.nodes.size(); ++k)
    coefficients[mask.nodes[k]] = mask.traction[k];
  std::vector<int> all;
  for (int e = 0; e < body.splines.elementCount(); ++e) all.push_back(e);
  const Vector3d middle = body.surface().smoothPosition(mask.point);
  const auto bump = [&](const Vector3d& x) {
    const double s = 1 - (x - middle).squaredNorm() / (mask.radius * mask.radius);
    return s > 0 ? s * s : 0.0;
  };
  double total = 0, bumpSpread = 0;
  visitSplinePoints(
      body.splines, all, 5, 3.0, [&](const ElementPlace&, const SurfaceJet& jet, double weight) {
        total += weight * bump(jet.position);
        bumpSpread += weight * bump(jet.position) * (jet.position - middle).squaredNorm();
      });
  MaskShape shape;
  std::vector<double> basis;
  const auto valueAt = [&](int element) {
    double value = 0;
    for (std::size_t f = 0; f < basis.size(); ++f)
      value += basis[f] * coefficients[body.splines.functions(element)[f]];
    return value;
  };
  double square = 0;
  visitSplinePoints(body.splines, all, 5, 3.0,
                    [&](const ElementPlace& place, const SurfaceJet& jet, double weight) {
                      body.splines.evaluateTractionBasis(place, basis);
                      const double value = valueAt(place.element);
                      const double wanted = bump(jet.position) / total;
                      shape.integral += weight * value;
                      shape.place += weight * value * jet.position;
                      shape.spread += weight * value * (jet.position - middle).squaredNorm();
                      shape.error += weight * (value - wanted) * (value - wanted);
                      square += weight * wanted * wanted;
                    });
  const SplineMesh::Point at = body.onMesh->at(mask.point);
  body.splines.evaluateBasis(at.element, at.parameters, basis);
  shape.height = valueAt(at.element) * total;
  shape.error = std::sqrt(shape.error / square);
  shape.spread *= total / bumpSpread;
  return shape;
}

TEST(SplineMask, IsTheBumpAsWellAsSplinesCan) {
  // Coefficients of the place as a displacement: the control points, except beside the border.
  const Eigen::VectorXd places =
      projectDisplacement(sphere().splines, [](const Vector3d& x, const Vector3d&) { return x; });
  const auto workspace = sphere().surface().makeWorkspace();
  ContactMask mask;
  double least = INFINITY, most = 0;
  for (const double wider : {1.0, 1.25, 1.7}) {
    double error = 0, height = 0, spread = 0, integral = 0;
    for (const Vector3d& direction : directions(16)) {
      const SurfacePoint point = sphere().surface().nearest(kRadius * direction);
      const double narrowest = sphere().surface().narrowestMask(point);
      least = std::min(least, narrowest);
      most = std::max(most, narrowest);
      ASSERT_TRUE(sphere().surface().makeMask(point, wider * narrowest, *workspace, mask));
      EXPECT_EQ(mask.radius, wider * narrowest);
      const MaskShape shape = shapeOf(sphere(), mask);
      error = std::max(error, shape.error);
      // Beside the border of the support, whose functions are extrapolated, 0.4 times as good.
      const double part = point.position.z() + 20 < 2 * narrowest ? 0.4 : 1;
      height = std::max(height, part * std::abs(shape.height - 1));
      spread = std::max(spread, part * std::abs(shape.spread - 1));
      integral = std::max(integral, std::abs(shape.integral - 1));
      double measured = 0, weights = 0;
      Vector3d middle = Vector3d::Zero(), byMeasure = Vector3d::Zero();
      for (std::size_t k = 0; k < mask.measure.size(); ++k) {
        measured += mask.measure[k];
        byMeasure += mask.measure[k] * places.segment<3>(3 * mask.measureNodes[k]);
      }
      for (std::size_t k = 0; k < mask.points.size(); ++k) {
        weights += mask.pointWeights[k];
        middle += mask.pointWeights[k] * mask.points[k];
      }
      EXPECT_NEAR(measured, 1, 1e-12);
      EXPECT_NEAR(weights, 1, 1e-12);
      // Two quadratures of the mean place of the bump.
      EXPECT_LE((middle - (byMeasure + shape.place) / 2).norm(), 2e-3);
    }
    std::printf("radius %.2f narrowest: error %.3f, height %.3f, mean ρ^2 %.3f, integral %.1e\n",
                wider, error, height, spread, integral);
    EXPECT_LE(integral, 2e-5);
    EXPECT_LE(error, wider < 1.1 ? 0.2 : wider < 1.5 ? 0.12 : 0.06);
    EXPECT_LE(height, wider < 1.1 ? 0.08 : wider < 1.5 ? 0.05 : 0.01);
    EXPECT_LE(spread, wider < 1.1 ? 0.12 : wider < 1.5 ? 0.06 : 0.03);
  }
  std::printf("narrowest masks %.1f … %.1f mm\n", least, most);
}

/// Along a way over four patches, in steps of 0.05 mm.
TEST(SplineMask, WidthsHaveNoKinks) {
  const SplineMaskWidths widths(sphere().splines);
  const ContactSurface& surface = sphere().surface();
  const auto kinkOf = [](const std::vector<double>& values) {
    double kink = 0;
    for (std::size_t k = 1; k + 1 < values.size(); ++k)
      kink = std::max(kink, std::abs(values[k + 1] - 2 * values[k] + values[k - 1]));
    return kink;
  };
  constexpr double kStep = 0.05;
  std::vector<double> smooth, byFunctions, basis;
  for (double angle = 0; angle < 2 * std::numbers::pi; angle += kStep / kRadius) {
    const Vector3d direction(std::cos(angle), 0.8 * std::sin(angle), 0.6 * std::sin(angle));
    const SurfacePoint point = surface.nearest(kRadius * direction);
    const SplineMesh::Point at = sphere().onMesh->at(point);
    smooth.push_back(widths.at(at.element, point.position));
    EXPECT_EQ(smooth.back(), surface.narrowestMask(point));
    sphere().splines.evaluateBasis(at.element, at.parameters, basis);
    double width = 0;
    for (std::size_t f = 0; f < basis.size(); ++f)
      width += basis[f] * widths.ofFunctions()[sphere().splines.functions(at.element)[f]];
    byFunctions.push_back(width);
    EXPECT_GE(smooth.back(), 0.95 * width);
  }
  std::printf("kinks of %.4f mm per mm, interpolated by the splines %.3f\n", kinkOf(smooth) / kStep,
              kinkOf(byFunctions) / kStep);
  EXPECT_LE(kinkOf(smooth), 0.02 * kStep);
  EXPECT_GE(kinkOf(byFunctions), 0.1 * kStep);
}

TEST(SplineMask, RadiusIsWhatIsAskedWhereThatIsCarried) {
  const ContactSurface& surface = sphere().surface();
  const SurfacePoint point = surface.nearest({3, 4, 24});
  const double narrowest = surface.narrowestMask(point);
  EXPECT_EQ(surface.maskRadius(point, 0), narrowest);
  EXPECT_EQ(surface.maskRadius(point, 0.9 * narrowest), narrowest);
  EXPECT_EQ(surface.maskRadius(point, narrowest), narrowest);
  EXPECT_EQ(surface.maskRadius(point, 1.01 * narrowest), 1.01 * narrowest);
  double before = narrowest, slope = 0;
  for (double part = 0.9; part < 1.1; part += 1e-3) {
    const double radius = surface.maskRadius(point, part * narrowest);
    EXPECT_GE(radius, 0.985 * narrowest);
    EXPECT_GE(radius, part * narrowest);
    // Its slope by the radius asked goes from 0 to 1 without a step.
    const double next = part > 0.9005 ? (radius - before) / (1e-3 * narrowest) : 0;
    EXPECT_NEAR(next, slope, 0.05);
    before = radius;
    slope = next;
  }
}

/// A plate of 2 mm: what is touched is one side.
TEST(SplineMask, LeavesTheFarSideAlone) {
  const SplineTouched plate(halved(halved(halved(modeling::makeBox({60, 2, 60})))), FixedBelow{},
                            kMaterial, 6);
  const auto workspace = plate.surface().makeWorkspace();
  ContactMask mask;
  const SurfacePoint point = plate.surface().nearest({1, 1, 31});
  ASSERT_TRUE(plate.surface().makeMask(point, 8, *workspace, mask));
  EXPECT_LT(mask.radius, 20);
  for (const int node : mask.nodes) EXPECT_NEAR(plate.surface().places()[node].y(), 1, 1e-9);
}

TEST(SplineMask, IsEmptyOnASupport) {
  const auto workspace = sphere().surface().makeWorkspace();
  ContactMask mask;
  EXPECT_FALSE(
      sphere().surface().makeMask(sphere().surface().nearest({0, 0, -25}), 3, *workspace, mask));
  EXPECT_TRUE(mask.nodes.empty());
}

TEST(SplineContactSurface, PointsAreOnTheTrueSurface) {
  const ContactSurface& surface = sphere().surface();
  double farthest = 0, aside = 0, tilted = 0;
  for (const Vector3d& direction : directions(200)) {
    for (const double height : {20.0, 25.5, 37.0}) {
      const SurfacePoint foot = surface.nearest(height * direction);
      farthest = std::max(farthest, std::abs(foot.position.norm() - kRadius));
      const Vector3d off = height * direction - foot.position;
      const Vector3d normal = surface.normal(foot);
      aside = std::max(aside, (off - normal * normal.dot(off)).norm());
      tilted = std::max(tilted, (normal - foot.position.normalized()).norm());
      EXPECT_LE((surface.at(foot.triangle, foot.weights).position - foot.position).norm(), 1e-12);
    }
  }
  std::printf("off the sphere %.1e mm, aside %.1e mm, normals %.1e\n", farthest, aside, tilted);
  EXPECT_LE(farthest, 2e-3);  // how well cubics fit the sphere
  EXPECT_LE(tilted, 1e-3);
  // Smooth edges of patches are not quite smooth, and feet may end there.
  EXPECT_LE(aside, 5e-3);
}

TEST(SplineContactSurface, MasksDoNotAllocate) {
  const ContactSurface& surface = sphere().surface();
  const auto workspace = surface.makeWorkspace();
  ContactMask mask;
  const std::vector<Vector3d> places = directions(100);
  const auto makeAll = [&] {
    for (const Vector3d& place : places)
      surface.makeMask(surface.nearest(kRadius * place), 12, *workspace, mask);
  };
  makeAll();
  app::test::watchAllocations(::gettid());
  const std::clock_t begin = std::clock();
  makeAll();
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  const long allocations = app::test::allocations();
  app::test::watchAllocations(0);
  EXPECT_EQ(allocations, 0);
  std::printf("%.0f µs per mask of %zu coefficients\n",
              1e6 * seconds / static_cast<double>(places.size()), mask.nodes.size());
}

TEST(SplineContactSurface, StrainEnergyIsTheWorkOfAForce) {
  ContactSimulation simulation = sphere().simulation();
  const auto id = simulation.begin({ContactTool::Kind::kForce, 12}, {0, 0, 25}, {0.02, 0, -0.1});
  sphere().settle(simulation);
  const auto& contact = *simulation.find(id);
  BoundaryField known = sphere().base();
  std::vector<int> nodes;
  std::vector<Vector3d> values;
  simulation.tractions(nodes, values);
  const TractionSlots& slots = sphere().surface().slots();
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (int slot = slots.firstOfNode[nodes[k]]; slot < slots.firstOfNode[nodes[k] + 1]; ++slot)
      known.p.col(0).segment<3>(3 * slot) = values[k];
  const BoundaryField field = sphere().problem()->solveField(known);
  const double work = 0.5 * contact.force.dot(contact.displacement);
  // The mean displacement is taken over the bump, the energy of the traction over its projection.
  EXPECT_NEAR(sphere().surface().strainEnergy(field.u.col(0), field.p.col(0)), work, 0.015 * work);
}

}  // namespace
}  // namespace palpa::bem::test
