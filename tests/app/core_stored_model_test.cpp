#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <span>

#include "app/core/live/touchable_model.h"
#include "app/core/model/model_cache.h"
#include "app/core/model/stored_model.h"
#include "app/core/results/touch.h"
#include "app/core/session/session.h"
#include "bem/compressed/compressed_reference_problem.h"
#include "bem/compressed/make_problem.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "core_projects.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

modeling::Project quadraticSphere(double edgeLength = 6) {
  modeling::Project project = test::clampedSphere(edgeLength);
  project.mesh.engine = modeling::Engine::kQuadratic;
  return project;
}

BuildOptions compressed() {
  BuildOptions options;
  options.precision = bem::Precision::kCompressed;
  return options;
}

modeling::Touch grab() {
  modeling::Touch touch;
  touch.name = "touch";
  touch.at = {0, 0, 25};
  touch.vector = {0, 0, -2};
  return touch;
}

class StoredModelTest : public testing::Test {
 protected:
  StoredModelTest()
      : folder_(fs::temp_directory_path() / ("palpa_stored_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~StoredModelTest() override { fs::remove_all(folder_); }

  fs::path file() const { return folder_ / "sphere.model"; }

  /// Computes a model and stores it as palpa-mpi does.
  std::shared_ptr<const TouchModel> store(const modeling::Project& project,
                                          const bem::ReferenceProblem* other = nullptr) {
    BuildOptions options = compressed();
    options.makeProblem = [&](const auto& on, const auto& with, const auto&... rest) {
      inputs_ = with;
      return bem::makeReferenceProblem(on, with, rest...);
    };
    auto model = buildTouchModel(project, options, {});
    writeStoredModel(file(), *model->setup().discretisation, inputs_,
                     other ? *other : *model->problem(), {});
    return model;
  }

  std::shared_ptr<const TouchModel> read(const modeling::Project& project, bool isNeeded) const {
    BuildOptions options;
    options.storedModel = file();
    options.needsStoredModel = isNeeded;
    return buildTouchModel(project, options, {});
  }

  static bool isRead(const TouchModel& model) { return model.report().assembleSeconds == 0; }

  fs::path folder_;
  bem::ProblemInputs inputs_;  ///< of the stored model
};

TEST_F(StoredModelTest, GivesTheSameForcesBitByBit) {
  const auto built = store(quadraticSphere());
  const auto stored = read(quadraticSphere(), true);
  EXPECT_TRUE(isRead(*stored));
  EXPECT_EQ(stored->report().storage, "compressed");
  const modeling::Touch touch = grab();
  const TouchState a = playTouches(*built, {&touch, 1}), b = playTouches(*stored, {&touch, 1});
  EXPECT_GT(a.contacts.at(0).force.norm(), 0.01);
  EXPECT_EQ(a.contacts.at(0).force, b.contacts.at(0).force);
  EXPECT_EQ(a.field.u, b.field.u);
}

TEST_F(StoredModelTest, ServesMeshesThatDifferByRounding) {
  const auto model = store(quadraticSphere());
  const BoundarySetup& setup = model->setup();
  std::vector<int> supportTags;
  for (const auto& support : setup.supports)
    for (const int t : support.triangles) supportTags.push_back(setup.mesh().tags[t]);
  const auto fitOf = [&](double change) {
    bem::BoundaryMesh mesh = setup.mesh();
    for (auto& node : mesh.nodes) node *= 1 + change;
    const bem::QuadraticDiscretisation on(std::move(mesh), supportTags);
    return readStoredModel(file(), on, inputs_, {}).fit;
  };
  EXPECT_EQ(fitOf(1e-14), StoredModelFit::kFits);
  EXPECT_EQ(fitOf(1e-8), StoredModelFit::kOther);
}

TEST_F(StoredModelTest, IsNotTakenForAnotherProject) {
  store(quadraticSphere());
  const auto refuses = [&](const std::function<void(modeling::Project&)>& change) {
    modeling::Project project = quadraticSphere();
    change(project);
    EXPECT_THROW(read(project, true), modeling::ModelingError);
    const auto computed = read(project, false);
    EXPECT_FALSE(isRead(*computed));
    EXPECT_EQ(computed->report().notice, "");
  };
  refuses([](modeling::Project& p) { p.mesh.edgeLength = 7; });
  refuses([](modeling::Project& p) { p.material.poissonRatio = 0.44; });
  refuses([](modeling::Project& p) {
    p.supports[0].where = modeling::Region::below(Eigen::Vector3d::UnitZ(), -15);
  });
  refuses([](modeling::Project& p) {
    auto& solid = std::get<modeling::Solid>(p.body);
    auto points = solid.controlPoints();
    points.front().x() += 1e-6;
    p.body = solid.withControlPoints(std::move(points));
  });
  refuses([](modeling::Project& p) { p.mesh.engine = modeling::Engine::kTriangles; });
}

TEST_F(StoredModelTest, IsReportedWhenDamaged) {
  store(quadraticSphere());
  const auto size = fs::file_size(file());
  const auto expectDamaged = [&] {
    EXPECT_THROW(read(quadraticSphere(), true), modeling::ModelingError);
    const auto computed = read(quadraticSphere(), false);
    EXPECT_FALSE(isRead(*computed));
    EXPECT_NE(computed->report().notice, "");
    EXPECT_TRUE(fs::exists(file())) << "it is the user's";
  };
  {
    std::fstream bytes(file(), std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(size / 2));
    const int old = bytes.peek();
    bytes.seekp(static_cast<std::streamoff>(size / 2));
    bytes.put(static_cast<char>(old ^ 4));
  }
  expectDamaged();
  fs::resize_file(file(), size - 1);
  expectDamaged();
  fs::remove(file());
  EXPECT_THROW(read(quadraticSphere(), true), modeling::ModelingError);
  EXPECT_EQ(read(quadraticSphere(), false)->report().notice, "");
}

TEST_F(StoredModelTest, IsTakenBesideAProject) {
  store(quadraticSphere());
  const fs::path project = folder_ / "sphere.json";
  EXPECT_EQ(storedModelBeside(project), file());
  modeling::writeProject(quadraticSphere(), project);
  Session session(project, {});
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  EXPECT_TRUE(isRead(*session.pipeline().model()));
  session.perform(
      modeling::MovePoints{modeling::PointSelection::of({0}), modeling::MoveBy{{0, 0, 1}}, {}});
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  EXPECT_FALSE(isRead(*session.pipeline().model()));
  session.undo();
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  EXPECT_TRUE(isRead(*session.pipeline().model()));
}

TEST_F(StoredModelTest, BringsItsColumns) {
  bem::KnownColumns known;
  {
    std::unique_ptr<bem::CompressedReferenceProblem> problem;
    const auto model = store(quadraticSphere());
    bem::GreensColumns columns(model->problem());
    const std::vector<int> near =
        columns.nodesNear(model->setup().discretisation->places(), {0, 0, 25});
    const std::span<const int> some(near.data(), 10);
    columns.compute(some, {});
    known = columns.copyOf(some);
    // The same problem with them.
    std::vector<std::byte> bytes;
    model->problem()->write([&](std::span<const std::byte> more) {
      bytes.insert(bytes.end(), more.begin(), more.end());
    });
    std::size_t at = 0;
    problem = std::make_unique<bem::CompressedReferenceProblem>(
        model->problem()->dofs(), [&](std::span<std::byte> to) {
          std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), to.size(), to.begin());
          at += to.size();
        });
    problem->setKnownColumns(known);
    store(quadraticSphere(), problem.get());
  }
  const TouchableModel body(read(quadraticSphere(), true));
  const bem::GreensColumns& columns = *body.columns();
  ASSERT_EQ(known.nodes.size(), 10u);
  EXPECT_EQ(columns.readyCount(), 10);
  for (std::size_t k = 0; k < known.nodes.size(); ++k) {
    ASSERT_TRUE(columns.has(known.nodes[k]));
    EXPECT_EQ(columns.column(known.nodes[k], 1)[7], known.values(7, 3 * static_cast<int>(k) + 1));
  }
}

TEST_F(StoredModelTest, TheCacheKeepsCompressedModels) {
  const auto cache = std::make_shared<ModelCache>(folder_ / "cache", 1e9);
  BuildOptions options = compressed();
  options.cache = cache;
  const auto built = buildTouchModel(quadraticSphere(), options, {});
  ASSERT_TRUE(built->problem()->canBeWritten());
  EXPECT_TRUE(cache->write(built->key(), *built->problem(), {}));
  EXPECT_GT(cache->size(), 0);
  const auto again = buildTouchModel(quadraticSphere(), options, {});
  EXPECT_TRUE(isRead(*again));
  EXPECT_EQ(again->rest().energy, built->rest().energy);
  options.precision = bem::Precision::kAutomatic;
  EXPECT_FALSE(isRead(*buildTouchModel(quadraticSphere(), options, {}))) << "it would be dense";
}

}  // namespace
}  // namespace palpa::app
