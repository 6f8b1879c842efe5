#include "app/view/mesh_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "app/view/errors.h"

namespace palpa::view {
namespace {

namespace fs = std::filesystem;

class MeshFiles : public testing::Test {
 protected:
  MeshFiles() : folder_(fs::temp_directory_path() / ("palpa-mesh-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~MeshFiles() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  static std::string content(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  const MeshFile tetrahedron_{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
                              {{"displacement_mm", 3, std::vector<double>(12, 0.5)}},
                              {{"patch", 1, {0, 1, 2, 3}}}};

 private:
  fs::path folder_;
};

TEST_F(MeshFiles, ObjCountsFromOne) {
  writeMesh(tetrahedron_, file("a.obj"));
  EXPECT_NE(content(file("a.obj")).find("f 1 3 2\n"), std::string::npos);
}

TEST_F(MeshFiles, BinaryStlHasItsExactSize) {
  writeMesh(tetrahedron_, file("a.STL"));
  EXPECT_EQ(fs::file_size(file("a.STL")), 80u + 4u + 4u * 50u);
}

TEST_F(MeshFiles, PlyAndVtpSayWhatTheyAre) {
  writeMesh(tetrahedron_, file("a.ply"));
  writeMesh(tetrahedron_, file("a.vtp"));
  EXPECT_EQ(content(file("a.ply")).substr(0, 3), "ply");
  const std::string vtp = content(file("a.vtp"));
  EXPECT_NE(vtp.find("displacement_mm"), std::string::npos);
  EXPECT_NE(vtp.find("\"patch\""), std::string::npos);
}

TEST_F(MeshFiles, UnknownEndingsAndBadFoldersAreErrors) {
  EXPECT_THROW(writeMesh(tetrahedron_, file("a.step")), ViewError);
  for (const char* ending : {"stl", "obj", "ply", "vtp"}) {
    EXPECT_THROW(writeMesh(tetrahedron_, file("no/such/folder/a.") += ending), ViewError) << ending;
  }
}

}  // namespace
}  // namespace palpa::view
