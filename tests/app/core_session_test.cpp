#include "app/core/session/session.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "app/core/session/import_all.h"
#include "core_projects.h"
#include "modeling/error.h"
#include "modeling/project/project_file.h"
#include "tests/modeling/child_process.h"

namespace palpa::app {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using modeling::Command;

class SessionTest : public testing::Test {
 protected:
  SessionTest()
      : folder_(fs::temp_directory_path() / ("palpa_session_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~SessionTest() override { fs::remove_all(folder_); }

  Session::Options options() const {
    Session::Options result;
    result.autosaveFolder = folder_ / "autosave";
    return result;
  }

  std::size_t snapshots() const {
    if (!fs::exists(folder_ / "autosave")) return 0;
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_ / "autosave"), fs::directory_iterator()));
  }

  static Command move(double z) {
    return modeling::MovePoints{modeling::PointSelection::of({0}), modeling::MoveBy{{0, 0, z}}, {}};
  }

  fs::path folder_;
};

TEST_F(SessionTest, EveryEditOfTheBodyEndsInAModelOfIt) {
  Session session(test::clampedSphere(12), options());
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  const auto before = session.pipeline().model();
  session.perform(move(2.0));
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  const auto moved = session.pipeline().model();
  EXPECT_NE(moved->surface().positions, before->surface().positions);
  session.undo();
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  EXPECT_EQ(session.pipeline().model()->surface().positions, before->surface().positions);
  session.redo();
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  EXPECT_EQ(session.pipeline().model()->surface().positions, moved->surface().positions);
}

TEST_F(SessionTest, WhatDoesNotConcernTheModelStartsNoRebuild) {
  Session session(test::clampedSphere(12), options());
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  const auto revision = session.pipeline().status().revision;
  session.perform(modeling::RenameProject{"other"});
  session.perform(modeling::AddTouch{
      {"poke", {0, 0, 25}, modeling::TouchKind::kGrab, {0, 0, -1}, std::nullopt}});
  EXPECT_EQ(session.pipeline().status().revision, revision);
  session.perform(modeling::SetMaterial{{"stiff", 5.0, 0.3}});
  EXPECT_EQ(session.pipeline().status().revision, revision + 1);
}

TEST_F(SessionTest, ElementsOfSplinesFollowTouches) {
  Session session(test::clampedCylinder(8), options());
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  const auto count = [&] {
    return session.pipeline().model()->setup().discretisation->displacementCount();
  };
  const int before = count();
  session.perform(
      modeling::AddTouch{{"poke", {20, 0, 30}, modeling::TouchKind::kGrab, {-1, 0, 0}, 3.0}});
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  EXPECT_GT(count(), before);
  session.undo();
  ASSERT_TRUE(session.pipeline().waitUntilSettled(60s));
  EXPECT_EQ(count(), before);
}

TEST_F(SessionTest, ARefusedCommandChangesNothing) {
  Session session(test::clampedSphere(12), options());
  const std::string before = modeling::toJson(session.project());
  const auto revision = session.pipeline().status().revision;
  EXPECT_THROW(session.perform(modeling::RemoveSupport{"nobody"}), modeling::ModelingError);
  EXPECT_EQ(modeling::toJson(session.project()), before);
  EXPECT_EQ(session.pipeline().status().revision, revision);
  EXPECT_FALSE(session.isModified());
}

TEST_F(SessionTest, SavesReopensAndKnowsWhetherItIsModified) {
  const fs::path file = folder_ / "ball.json";
  Session session(test::clampedSphere(12), options());
  EXPECT_FALSE(session.file());
  EXPECT_THROW(session.save(), std::logic_error);
  session.perform(move(1.0));
  EXPECT_TRUE(session.isModified());
  session.saveAs(file);
  EXPECT_FALSE(session.isModified());
  session.perform(move(1.0));
  EXPECT_TRUE(session.isModified());
  session.undo();
  EXPECT_FALSE(session.isModified());
  const Session again(file, options());
  EXPECT_EQ(modeling::toJson(again.project()), modeling::toJson(session.project()));
  EXPECT_EQ(again.file(), file);
  EXPECT_THROW(session.saveAs(folder_ / "no" / "such" / "folder.json"), modeling::ModelingError);
  EXPECT_EQ(session.file(), file);
}

/// Clock that tests set.
struct FakeClock {
  std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now();
  Session::Options with(Session::Options options) {
    options.clock = [this] { return now; };
    return options;
  }
};

TEST_F(SessionTest, SnapshotsAreWrittenWhenDueAndForgottenWhenSaved) {
  FakeClock clock;
  const auto start = clock.now;
  Session session(test::clampedSphere(12), clock.with(options()));
  EXPECT_FALSE(session.autosaveIfDue(start + 1h));  // nothing to keep
  session.perform(move(1.0));
  EXPECT_FALSE(session.autosaveIfDue(start));
  EXPECT_FALSE(session.autosaveIfDue(start + 50s));
  EXPECT_TRUE(session.autosaveIfDue(start + 59s));
  EXPECT_EQ(snapshots(), 1u);
  EXPECT_FALSE(session.autosaveIfDue(start + 2h));  // nothing new
  session.saveAs(folder_ / "ball.json");
  EXPECT_EQ(snapshots(), 0u);
}

TEST_F(SessionTest, ASnapshotIsWrittenWithinTheIntervalWheneverItIsAskedFor) {
  FakeClock clock;
  const auto start = clock.now;
  Session session(test::clampedSphere(12), clock.with(options()));
  // Edits at any time between two calls, and further edits, do not delay it.
  for (int edit = 0; edit < 3; ++edit) {
    const auto edited = start + edit * 1000s + edit * 333ms;
    clock.now = edited;
    session.perform(move(1.0));
    clock.now = edited + 30s;
    session.perform(move(1.0));
    std::optional<std::chrono::steady_clock::time_point> written;
    for (auto call = start + edit * 1000s; !written && call < edited + 2min; call += 1s)
      if (session.autosaveIfDue(call)) written = call;
    ASSERT_TRUE(written);
    EXPECT_LT(*written, edited + 60s);
    EXPECT_GT(*written, edited + 45s);
  }
}

TEST_F(SessionTest, AnEditOfTheViewIsSavedAndKeptInSnapshots) {
  FakeClock clock;
  const auto start = clock.now;
  Session session(test::clampedSphere(12), clock.with(options()));
  session.setView(R"({"zoom":2})");
  EXPECT_FALSE(session.isModified());
  session.editView(R"({"zoom":2,"selections":[]})");
  EXPECT_TRUE(session.isModified());
  EXPECT_FALSE(session.document().canUndo());
  EXPECT_TRUE(session.autosaveIfDue(start + 60s));
  EXPECT_EQ(snapshots(), 1u);
  session.saveAs(folder_ / "ball.json");
  EXPECT_FALSE(session.isModified());
  EXPECT_EQ(Session(folder_ / "ball.json", options()).project().view,
            R"({"zoom":2,"selections":[]})");
}

TEST_F(SessionTest, AKilledProcessLeavesTheEditsOfTheLastInterval) {
  using namespace testing_support;
  Reports reports;
  Session::Options often = options();
  often.autosaveEvery = 1s;
  const pid_t child = startChild([&] {
    Session session(test::clampedSphere(12), often);
    session.perform(move(3.0));
    while (!session.autosaveIfDue(std::chrono::steady_clock::now())) ::usleep(1000);
    reports.report(1);
    ::pause();
  });
  reports.stopWriting();
  ASSERT_TRUE(reports.next()) << "no snapshot was written";
  killChild(child);
  const auto left = modeling::findRecoverable(folder_ / "autosave");
  ASSERT_EQ(left.snapshots.size(), 1u);
  const modeling::Project edited = modeling::apply(move(3.0), test::clampedSphere(12)).project;
  EXPECT_EQ(std::get<modeling::Solid>(modeling::recover(left.snapshots[0]).body).controlPoints(),
            std::get<modeling::Solid>(edited.body).controlPoints());
}

TEST_F(SessionTest, AnEditThatWasUndoneNeedsNoSnapshot) {
  FakeClock clock;
  const auto start = clock.now;
  Session session(test::clampedSphere(12), clock.with(options()));
  session.perform(move(1.0));
  ASSERT_TRUE(session.autosaveIfDue(start + 60s));
  session.undo();
  EXPECT_FALSE(session.autosaveIfDue(start + 2h));
  EXPECT_EQ(snapshots(), 0u);
}

TEST(ImportAll, LongNamesAreCutBetweenCharacters) {
  modeling::FileBodies found;
  found.bodies.resize(2);
  found.bodies[0].name = "x";
  for (int k = 0; k < 60; ++k) found.bodies[0].name += "é";  // two bytes each
  found.bodies[1].name = std::string(120, 'a');
  const auto files = projectFiles(found, "parts");
  EXPECT_EQ(files[0], "parts/" + found.bodies[0].name.substr(0, 99) + ".json");
  EXPECT_EQ(files[1], "parts/" + std::string(100, 'a') + ".json");
}

}  // namespace
}  // namespace palpa::app
