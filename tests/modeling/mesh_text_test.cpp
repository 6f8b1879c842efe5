// Text files of meshes as other programs and editors save them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

/// The message says all of it.
void expectSays(const std::string& text, FileFormat format,
                std::initializer_list<std::string> parts) {
  const std::string error = errorOf(text, format);
  for (const std::string& part : parts)
    EXPECT_NE(error.find(part), std::string::npos) << "no \"" << part << "\" in: " << error;
}

TEST(MeshText, DamagedStlNamesTheLineAndWhatToDo) {
  const FileFormat s = FileFormat::kStl;
  expectSays("solid\nvertex 0 0 0\nsolid\n", s, {"line 3: a solid begins within a facet; export"});
  std::string many = "solid\nfacet\n";
  for (int i = 0; i <= kMaxPolygonCorners; ++i) many += "vertex 0 0 0\n";
  expectSays(many, s, {"line 2003: a facet has too many vertices; export the file again"});
  std::string binary(84 + 50, '\0');
  binary[80] = 1;
  binary.replace(84 + 12, 4, "\xff\xff\xff\xff");
  expectSays(binary, s, {"triangle 1: a coordinate is not a finite number; export the file again"});
  expectSays("abc", s,
             {"has 3 bytes and does not begin with \"solid\"; export it again, or correct"});
}

TEST(MeshText, DamagedObjNamesTheLineAndWhatToDo) {
  const FileFormat o = FileFormat::kObj;
  expectSays("v 0 0 0\ncurv 0 1 1 2\n", o,
             {"line 2: curves and free-form surfaces (\"curv\") are not supported; export the "
              "surface as polygons"});
  std::string polygon = "v 0 0 0\nf";
  for (int i = 0; i <= kMaxPolygonCorners; ++i) polygon += " 1";
  expectSays(polygon, o, {"line 2: a polygon has more than 2000 corners; export the file again"});
  expectSays("v 0 0 0\nf 1 1 1\n", o, {"without extent; export a closed surface"});
  expectSays("v 1 2 x\n", o, {"line 1: expected a number, found \"x\"; export the file again"});
  // A double cone whose triangles are all groups.
  std::string groups;
  constexpr int n = 502;  // triangles of a fan on each side
  for (int i = 0; i < n; ++i)
    groups += "v " + std::to_string(std::cos(2 * std::numbers::pi * i / n)) + " " +
              std::to_string(std::sin(2 * std::numbers::pi * i / n)) + " 0\n";
  groups += "v 0 0 1\nv 0 0 -1\n";
  for (int i = 1; i <= n; ++i) {
    const std::string a = std::to_string(i);
    const std::string b = std::to_string(i % n + 1);
    groups += "g u" + a + "\nf " + a + " " + b + " 503\ng d" + a + "\nf " + b + " " + a + " 504\n";
  }
  expectSays(groups, o, {"has 1004 groups; at most 1000 can become faces: unite some of them"});
}

TEST(MeshText, TooManyTrianglesAreCounted) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  text.reserve(40'000'000);
  for (int i = 0; i <= kMaxMeshTriangles; ++i) text += "f 1 2 3\n";
  expectSays(text, FileFormat::kObj,
             {"has more than 4000000 triangles; reduce their number in the program of origin"});
}

TEST(MeshText, DamagedPlyNamesTheLineAndWhatToDo) {
  const FileFormat p = FileFormat::kPly;
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::string vertex = start + "element vertex 1\n";
  expectSays(vertex + "property list float int a\n", p,
             {"line 4: the length of a list must be a whole number; export the file again"});
  expectSays(start + "banana\n", p, {"line 3: \"banana\" is not a statement of a PLY header; exp"});
  expectSays(vertex + "property float\n", p, {"no end; export the file again"});
  expectSays("ply\nend_header\n", p, {"line 2: the header names no format; export the file again"});
  std::string elements = start;
  for (int i = 0; i <= 64; ++i) elements += "element e 0\n";
  expectSays(elements, p, {"line 67: too many kinds of elements; export the file again"});
  std::string properties = vertex;
  for (int i = 0; i <= 256; ++i) properties += "property float x\n";
  expectSays(properties, p, {"line 260: too many properties; export the file again"});
  expectSays(start + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0\n",
             p, {"contains triangle strips, which are not supported; export plain triangles"});
  expectSays(vertex + "property float x\nproperty float y\nproperty float z\nend_header\n1 2 x\n",
             p, {"line 8: expected a number, found \"x\"; export the file again"});
  std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float "
      "y\nproperty float z\nend_header\n";
  expectSays(binary + std::string(10, '\0'), p, {"the file is cut off or wrong: export it again"});
  binary += std::string(8, '\0');
  expectSays(
      binary + "\xff\xff\xff\xff", p,
      {"a coordinate is not a finite number, 0 bytes before the end; export the file again"});
}

}  // namespace
}  // namespace palpa::modeling
