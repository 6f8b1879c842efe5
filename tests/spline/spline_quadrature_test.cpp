#include "bem/spline/spline_quadrature.h"

#include "base/parallel.h"
#include "bem/spline/spline_assembly.h"
#include "spline_body.h"

namespace palpa::bem::test {
namespace {

using Eigen::Vector3d;

/// Errors of the integrals over elements against much finer rules, over the largest of the same
/// element, for every third collocation point.
struct WorstError {
  double apart = 0, inside = 0;
};

/// Sums of T less what a translation takes away, and sums of U.
std::vector<double> reduced(const SplineSurface& surface, const SplineQuadrature& quadrature,
                            int element, const CollocationPlace& point, const ElementPlace* inside,
                            ElementQuadrature::Workspace& work) {
  quadrature.integrate(element, point.position, inside, work);
  const auto count = surface.functions(element).size();
  std::vector<double> basis(count, 0), result;
  if (inside) surface.evaluateBasis(*inside, basis);
  for (int k = 0; k < kKernelSums; ++k) {
    double total = 0;
    for (std::size_t f = 0; f < count; ++f) total += work.sums[f].of[k];
    for (std::size_t f = 0; f < count; ++f)
      result.push_back(work.sums[f].of[k] - (k >= 6 ? basis[f] * total : 0));
  }
  return result;
}

WorstError measure(const SplineSurface& surface, double tolerance, bool skipCorners = false) {
  const SplineQuadrature quadrature(surface, tolerance);
  const SplineQuadrature reference(surface, tolerance * 1e-3);
  const auto points = grevilleCollocation(surface);
  const auto workspace = quadrature.makeWorkspace();
  ElementQuadrature::Workspace& work = *workspace;
  WorstError worst;
  for (std::size_t k = 0; k < points.size(); k += 3)
    for (int e = 0; e < surface.elementCount(); ++e) {
      const ElementPlace* inside = nullptr;
      for (const ElementPlace& place : points[k].places)
        if (place.element == e) inside = &place;
      if (inside && skipCorners) {
        const SurfaceJet jet = surface.evaluate(*inside);
        if (jet.areaVector().norm() < 0.1 * jet.du.norm() * jet.dv.norm()) continue;
      }
      const auto found = reduced(surface, quadrature, e, points[k], inside, work);
      const auto exact = reduced(surface, reference, e, points[k], inside, work);
      // U and T apart: they have different units.
      const std::size_t border = found.size() / kKernelSums * 6;
      for (const auto& [begin, end] : {std::pair(std::size_t{0}, border), {border, found.size()}}) {
        double error = 0, scale = 0;
        for (std::size_t i = begin; i < end; ++i) {
          error = std::max(error, std::abs(found[i] - exact[i]));
          scale = std::max(scale, std::abs(exact[i]));
        }
        double& place = inside ? worst.inside : worst.apart;
        place = std::max(place, error / scale);
      }
    }
  return worst;
}

class QuadratureTolerance : public testing::TestWithParam<double> {};

TEST_P(QuadratureTolerance, IsKeptOnAllBodies) {
  const double tolerance = GetParam();
  // A plate of 20:1 has elements of 6.7:1 at its sides, and faces close to each other.
  const std::vector<std::pair<const char*, modeling::Solid>> bodies{
      {"sphere", modeling::makeSphere(25)},
      {"coarse sphere", modeling::makeSphere(25, 5)},
      {"plate", modeling::makeBox({60, 60, 3})},
      {"torus", makeTorus(30, 10)}};
  for (const auto& [name, solid] : bodies) {
    const WorstError worst = measure(app::splineSurfaceOf(solid), tolerance);
    EXPECT_LT(worst.apart, 3 * tolerance) << name;
    EXPECT_LT(worst.inside, 20 * tolerance) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Spline, QuadratureTolerance, testing::Values(1e-4, 1e-5, 1e-7));

TEST(SplineQuadrature, RoundCapsKeepTheToleranceExceptInTheirCorners) {
  const SplineSurface cylinder = app::splineSurfaceOf(modeling::makeCylinder(20, 60));
  const WorstError worst = measure(cylinder, 1e-5, true);
  EXPECT_LT(worst.apart, 3e-5);
  EXPECT_LT(worst.inside, 2e-4);
}

/// H (ω × x) = 0 holds to the quadrature's tolerance only: the translations alone are built in.
TEST(SplineAssembly, ARotationNeedsNoTraction) {
  for (const auto& [solid, limit] : {std::pair(modeling::makeSphere(25), 3e-5),
                                     {modeling::makeBox({60, 60, 3}), 3e-5},
                                     {modeling::makeCylinder(20, 60), 3e-3}}) {
    const SplineSurface surface = app::splineSurfaceOf(solid);
    const SplineTractions tractions(surface);
    const auto operators =
        assemble<double>(surface, tractions, collocationEquations(grevilleCollocation(surface)),
                         {0.1, 0.4}, {1e-5}, Job{});
    Eigen::VectorXd turn(3 * surface.coefficientCount());
    const Vector3d axis = Vector3d(0.3, -0.5, 0.8) / 60;
    for (int k = 0; k < surface.coefficientCount(); ++k)
      turn.segment<3>(3 * k) = axis.cross(surface.controlPoints()[k]);
    EXPECT_LT((operators.H.view() * turn).lpNorm<Eigen::Infinity>(),
              limit * turn.lpNorm<Eigen::Infinity>());
  }
}

TEST(SplineAssembly, DoesNotDependOnTheNumberOfThreads) {
  const SplineSurface surface = app::splineSurfaceOf(modeling::makeCylinder(20, 60));
  const SplineTractions tractions(surface);
  Job one, three;
  one.threads = 1;
  three.threads = 3;
  const auto points = collocationEquations(grevilleCollocation(surface));
  const auto a = assemble<double>(surface, tractions, points, {0.1, 0.3}, {1e-5}, one);
  const auto b = assemble<double>(surface, tractions, points, {0.1, 0.3}, {1e-5}, three);
  EXPECT_EQ(a.H.view(), b.H.view());
  EXPECT_EQ(a.G.view(), b.G.view());
}

TEST(SplineAssembly, StopsWhenAsked) {
  const SplineSurface surface = app::splineSurfaceOf(modeling::makeSphere(25, 11));
  const SplineTractions tractions(surface);
  std::stop_source source;
  Job job;
  job.stop = source.get_token();
  job.progress = [&](Phase, double) { source.request_stop(); };
  EXPECT_THROW(
      assemble<double>(surface, tractions, collocationEquations(grevilleCollocation(surface)),
                       {0.1, 0.3}, {1e-5}, job),
      Cancelled);
}

/// Linear fields lie in the space of the splines, so only quadrature errs (and, on bent faces, the
/// projection of the tractions).
TEST(SplinePatchTest, LinearFields) {
  const auto base = [](const Vector3d& x) { return x.z() < 1e-6; };
  for (const double nu : {0.0, 0.3, 0.5}) {
    const Material material{0.1, nu};
    const ExactField exact = linearField(generalGradient(nu == 0.5), {0.1, -0.2, 0.3}, material);
    const SplineBody box(fixedWhere(app::splineSurfaceOf(modeling::makeBox({40, 30, 20})), base),
                         material, exact, {1e-8});
    EXPECT_LT(box.displacementError(exact), 1e-7) << nu;
    EXPECT_LT(box.tractionError(exact), 1e-6) << nu;
    const SplineBody plate(fixedWhere(app::splineSurfaceOf(modeling::makeBox({60, 60, 3})), base),
                           material, exact, {1e-8});
    EXPECT_LT(plate.displacementError(exact), 1e-6) << nu;
    const SplineBody sphere(fixedWhere(app::splineSurfaceOf(modeling::makeSphere(25, 9)),
                                       [](const Vector3d& x) {
                                         return x.z() < -std::max(std::abs(x.x()), std::abs(x.y()));
                                       }),
                            material, exact, {1e-6});
    EXPECT_LT(sphere.displacementError(exact), 3e-5) << nu;
  }
}

}  // namespace
}  // namespace palpa::bem::test
