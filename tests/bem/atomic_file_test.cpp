#include "base/atomic_file.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace palpa {
namespace {

namespace fs = std::filesystem;

/// A new folder, removed at the end.
class AtomicFileTest : public testing::Test {
 protected:
  AtomicFileTest() {
    std::string name = (fs::temp_directory_path() / "palpa-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  ~AtomicFileTest() override { fs::remove_all(folder_); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  static std::string contentOf(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  fs::path folder_;
};

TEST_F(AtomicFileTest, TheTargetAppearsWithCommit) {
  const fs::path path = folder_ / "table.csv";
  {
    AtomicFile file(path);
    EXPECT_TRUE(files().empty());
    file.write("half");
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_TRUE(files().empty());
  AtomicFile file(path);
  file.write("whole");
  file.commit();
  EXPECT_EQ(contentOf(path), "whole");
  EXPECT_EQ(files(), std::vector<std::string>{"table.csv"});
}

TEST_F(AtomicFileTest, ALibraryMayWriteTheHiddenFile) {
  const fs::path path = folder_ / "film.mp4";
  std::ofstream(path) << "old";
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  AtomicFile file(path);
  std::ofstream(file.freshPath()) << "new";
  EXPECT_EQ(contentOf(path), "old");
  file.commit();
  EXPECT_EQ(contentOf(path), "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(files(), std::vector<std::string>{"film.mp4"});
}

TEST_F(AtomicFileTest, RefusesBeforeTheWorkWhatCannotBeWritten) {
  EXPECT_THROW(AtomicFile(folder_ / ""), FileError);
  EXPECT_THROW(AtomicFile{folder_}, FileError);
  EXPECT_THROW(AtomicFile("/dev/null"), FileError);
  EXPECT_THROW(replaceFile("text", folder_ / "no folder" / "file"), FileError);
  // Nothing was written to the hidden file.
  AtomicFile file(folder_ / "empty");
  EXPECT_THROW(file.commit(), FileError);
  EXPECT_TRUE(files().empty());
}

TEST_F(AtomicFileTest, ABackupThatIsTheSameFileLeavesNothingBehind) {
  const fs::path path = folder_ / "project.json";
  std::ofstream(path) << "old";
  fs::create_hard_link(path, backupPath(path));
  replaceFile("new", path, {.backup = true});
  EXPECT_EQ(contentOf(path), "new");
  EXPECT_EQ(contentOf(backupPath(path)), "old");
  EXPECT_EQ(files(), (std::vector<std::string>{"project.json", "project.json.bak"}));
}

}  // namespace
}  // namespace palpa
