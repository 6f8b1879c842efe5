#include "modeling/exchange/mesh_reader.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <set>

#include "modeling/error.h"
#include "modeling/shapes/primitives.h"
#include "test_bodies.h"
#include "test_mesh_files.h"

namespace palpa::modeling {
namespace {

MeshBody parse(std::string_view bytes, FileFormat format, double scale = 1.0) {
  return parseMesh(bytes, format, "file", {scale});
}

/// Message with which a content is refused; it must begin with the source's name.
std::string refusal(std::string_view bytes, FileFormat format) {
  try {
    parse(bytes, format);
  } catch (const ModelingError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind("file: ", 0), 0U) << message;
    return message;
  }
  ADD_FAILURE() << "was not refused";
  return "";
}

void expectRefused(std::string_view bytes, FileFormat format,
                   std::initializer_list<std::string> parts) {
  const std::string message = refusal(bytes, format);
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "no \"" << part << "\" in: " << message;
}

/// OBJ text of points and polygons.
std::string obj(const std::vector<std::string>& points, const std::vector<std::string>& polygons) {
  std::string text;
  for (const std::string& point : points) text += "v " + point + "\n";
  for (const std::string& polygon : polygons) text += "f " + polygon + "\n";
  return text;
}

/// Unit cube of quads at an offset along x, its points numbered from `first`.
std::string cube(double x, int first, double size = 1.0) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += "v " + std::to_string(x + size * (i & 1)) + " " +
            std::to_string(size * ((i >> 1) & 1)) + " " + std::to_string(size * (i >> 2)) + "\n";
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    text += "f " + std::to_string(a + first) + " " + std::to_string(b + first) + " " +
            std::to_string(c + first) + " " + std::to_string(d + first) + "\n";
  return text;
}

TEST(MeshReader, AllFormatsGiveTheSameBody) {
  const MeshBody sphere = test::icosphere(10.0, 2);
  const double exact = volume(sphere);
  for (const auto& [bytes, format, precision] :
       std::vector<std::tuple<std::string, FileFormat, double>>{
           {test::stlText(sphere), FileFormat::kStl, 1e-12},
           {test::stlBinary(sphere), FileFormat::kStl, 1e-6},
           {test::stlBinary(sphere, "solid but binary"), FileFormat::kStl, 1e-6},
           {test::objText(sphere), FileFormat::kObj, 1e-12},
           {test::plyText(sphere, test::PlyKind::kText), FileFormat::kPly, 1e-12},
           {test::plyText(sphere, test::PlyKind::kLittleEndian), FileFormat::kPly, 1e-12},
           {test::plyText(sphere, test::PlyKind::kBigEndian), FileFormat::kPly, 1e-12}}) {
    const MeshBody read = parse(bytes, format);
    EXPECT_EQ(read.positions().size(), sphere.positions().size());
    EXPECT_EQ(read.triangles().size(), sphere.triangles().size());
    EXPECT_NEAR(volume(read) / exact, 1.0, precision);
    EXPECT_EQ(read.faceNames(), std::vector<std::string>{"face_1"});
  }
}

TEST(MeshReader, TextWithOtherLineEndsAndLettersIsTheSame) {
  const MeshBody box = test::plainBox({1, 2, 3});
  for (std::string text : {test::stlText(box), test::objText(box)}) {
    const FileFormat format = text[0] == 's' ? FileFormat::kStl : FileFormat::kObj;
    std::string windows;
    for (char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_NEAR(volume(parse(windows, format)), 6.0, 1e-12);
  }
  std::string shouting = test::stlText(box);
  for (char& c : shouting) c = static_cast<char>(std::toupper(c));
  EXPECT_NEAR(volume(parse(shouting, FileFormat::kStl)), 6.0, 1e-12);
}

TEST(MeshReader, ScaleTurnsUnitsIntoMillimetres) {
  const std::string text = test::stlText(test::plainBox({1, 2, 3}));
  EXPECT_NEAR(volume(parse(text, FileFormat::kStl, 10.0)), 6000.0, 1e-9);
  for (double scale : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(parse(text, FileFormat::kStl, scale), ModelingError);
  EXPECT_THROW(parse(text, FileFormat::kStl, 1e8), ModelingError);
}

TEST(MeshReader, ObjReadsQuadsPolygonsAndNegativeIndices) {
  const MeshBody box = parse(cube(0.0, 1), FileFormat::kObj);
  EXPECT_NEAR(volume(box), 1.0, 1e-12);
  EXPECT_EQ(box.triangles().size(), 12U);
  // An L-shaped prism: its two ends are non-convex polygons. Area 3, height 2.
  const std::string prism = obj({"0 0 0", "2 0 0", "2 1 0", "1 1 0", "1 2 0", "0 2 0", "0 0 2",
                                 "2 0 2", "2 1 2", "1 1 2", "1 2 2", "0 2 2"},
                                {"6 5 4 3 2 1", "-6 -5 -4 -3 -2 -1", "1 2 8 7", "2 3 9 8",
                                 "3 4 10 9", "4 5 11 10", "5 6 12 11", "6 1 7 12"});
  EXPECT_NEAR(volume(parse(prism, FileFormat::kObj)), 6.0, 1e-12);
  EXPECT_NEAR(area(parse(prism, FileFormat::kObj)), 6.0 + 16.0, 1e-12);
  EXPECT_EQ(parse(prism, FileFormat::kObj).faceNames().size(), 8U);
  // The same polygon on two lines.
  std::string continued = prism;
  continued.replace(continued.find("f 6 5 4 3"), 9, "f 6 5 \\\n4 3");
  EXPECT_NEAR(volume(parse(continued, FileFormat::kObj)), 6.0, 1e-12);
}

TEST(MeshReader, APolygonOfManyCornersIsCut) {
  // A disc with 500 corners above and below.
  constexpr int n = 500;
  std::vector<std::string> points;
  std::string below = "1";
  std::string above = std::to_string(2 * n);
  std::vector<std::string> polygons;
  for (int k = 0; k < 2 * n; ++k)
    points.push_back(std::to_string(10 * std::cos(2 * std::numbers::pi * k / n)) + " " +
                     std::to_string(10 * std::sin(2 * std::numbers::pi * k / n)) +
                     (k < n ? " 0" : " 1"));
  for (int k = 1; k < n; ++k) {
    below = std::to_string(k + 1) + " " + below;
    above = std::to_string(n + k) + " " + above;
  }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    polygons.push_back(std::to_string(k + 1) + " " + std::to_string(next + 1) + " " +
                       std::to_string(n + next + 1) + " " + std::to_string(n + k + 1));
  }
  polygons.push_back(below);
  polygons.push_back(above);
  const MeshBody disc = parse(obj(points, polygons), FileFormat::kObj);
  EXPECT_NEAR(volume(disc), 0.5 * n * 100 * std::sin(2 * std::numbers::pi / n), 1e-3);
  EXPECT_EQ(disc.faceNames().size(), 3U);
}

TEST(MeshReader, GroupsObjectsAndMaterialsBecomeFaces) {
  const MeshBody cylinder = test::bodyOf(makeCylinder(10, 20), 4);
  for (const char* grouping : {"g", "o", "usemtl"}) {
    const MeshBody read = parse(test::objText(cylinder, grouping), FileFormat::kObj);
    EXPECT_EQ(read.faceNames(), cylinder.faceNames());
    for (std::size_t t = 0; t < read.triangles().size(); t += 7) {
      // Triangles are identified by their centres.
      const auto centre = [](const MeshBody& body, std::size_t i) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int n : body.triangles()[i]) sum += body.positions()[n];
        return Eigen::Vector3d(sum / 3.0);
      };
      std::size_t best = 0;
      for (std::size_t i = 0; i < cylinder.triangles().size(); ++i)
        if ((centre(cylinder, i) - centre(read, t)).norm() <
            (centre(cylinder, best) - centre(read, t)).norm())
          best = i;
      EXPECT_EQ(read.faceOfTriangle()[t], cylinder.faceOfTriangle()[best]);
    }
  }
  // A single group contains no information, so sharp edges divide the surface.
  EXPECT_EQ(parse("g all\n" + test::objText(cylinder), FileFormat::kObj).faceNames(),
            (std::vector<std::string>{"face_1", "face_2", "face_3"}));
}

TEST(MeshReader, FaceNamesAreCleanAndDistinct) {
  std::string text = cube(0.0, 1);
  const std::string names[] = {"g a\xff\n", "g a\x01\n", "g a_\n",
                               "g\n",       "g a_\n",    "g " + std::string(500, 'x') + "\n"};
  std::size_t at = text.find("f ");
  for (const std::string& name : names) {
    text.insert(at, name);
    at = text.find("f ", text.find('\n', at + name.size()));
  }
  const MeshBody box = parse(text, FileFormat::kObj);
  EXPECT_EQ(box.faceNames().size(), 5U);
  for (const std::string& name : box.faceNames()) {
    EXPECT_FALSE(name.empty());
    EXPECT_LE(name.size(), 90U);
    for (char c : name) EXPECT_TRUE(c >= ' ' && c <= '~');
  }
}

TEST(MeshReader, SharpEdgesDivideASurfaceTheLargestFirst) {
  const MeshBody box = parse(test::stlText(test::plainBox({1, 20, 30})), FileFormat::kStl);
  ASSERT_EQ(box.faceNames().size(), 6U);
  std::vector<double> areas(6, 0.0);
  const auto& p = box.positions();
  for (std::size_t t = 0; t < box.triangles().size(); ++t) {
    const auto [a, b, c] = box.triangles()[t];
    areas[box.faceOfTriangle()[t]] += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
  }
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(areas[i], (std::array{600, 600, 30, 30, 20, 20})[i], 1e-9);
  // Slivers along the edges change nothing.
  const MeshBody slivers = test::withSlivers(test::plainBox({1, 20, 30}));
  EXPECT_EQ(parse(test::stlText(slivers), FileFormat::kStl).faceNames().size(), 6U);
  // Bore, outside and two rings.
  const MeshBody bored = test::boredCylinder(20, 5, 30, 48);
  EXPECT_EQ(parse(test::stlText(bored), FileFormat::kStl).faceNames().size(), 4U);
  // On a surface as rough as a rock, the number of faces stays reasonable.
  const MeshBody rock = test::noisy(test::icosphere(20, 4), 0.4);
  EXPECT_LE(rock.triangles().size(), 5120U);
  EXPECT_LE(parse(test::stlText(rock), FileFormat::kStl).faceNames().size(), 100U);
}

TEST(MeshReader, WrongOrientationsAreRepaired) {
  const MeshBody body = test::hollowSphere(10, 4, 2);
  std::mt19937 random(3);
  std::vector<std::array<int, 3>> triangles = body.triangles();
  for (auto& t : triangles)
    if (random() % 2 == 0) std::swap(t[0], t[1]);
  std::string text;
  for (const Eigen::Vector3d& p : body.positions())
    text += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
            std::to_string(p.z()) + "\n";
  for (const auto& [a, b, c] : triangles)
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
            std::to_string(c + 1) + "\n";
  EXPECT_NEAR(volume(parse(text, FileFormat::kObj)), volume(body), 1e-2);
}

TEST(MeshReader, DuplicateAndDegenerateTrianglesAreOmitted) {
  std::string text = test::stlText(test::plainBox({1, 2, 3}));
  const std::string facet =
      text.substr(text.find("  facet"), text.find("endfacet") - text.find("  facet") + 9);
  const std::string point =
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\n"
      "vertex 1 0 0\nendloop\nendfacet\n";
  text.insert(text.find("endsolid"), facet + point);
  EXPECT_EQ(parse(text, FileFormat::kStl).triangles().size(), 12U);
}

TEST(MeshReader, TrianglesWithoutAreaAreRemoved) {
  // The cube's first edge has a point in its middle: one quad contains it, the other is connected
  // by a triangle without area.
  std::string text = cube(0.0, 1);
  text.insert(text.find("f "), "v 0.5 0 0\n");
  text += "f 1 2 9\n";
  text.replace(text.find("f 1 2 6 5"), 9, "f 1 9 2 6 5");
  const MeshBody box = parse(text, FileFormat::kObj);
  EXPECT_NEAR(volume(box), 1.0, 1e-12);
  EXPECT_EQ(box.faceNames().size(), 6U);
  const auto& p = box.positions();
  for (const auto& [a, b, c] : box.triangles())
    EXPECT_GT((p[b] - p[a]).cross(p[c] - p[a]).norm(), 1e-6);
}

TEST(MeshReader, ASurfaceOfFlatTrianglesOnlyIsNoBody) {
  // A tetrahedron with its corners on one line; found by fuzzing.
  expectRefused(obj({"0 0 0", "0 0 5", "0 0 4", "0 0 3"}, {"1 3 2", "1 2 4", "1 4 3", "2 3 4"}),
                FileFormat::kObj, {"without area"});
}

TEST(MeshReader, RoundedCornersAreWelded) {
  // Every corner of every triangle is slightly displaced.
  const MeshBody sphere = test::icosphere(10, 2);
  std::mt19937 random(5);
  std::string text = "solid\n";
  for (const auto& triangle : sphere.triangles()) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (int n : triangle) {
      text += "vertex";
      for (int axis = 0; axis < 3; ++axis) {
        char number[40];
        std::snprintf(number, sizeof number, " %.17g",
                      sphere.positions()[n][axis] + 1e-7 * (random() % 100) / 100.0);
        text += number;
      }
      text += "\n";
    }
    text += "endloop\nendfacet\n";
  }
  const MeshBody read = parse(text + "endsolid\n", FileFormat::kStl);
  EXPECT_EQ(read.positions().size(), sphere.positions().size());
  EXPECT_NEAR(volume(read), volume(sphere), 1e-3);
}

TEST(MeshReader, OpenSurfacesReportTheirEdgesAndALocation) {
  std::string text = cube(0.0, 1);
  text.erase(text.rfind("f 2 4 8 6"));
  expectRefused(text, FileFormat::kObj, {"4 open edges", "(1, 0, 0)", "close the surface"});
}

TEST(MeshReader, CrowdedEdgesAndVerticesAreNamed) {
  // Two cubes with a common edge; two tetrahedra with a common corner.
  std::string edge = cube(0.0, 1);
  edge += "v 2 -1 0\nv 1 -1 0\nv 2 0 0\nv 2 -1 1\nv 1 -1 1\nv 2 0 1\n";  // 9 … 14
  edge += "f 10 2 11 9\nf 13 12 14 6\nf 10 9 12 13\nf 9 11 14 12\nf 11 2 6 14\nf 2 10 13 6\n";
  expectRefused(edge, FileFormat::kObj, {"1 edge has more than two triangles", "(1, 0, 0)"});
  // A wall through the middle of a cube that is otherwise closed.
  expectRefused(cube(0.0, 1) + "f 1 4 8 5\n", FileFormat::kObj, {"more than two triangles"});
  const std::string corner =
      obj({"0 0 0", "1 0 0", "0 1 0", "0 0 1", "-1 0 0", "0 -1 0", "0 0 -1"},
          {"1 3 2", "1 2 4", "1 4 3", "2 3 4", "1 6 5", "1 5 7", "1 7 6", "5 6 7"});
  expectRefused(corner, FileFormat::kObj, {"1 single vertex", "(0, 0, 0)"});
}

TEST(MeshReader, SurfacesThatCutThemselvesAreRefused) {
  expectRefused(cube(0.0, 1) + cube(0.5, 9), FileFormat::kObj,
                {"intersects or touches itself", "mm"});
  expectRefused(cube(0.0, 1) + cube(2.0, 9), FileFormat::kObj, {"contains 2 solids"});
  std::string many;
  for (int i = 0; i < 201; ++i) many += cube(2.0 * i, 8 * i + 1);
  expectRefused(many, FileFormat::kObj, {"more than 200 closed surfaces"});
}

TEST(MeshReader, AKleinBottleIsRefused) {
  // The figure-eight immersion: after one turn v has the opposite sign.
  constexpr int n = 8;
  std::vector<std::string> points;
  std::vector<std::string> polygons;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / n;
      const double v = 2 * std::numbers::pi * (j + 0.5) / n;
      const double r = 3 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      points.push_back(
          std::to_string(r * std::cos(u)) + " " + std::to_string(r * std::sin(u)) + " " +
          std::to_string(std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v)));
    }
  const auto index = [&](int i, int j) {
    if (i == n) return std::to_string(1 + (2 * n - 1 - j) % n);
    return std::to_string(1 + i * n + j % n);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      polygons.push_back(index(i, j) + " " + index(i + 1, j) + " " + index(i + 1, j + 1));
      polygons.push_back(index(i, j) + " " + index(i + 1, j + 1) + " " + index(i, j + 1));
    }
  const std::string message = refusal(obj(points, polygons), FileFormat::kObj);
  EXPECT_NE(message.find("one side only"), std::string::npos) << message;
}

TEST(MeshReader, SyntaxErrorsNameTheLine) {
  const FileFormat o = FileFormat::kObj;
  expectRefused("v 1 2\n", o, {"line 1", "number is missing"});
  expectRefused("v 1 2 x\n", o, {"line 1", "\"x\""});
  expectRefused("v 1 2 nan\n", o, {"line 1", "not finite"});
  expectRefused("v 1 2 1e999\n", o, {"line 1", "1e999", "too large"});
  expectRefused("v 0 0 0\nf 1 1\n", o, {"line 2", "fewer than three"});
  expectRefused("v 0 0 0\nf 1 2 1\n", o, {"line 2", "no point 2", "is 1"});
  expectRefused("v 0 0 0\nf 1 0 1\n", o, {"line 2", "no point 0"});
  expectRefused("v 0 0 0\nf -1 -2 -1\n", o, {"no point -2"});
  expectRefused("v 0 0 0\nf 1 -99999999999999999999 1\n", o, {"expected the number of a point"});
  expectRefused("hello\n", o, {"line 1", "\"hello\"", "not a statement"});
  expectRefused("curv 0 1 1 2\n", o, {"free-form"});
  expectRefused("", o, {"no triangles"});
  const FileFormat s = FileFormat::kStl;
  expectRefused("", s, {"not an STL file"});
  expectRefused("solid\nvertex 1 2 3\nvertex 1 2 3\nendfacet\n", s, {"line 4", "fewer than three"});
  expectRefused("solid\nfacet\nvertex 1 2 3\n", s, {"cut off"});
  expectRefused("solid\nfacet\nvertex 1 2 3\nfacet\n", s, {"line 4", "within a facet"});
  expectRefused("solid\nbananas\n", s, {"line 2", "bananas"});
  expectRefused("solid\nendsolid\n", s, {"no triangles"});
  const FileFormat p = FileFormat::kPly;
  expectRefused("", p, {"not a PLY file"});
  expectRefused("ply\nformat binary_middle_endian 1.0\n", p, {"line 2", "binary_middle_endian"});
  expectRefused("ply\nelement vertex 3\n", p, {"no end"});
  expectRefused("ply\nend_header\n", p, {"no format"});
  expectRefused("ply\nformat ascii 1.0\nproperty float x\n", p, {"line 3", "before the first"});
  expectRefused("ply\nformat ascii 1.0\nelement vertex -3\n", p, {"line 3", "\"-3\""});
  expectRefused("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n", p, {"quad"});
  expectRefused("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", p,
                {"no properties x, y and z"});
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  expectRefused(header + "0 0 nan\n3 0 0 0\n", p, {"line 10", "not finite"});
  expectRefused(header + "0 0 0\n3 0 0 1\n", p, {"no vertex 1"});
  expectRefused(header + "0 0 0\n3 0 0 -1\n", p, {"line 11", "invalid corner index"});
  expectRefused(header + "0 0 0\n2 0 0 0\n", p, {"line 11", "has 2 corners"});
  expectRefused(header + "0 0 0\n3 0 0", p, {"cut off"});
  expectRefused(header + "0 0 0\n1000000000 0 0", p, {"invalid length"});
}

TEST(MeshReader, DeclaredCountsCannotTakeMemory) {
  std::string stl = test::stlBinary(test::plainBox({1, 1, 1}));
  stl.replace(80, 4, "\xff\xff\xff\xff");
  expectRefused(stl, FileFormat::kStl, {"4294967295 triangles", "cut off"});
  std::string ply = test::plyText(test::plainBox({1, 1, 1}), test::PlyKind::kLittleEndian);
  ply.replace(ply.find("vertex 8"), 8, "vertex 18446744073709551615");
  expectRefused(ply, FileFormat::kPly, {"18446744073709551615 elements", "bytes"});
  expectRefused("ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n",
                FileFormat::kPly, {"no triangles"});
  // A list longer than the file.
  std::string list =
      "ply\nformat binary_little_endian 1.0\nelement face 1\n"
      "property list uint double vertex_indices\nend_header\n";
  list += "\xff\xff\xff\xff";
  expectRefused(list + "0123456789", FileFormat::kPly, {"invalid length"});
}

TEST(MeshReader, TruncatedFilesAreRefused) {
  const MeshBody sphere = test::icosphere(10, 1);
  for (const auto& [bytes, format] : std::vector<std::pair<std::string, FileFormat>>{
           {test::stlText(sphere), FileFormat::kStl},
           {test::stlBinary(sphere), FileFormat::kStl},
           {test::objText(sphere), FileFormat::kObj},
           {test::plyText(sphere, test::PlyKind::kText), FileFormat::kPly},
           {test::plyText(sphere, test::PlyKind::kBigEndian), FileFormat::kPly}})
    for (std::size_t length = 0; length < bytes.size() * 97 / 100; length += 37)
      EXPECT_THROW(parse(std::string_view(bytes).substr(0, length), format), ModelingError)
          << length;
}

TEST(MeshReader, GarbageIsRefusedOrABody) {
  std::mt19937 random(7);
  const MeshBody box = test::plainBox({1, 2, 3});
  const std::vector<std::pair<std::string, FileFormat>> seeds{
      {test::stlText(box), FileFormat::kStl},
      {test::stlBinary(box), FileFormat::kStl},
      {test::objText(box, "g"), FileFormat::kObj},
      {test::plyText(box, test::PlyKind::kText), FileFormat::kPly},
      {test::plyText(box, test::PlyKind::kLittleEndian), FileFormat::kPly},
      {test::plyText(box, test::PlyKind::kBigEndian), FileFormat::kPly}};
  int bodies = 0;
  for (int i = 0; i < 6000; ++i) {
    auto [bytes, format] = seeds[random() % seeds.size()];
    if (i % 10 == 0) {  // only noise
      bytes.assign(random() % 400, '\0');
      for (char& c : bytes) c = static_cast<char>(random());
    }
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < changes && !bytes.empty(); ++k) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 4) {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes.erase(at, random() % 20);
          break;
        case 2:
          bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 60));
          break;
        default:
          bytes[at] = "0123456789-.e "[random() % 14];
          break;
      }
    }
    try {
      const MeshBody body = parse(bytes, format);
      EXPECT_GT(volume(body), 0.0);
      ++bodies;
    } catch (const ModelingError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("file: ", 0), 0U);
    }
  }
  EXPECT_GT(bodies, 100);  // changes in names, normals and colours
}

TEST(MeshReader, TheNameDeterminesTheFormat) {
  const std::filesystem::path folder = testing::TempDir();
  const MeshBody box = test::plainBox({1, 2, 3});
  std::ofstream(folder / "box.STL", std::ios::binary) << test::stlBinary(box);
  EXPECT_NEAR(volume(readMeshFile(folder / "box.STL", {2.0})), 48.0, 1e-5);
  const auto kindOf = [](const std::filesystem::path& path) {
    try {
      readMeshFile(path);
    } catch (const ModelingError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
      return error.kind();
    }
    return ModelingError::Kind::kTooLarge;
  };
  EXPECT_EQ(kindOf(folder / "none.obj"), ModelingError::Kind::kNotFound);
  EXPECT_EQ(kindOf(folder / "box.step"), ModelingError::Kind::kBadInput);
  std::filesystem::create_directories(folder / "folder.ply");
  EXPECT_EQ(kindOf(folder / "folder.ply"), ModelingError::Kind::kIo);
}

TEST(MeshReader, CanBeCancelledAndReportsProgress) {
  const std::string text = test::stlText(test::icosphere(10, 3));
  double last = -1.0;
  std::stop_source stop;
  Job job;
  job.stop = stop.get_token();
  job.progress = [&](Phase phase, double fraction) {
    EXPECT_EQ(phase, Phase::kImport);
    EXPECT_GT(fraction, last);
    last = fraction;
  };
  parseMesh(text, FileFormat::kStl, "file", {}, job);
  EXPECT_EQ(last, 1.0);
  last = -1.0;
  job.progress = [&](Phase, double fraction) {
    if (fraction > 0.5) stop.request_stop();
  };
  EXPECT_THROW(parseMesh(text, FileFormat::kStl, "file", {}, job), Cancelled);
}

}  // namespace
}  // namespace palpa::modeling
