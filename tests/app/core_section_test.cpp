// Fields on a plane through a touched body.
#include <gtest/gtest.h>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/body_section.h"
#include "app/core/results/point_sample.h"
#include "app/core/results/section_file.h"
#include "app/core/results/touch.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using Eigen::Vector3d;

/// A cylinder whose top is pulled aside.
struct Bent {
  std::shared_ptr<const TouchModel> model;
  TouchState state;
  std::shared_ptr<const DrawnBody> drawn;

  explicit Bent(bool withSplines) {
    modeling::Project project = test::clampedCylinder(5);
    project.mesh.engine = withSplines ? modeling::Engine::kSplines : modeling::Engine::kTriangles;
    const modeling::Touch touch{"pull", {0, 0, 60}, modeling::TouchKind::kGrab, {1, 0, 0.5}, 12.0};
    project.touches = {touch};
    model = buildTouchModel(project, BuildOptions{}, Job{});
    state = playTouches(*model, std::vector{touch});
    drawn = std::make_shared<const DrawnBody>(model);
  }
};

/// Force of the removed part on the rest: the integral of the traction over the section.
Vector3d forceOn(const BodySection& section, const std::vector<bem::InteriorState>& states) {
  Vector3d sum = Vector3d::Zero();
  const modeling::PlaneSection& mesh = section.mesh();
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return static_cast<std::size_t>(t[k]); };
    const double area = (mesh.positions[at(1)] - mesh.positions[at(0)])
                            .cross(mesh.positions[at(2)] - mesh.positions[at(0)])
                            .norm() /
                        2;
    for (std::size_t k = 0; k < 3; ++k)
      sum += area / 3 * states[at(k)].stress * section.plane().normal;
  }
  return sum;
}

TEST(SectionField, CarriesTheForceOfTheTouchThroughEverySection) {
  for (const bool withSplines : {true, false}) {
    const Bent bent(withSplines);
    const Vector3d force = bent.state.contacts.front().force;
    for (const double height : {8.0, 30.0, 45.0}) {
      const auto section = std::make_shared<const BodySection>(
          bent.drawn, modeling::Plane{Vector3d::UnitZ(), height});
      const SectionField field(section);
      const auto states = field.states(bent.state.field, {});
      ASSERT_EQ(states.size(), section->mesh().positions.size());
      const Vector3d found = forceOn(*section, states);
      std::printf("splines %d, z = %g: force %.4f %.4f %.4f, section %.4f %.4f %.4f N\n",
                  withSplines, height, force.x(), force.y(), force.z(), found.x(), found.y(),
                  found.z());
      EXPECT_LE((found - force).norm(), (withSplines ? 0.02 : 0.05) * force.norm());
      // Seen from the other side the force is the opposite one.
      const auto other = std::make_shared<const BodySection>(
          bent.drawn, modeling::Plane{-Vector3d::UnitZ(), -height});
      const auto mirrored = SectionField(other).states(bent.state.field, {});
      EXPECT_LE((forceOn(*other, mirrored) + found).norm(), 0.02 * force.norm());
    }
  }
}

TEST(SectionField, JoinsTheSurfaceSteadily) {
  const Bent bent(true);
  const auto section = std::make_shared<const BodySection>(
      bent.drawn, modeling::Plane{Vector3d(1, 0.3, 0.2).normalized(), 2});
  const auto states = SectionField(section).states(bent.state.field, {});
  double largest = 0, jump = 0;
  for (const auto& state : states) largest = std::max(largest, state.displacement.norm());
  // Along an edge from the outline inwards nothing changes by more than the edge's length explains.
  const auto& mesh = section->mesh();
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      jump = std::max(jump, (states[a].displacement - states[b].displacement).norm() -
                                0.15 * (mesh.positions[a] - mesh.positions[b]).norm());
    }
  EXPECT_LE(jump, 0.01 * largest);
}

TEST(SectionField, IsEmptyBesideTheBody) {
  const Bent bent(true);
  for (const double height : {60.0, 61.0, 1e5, -1.0}) {
    const auto section =
        std::make_shared<const BodySection>(bent.drawn, modeling::Plane{Vector3d::UnitZ(), height});
    EXPECT_TRUE(section->isEmpty()) << height;
    EXPECT_TRUE(SectionField(section).states(bent.state.field, {}).empty());
  }
}

TEST(SectionField, IsWrittenAsATableWithEveryPoint) {
  const Bent bent(true);
  const auto section =
      std::make_shared<const BodySection>(bent.drawn, modeling::Plane{Vector3d::UnitX(), 0});
  const auto states = SectionField(section).states(bent.state.field, {});
  const std::string table = sectionTable(*section, states);
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')),
            states.size() + 1);
  const std::string header = table.substr(0, table.find('\n'));
  const std::string line =
      table.substr(header.size() + 1, table.find('\n', header.size() + 1) - header.size() - 1);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','),
            std::count(line.begin(), line.end(), ','));
  EXPECT_EQ(sectionMesh(*section, states).pointData.size(), 6U);
}

TEST(PointSample, OfTheSurfaceAgreesWithTheTraction) {
  const Bent bent(true);
  const BoundarySetup& setup = bent.model->setup();
  const Eigen::VectorXd u = bent.state.field.u.col(0), p = bent.state.field.p.col(0);
  const auto stress = setup.discretisation->surfaceStress(u, p, setup.material);
  for (int t = 0; t < setup.mesh().triangleCount(); t += 97) {
    bem::SurfacePoint place{t, Vector3d(0.3, 0.3, 0.4), Vector3d::Zero(), 0};
    place.position = setup.mesh().point(t, place.weights);
    const PointSample sample = sampleSurface(*bent.model, bent.state.field, stress, place);
    const Vector3d fromStress = sample.stress * setup.mesh().normal(t);
    double scale = 1e-4;
    for (const auto& s : stress) scale = std::max(scale, s.norm());
    EXPECT_LE((fromStress - *sample.traction).norm(), 0.25 * scale) << "linear between nodes";
    EXPECT_NEAR(sample.numbers.principal.sum(), 3 * sample.numbers.mean, 1e-9 * scale);
    EXPECT_GE(sample.numbers.principal[0], sample.numbers.principal[2]);
    for (int k = 0; k < 3; ++k)
      EXPECT_LE((sample.stress * sample.numbers.directions.col(k) -
                 sample.numbers.principal[k] * sample.numbers.directions.col(k))
                    .norm(),
                1e-9 * scale + 1e-9 * sample.stress.norm());
  }
}

}  // namespace
}  // namespace palpa::app
