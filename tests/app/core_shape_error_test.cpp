// Parts of the stated error that the residual of the equations does not show by itself: the shape
// of the mesh, and directions in which a body yields easily.
#include "app/core/results/shape_error.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/touch.h"
#include "core_projects.h"
#include "modeling/shapes/primitive.h"
#include "modeling/shapes/primitives.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;
using modeling::Engine;
using modeling::Region;
using modeling::Support;

/// A bar of facets in tension is less stiff by the missing part of its section.
TEST(ShapeError, IsTheMissingSectionOfABarInTension) {
  for (const auto& [engine, edge] :
       {std::pair{Engine::kTriangles, 9.0}, {Engine::kQuadratic, 30.0}}) {
    modeling::Project project = test::clampedCylinder(edge, 0);
    project.mesh.engine = engine;
    project.loads.push_back({"pull", modeling::TotalForce{Region::ofPatches({"top"}), {0, 0, 10}}});
    const auto model = buildTouchModel(project, {}, {});
    const bem::BoundaryField& field = model->rest().field;
    const EnergyDensity density(model->setup(), field.u.col(0), field.p.col(0));
    const double meshed = model->setup().discretisation->volumeMoments().volume();
    const double missing = (modeling::volume(project.body) - meshed) / meshed;
    EXPECT_GT(missing, engine == Engine::kTriangles ? 0.01 : 0.001);
    const double stated = shapeError(*model, density, model->rest().energy, {});
    EXPECT_NEAR(stated, missing, 0.12 * missing);
  }
}

/// Splines of a solid lie on its surface.
TEST(ShapeError, IsZeroForSplines) {
  modeling::Project project = test::clampedCylinder(12);
  project.mesh.engine = Engine::kSplines;
  const auto model = buildTouchModel(project, {}, {});
  for (const double offset : model->surfaceOffsets({})) EXPECT_EQ(offset, 0);
}

struct Grab {
  Vector3d force;
  double stated;
};

Grab grab(modeling::Project project, Engine engine, double edge) {
  project.mesh.engine = engine;
  project.mesh.edgeLength = edge;
  const auto model = buildTouchModel(project, {}, {});
  const TouchState state = playTouches(*model, project.touches);
  return {state.contacts[0].force, estimateErrors(*model, state).contacts[0]};
}

/// Coarse quadratic triangles cut a part of a thin ring off, and bending feels it.
TEST(ShapeError, CoversTheForceOnACoarseRing) {
  modeling::Project project = test::freeBox(5);
  project.body = modeling::makePrimitive({modeling::TorusShape{24, 5}});
  project.supports.push_back(
      {"base", Support::Kind::kFixed, Region::below(Vector3d::UnitX(), -20), Vector3d::Zero()});
  project.touches.push_back({"grab", {29, 0, 0}, modeling::TouchKind::kGrab, {0, 0, -2}, 5.0});
  const Grab fine = grab(project, Engine::kQuadratic, 3);
  for (const double edge : {4.5, 5.0}) {
    const Grab coarse = grab(project, Engine::kQuadratic, edge);
    const double error = (coarse.force - fine.force).norm() / fine.force.norm();
    EXPECT_GT(error, 0.003) << edge;
    EXPECT_GT(coarse.stated, error) << edge;
    EXPECT_LT(coarse.stated, 4 * error) << edge;
  }
}

/// An error of the displacement across the motion of a place is a larger one of the force where the
/// body hardly yields in that direction.
TEST(ContactError, KnowsTheDirectionsInWhichABodyYields) {
  modeling::Project project = test::clampedCylinder(12);
  project.mesh.engine = Engine::kQuadratic;
  project.touches.push_back({"grab", {20, 0, 40}, modeling::TouchKind::kGrab, {-2, 1, 0}, 6.0});
  const auto model = buildTouchModel(project, {}, {});
  TouchState state = playTouches(*model, project.touches);
  TouchState::Contact& contact = state.contacts[0];
  ASSERT_TRUE(contact.compliance);
  EXPECT_LT((*contact.compliance * contact.force - contact.deflection).norm(),
            1e-9 * contact.deflection.norm());
  const auto stated = [&](const std::optional<Eigen::Matrix3d>& compliance) {
    contact.compliance = compliance;
    return estimateErrors(*model, state).contacts[0];
  };
  const double bySize = stated({});
  contact.force = contact.displacement;
  EXPECT_NEAR(stated(Eigen::Matrix3d::Identity()), bySize, 1e-12);
  const Vector3d along = contact.displacement.normalized();
  const Eigen::Matrix3d ofAlong = along * along.transpose();
  constexpr double kStiffer = 100;
  const double stiffAcross = stated(ofAlong + (Eigen::Matrix3d::Identity() - ofAlong) / kStiffer);
  EXPECT_GT(stiffAcross, 3 * bySize);
  EXPECT_LT(stiffAcross, kStiffer * bySize);
}

}  // namespace
}  // namespace palpa::app
