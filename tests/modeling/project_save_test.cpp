#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "modeling/error.h"
#include "modeling/project/atomic_write.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/child_process.h"

namespace palpa::modeling {
namespace {

namespace fs = std::filesystem;
using testing_support::resultOf;
using testing_support::startChild;
using testing_support::TemporaryFolder;

std::string contentOf(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

mode_t modeOf(const fs::path& path) {
  struct stat state {};
  return ::stat(path.c_str(), &state) == 0 ? state.st_mode & 07777 : 0;
}

std::string errorOf(std::string_view text, const fs::path& path, AtomicWriteOptions options = {}) {
  try {
    writeAtomically(text, path, options);
  } catch (const ModelingError& error) {
    EXPECT_EQ(error.kind(), ModelingError::Kind::kIo);
    return error.what();
  }
  return "no error";
}

Project numbered(int number) {
  Project project;
  project.name = std::to_string(number);
  project.material = {"rubber", 1.5, 0.45};
  project.body = makeBox({40, 30, 20});
  return project;
}

/// Number of a saved project; fails the test if the file differs from the saved content.
int numberIn(const fs::path& path) {
  const std::string text = contentOf(path);
  const int number = std::stoi(parseProject(text, path.string()).name);
  EXPECT_EQ(text, toJson(numbered(number)));
  return number;
}

TEST(ProjectSave, AKillAtAnyMomentLosesNothing) {
  const TemporaryFolder folder;
  const fs::path path = folder / "box.json";
  writeProject(numbered(0), path);
  int last = 0;
  for (int round = 0; round < 50; ++round) {
    const auto saved = testing_support::killAmongReports(
        1 + round % 3, 173 * (round * 7 % 50), [&](testing_support::Reports& reports) {
          for (int number = last + 1;; ++number) {
            writeProject(numbered(number), path);
            reports.report(static_cast<std::uint64_t>(number));
          }
        });
    const int number = numberIn(path);
    ASSERT_GT(number, last);
    // The interrupted save may have finished.
    ASSERT_TRUE(number == static_cast<int>(saved) || number == static_cast<int>(saved) + 1);
    const int backup = numberIn(backupPath(path));
    ASSERT_TRUE(backup == number - 1 || backup == number) << number << ", backup " << backup;
    last = number;
  }
}

TEST(ProjectSave, AFullDiskKeepsTheOldFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const fs::path path = folder / "box.json";
  writeProject(numbered(1), path);
  const pid_t child = startChild([&] {
    ::signal(SIGXFSZ, SIG_IGN);  // the write then fails with an error
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writeProject(numbered(2), path);
    } catch (const ModelingError& error) {
      ::_exit(error.kind() == ModelingError::Kind::kIo ? 7 : 8);
    }
  });
  EXPECT_EQ(resultOf(child), 7);
  EXPECT_EQ(numberIn(path), 1);
  EXPECT_EQ(folder.size(), 1);
}

TEST(ProjectSave, AnUnreadableProjectIsNotSaved) {
  const TemporaryFolder folder;
  const fs::path path = folder / "box.json";
  writeProject(numbered(1), path);
  const auto error = [&](const Project& project) -> std::string {
    try {
      writeProject(project, path);
    } catch (const ModelingError& caught) {
      return std::string(caught.what()).substr(path.string().size());
    }
    return "no error";
  };
  Project project = numbered(2);
  project.primitive = Primitive{SphereShape{-3.0}, 3, 0};
  EXPECT_EQ(error(project), " is not saved: primitive.radius_mm: found -3, expected more than 0");
  project = numbered(2);
  project.body = Solid();
  EXPECT_EQ(error(project),
            " is not saved: solid.control_points_mm: found a list of 0, expected at least 4 "
            "entries");
  project = numbered(2);
  project.view = "{\"zoom\": ";
  EXPECT_EQ(error(project).find(" is not saved: line "), 0U) << error(project);
  EXPECT_EQ(numberIn(path), 1);
  EXPECT_EQ(folder.size(), 1);
}

TEST(AtomicWrite, FollowsLinksAndKeepsThem) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "real");
  fs::create_symlink("real/target.json", folder / "first");
  fs::create_symlink("first", folder / "second");
  writeAtomically("old", folder / "second");  // the target does not exist yet
  writeAtomically("new", folder / "second", {.backup = true});
  EXPECT_TRUE(fs::is_symlink(folder / "first") && fs::is_symlink(folder / "second"));
  EXPECT_FALSE(fs::is_symlink(folder.path() / "real/target.json"));
  EXPECT_EQ(contentOf(folder.path() / "real/target.json"), "new");
  EXPECT_EQ(backupPath(folder / "second"), folder.path() / "real/target.json.bak");
  EXPECT_EQ(contentOf(folder.path() / "real/target.json.bak"), "old");

  fs::create_symlink("round", folder / "circle");
  fs::create_symlink("circle", folder / "round");
  EXPECT_NE(errorOf("x", folder / "circle").find("symbolic links"), std::string::npos);
}

TEST(AtomicWrite, KeepsPermissions) {
  const TemporaryFolder folder;
  const mode_t mask = ::umask(022);
  writeAtomically("1", folder / "plain");
  writeAtomically("1", folder / "secret", {.secret = true});
  ::umask(mask);
  EXPECT_EQ(modeOf(folder / "plain"), 0644U);
  EXPECT_EQ(modeOf(folder / "secret"), 0600U);
  ::chmod((folder / "plain").c_str(), 0664);
  writeAtomically("2", folder / "plain", {.backup = true});
  EXPECT_EQ(modeOf(folder / "plain"), 0664U);
  EXPECT_EQ(modeOf(folder / "plain.bak"), 0664U);
}

TEST(AtomicWrite, RefusesFoldersAndForeignFiles) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a folder");
  EXPECT_NE(errorOf("x", folder / "a folder").find("Is a directory"), std::string::npos);
  EXPECT_NE(errorOf("x", "/dev/full").find("this is not a file"), std::string::npos);
  EXPECT_NE(errorOf("x", "").find("no file name"), std::string::npos);
  EXPECT_NE(errorOf("x", folder / "missing/file").find("No such file"), std::string::npos);
  EXPECT_NE(errorOf("x", folder / std::string(300, 'n')).find("File name too long"),
            std::string::npos);

  writeAtomically("old", folder / "file");
  fs::create_directory(folder / "file.bak");
  EXPECT_NE(errorOf("new", folder / "file", {.backup = true}).find("there is a folder"),
            std::string::npos);
  EXPECT_EQ(contentOf(folder / "file"), "old");
  EXPECT_EQ(folder.size(), 3);
}

TEST(AtomicWrite, RespectsReadOnlyFilesAndFolders) {
  const TemporaryFolder folder;
  writeAtomically("old", folder / "file");
  ::chmod((folder / "file").c_str(), 0444);
  fs::create_directory(folder / "closed");
  ::chmod((folder / "closed").c_str(), 0555);
  ::chmod(folder.path().c_str(), 0777);
  const pid_t child = startChild([&] {
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(2);  // root may write everywhere
    if (errorOf("x", folder / "file").find("Permission denied") == std::string::npos) ::_exit(3);
    if (errorOf("x", folder / "closed/file").find("Permission denied") == std::string::npos)
      ::_exit(4);
  });
  EXPECT_EQ(resultOf(child), 0);
  EXPECT_EQ(contentOf(folder / "file"), "old");
}

TEST(AtomicWrite, AcceptsTheLongestNames) {
  const TemporaryFolder folder;
  std::string name;
  for (int i = 0; i < 127; ++i) name += "ü";
  const fs::path path = folder / (name + "x");  // 255 bytes
  writeAtomically("old", path, {.backup = true});
  writeAtomically("new", path, {.backup = true});
  EXPECT_EQ(contentOf(path), "new");
  EXPECT_EQ(contentOf(backupPath(path)), "old");
  EXPECT_EQ(backupPath(path).filename().string(), name.substr(0, 250) + ".bak");
}

TEST(AtomicWrite, RemovesOldLeftoversOfTheSameFile) {
  const TemporaryFolder folder;
  const std::string dead = ".file.4711-0.palpa-new";
  for (const char* name : {".file.4711-0.palpa-new", ".file.4711-1.palpa-new",
                           ".other.4711-0.palpa-new", ".file.4711-0.mine"})
    std::ofstream(folder / name) << "half";
  const auto longAgo = fs::file_time_type::clock::now() - std::chrono::hours(25);
  for (const char* name :
       {".file.4711-0.palpa-new", ".other.4711-0.palpa-new", ".file.4711-0.mine"})
    fs::last_write_time(folder / name, longAgo);
  writeAtomically("new", folder / "file");
  EXPECT_FALSE(fs::exists(folder / dead));
  EXPECT_EQ(folder.size(), 4);
}

}  // namespace
}  // namespace palpa::modeling
