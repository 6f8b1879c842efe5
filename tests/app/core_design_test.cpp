// Parts of the search for a shape that solve nothing: the subproblem of a step, the motions that a
// design allows, what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "app/core/design/design_space.h"
#include "app/core/design/shape_measures.h"
#include "app/core/design/shape_search.h"
#include "app/core/design/step_problem.h"
#include "modeling/error.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/tangent_continuity.h"

namespace palpa::app {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using modeling::Design;
using modeling::PatchPoints;
using modeling::PointSelection;

VectorXd randomVector(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  VectorXd result(size);
  for (double& value : result) value = normal(random);
  return result;
}

/// Largest violation of the conditions of a minimum: 0 in exact arithmetic.
double optimalityError(const StepProblem& problem, const StepSolution& solution) {
  VectorXd gradient = solution.x + problem.push;
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    const StepProblem::Row& row = problem.rows[r];
    const double miss = row.goal - row.value - row.slope.dot(solution.x - problem.present);
    gradient -= row.weight * (row.isLimit ? std::max(0.0, miss) : miss) * row.slope;
  }
  double error = 0;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const double low = std::max(-1.0, problem.present[i] - problem.radius),
                 high = std::min(1.0, problem.present[i] + problem.radius);
    EXPECT_GE(solution.x[i], low - 1e-12);
    EXPECT_LE(solution.x[i], high + 1e-12);
    // A step against the gradient must leave the bounds.
    const double step = std::clamp(solution.x[i] - gradient[i], low, high) - solution.x[i];
    error = std::max(error, std::abs(step));
  }
  return error;
}

StepProblem stepProblem(int variables, int rows, double goal, unsigned seed) {
  StepProblem problem;
  problem.present = VectorXd::Constant(variables, 0.1);
  problem.push = VectorXd::Zero(variables);
  problem.radius = 0.5;
  for (int r = 0; r < rows; ++r)
    problem.rows.push_back({0.05 * randomVector(variables, seed + static_cast<unsigned>(r)), 0,
                            r % 2 == 0 ? goal : -goal, 1e4, r >= 2});
  return problem;
}

TEST(StepProblem, FindsTheMinimum) {
  for (const int variables : {1, 30, 1000})
    for (const int rows : {1, 2, 12})
      for (const double goal : {0.01, 0.3}) {
        const StepProblem problem = stepProblem(variables, rows, goal, 7);
        EXPECT_LT(optimalityError(problem, solveStep(problem)), 1e-4)
            << variables << " variables, " << rows << " rows, goal " << goal;
      }
}

TEST(StepProblem, GoesToTheBoundsForAnImpossibleGoal) {
  StepProblem problem = stepProblem(50, 1, 1e3, 3);
  const StepSolution solution = solveStep(problem);
  for (Eigen::Index i = 0; i < 50; ++i) EXPECT_NEAR(std::abs(solution.x[i] - 0.1), 0.5, 1e-12);
  EXPECT_GT(solution.pressure[0], 0);
}

TEST(StepProblem, WithoutRowsThePushCounts) {
  StepProblem problem;
  problem.present = VectorXd::Zero(3);
  problem.push = Vector3d(0.2, -3, 0);
  EXPECT_LT((solveStep(problem).x - Vector3d(-0.2, 1, 0)).norm(), 1e-12);
}

modeling::Project projectOf(modeling::Solid solid) {
  modeling::Project project;
  project.body = std::move(solid);
  project.supports = {{"base", modeling::Support::Kind::kFixed,
                       modeling::Region::ofPatches({"bottom"}), Vector3d::Zero()}};
  project.touches = {{"poke", {0, 0, 20}, modeling::TouchKind::kGrab, {0, 0, -1}, 4.0},
                     {"pull", {5, 0, 20}, modeling::TouchKind::kForce, {0, 0, 1}, 4.0},
                     {"needle", {5, 0, 20}, modeling::TouchKind::kPin, {0, 0, 0}, 4.0}};
  return project;
}

Design designWith(std::optional<PointSelection> points, Design::Along along) {
  Design design;
  design.targets = {{"poke", modeling::DesignTarget::Kind::kStiffness, 1.0}};
  design.points = std::move(points);
  design.along = along;
  design.largestMovement = 2.0;
  return design;
}

double largestMotion(const Matrix3Xd& motion) {
  return motion.colwise().norm().maxCoeff();
}

TEST(DesignSpace, PullsGradientsBackAsItMovesPoints) {
  const modeling::Project ball = projectOf(modeling::makeSphere(25.0));
  for (const Design::Along along :
       {Design::Along::kNormal, Design::Along::kAny, Design::Along::kDirection}) {
    const DesignSpace space(ball, designWith(std::nullopt, along));
    const VectorXd y = randomVector(space.variableCount(), 1);
    const Matrix3Xd gradient =
        randomVector(3 * static_cast<Eigen::Index>(space.solid().controlPoints().size()), 2)
            .reshaped(3, Eigen::AutoSize);
    const double expected = space.displacement(y).cwiseProduct(gradient).sum();
    EXPECT_NEAR(space.pullBack(gradient).dot(y), expected, 1e-9 * std::abs(expected));
  }
}

TEST(DesignSpace, VariablesWithinTheirLimitKeepTheLargestMovement) {
  const modeling::Project box = projectOf(modeling::makeBox({40, 30, 20}));
  for (const double smoothness : {0.0, 1.0, 30.0}) {
    Design design = designWith(std::nullopt, Design::Along::kNormal);
    design.smoothness = smoothness;
    const DesignSpace space(box, design);
    const VectorXd most = VectorXd::Constant(space.variableCount(), space.limit());
    // Some point reaches the limit, none exceeds it.
    EXPECT_NEAR(largestMotion(space.displacement(most)), 2.0, 1e-9) << smoothness;
    const VectorXd some =
        randomVector(space.variableCount(), 5).cwiseMax(-1).cwiseMin(1) * space.limit();
    EXPECT_LE(largestMotion(space.displacement(some)), 2.0 + 1e-9) << smoothness;
  }
}

TEST(DesignSpace, SmoothnessSpreadsAMotion) {
  const modeling::Project box =
      projectOf(modeling::makePrimitive({modeling::BoxShape{{40, 30, 20}}, 3, 7}));
  const auto spread = [&](double smoothness) {
    Design design = designWith(PointSelection{{PatchPoints{{"top"}}}}, Design::Along::kDirection);
    design.smoothness = smoothness;
    const DesignSpace space(box, design);
    VectorXd one = VectorXd::Zero(space.variableCount());
    one[space.variableCount() / 2] = 1;
    const Matrix3Xd motion = space.displacement(one);
    return motion.colwise().norm().sum() / largestMotion(motion);
  };
  EXPECT_NEAR(spread(0), 1, 1e-9);
  EXPECT_GT(spread(1), 2);
  EXPECT_GT(spread(10), 1.5 * spread(1));
}

TEST(DesignSpace, OnlySelectedPointsMove) {
  const modeling::Project box = projectOf(modeling::makeBox({40, 30, 20}));
  const DesignSpace chosen(box, designWith(PointSelection::of({3, 5}), Design::Along::kAny));
  EXPECT_EQ(chosen.variableCount(), 6);
  const Matrix3Xd motion = chosen.displacement(VectorXd::Ones(6));
  for (Eigen::Index i = 0; i < motion.cols(); ++i)
    EXPECT_EQ(motion.col(i).norm() > 0, i == 3 || i == 5) << i;
  // By default the fixed patch stays.
  const DesignSpace usual(box, designWith(std::nullopt, Design::Along::kNormal));
  const auto moved = usual.moved(VectorXd::Constant(usual.variableCount(), 1.0));
  for (std::size_t i = 0; i < moved.points.size(); ++i)
    EXPECT_EQ(moved.points[i] != usual.solid().controlPoints()[i],
              usual.solid().controlPoints()[i].z() > 1e-9)
        << i;
}

TEST(DesignSpace, MirrorPlanesKeepTheSymmetry) {
  const modeling::Project box = projectOf(modeling::makeBox({40, 30, 20}));
  Design design = designWith(std::nullopt, Design::Along::kAny);
  design.mirrors = {{Vector3d::Zero(), Vector3d::UnitX()}, {Vector3d::Zero(), {0, 2, 0}}};
  const DesignSpace space(box, design);
  EXPECT_LT(space.variableCount(), 3 * static_cast<int>(space.points().size()) / 2);
  const auto moved = space.moved(randomVector(space.variableCount(), 4).cwiseMax(-1).cwiseMin(1));
  const Vector3d flipX(-1, 1, 1), flipY(1, -1, 1);
  for (const Vector3d& flip : {flipX, flipY})
    for (const Vector3d& point : moved.points) {
      double least = HUGE_VAL;
      for (const Vector3d& other : moved.points)
        least = std::min(least, (other - flip.cwiseProduct(point)).norm());
      EXPECT_LT(least, 1e-9);
    }
}

TEST(DesignSpace, SmoothEdgesStaySmooth) {
  const modeling::Project ball = projectOf(modeling::makeSphere(25.0));
  const double before = modeling::largestTangentAngle(modeling::makeSphere(25.0));
  const DesignSpace space(ball, designWith(std::nullopt, Design::Along::kNormal));
  const auto moved =
      space.moved(randomVector(space.variableCount(), 4).cwiseMax(-1).cwiseMin(1) * 2.0);
  EXPECT_LE(moved.largestMovement, 2.0 + 1e-12);
  EXPECT_GT(moved.largestMovement, 0.1);
  EXPECT_LT(modeling::largestTangentAngle(space.solid().withControlPoints(moved.points)),
            before + 0.01);
}

std::string faultOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const modeling::ModelingError& error) {
    return error.what();
  }
  return "no error";
}

void expectBegins(const std::string& text, const std::string& start) {
  EXPECT_EQ(text.rfind(start, 0), 0U) << text;
}

TEST(DesignSpace, RefusesWhatCannotMove) {
  const modeling::Project box = projectOf(modeling::makeBox({40, 30, 20}));
  const auto fault = [&](const std::function<void(Design&)>& change) {
    Design design = designWith(std::nullopt, Design::Along::kNormal);
    change(design);
    return faultOf([&] { DesignSpace(box, design); });
  };
  expectBegins(fault([](Design& d) {
                 d.points = PointSelection::of({1, 4711});
               }),
               "design.points[1]: control point 4711 does not exist");
  expectBegins(fault([](Design& d) { d.points = PointSelection{{PatchPoints{{"lid"}}}}; }),
               "design.points.patches[0]: no patch is named \"lid\"");
  expectBegins(fault([](Design& d) {
                 d.mirrors = {{{3, 0, 0}, {1, 0, 0}}};
               }),
               "design.mirrors: control point ");
  modeling::Project everywhere = box;
  everywhere.supports[0].where = modeling::Region::ofPatches(
      {"bottom", "top", "side_xmin", "side_xmax", "side_ymin", "side_ymax"});
  expectBegins(
      faultOf([&] { DesignSpace(everywhere, designWith(std::nullopt, Design::Along::kNormal)); }),
      "design.points: supports fix every patch");
}

TEST(ValidateDesign, NamesWhatIsWrong) {
  const modeling::Project box = projectOf(modeling::makeBox({40, 30, 20}));
  using Kind = modeling::DesignTarget::Kind;
  const auto fault = [&](std::vector<modeling::DesignTarget> targets) {
    Design design;
    design.targets = std::move(targets);
    return faultOf([&] { validateDesign(box, design); });
  };
  expectBegins(fault({}), "design.targets: there is no target");
  expectBegins(fault({{"poke"}, {"prod"}}), "design.targets[1].touch: no touch is named \"prod\"");
  expectBegins(fault({{"pull", Kind::kForce, 1.0}}), "design.targets[0].force_N: the touch");
  expectBegins(fault({{"needle", Kind::kForce, 1.0, 2.0}}),
               "design.targets[0].depth_mm: the touch");
  expectBegins(fault({{"poke", Kind::kStiffness, -1.0}}), "design.targets[0].stiffness_N_per_mm");
}

TEST(WallThickness, HasTheGradientOfDifferences) {
  const modeling::Solid box = modeling::makeBox({40, 30, 20});
  std::vector<WallThickness> walls = wallThicknesses(box, {*box.findPatch("top")});
  ASSERT_EQ(walls.size(), 36U);
  const WallThickness wall = walls[7];
  EXPECT_NEAR(wall.value, 20, 1e-9);
  const Matrix3Xd gradient = wall.gradient(box);
  std::vector<Vector3d> points = box.controlPoints();
  double expected = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].z() > 19) {
      const double lift = 1e-3 * (1 + std::sin(static_cast<double>(i)));
      points[i].z() += lift;
      expected += lift * gradient(2, static_cast<Eigen::Index>(i));
    }
  const auto after = wallThicknesses(box.withControlPoints(points), {*box.findPatch("top")})[7];
  EXPECT_NEAR(after.value - wall.value, expected, 0.02 * expected);
}

}  // namespace
}  // namespace palpa::app
