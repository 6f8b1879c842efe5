// Text files of meshes as other programs and editors save them.
#include <gtest/gtest.h>

#include "modeling/error.h"
#include "modeling/exchange/mesh_reader.h"

namespace palpa::modeling {
namespace {

const std::string kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::string errorOf(const std::string& text, FileFormat format = FileFormat::kObj) {
  try {
    parseMesh(text, format, "part.obj");
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshText, AMarkBeforeUtf8IsSkipped) {
  const MeshBody body = parseMesh("\xEF\xBB\xBF" + kTetrahedron, FileFormat::kObj, "part.obj");
  EXPECT_EQ(body.triangles().size(), 4u);
}

TEST(MeshText, Utf16IsNamed) {
  for (const std::string mark : {"\xFF\xFE", "\xFE\xFF"}) {
    for (const FileFormat format : {FileFormat::kObj, FileFormat::kPly})
      EXPECT_EQ(errorOf(mark + std::string("v\0 \0", 4), format),
                "part.obj: is text in UTF-16, which is not read; save it as UTF-8 or ASCII");
  }
}

TEST(MeshText, PointsWithoutASurfaceAreNamed) {
  for (const char* text : {"v 0 0 0\nv 1 0 0\n", "v 0 0 0\nv 1 0 0\nl 1 2\n", ""})
    EXPECT_EQ(errorOf(text),
              "part.obj: contains no triangles, only points or lines, or nothing; export a surface")
        << text;
}

}  // namespace
}  // namespace palpa::modeling
