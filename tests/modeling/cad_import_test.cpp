#include "modeling/exchange/cad_import.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <numbers>
#include <set>

#include "modeling/error.h"
#include "modeling/exchange/cad_answer.h"
#include "modeling/exchange/cad_body.h"
#include "modeling/exchange/import.h"
#include "modeling/exchange/opencascade_session.h"
#include "modeling/solid/surface_properties.h"
#include "tests/modeling/cad_files.h"
#include "tests/modeling/cad_shapes.h"

namespace palpa::modeling {
namespace {

using tests::Folder;

const std::array<const char*, 3> kFormats{"body.step", "body.igs", "body.brep"};

struct Foreign {
  const char* name;
  TopoDS_Shape shape;
  std::size_t faces;   ///< expected patches or faces
  const char* reason;  ///< reason for a mesh body; null for a solid
};

std::vector<Foreign> foreignShapes() {
  return {
      {"box", BRepPrimAPI_MakeBox(40.0, 30.0, 20.0).Shape(), 6, nullptr},
      {"wedge", BRepPrimAPI_MakeWedge(40.0, 30.0, 20.0, 10.0, 5.0, 30.0, 15.0).Shape(), 6, nullptr},
      {"quarter pipe", tests::quarterPipe(), 6, nullptr},
      {"rational quarter pipe", BRepBuilderAPI_NurbsConvert(tests::quarterPipe()).Shape(), 6,
       nullptr},
      {"swept rectangle", tests::sweptRectangle(), 6, nullptr},
      {"loft", tests::loft(), 6, nullptr},
      {"torus", BRepPrimAPI_MakeTorus(25.0, 8.0).Shape(), 4, nullptr},
      {"cylinder", BRepPrimAPI_MakeCylinder(15.0, 40.0).Shape(), 3, "is bounded by 2 edges"},
      {"cone", BRepPrimAPI_MakeCone(15.0, 0.0, 40.0).Shape(), 2, "has a pole"},
      {"sphere", BRepPrimAPI_MakeSphere(25.0).Shape(), 1, "has a pole"},
      {"filleted box", tests::filletedBox(), 26, "has a pole"},
      {"split box", tests::splitBox(), 7, "is flat with 5 edges"},
      {"bored cylinder", tests::boredCylinder(), 4, "has a hole"}};
}

std::string joined(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += note + "\n";
  return text;
}

std::string errorOf(const std::filesystem::path& path, const ImportOptions& options = {}) {
  try {
    importBody(path, options);
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "";
}

TEST(CadImport, ForeignBodiesBecomeSolidsWherePossibleAndMeshBodiesOtherwise) {
  const Folder folder;
  for (const Foreign& foreign : foreignShapes()) {
    const double expected = std::abs(tests::volumeOf(foreign.shape));  // one is inverted
    const double area = tests::areaOf(foreign.shape);
    const double size = std::cbrt(expected);
    for (const char* format : kFormats) {
      const std::string what = std::string(foreign.name) + " as " + format;
      tests::writeForeign(foreign.shape, folder.file(format));
      const ImportedBody read = importCad(folder.file(format));
      const std::string notes = joined(read.notes);
      // The constructors check that both are closed, oriented and manifold.
      EXPECT_EQ(std::holds_alternative<Solid>(read.body), foreign.reason == nullptr) << what << "\n"
                                                                                     << notes;
      EXPECT_NE(notes.find(foreign.reason ? foreign.reason : ""), std::string::npos)
          << what << notes;
      const std::vector<std::string> names = patchNames(read.body);
      EXPECT_EQ(names.size(), foreign.faces) << what;
      EXPECT_EQ(std::set(names.begin(), names.end()).size(), names.size()) << what;
      EXPECT_EQ(names.front().rfind("face_1", 0), 0u) << what << " " << names.front();
      // A surface that deviates by d everywhere changes the volume by at most about area · d.
      EXPECT_NEAR(volume(read.body), expected, area * read.deviation + 1e-6 * expected) << what;
      EXPECT_LT(read.deviation, foreign.reason ? 5e-3 * size : 1e-3 * size) << what;
    }
  }
}

TEST(CadImport, PatchesKeepTheRequestedTolerance) {
  const Folder folder;
  const auto path = folder.file("pipe.step");
  tests::writeForeign(tests::quarterPipe(), path);
  std::size_t points = 0;
  for (const double tolerance : {0.1, 1e-3, 1e-5}) {
    ImportOptions options;
    options.tolerance = tolerance;
    const ImportedBody read = importCad(path, options);
    const Solid& solid = std::get<Solid>(read.body);
    EXPECT_LE(read.deviation, tolerance);
    EXPECT_GT(solid.controlPoints().size(), points);
    points = solid.controlPoints().size();
    // The points of the cylinders are 10 or 16 mm away from the axis.
    const SurfaceEvaluator surface(solid);
    double worst = 0.0;
    for (int patch = 0; patch < surface.patchCount(); ++patch)
      for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j) {
          const auto [u0, u1] = surface.range(patch, 0);
          const auto [v0, v1] = surface.range(patch, 1);
          const Eigen::Vector3d p =
              surface.position(patch, u0 + (u1 - u0) * i / 20, v0 + (v1 - v0) * j / 20);
          const double radius = p.head<2>().norm();
          worst = std::max(worst, std::max(10.0 - radius, radius - 16.0));
        }
    EXPECT_LE(worst, tolerance);
  }
}

TEST(CadImport, MeshBodiesHaveTheRequestedEdgeLength) {
  const Folder folder;
  const auto path = folder.file("bored.step");
  tests::writeForeign(tests::boredCylinder(), path);
  double last = 1e9;
  for (const double edgeLength : {8.0, 2.0, 0.5}) {
    ImportOptions options;
    options.edgeLength = edgeLength;
    const ImportedBody read = importCad(path, options);
    EXPECT_LE(read.deviation, edgeLength / 50.0);
    EXPECT_LT(read.deviation, last);
    last = read.deviation;
  }
  ImportOptions options;
  options.edgeLength = 1e-4;
  EXPECT_NE(errorOf(path, options).find("too many triangles"), std::string::npos);
  options.edgeLength = -1.0;
  EXPECT_NE(errorOf(path, options).find("edge_length_mm: -1"), std::string::npos);
}

/// Second moment of area of a rod's section around the x axis, mm⁴, per length: of the body
/// between z = 0 and z = `length`.
double secondMoment(const MeshBody& body, double length) {
  double sum = 0.0;
  for (const auto& triangle : body.triangles()) {
    const Eigen::Vector3d& a = body.positions()[triangle[0]];
    const Eigen::Vector3d& b = body.positions()[triangle[1]];
    const Eigen::Vector3d& c = body.positions()[triangle[2]];
    // ∫ y² dV = ∫ y³/3 n_y dS; the integral of y³ over a triangle is exact.
    const double ya = a.y(), yb = b.y(), yc = c.y();
    const double cubes = ya * ya * ya + yb * yb * yb + yc * yc * yc + ya * yb * yc +
                         ya * ya * (yb + yc) + yb * yb * (ya + yc) + yc * yc * (ya + yb);
    sum += 0.5 * (b - a).cross(c - a).y() * cubes / 10.0 / 3.0;
  }
  return sum / length;
}

TEST(CadImport, MeshBodiesHaveAsMuchMaterialAsTheirRoundFaces) {
  const Folder folder;
  const auto path = folder.file("round.brep");
  for (const Foreign& foreign : foreignShapes()) {
    if (foreign.reason == nullptr) continue;
    const double expected = std::abs(tests::volumeOf(foreign.shape));
    tests::writeForeign(foreign.shape, path);
    const double found = volume(importCad(path).body);
    EXPECT_NEAR(found / expected, 1.0, 2e-4) << foreign.name;
  }
}

TEST(CadImport, RodsBendAsRoundOnes) {
  const Folder folder;
  const auto path = folder.file("rod.step");
  constexpr double kRadius = 0.4;
  constexpr double kLength = 20.0;
  tests::writeForeign(BRepPrimAPI_MakeCylinder(kRadius, kLength).Shape(), path);
  for (const double edgeLength : {0.2, 1.0, 5.0}) {
    ImportOptions options;
    options.edgeLength = edgeLength;
    const MeshBody rod = std::get<MeshBody>(importCad(path, options).body);
    const double round = std::numbers::pi / 4.0 * std::pow(kRadius, 4);
    EXPECT_NEAR(secondMoment(rod, kLength) / round, 1.0, 5e-5) << edgeLength;
    // The ends stay in their planes.
    for (const Eigen::Vector3d& p : rod.positions())
      EXPECT_TRUE(p.z() == 0.0 || std::abs(p.z() - kLength) < 1e-12) << p.transpose();
  }
}

TEST(CadImport, InchesBecomeMillimetres) {
  const Folder folder;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(40.0, 30.0, 20.0).Shape();
  tests::writeForeign(box, folder.file("inch.step"), "INCH");
  EXPECT_NE(tests::readText(folder.file("inch.step")).find("INCH"), std::string::npos);
  EXPECT_NEAR(volume(importCad(folder.file("inch.step")).body), 24000.0, 1e-6);
}

/// Everything of a body, with all digits.
std::string textOf(const ImportedBody& imported) {
  return toLine(imported) + std::to_string(imported.body.index());
}

TEST(CadImport, TheSameFileGivesTheSameBits) {
  const Folder folder;
  for (const TopoDS_Shape& shape : {tests::quarterPipe(), tests::filletedBox()}) {
    tests::writeForeign(shape, folder.file("a.step"));
    EXPECT_EQ(textOf(importCad(folder.file("a.step"))), textOf(importCad(folder.file("a.step"))));
  }
}

TEST(CadImport, ThePalpaReadCadProgramPassesBodiesOnExactly) {
  const Folder folder;
  const auto path = folder.file("a.step");
  for (const Foreign& foreign : foreignShapes()) {
    tests::writeForeign(foreign.shape, path);
    const ImportedBody passed = importCad(path);
    const OpenCascadeSession session;
    const ImportedBody read = readCadBody(path, tests::readText(path), {}, {});
    ASSERT_EQ(passed.body.index(), read.body.index()) << foreign.name;
    EXPECT_EQ(passed.notes, read.notes);
    EXPECT_EQ(passed.deviation, read.deviation);
    EXPECT_EQ(patchNames(passed.body), patchNames(read.body));
    if (const auto* solid = std::get_if<Solid>(&passed.body)) {
      const auto& other = std::get<Solid>(read.body);
      EXPECT_EQ(solid->controlPoints(), other.controlPoints()) << foreign.name;
      for (std::size_t p = 0; p < other.patches().size(); ++p) {
        EXPECT_EQ(solid->patches()[p].knots, other.patches()[p].knots) << foreign.name;
        EXPECT_EQ(solid->patches()[p].net, other.patches()[p].net) << foreign.name;
      }
      ASSERT_EQ(solid->edges().size(), other.edges().size()) << foreign.name;
      for (std::size_t e = 0; e < other.edges().size(); ++e)
        EXPECT_EQ(solid->edges()[e].smooth, other.edges()[e].smooth) << foreign.name << ' ' << e;
    } else {
      const auto& mesh = std::get<MeshBody>(passed.body);
      const auto& other = std::get<MeshBody>(read.body);
      EXPECT_EQ(mesh.positions(), other.positions()) << foreign.name;
      EXPECT_EQ(mesh.triangles(), other.triangles()) << foreign.name;
      EXPECT_EQ(mesh.faceOfTriangle(), other.faceOfTriangle()) << foreign.name;
    }
  }
}

}  // namespace
}  // namespace palpa::modeling
