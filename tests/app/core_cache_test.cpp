#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "app/core/model/model_cache.h"
#include "app/core/results/touch.h"
#include "app/core/session/session.h"
#include "core_projects.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr double kMiB = 1024.0 * 1024.0;

/// Gives root's rights up as long as it lives.
class AsUser {
 public:
  explicit AsUser(uid_t user) : before_(::geteuid()) { EXPECT_EQ(::seteuid(user), 0); }
  ~AsUser() { EXPECT_EQ(::seteuid(before_), 0); }
  AsUser(const AsUser&) = delete;
  AsUser& operator=(const AsUser&) = delete;

 private:
  uid_t before_;
};

class ModelCacheTest : public testing::Test {
 protected:
  ModelCacheTest()
      : folder_(fs::temp_directory_path() / ("palpa_cache_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
  }
  ~ModelCacheTest() override {
    std::error_code error;
    fs::permissions(folder_, fs::perms::owner_all, error);
    fs::remove_all(folder_, error);
  }

  std::shared_ptr<ModelCache> cache(double limit = 1000 * kMiB) const {
    return std::make_shared<ModelCache>(folder_, limit);
  }
  static std::shared_ptr<const TouchModel> build(const std::shared_ptr<ModelCache>& from,
                                                 const modeling::Project& project = sphere(),
                                                 BuildOptions options = {}) {
    options.cache = from;
    return buildTouchModel(project, options, {});
  }
  static modeling::Project sphere() { return test::clampedSphere(12); }
  static bool isRead(const TouchModel& model) { return model.report().readSeconds > 0; }

  /// The files, without the temporary ones that others may be writing.
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    if (fs::exists(folder_))
      for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
    return found;
  }

  /// Stores a sphere, damages the file by `spoil`, and expects a full rebuild.
  void expectIgnored(const std::function<void(const fs::path&)>& spoil) {
    const auto stored = cache();
    const auto built = build(nullptr);
    stored->write(built->key(), *built->problem(), {});
    ASSERT_EQ(files().size(), 1u);
    spoil(files().front());
    const auto again = build(stored);
    EXPECT_FALSE(isRead(*again));
    EXPECT_NE(again->report().notice, "");
    EXPECT_EQ(again->rest().energy, built->rest().energy);
    EXPECT_TRUE(files().empty()) << "a damaged file must go";
    EXPECT_EQ(build(stored)->report().notice, "") << "it is said once";
  }

  static void flipByte(const fs::path& path, std::uintmax_t at) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char byte = static_cast<char>(file.get() ^ 0x10);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(byte);
  }

  fs::path folder_;
};

TEST_F(ModelCacheTest, AStoredModelGivesTheSameForcesBitByBit) {
  const auto stored = cache();
  for (const auto precision :
       {bem::Precision::kDouble, bem::Precision::kMixed, bem::Precision::kSingle}) {
    BuildOptions options;
    options.precision = precision;
    const auto built = build(stored, sphere(), options);
    EXPECT_FALSE(isRead(*built));
    EXPECT_TRUE(stored->write(built->key(), *built->problem(), {}));
    const auto read = build(stored, sphere(), options);
    EXPECT_TRUE(isRead(*read));
    EXPECT_EQ(read->report().assembleSeconds, 0.0);
    modeling::Touch touch;
    touch.name = "touch";
    touch.at = {0, 0, 25};
    touch.kind = modeling::TouchKind::kGrab;
    touch.vector = {0, 0, -2};
    const TouchState a = playTouches(*built, {&touch, 1});
    const TouchState b = playTouches(*read, {&touch, 1});
    EXPECT_EQ(a.contacts.at(0).force, b.contacts.at(0).force);
    EXPECT_GT(a.contacts.at(0).force.norm(), 0.01);
    EXPECT_EQ(a.field.u, b.field.u);
    EXPECT_EQ(a.field.p, b.field.p);
    EXPECT_EQ(built->problem()->conditionEstimate(), read->problem()->conditionEstimate());
  }
  EXPECT_EQ(files().size(), 3u);
}

TEST_F(ModelCacheTest, EverythingThatTheSolutionDependsOnIsInTheKey) {
  const auto base = build(nullptr);
  const auto keyAfter = [](const std::function<void(modeling::Project&, BuildOptions&)>& change) {
    modeling::Project project = sphere();
    BuildOptions options;
    change(project, options);
    return build(nullptr, project, options)->key();
  };
  using modeling::Project;
  EXPECT_EQ(keyAfter([](Project&, BuildOptions&) {}), base->key());
  EXPECT_NE(keyAfter([](Project& p, BuildOptions&) { p.material.youngsModulus *= 1.0 + 1e-15; }),
            base->key());
  EXPECT_NE(keyAfter([](Project& p, BuildOptions&) { p.material.poissonRatio = 0.44; }),
            base->key());
  EXPECT_NE(keyAfter([](Project& p, BuildOptions&) { p.mesh.edgeLength = 11; }), base->key());
  EXPECT_NE(keyAfter([](Project&, BuildOptions& o) { o.assembly = bem::AssemblyOptions{1e-6}; }),
            base->key());
  EXPECT_NE(keyAfter([](Project&, BuildOptions& o) { o.precision = bem::Precision::kSingle; }),
            base->key());
  EXPECT_NE(keyAfter([](Project& p, BuildOptions&) {
              p.supports[0].where = modeling::Region::below(Eigen::Vector3d::UnitZ(), -15);
            }),
            base->key());
  EXPECT_NE(keyAfter([](Project& p, BuildOptions&) {
              auto& solid = std::get<modeling::Solid>(p.body);
              auto points = solid.controlPoints();
              points.front().x() += 1e-9;
              p.body = solid.withControlPoints(std::move(points));
            }),
            base->key());
  // Loads and names change only the right-hand side.
  EXPECT_EQ(keyAfter([](Project& p, BuildOptions&) { p.name = "other"; }), base->key());
}

TEST_F(ModelCacheTest, TruncatedFilesAreIgnored) {
  expectIgnored([](const fs::path& file) { fs::resize_file(file, fs::file_size(file) - 1); });
  expectIgnored([](const fs::path& file) { fs::resize_file(file, 20); });
  expectIgnored([](const fs::path& file) { fs::resize_file(file, 0); });
}

TEST_F(ModelCacheTest, FlippedBitsAreFound) {
  // Magic, format, key, size, checksum; the first number, one in the middle, the last byte.
  for (const std::uintmax_t at : {0u, 8u, 20u, 33u, 41u, 48u})
    expectIgnored([at](const fs::path& file) { flipByte(file, at); });
  expectIgnored([](const fs::path& file) { flipByte(file, fs::file_size(file) / 2); });
  expectIgnored([](const fs::path& file) { flipByte(file, fs::file_size(file) - 1); });
}

TEST_F(ModelCacheTest, ForeignFilesAreIgnored) {
  expectIgnored([](const fs::path& file) { std::ofstream(file) << "{\"palpa\": 2}\n"; });
  expectIgnored([](const fs::path& file) {
    // Of another model, under this one's name.
    const auto other = build(nullptr, test::clampedSphere(10));
    ModelCache(file.parent_path(), 1000 * kMiB).write(other->key(), *other->problem(), {});
    for (const auto& entry : fs::directory_iterator(file.parent_path()))
      if (entry.path() != file) fs::rename(entry.path(), file);
  });
}

TEST_F(ModelCacheTest, WhatWasUsedLongestAgoGoesFirst) {
  std::vector<std::shared_ptr<const TouchModel>> models;
  for (const double poisson : {0.41, 0.42, 0.43})
    models.push_back(build(nullptr, test::clampedSphere(12, poisson)));
  const double one = 1.1 * static_cast<double>(models[0]->problem()->bytes()) + 65536;
  const auto stored = cache(2 * one);
  const auto write = [&](std::size_t i) {
    std::this_thread::sleep_for(20ms);  // the clock of the file system is coarse
    stored->write(models[i]->key(), *models[i]->problem(), {});
  };
  write(0);
  write(1);
  std::this_thread::sleep_for(20ms);
  EXPECT_TRUE(isRead(*build(stored, test::clampedSphere(12, 0.41))));  // used again
  write(2);
  EXPECT_LE(stored->size(), stored->limit());
  EXPECT_TRUE(isRead(*build(stored, test::clampedSphere(12, 0.41))));
  EXPECT_FALSE(isRead(*build(stored, test::clampedSphere(12, 0.42))));
  EXPECT_TRUE(isRead(*build(stored, test::clampedSphere(12, 0.43))));
  stored->setLimit(one);
  EXPECT_EQ(files().size(), 1u);
  stored->clear();
  EXPECT_EQ(stored->size(), 0.0);
  EXPECT_TRUE(files().empty());
  // Larger than the limit: not stored at all.
  stored->setLimit(1000);
  stored->write(models[0]->key(), *models[0]->problem(), {});
  EXPECT_TRUE(files().empty());
}

TEST_F(ModelCacheTest, AFolderThatCannotBeUsedOnlyDisablesIt) {
  std::ofstream(folder_) << "a file where the folder should be";
  const auto stored = cache();
  const auto built = build(stored);
  EXPECT_FALSE(stored->write(built->key(), *built->problem(), {}));
  EXPECT_NE(stored->trouble(), "");
  EXPECT_FALSE(isRead(*build(stored)));
  EXPECT_EQ(stored->size(), 0.0);
  fs::remove(folder_);
  EXPECT_TRUE(stored->write(built->key(), *built->problem(), {}));
  EXPECT_EQ(stored->trouble(), "");
}

TEST_F(ModelCacheTest, AFolderThatMayOnlyBeReadIsRead) {
  const auto stored = cache();
  const auto built = build(nullptr);
  ASSERT_TRUE(stored->write(built->key(), *built->problem(), {}));
  const auto other = build(nullptr, test::clampedSphere(10));
  const bool isRoot = ::geteuid() == 0;  // who may write anywhere
  constexpr uid_t kNobody = 65534;
  if (isRoot) {
    ASSERT_EQ(::chown(files().front().c_str(), kNobody, kNobody), 0);
    ASSERT_EQ(::chown(folder_.c_str(), kNobody, kNobody), 0);
  }
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  const AsUser nobody(isRoot ? kNobody : ::geteuid());
  EXPECT_TRUE(isRead(*build(stored)));
  EXPECT_FALSE(stored->write(other->key(), *other->problem(), {}));
  EXPECT_NE(stored->trouble().find(folder_.string()), std::string::npos) << stored->trouble();
  EXPECT_FALSE(isRead(*build(stored, test::clampedSphere(10))));
  stored->clear();  // cannot, and does not throw
  EXPECT_EQ(files().size(), 1u);
  flipByte(files().front(), 100);
  const std::string notice = build(stored)->report().notice;
  EXPECT_NE(notice.find("cannot be deleted"), std::string::npos) << notice;
}

TEST_F(ModelCacheTest, WritingThatFailsHalfwayLeavesNothing) {
  const auto stored = cache();
  const auto built = build(nullptr);
  // A limit on the size of files stands for a disk that becomes full meanwhile.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit half{static_cast<rlim_t>(built->problem()->bytes() / 2), before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &half), 0);
  const bool isWritten = stored->write(built->key(), *built->problem(), {});
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(isWritten);
  EXPECT_NE(stored->trouble(), "");
  EXPECT_TRUE(files().empty());
  EXPECT_TRUE(stored->write(built->key(), *built->problem(), {}));
  EXPECT_EQ(stored->trouble(), "");
}

TEST_F(ModelCacheTest, AlmostFullDisksAreLeftAlone) {
  fs::create_directories(folder_);
  if (::mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=64m") != 0)
    GTEST_SKIP() << "only root may mount a small disk";
  const auto stored = cache();
  const auto built = build(stored);
  EXPECT_TRUE(stored->write(built->key(), *built->problem(), {}));
  EXPECT_TRUE(files().empty());
  EXPECT_FALSE(isRead(*build(stored)));
  EXPECT_EQ(::umount(folder_.c_str()), 0);
}

TEST_F(ModelCacheTest, StoppedWritingLeavesNothing) {
  const auto stored = cache();
  const auto built = build(nullptr);
  std::stop_source source;
  source.request_stop();
  Job job;
  job.stop = source.get_token();
  EXPECT_THROW(stored->write(built->key(), *built->problem(), job), Cancelled);
  EXPECT_TRUE(files().empty());
}

TEST_F(ModelCacheTest, ManyMayUseItAtOnce) {
  std::vector<std::shared_ptr<const TouchModel>> models;
  const std::vector<double> edges{12.0, 11.5};
  for (const double edge : edges) models.push_back(build(nullptr, test::clampedSphere(edge)));
  const double one = 1.3 * static_cast<double>(models[0]->problem()->bytes());
  std::vector<std::jthread> threads;
  std::atomic<int> damaged{0};
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      // One object per thread, as in several processes; room for one model only.
      const auto mine = cache(one);
      for (int i = 0; i < 10; ++i) {
        const std::size_t which = static_cast<std::size_t>(i + k) % 2;
        mine->write(models[which]->key(), *models[which]->problem(), {});
        const auto model = build(mine, test::clampedSphere(edges[which]));
        damaged += model->report().notice.empty() ? 0 : 1;
        if (i % 5 == 4) mine->clear();
      }
    });
  threads.clear();
  EXPECT_EQ(damaged, 0);
}

TEST_F(ModelCacheTest, ASessionStoresWhatItOpensAndSaves) {
  Session::Options options;
  options.cacheFolder = folder_;
  options.cacheLimit = 1000 * kMiB;
  const fs::path file = folder_.string() + ".json";
  {
    Session session(sphere(), options);
    ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
    EXPECT_TRUE(files().empty()) << "it has no file yet";
    session.saveAs(file);
    ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
    EXPECT_EQ(files().size(), 1u);
    session.perform(
        modeling::MovePoints{modeling::PointSelection::of({0}), modeling::MoveBy{{0, 0, 1}}, {}});
    ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
    EXPECT_EQ(files().size(), 1u) << "what is not saved is not stored";
  }
  {
    Session session(file, options);
    ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
    EXPECT_TRUE(isRead(*session.pipeline().model()));
    session.cache()->clear();
  }
  {
    Session session(file, options);
    ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
    EXPECT_FALSE(isRead(*session.pipeline().model()));
    EXPECT_EQ(files().size(), 1u) << "opened and stored again";
  }
  fs::remove(file);
}

}  // namespace
}  // namespace palpa::app
