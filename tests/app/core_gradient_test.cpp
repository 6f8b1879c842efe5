// Gradients of stiffness by the control points: identities, beam theory, central differences of
// operators that are assembled and factorised from scratch.
#include <gtest/gtest.h>

#include <random>

#include "app/core/design/carried_stiffness.h"
#include "app/core/design/shape_measures.h"
#include "app/core/design/stiffness_gradient.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "bench/plain_boundary_form.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/primitives.h"

namespace palpa::app {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

modeling::Project example(const std::string& name, modeling::Engine engine) {
  modeling::Project project =
      modeling::readProject(std::string(PALPA_PROJECTS) + "/" + name + ".json");
  project.mesh.engine = engine;
  return project;
}

const modeling::Solid& solidOf(const modeling::Project& project) {
  return std::get<modeling::Solid>(project.body);
}

/// A project's model with the gradient of its first touch.
struct Case {
  modeling::Project project;
  std::shared_ptr<const TouchModel> model;
  StiffnessRule rule;
  StiffnessGradient result;

  explicit Case(modeling::Project from) : project(std::move(from)) {
    model = buildTouchModel(project, {}, {});
    rule = stiffnessRuleOf(playTouches(*model, project.touches).contacts.front());
    result = StiffnessGradients(project, *model).of(rule);
  }
  /// Σ g_j · (S P_j).
  double along(const Eigen::Matrix3d& S) const {
    double sum = 0;
    for (Eigen::Index k = 0; k < result.gradient.cols(); ++k)
      sum += result.gradient.col(k).dot(
          S * solidOf(project).controlPoints()[static_cast<std::size_t>(k)]);
    return sum;
  }
};

/// Root mean square of the error over the root mean square of the changes.
double errorOf(const Case& each, double step, int directions) {
  const auto [low, high] = modeling::boundingBox(each.project.body);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double error = 0, square = 0;
  for (int direction = 0; direction < directions; ++direction) {
    Matrix3Xd motion(3, each.result.gradient.cols());
    for (double& value : motion.reshaped()) value = step * (high - low).norm() * normal(random);
    const auto at = [&](double sign) {
      std::vector<Vector3d> points = solidOf(each.project).controlPoints();
      for (std::size_t k = 0; k < points.size(); ++k)
        points[k] += sign * motion.col(static_cast<Eigen::Index>(k));
      return movedStiffness(each.project, *each.model, each.rule, std::move(points));
    };
    const double difference = (at(1) - at(-1)) / 2;
    square += difference * difference;
    error += std::pow(each.result.gradient.cwiseProduct(motion).sum() - difference, 2);
  }
  return std::sqrt(error / square);
}

TEST(StiffnessGradient, EqualsCentralDifferencesWithSplines) {
  EXPECT_LT(errorOf(Case(example("box", modeling::Engine::kSplines)), 5e-5, 3), 0.01);
}

TEST(StiffnessGradient, EqualsCentralDifferencesWithFlatTriangles) {
  EXPECT_LT(errorOf(Case(example("box", modeling::Engine::kTriangles)), 1e-3, 3), 0.05);
}

// On a curved surface the recovered slopes of displacements change with the triangles around.
TEST(StiffnessGradient, OfACurvedSurfaceEqualsCentralDifferencesWithFlatTriangles) {
  EXPECT_LT(errorOf(Case(example("fingertip-pad", modeling::Engine::kTriangles)), 2e-4, 3), 0.02);
}

TEST(StiffnessGradient, EqualsCentralDifferencesWithQuadraticTriangles) {
  EXPECT_LT(errorOf(Case(example("box", modeling::Engine::kQuadratic)), 1e-3, 2), 0.05);
}

// Elements as long as half the tube's radius interpolate the motion below the mask.
TEST(StiffnessGradient, OfACurvedSurfaceEqualsCentralDifferencesWithQuadraticTriangles) {
  EXPECT_LT(errorOf(Case(example("torus-seal", modeling::Engine::kQuadratic)), 2e-4, 1), 0.03);
}

TEST(StiffnessGradient, OfASphereOnAPlaneEqualsCentralDifferences) {
  EXPECT_LT(errorOf(Case(example("sphere", modeling::Engine::kSplines)), 5e-5, 2), 0.02);
}

TEST(StiffnessGradient, TranslationsOfTheBodyChangeNothing) {
  const Case box(example("box", modeling::Engine::kSplines));
  EXPECT_LT(box.result.gradient.rowwise().sum().norm(),
            1e-10 * box.result.gradient.colwise().norm().sum());
}

// k is homogeneous of degree 1 in the shape and the radius of the mask together.
TEST(StiffnessGradient, ScalingFollowsTheRadius) {
  const Case box(example("box", modeling::Engine::kSplines));
  const auto surface =
      box.model->setup().discretisation->makeContactSurface(box.model->problem()->dofs());
  const auto withRadius = [&](double factor) {
    StiffnessRule rule = box.rule;
    rule.masks.front().radius *= factor;
    return contactStiffness(*box.model->problem(), *surface, rule).value;
  };
  const double byRadius = (withRadius(1.02) - withRadius(1.0)) / 0.02;
  EXPECT_NEAR(box.along(Eigen::Matrix3d::Identity()) + byRadius, box.result.stiffness,
              0.03 * box.result.stiffness);
}

/// Largest difference between the prepared boundary form and its plain sums over the points, over
/// the largest value.
double formDifference(const StiffnessGradients& gradients, const TouchModel& model,
                      const StiffnessRule& rule) {
  const ContactStiffness stiffness =
      contactStiffness(*model.problem(), gradients.contactSurface(), rule);
  const Matrix3Xd plain = bench::plainBoundaryForm(gradients.surface(), model, stiffness);
  return (gradients.boundaryForm(stiffness) - plain).cwiseAbs().maxCoeff() /
         plain.cwiseAbs().maxCoeff();
}

TEST(BoundaryForm, EqualsThePlainSumsOverThePoints) {
  for (const modeling::Engine engine :
       {modeling::Engine::kSplines, modeling::Engine::kQuadratic, modeling::Engine::kTriangles}) {
    const modeling::Project project = example("box", engine);
    const auto model = buildTouchModel(project, {}, {});
    const StiffnessGradients gradients(project, *model);
    StiffnessRule rule = stiffnessRuleOf(playTouches(*model, project.touches).contacts.front());
    EXPECT_LT(formDifference(gradients, *model, rule), 1e-12) << "engine " << int(engine);
    // Several masks with forces, as below a ball; one of them beside an edge of the box.
    rule.deflection.setZero();
    rule.masks = {{Vector3d(-8, 0, 20), 6, Vector3d(0, 0.1, -0.8)},
                  {Vector3d(-5, 2, 20), 5, Vector3d(0.1, 0, -0.2)},
                  {Vector3d(11, 0, 20), 5, Vector3d(0, 0, 0.3)}};
    EXPECT_LT(formDifference(gradients, *model, rule), 1e-12) << "engine " << int(engine);
  }
}

TEST(BoundaryForm, DoesNotDependOnTheNumberOfThreads) {
  const modeling::Project project = example("box", modeling::Engine::kSplines);
  const auto model = buildTouchModel(project, {}, {});
  const StiffnessGradients gradients(project, *model);
  const ContactStiffness stiffness =
      contactStiffness(*model->problem(), gradients.contactSurface(),
                       stiffnessRuleOf(playTouches(*model, project.touches).contacts.front()));
  Job one, three;
  one.threads = 1;
  three.threads = 3;
  EXPECT_EQ(gradients.boundaryForm(stiffness, one), gradients.boundaryForm(stiffness, three));
}

// A slender bar that is bent across: k ~ w h³ / L³, apart from shear and the press of the mask.
TEST(StiffnessGradient, OfABarFollowsBeamTheory) {
  modeling::Project project = example("box", modeling::Engine::kSplines);
  modeling::Solid solid = solidOf(project);
  std::vector<Vector3d> points = solid.controlPoints();
  const auto [low, high] = modeling::boundingBox(solid);
  for (Vector3d& point : points) {
    point.x() = 8 * (point.x() - low.x()) / (high.x() - low.x()) - 4;
    point.y() = 8 * (point.y() - low.y()) / (high.y() - low.y()) - 4;
    point.z() = 80 * (point.z() - low.z()) / (high.z() - low.z());
  }
  project.body = solid.withControlPoints(std::move(points));
  modeling::Touch touch;
  touch.name = "bend";
  touch.at = Vector3d(4, 0, 76);
  touch.kind = modeling::TouchKind::kForce;
  touch.vector = Vector3d(-1e-4, 0, 0);
  touch.radius = 3;
  project.touches = {touch};
  const Case bar(std::move(project));
  const auto scaled = [&](int axis) {
    Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
    S(axis, axis) = 1;
    return bar.along(S) / bar.result.stiffness;
  };
  EXPECT_NEAR(scaled(0), 3, 0.3);
  EXPECT_NEAR(scaled(1), 1, 0.1);
  EXPECT_NEAR(scaled(2), -3, 0.3);
}

TEST(StiffnessGradient, IsRefusedForRollers) {
  modeling::Project project = example("box", modeling::Engine::kSplines);
  modeling::Support guide = project.supports.front();
  guide.name = "guide";
  guide.kind = modeling::Support::Kind::kRoller;
  guide.where = modeling::Region::ofPatches({solidOf(project).patches().back().name});
  const auto model = buildTouchModel(project, {}, {});
  project.supports.push_back(guide);
  EXPECT_THROW(StiffnessGradients(project, *model), bem::SolverError);
}

TEST(ShapeMeasures, OfABoxFollowItsSides) {
  const modeling::Project project = example("box", modeling::Engine::kSplines);
  const auto model = buildTouchModel(project, {}, {});
  const DesignSurface surface = makeDesignSurface(*model);
  const auto scaling = [&](const ShapeMeasure& measure) {
    double sum = 0;
    for (Eigen::Index k = 0; k < measure.gradient.cols(); ++k)
      sum += measure.gradient.col(k).dot(
          solidOf(project).controlPoints()[static_cast<std::size_t>(k)]);
    return sum / measure.value;
  };
  const ShapeMeasure volume = volumeOf(surface), area = areaOf(surface);
  EXPECT_NEAR(volume.value, modeling::volume(project.body), 1e-6 * volume.value);
  EXPECT_NEAR(scaling(volume), 3, 1e-6);
  EXPECT_NEAR(scaling(area), 2, 1e-6);
  const auto thickness = smallestThickness(solidOf(project));
  ASSERT_TRUE(thickness);
  EXPECT_NEAR(scaling(*thickness), 1, 1e-6);
}

}  // namespace
}  // namespace palpa::app
