#include "modeling/exchange/mesh_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>

#include "modeling/error.h"
#include "modeling/exchange/file_format.h"
#include "modeling/exchange/mesh_reader.h"
#include "modeling/project/text_file.h"
#include "test_bodies.h"

namespace palpa::modeling {
namespace {

namespace fs = std::filesystem;

class MeshWriter : public testing::Test {
 protected:
  MeshWriter() : folder_(fs::temp_directory_path() / ("palpa-mesh-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~MeshWriter() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }
  std::string content(const std::string& name) const { return readTextFile(file(name), 1 << 20); }

  const MeshFile tetrahedron_{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
                              {{"displacement_mm", 3, std::vector<double>(12, 0.5)}},
                              {{"patch", 1, {0, 1, 2, 3}}}};

 private:
  fs::path folder_;
};

TEST_F(MeshWriter, EveryFormatThatIsReadGivesTheBodyBack) {
  const MeshBody body = test::torus(20, 5, 24, 12);
  for (const FileFormatInfo& info : kFileFormats) {
    if (!isWritableMesh(info) || !isReadableMesh(info)) continue;
    SCOPED_TRACE(info.name);
    const fs::path path = file(std::string("torus") + info.endings[0]);
    writeMesh({body.positions(), body.triangles(), {}, {}}, path);
    const MeshBody read = readMeshFile(path);
    EXPECT_EQ(read.triangles().size(), body.triangles().size());
    EXPECT_NEAR(volume(read), volume(body), 1e-5 * volume(body));
  }
}

TEST_F(MeshWriter, ObjCountsFromOne) {
  writeMesh(tetrahedron_, file("a.obj"));
  EXPECT_EQ(content("a.obj"),
            "# lengths in mm\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
            "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
}

TEST_F(MeshWriter, BinaryStlHasItsExactSizeAndNormals) {
  writeMesh(tetrahedron_, file("a.STL"));
  const std::string bytes = content("a.STL");
  ASSERT_EQ(bytes.size(), 80u + 4u + 4u * 50u);
  float normal[3];
  std::memcpy(normal, bytes.data() + 84 + 2 * 50, sizeof normal);  // of the third triangle
  for (const float component : normal) EXPECT_FLOAT_EQ(component, std::sqrt(1.0F / 3.0F));
}

TEST_F(MeshWriter, UnknownEndingsAndBadFoldersAreErrors) {
  EXPECT_THROW(writeMesh(tetrahedron_, file("a.step")), ModelingError);
  for (const char* ending : {"stl", "obj", "ply", "vtp"}) {
    EXPECT_THROW(writeMesh(tetrahedron_, file("no/such/folder/a.") += ending), ModelingError)
        << ending;
  }
}

}  // namespace
}  // namespace palpa::modeling
