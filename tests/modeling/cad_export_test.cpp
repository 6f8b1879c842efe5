#include "modeling/exchange/cad_export.h"

#include <gtest/gtest.h>

#include <BRepCheck_Analyzer.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <random>

#include "modeling/error.h"
#include "modeling/exchange/cad_import.h"
#include "modeling/shapes/primitives.h"
#include "modeling/solid/surface_properties.h"
#include "tests/modeling/cad_files.h"

namespace palpa::modeling {
namespace {

using tests::Folder;

const std::array<const char*, 3> kFormats{"solid.step", "solid.igs", "solid.brep"};

std::vector<std::pair<std::string, Solid>> primitives() {
  return {{"sphere", makeSphere(25)},
          {"tiny sphere", makeSphere(0.05)},
          {"cylinder", makeCylinder(15, 40)},
          {"box", makeBox({40, 30, 20})}};
}

/// Solid with every control point moved randomly by up to three per cent of the size.
Solid shaken(const Solid& solid, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.03, 0.03);
  const auto box = boundingBox(solid);
  const double size = (box[1] - box[0]).minCoeff();
  std::vector<Eigen::Vector3d> points = solid.controlPoints();
  for (auto& p : points) p += size * Eigen::Vector3d(shift(random), shift(random), shift(random));
  return solid.withControlPoints(points);
}

int countOf(const TopoDS_Shape& shape, TopAbs_ShapeEnum type) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, type, map);
  return map.Extent();
}

void expectSame(const Solid& a, const Solid& b, const std::string& what) {
  const auto box = boundingBox(a);
  const double size = (box[1] - box[0]).norm();
  ASSERT_EQ(a.patches().size(), b.patches().size()) << what;
  ASSERT_EQ(a.controlPoints().size(), b.controlPoints().size()) << what;
  for (std::size_t p = 0; p < a.patches().size(); ++p) {
    const Patch& one = a.patches()[p];
    const Patch& two = b.patches()[p];
    EXPECT_EQ(one.name, two.name) << what;
    EXPECT_EQ(one.degree, two.degree) << what;
    EXPECT_EQ(one.net, two.net) << what;
    for (int d : {0, 1}) {
      ASSERT_EQ(one.knots[d].size(), two.knots[d].size()) << what;
      for (std::size_t k = 0; k < one.knots[d].size(); ++k)
        EXPECT_NEAR(one.knots[d][k], two.knots[d][k], 1e-12) << what;
    }
  }
  for (std::size_t i = 0; i < a.controlPoints().size(); ++i)
    EXPECT_LE((a.controlPoints()[i] - b.controlPoints()[i]).norm(), 1e-9 * size)
        << what << " " << i;
}

TEST(CadExport, AWrittenSolidIsReadBackUnchanged) {
  const Folder folder;
  for (const auto& [name, solid] : primitives())
    for (const char* format : kFormats)
      for (unsigned seed : {0u, 1u, 2u}) {
        const Solid written = seed ? shaken(solid, seed) : solid;
        const auto path = folder.file(format);
        exportCad(written, path, name);
        const ImportedBody read = importCad(path);
        const std::string what = name + " as " + format;
        EXPECT_TRUE(read.notes.empty()) << what << ": " << read.notes.front();
        EXPECT_LE(read.deviation, 1e-9 * 100) << what;
        ASSERT_TRUE(std::holds_alternative<Solid>(read.body)) << what;
        expectSame(written, std::get<Solid>(read.body), what);
      }
}

TEST(CadExport, TheShapeIsAValidClosedSolidWithTheSameVolume) {
  const Folder folder;
  for (const auto& [name, solid] : primitives()) {
    exportCad(solid, folder.file("solid.brep"));
    TopoDS_Shape shape;
    BRepTools::Read(shape, folder.file("solid.brep").c_str(), BRep_Builder());
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid()) << name;
    EXPECT_EQ(countOf(shape, TopAbs_FACE), static_cast<int>(solid.patches().size()));
    EXPECT_EQ(countOf(shape, TopAbs_EDGE), static_cast<int>(solid.edges().size()));
    EXPECT_EQ(countOf(shape, TopAbs_VERTEX), 8);
    const double expected = volume(solid);
    EXPECT_NEAR(tests::volumeOf(shape), expected, 1e-6 * expected) << name;
  }
}

TEST(CadExport, UnusualNamesAreKept) {
  const Folder folder;
  const Solid box = makeBox({4, 3, 2});
  std::vector<Patch> patches = box.patches();
  const std::vector<std::string> names{"it's",   "größe 5", "a;b,c(d)",
                                       "x/*y*/", "#12",     "back\\slash"};
  for (std::size_t p = 0; p < names.size(); ++p) patches[p].name = names[p];
  const Solid solid(box.controlPoints(), patches);
  for (const char* format : kFormats) {
    exportCad(solid, folder.file(format));
    EXPECT_EQ(patchNames(importCad(folder.file(format)).body), names) << format;
  }
}

TEST(CadExport, RefusesInvalidInputAndKeepsTheOldFile) {
  const Folder folder;
  const auto messageOf = [&](const Body& body, const std::filesystem::path& path) -> std::string {
    try {
      exportCad(body, path);
    } catch (const ModelingError& error) {
      return error.what();
    }
    return "";
  };
  const MeshBody tetrahedron({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                              {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
                              {0, 0, 0, 0},
                              {"all"}});
  EXPECT_NE(messageOf(tetrahedron, folder.file("a.step")).find("STL, OBJ or PLY"),
            std::string::npos);
  EXPECT_NE(messageOf(Solid(), folder.file("a.step")).find("no patches"), std::string::npos);
  const Solid box = makeBox({4, 3, 2});
  EXPECT_NE(messageOf(box, folder.file("a.txt")).find(".step, .stp"), std::string::npos);
  EXPECT_NE(messageOf(box, folder.file("none/a.step")).find("cannot be written"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
  exportCad(box, folder.file("a.step"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.step.new")));
}

}  // namespace
}  // namespace palpa::modeling
