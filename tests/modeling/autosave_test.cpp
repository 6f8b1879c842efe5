#include "modeling/project/autosave.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "modeling/error.h"
#include "modeling/project/process_id.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/child_process.h"

namespace palpa::modeling {
namespace {

namespace fs = std::filesystem;
using testing_support::resultOf;
using testing_support::startChild;
using testing_support::TemporaryFolder;

Project named(const std::string& name) {
  Project project;
  project.name = name;
  project.material = {"rubber", 1.5, 0.45};
  project.body = makeBox({40, 30, 20});
  return project;
}

std::string contentOf(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Starts a child that writes one snapshot, and kills it.
void crashAfterAutosave(const fs::path& folder, const fs::path& original, const std::string& name,
                        std::uint64_t revision) {
  const pid_t child = startChild([&] {
    Autosave(folder).write(named(name), original, revision);
    ::raise(SIGKILL);
  });
  EXPECT_EQ(resultOf(child), -1) << "the snapshot was not written";
}

TEST(Autosave, RecoversTheProjectOfAKilledProcess) {
  const TemporaryFolder folder;
  const fs::path states = folder / "state/palpa";
  const auto before = std::chrono::system_clock::now();
  crashAfterAutosave(states, "/some where/böx %41.json", "my box", 17);
  const RecoveryList list = findRecoverable(states);
  EXPECT_TRUE(list.problems.empty() && list.outdated.empty());
  ASSERT_EQ(list.snapshots.size(), 1U);
  const Snapshot& snapshot = list.snapshots.front();
  EXPECT_EQ(snapshot.original, "/some where/böx %41.json");
  EXPECT_EQ(snapshot.projectName, "my box");
  EXPECT_EQ(snapshot.revision, 17U);
  EXPECT_GE(snapshot.time, before - std::chrono::milliseconds(1));
  EXPECT_LE(snapshot.time, std::chrono::system_clock::now());
  EXPECT_EQ(toJson(recover(snapshot)), toJson(named("my box")));

  struct stat state {};
  ASSERT_EQ(::stat(states.c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 0777, 0700U);
  ASSERT_EQ(::stat(snapshot.file.c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 0777, 0600U);

  discard(snapshot);
  discard(snapshot);
  EXPECT_TRUE(findRecoverable(states).snapshots.empty());
  EXPECT_THROW(recover(snapshot), ModelingError);
}

TEST(Autosave, IgnoresRunningAndCleanlyClosedPrograms) {
  const TemporaryFolder folder;
  Autosave autosave(folder.path());
  autosave.write(named("a"), "", 1);
  EXPECT_EQ(folder.size(), 1);
  EXPECT_TRUE(findRecoverable(folder.path()).snapshots.empty());
  autosave.write(named("b"), "", 2);
  EXPECT_EQ(folder.size(), 1);
  autosave.remove();
  autosave.remove();
  EXPECT_EQ(folder.size(), 0);
  EXPECT_TRUE(findRecoverable(folder / "none").snapshots.empty());
}

TEST(Autosave, FollowsTheProjectToItsNewName) {
  const TemporaryFolder folder;
  Autosave autosave(folder.path());
  autosave.write(named("a"), "", 1);
  autosave.write(named("a"), "/saved.json", 2);
  EXPECT_EQ(folder.size(), 1);
  autosave.remove();
  EXPECT_EQ(folder.size(), 0);
}

TEST(Autosave, AKillDuringWritingLosesNothing) {
  const TemporaryFolder folder;
  for (int round = 0; round < 20; ++round) {
    const auto completed = testing_support::killAmongReports(
        1 + round % 3, 371 * round, [&](testing_support::Reports& reports) {
          Autosave autosave(folder.path());
          for (std::uint64_t revision = 1;; ++revision) {
            autosave.write(named("revision " + std::to_string(revision)), "/a.json", revision);
            reports.report(revision);
          }
        });
    const RecoveryList list = findRecoverable(folder.path());
    EXPECT_TRUE(list.problems.empty());
    ASSERT_EQ(list.snapshots.size(), 1U);
    const Snapshot& snapshot = list.snapshots.front();
    EXPECT_TRUE(snapshot.revision == completed || snapshot.revision == completed + 1);
    EXPECT_EQ(recover(snapshot).name, "revision " + std::to_string(snapshot.revision));
    discard(snapshot);
  }
}

TEST(Autosave, KeepsProcessesAndProjectsApart) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i)
    crashAfterAutosave(folder.path(), "/same.json", std::to_string(i), 10 + i);
  Autosave one(folder.path());
  Autosave two(folder.path());
  one.write(named("one"), "", 1);
  two.write(named("two"), "", 1);
  EXPECT_EQ(folder.size(), 5);
  const RecoveryList list = findRecoverable(folder.path());
  ASSERT_EQ(list.snapshots.size(), 3U);
  EXPECT_EQ(list.snapshots.front().projectName, "2");  // the latest first
  EXPECT_EQ(list.snapshots.back().projectName, "0");
}

TEST(Autosave, KnowsLaterSaves) {
  const TemporaryFolder folder;
  const fs::path original = folder / "box.json";
  const fs::path states = folder / "state";
  writeProject(named("old"), original);
  fs::last_write_time(original, fs::file_time_type::clock::now() - std::chrono::seconds(5));
  crashAfterAutosave(states, original, "edited", 3);
  EXPECT_EQ(findRecoverable(states).snapshots.size(), 1U);
  fs::last_write_time(original, fs::file_time_type::clock::now() + std::chrono::seconds(5));
  const RecoveryList list = findRecoverable(states);
  EXPECT_TRUE(list.snapshots.empty());
  ASSERT_EQ(list.outdated.size(), 1U);
  EXPECT_EQ(list.outdated.front().projectName, "edited");
}

TEST(Autosave, SkipsAndReportsBrokenSnapshots) {
  const TemporaryFolder folder;
  crashAfterAutosave(folder.path(), "/good.json", "good", 1);
  const std::string good = contentOf(findRecoverable(folder.path()).snapshots.front().file);
  const auto put = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / (name + ".palpa-autosave"), std::ios::binary) << text;
  };
  const auto changed = [&](const std::string& from, const std::string& to) {
    return std::string(good).replace(good.find(from), from.size(), to);
  };
  put("a_empty", "");
  put("b_noise", std::string("\0\xff{{{\n[[[", 9));
  put("c_half", good.substr(0, good.size() / 2));
  put("d_header", good.substr(0, 40));
  put("e_version", changed("\"version\": 1", "\"version\": 9"));
  put("f_revision", changed("\"revision\": 1", "\"revision\": 1e300"));
  put("g_time", changed("\"time_us\": ", "\"time_us\": 9999999999"));
  put("h_array", "[1, 2]\n");
  put("i_type", changed("\"boot\": \"", "\"boot\": 1, \"x\": \""));
  fs::create_directory(folder / "j_folder.palpa-autosave");
  put("k_behind", good + "}");
  std::ofstream(folder / "notes.txt") << "not ours";
  const RecoveryList list = findRecoverable(folder.path());
  ASSERT_EQ(list.snapshots.size(), 1U);
  EXPECT_EQ(list.snapshots.front().projectName, "good");
  ASSERT_EQ(list.problems.size(), 11U);
  for (std::size_t i = 0; i < list.problems.size(); ++i)
    EXPECT_EQ(list.problems[i].find((folder / std::string(1, static_cast<char>('a' + i))).string()),
              0U)
        << list.problems[i];
}

TEST(Autosave, ReportsWhyItCannotWrite) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file") << "in the way";
  Autosave autosave(folder / "file/below");
  EXPECT_THROW(autosave.write(named("a"), "", 1), ModelingError);
  Autosave good(folder / "state");
  good.write(named("a"), "", 1);
  Project broken = named("b");
  broken.material.youngsModulus = -1.0;
  EXPECT_THROW(good.write(broken, "", 2), ModelingError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "state"), {}), 1);
}

TEST(Autosave, HasADefaultFolder) {
  const pid_t child = startChild([] {
    ::setenv("HOME", "/home/somebody", 1);
    ::setenv("XDG_STATE_HOME", "/var/state", 1);
    if (defaultAutosaveFolder() != "/var/state/palpa/autosave") ::_exit(2);
    ::setenv("XDG_STATE_HOME", "relative", 1);
    if (defaultAutosaveFolder() != "/home/somebody/.local/state/palpa/autosave") ::_exit(3);
    ::unsetenv("XDG_STATE_HOME");
    if (defaultAutosaveFolder() != "/home/somebody/.local/state/palpa/autosave") ::_exit(4);
    ::unsetenv("HOME");
    try {
      defaultAutosaveFolder();
      ::_exit(5);
    } catch (const ModelingError&) {
    }
  });
  EXPECT_EQ(resultOf(child), 0);
}

TEST(ProcessIdTest, DistinguishesProcesses) {
  ProcessId process = thisProcess();
  EXPECT_TRUE(isRunning(process));
  ++process.start;  // an earlier process with the same number
  EXPECT_FALSE(isRunning(process));
  process = thisProcess();
  process.boot += "x";
  EXPECT_FALSE(isRunning(process));
  process.machine += "x";
  EXPECT_TRUE(isRunning(process));  // unknown start time

  const pid_t child = startChild([] { ::pause(); });
  ProcessId other = thisProcess();
  other.number = child;
  ::kill(child, SIGKILL);
  siginfo_t info;
  ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  EXPECT_FALSE(isRunning(other));  // ended, but not yet waited for
  ::waitpid(child, nullptr, 0);
  EXPECT_FALSE(isRunning(other));
}

}  // namespace
}  // namespace palpa::modeling
