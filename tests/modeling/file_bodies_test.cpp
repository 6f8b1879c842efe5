// Choosing among the solids of a CAD file, its unit, scale and orientation.
#include "modeling/exchange/file_bodies.h"

#include <gtest/gtest.h>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <gp_Ax1.hxx>
#include <map>
#include <numbers>

#include "modeling/exchange/import.h"
#include "tests/modeling/cad_files.h"
#include "tests/modeling/cad_shapes.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using tests::errorOf;
using tests::Folder;
using tests::says;

const std::array<const char*, 3> kFormats{"body.step", "body.igs", "body.brep"};

TopoDS_Shape box(double x, double y, double z) {
  return BRepPrimAPI_MakeBox(x, y, z).Shape();
}

TopoDS_Shape moved(const TopoDS_Shape& shape, double x, double y, double z) {
  gp_Trsf by;
  by.SetTranslation({x, y, z});
  return shape.Moved(by);
}

TopoDS_Shape turnedAboutX(const TopoDS_Shape& shape) {
  gp_Trsf by;
  by.SetRotation(gp_Ax1({0, 0, 0}, {1, 0, 0}), std::numbers::pi / 2);
  return shape.Moved(by);
}

TopoDS_Shape compound(const std::vector<TopoDS_Shape>& parts) {
  const BRep_Builder builder;
  TopoDS_Compound result;
  builder.MakeCompound(result);
  for (const TopoDS_Shape& part : parts) builder.Add(result, part);
  return result;
}

/// Faces without solids and shells.
TopoDS_Shape looseFaces(const std::vector<TopoDS_Shape>& shapes) {
  std::vector<TopoDS_Shape> faces;
  for (const TopoDS_Shape& shape : shapes)
    for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) faces.push_back(f.Current());
  return compound(faces);
}

void writeAssembly(const TopoDS_Shape& shape, const std::filesystem::path& path) {
  STEPControl_Controller::Init();
  Interface_Static::SetIVal("write.step.assembly", 1);
  tests::writeForeign(shape, path);
  Interface_Static::SetIVal("write.step.assembly", 0);
}

/// Gives the entities of a kind names, in the order of the file: the first `texts` texts of each.
void rename(const std::filesystem::path& path, const std::string& kind,
            const std::vector<std::string>& names, int texts = 1) {
  std::string text = tests::readText(path);
  std::size_t at = 0;
  for (const std::string& name : names) {
    at = text.find(kind + "('", at);
    ASSERT_NE(at, std::string::npos) << kind;
    for (int i = 0; i < texts; ++i) {
      at = text.find('\'', at) + 1;
      text.replace(at, text.find('\'', at) - at, name);
      at = text.find('\'', at) + 1;
    }
  }
  tests::writeText(path, text);
}

std::vector<std::string> namesOf(const FileBodies& found) {
  std::vector<std::string> names;
  for (const FileBody& body : found.bodies) names.push_back(body.name);
  return names;
}

void expectBox(const FileBody& body, const Vector3d& low, const Vector3d& high) {
  EXPECT_LT((body.low - low).norm(), 1e-6) << body.name << ": " << body.low.transpose();
  EXPECT_LT((body.high - high).norm(), 1e-6) << body.name << ": " << body.high.transpose();
}

void expectBox(const Body& body, const Vector3d& low, const Vector3d& high) {
  const auto found = boundingBox(body);
  EXPECT_LT((found[0] - low).norm(), 1e-6) << found[0].transpose();
  EXPECT_LT((found[1] - high).norm(), 1e-6) << found[1].transpose();
}

ImportedBody importSolid(const std::filesystem::path& path, const std::string& solid) {
  ImportOptions options;
  options.solid = solid;
  return importBody(path, options);
}

TEST(FileBodies, SolidsAreListedWithSizesAndChosenByNumber) {
  const Folder folder;
  const TopoDS_Shape shape = compound({box(40, 30, 20), moved(tests::boredCylinder(), 100, 0, 0)});
  for (const char* format : kFormats) {
    const auto path = folder.file(format);
    tests::writeForeign(shape, path);  // IGES: loose faces, which are sewn
    const FileBodies found = listBodies(path);
    ASSERT_EQ(found.bodies.size(), 2U) << format;
    EXPECT_EQ(found.unit, 1.0);
    EXPECT_EQ(found.statesUnit, format != kFormats[2]);
    expectBox(found.bodies[0], {0, 0, 0}, {40, 30, 20});
    expectBox(found.bodies[1], {80, -20, 0}, {120, 20, 30});
    EXPECT_EQ(found.bodies[0].faces, 6);
    EXPECT_EQ(found.bodies[1].faces, 4);
    EXPECT_NEAR(found.bodies[0].volume, 24000.0, 1e-6);
    const double bored = std::numbers::pi * (400.0 - 64.0) * 30.0;
    EXPECT_NEAR(found.bodies[1].volume, bored, 1e-3 * bored);
    EXPECT_TRUE(found.bodies[0].surface.empty());

    const ImportedBody first = importSolid(path, "1");
    EXPECT_TRUE(std::holds_alternative<Solid>(first.body)) << format;
    expectBox(first.body, {0, 0, 0}, {40, 30, 20});
    const ImportedBody second = importSolid(path, found.bodies[1].name);
    EXPECT_TRUE(std::holds_alternative<MeshBody>(second.body)) << format;
    EXPECT_NEAR(volume(second.body), bored, 0.02 * bored);
    EXPECT_TRUE(says(second.notes.front(), "Read solid 2 of 2, \""));
  }
}

TEST(FileBodies, SeveralSolidsWithoutAChoiceAreListedInTheError) {
  const Folder folder;
  const auto path = folder.file("two.step");
  tests::writeForeign(compound({box(40, 30, 20), moved(box(1, 2, 3), 50, 0, 0)}), path);
  const std::string none = errorOf([&] { importBody(path); });
  EXPECT_TRUE(
      says(none, "two.step: contains 2 solids, but a project has one body; choose one: 1 "));
  EXPECT_TRUE(says(none, "of 40 × 30 × 20 mm; 2 "));
  EXPECT_TRUE(says(none, "of 1 × 2 × 3 mm"));
  EXPECT_THROW(importBody(path), SeveralBodies);
  for (const char* wrong : {"0", "3", "lid", "1x", "-1"}) {
    const std::string error = errorOf([&] { importSolid(path, wrong); });
    EXPECT_TRUE(says(error, "two.step: has no solid \"" + std::string(wrong) + "\"; its solids"));
    EXPECT_TRUE(says(error, "of 1 × 2 × 3 mm"));
  }
  // The choice is not necessary, but possible, for a single solid.
  tests::writeForeign(box(1, 2, 3), path);
  EXPECT_TRUE(importSolid(path, "1").name.empty());
  EXPECT_TRUE(importSolid(path, "1").notes.empty());
  EXPECT_TRUE(says(errorOf([&] { importSolid(path, "2"); }), "has no solid \"2\""));
}

TEST(FileBodies, AssembliesPlaceTheirSolidsAndNameThem) {
  const Folder folder;
  const auto path = folder.file("assembly.step");
  // The same screw twice, once in a turned subassembly, and a block.
  const TopoDS_Shape screw = BRepPrimAPI_MakeCylinder(3.0, 20.0).Shape();
  const TopoDS_Shape block = box(10, 8, 6);
  const TopoDS_Shape sub = compound({moved(screw, 0, 0, 5), block});
  writeAssembly(compound({moved(screw, 50, 0, 0), moved(turnedAboutX(sub), 0, 0, 100)}), path);
  const FileBodies plain = listBodies(path);
  ASSERT_EQ(plain.bodies.size(), 3U);
  // Turned about x: y becomes z, z becomes -y.
  expectBox(plain.bodies[0], {47, -3, 0}, {53, 3, 20});
  expectBox(plain.bodies[1], {-3, -25, 97}, {3, -5, 103});
  expectBox(plain.bodies[2], {0, -6, 100}, {10, 0, 108});
  for (int i = 0; i < 3; ++i) {
    const ImportedBody read = importSolid(path, std::to_string(i + 1));
    const auto [low, high] = boundingBox(read.body);
    EXPECT_LT((low - plain.bodies[i].low).norm(), 0.5) << i;  // facets of the mesh bodies
    EXPECT_LT((high - plain.bodies[i].high).norm(), 0.5) << i;
    EXPECT_NEAR(volume(read.body), plain.bodies[i].volume, 0.03 * plain.bodies[i].volume) << i;
  }
  // A block placed twice is a NUBS solid at both places.
  EXPECT_TRUE(std::holds_alternative<Solid>(importSolid(path, "3").body));
  expectBox(importSolid(path, "3").body, {0, -6, 100}, {10, 0, 108});

  rename(path, "PRODUCT", {"machine", "screw", "arm", "block"}, 2);
  EXPECT_EQ(namesOf(listBodies(path)), (std::vector<std::string>{"screw_1", "screw_2", "block"}));
  const ImportedBody named = importSolid(path, "block");
  EXPECT_EQ(named.name, "block");
  EXPECT_EQ(named.notes.front(), "Read solid 3 of 3, \"block\".");

  rename(path, "ADVANCED_FACE", {"side", "end", "base", "a", "b", "c", "d", "e", "f"});
  EXPECT_EQ(patchNames(importSolid(path, "block").body),
            (std::vector<std::string>{"a", "b", "c", "d", "e", "f"}));
  EXPECT_EQ(patchNames(importSolid(path, "screw_2").body),
            (std::vector<std::string>{"side", "end", "base"}));
}

TEST(FileBodies, SolidsOfOnePartHaveTheirOwnNames) {
  const Folder folder;
  const auto path = folder.file("part.step");
  tests::writeForeign(compound({box(1, 2, 3), moved(box(4, 5, 6), 10, 0, 0)}), path);
  const FileBodies found = listBodies(path);
  EXPECT_EQ(found.bodies.size(), 2U);
  rename(path, "MANIFOLD_SOLID_BREP", {"lid", "lid"});
  EXPECT_EQ(namesOf(listBodies(path)), (std::vector<std::string>{"lid_1", "lid_2"}));
  rename(path, "MANIFOLD_SOLID_BREP", {"lid", "pot"});
  EXPECT_EQ(namesOf(listBodies(path)), (std::vector<std::string>{"lid", "pot"}));
  // A BREP file has no names.
  tests::writeForeign(compound({box(1, 2, 3), moved(box(4, 5, 6), 10, 0, 0)}),
                      folder.file("part.brep"));
  EXPECT_EQ(namesOf(listBodies(folder.file("part.brep"))),
            (std::vector<std::string>{"solid_1", "solid_2"}));
  EXPECT_EQ(importSolid(folder.file("part.brep"), "2").name, "part_solid_2");
}

TEST(FileBodies, ASolidInsideAnotherIsChosenAlone) {
  const Folder folder;
  const TopoDS_Shape shape = compound({box(40, 40, 40), moved(box(10, 10, 10), 15, 15, 15)});
  for (const char* format : {"body.step", "body.brep"}) {
    tests::writeForeign(shape, folder.file(format));
    EXPECT_NEAR(volume(importSolid(folder.file(format), "1").body), 64000.0, 1e-6);
    EXPECT_NEAR(volume(importSolid(folder.file(format), "2").body), 1000.0, 1e-6);
  }
}

TEST(FileBodies, LooseFacesInsideOthersAreCavitiesAndTheBodiesInThem) {
  const Folder folder;
  for (const char* format : {"body.igs", "body.brep"}) {
    const auto path = folder.file(format);
    tests::writeForeign(
        looseFaces({moved(box(20, 20, 20), 10, 10, 10), box(40, 40, 40),
                    moved(box(4, 4, 4), 18, 18, 18), moved(box(5, 6, 7), 60, 0, 0)}),
        path);
    const FileBodies found = listBodies(path);
    ASSERT_EQ(found.bodies.size(), 3U) << format;
    std::vector<double> volumes;
    for (std::size_t i = 0; i < 3; ++i)
      volumes.push_back(volume(importSolid(path, std::to_string(i + 1)).body));
    std::sort(volumes.begin(), volumes.end());
    EXPECT_NEAR(volumes[0], 64.0, 1e-6) << format;
    EXPECT_NEAR(volumes[1], 210.0, 1e-6) << format;
    EXPECT_NEAR(volumes[2], 64000.0 - 8000.0, 1e-6) << format;
  }
}

TEST(FileBodies, TheUnitOfTheFileIsKnownAndCorrected) {
  const Folder folder;
  const auto path = folder.file("inch.step");
  for (const auto& [unit, mm] : std::map<std::string, double>{
           {"MM", 1.0}, {"INCH", 25.4}, {"M", 1000.0}, {"CM", 10.0}, {"FT", 304.8}}) {
    tests::writeForeign(box(40, 30, 20), path, unit);
    EXPECT_NEAR(listBodies(path).unit, mm, 1e-9 * mm) << unit;
    expectBox(listBodies(path).bodies[0], {0, 0, 0}, {40, 30, 20});
    // The numbers in the file are 40 / mm, …; they are now meant in cm.
    ImportPlacement placement;
    placement.unit = 10.0;
    const Vector3d size = 10.0 / mm * Vector3d(40, 30, 20);
    expectBox(listBodies(path, placement).bodies[0], {0, 0, 0}, size);
    ImportOptions options;
    options.placement = placement;
    expectBox(importBody(path, options).body, {0, 0, 0}, size);
  }
}

/// The data of both files in one, with the numbers of the second one shifted.
std::string joined(const std::string& a, const std::string& b) {
  const std::size_t end = a.rfind("ENDSEC;");
  const std::size_t begin = b.find("DATA;") + 5;
  const std::string second = b.substr(begin, b.rfind("ENDSEC;") - begin);
  std::string shifted;
  for (std::size_t i = 0; i < second.size(); ++i) {
    shifted += second[i];
    if (second[i] != '#') continue;
    const std::size_t stop = second.find_first_not_of("0123456789", i + 1);
    shifted += std::to_string(std::stoi(second.substr(i + 1, stop - i - 1)) + 100000);
    i = stop - 1;
  }
  return a.substr(0, end) + shifted + a.substr(end);
}

TEST(FileBodies, PartsInDifferentUnitsAreConvertedButNotCorrected) {
  const Folder folder;
  tests::writeForeign(box(40, 30, 20), folder.file("a.step"));
  tests::writeForeign(moved(box(1, 2, 3), 50, 0, 0), folder.file("b.step"), "INCH");
  const auto path = folder.file("mixed.step");
  tests::writeText(
      path, joined(tests::readText(folder.file("a.step")), tests::readText(folder.file("b.step"))));
  const FileBodies found = listBodies(path);
  ASSERT_EQ(found.bodies.size(), 2U);
  EXPECT_EQ(found.unit, 0.0);
  expectBox(found.bodies[0], {0, 0, 0}, {40, 30, 20});
  expectBox(found.bodies[1], {50, 0, 0}, {51, 2, 3});
  ImportPlacement placement;
  placement.scale = 2.0;
  expectBox(listBodies(path, placement).bodies[1], {100, 0, 0}, {102, 4, 6});
  placement.unit = 10.0;
  const std::string words = "mixed.step: has parts in different units of length";
  EXPECT_TRUE(says(errorOf([&] { listBodies(path, placement); }), words));
  ImportOptions options;
  options.solid = "1";
  options.placement = placement;
  EXPECT_TRUE(says(errorOf([&] { importBody(path, options); }), words));
}

TEST(FileBodies, SolidsAndMeshBodiesAreScaledAndTurned) {
  const Folder folder;
  const auto path = folder.file("body.step");
  const std::map<UpAxis, std::array<Vector3d, 2>> boxes{
      // The box from (0, 0, 0) to (4, 3, 2): the given axis becomes +z.
      {UpAxis::kX, {Vector3d(-2, 0, 0), Vector3d(0, 3, 4)}},
      {UpAxis::kMinusX, {Vector3d(0, 0, -4), Vector3d(2, 3, 0)}},
      {UpAxis::kY, {Vector3d(0, -2, 0), Vector3d(4, 0, 3)}},
      {UpAxis::kMinusY, {Vector3d(0, 0, -3), Vector3d(4, 2, 0)}},
      {UpAxis::kZ, {Vector3d(0, 0, 0), Vector3d(4, 3, 2)}},
      {UpAxis::kMinusZ, {Vector3d(0, -3, -2), Vector3d(4, 0, 0)}}};
  for (const TopoDS_Shape& shape :
       {box(4, 3, 2), TopoDS_Shape(tests::splitBox())}) {  // a NUBS solid and a mesh body
    tests::writeForeign(shape, path);
    const Body plain = importBody(path).body;
    for (const auto& [up, corners] : boxes) {
      ImportOptions options;
      options.placement = {0.0, 2.5, up};
      const ImportedBody read = importBody(path, options);
      EXPECT_EQ(read.body.index(), plain.index());
      EXPECT_EQ(patchNames(read.body), patchNames(plain));
      EXPECT_NEAR(volume(read.body), 15.625 * volume(plain), 1e-9 * volume(read.body));
      const auto [low, high] = boundingBox(read.body);
      const FileBody listed = listBodies(path, options.placement).bodies[0];
      EXPECT_LT((listed.low - low).norm() + (listed.high - high).norm(), 1e-6);
      EXPECT_NEAR(listed.volume, volume(read.body), 1e-6 * listed.volume);
      if (std::holds_alternative<Solid>(plain))
        expectBox(read.body, 2.5 * corners[0], 2.5 * corners[1]);
      EXPECT_TRUE(rotationOf(up).determinant() == 1.0);
    }
  }
}

TEST(FileBodies, LengthsOfTheOptionsAndNotesAreThoseOfThePlacedBody) {
  const Folder folder;
  const auto path = folder.file("body.step");
  ImportOptions plain;
  plain.tolerance = 1e-3;
  plain.edgeLength = 2.0;
  ImportOptions scaled;
  scaled.tolerance = 1e-2;
  scaled.edgeLength = 20.0;
  scaled.placement.scale = 10.0;
  for (const TopoDS_Shape& shape : {tests::quarterPipe(), tests::boredCylinder()}) {
    tests::writeForeign(shape, path);
    const ImportedBody a = importBody(path, plain);
    const ImportedBody b = importBody(path, scaled);
    EXPECT_NEAR(b.deviation, 10.0 * a.deviation, 1e-9 * b.deviation);
    const auto count = [](const Body& body) {
      const auto* solid = std::get_if<Solid>(&body);
      return solid ? solid->controlPoints().size() : std::get<MeshBody>(body).positions().size();
    };
    EXPECT_EQ(count(a.body), count(b.body));
    EXPECT_EQ(a.notes.size(), b.notes.size());
    EXPECT_NE(a.notes.back(), b.notes.back());  // has the ten times larger deviation
  }
}

TEST(FileBodies, PlacementsAreChecked) {
  const Folder folder;
  const auto path = folder.file("body.step");
  tests::writeForeign(box(4, 3, 2), path);
  const auto error = [&](const ImportPlacement& placement) {
    ImportOptions options;
    options.placement = placement;
    return errorOf([&] { importBody(path, options); });
  };
  EXPECT_TRUE(says(error({0.0, 0.0, UpAxis::kZ}), "scale: 0 is out of range"));
  EXPECT_TRUE(says(error({0.0, -1.0, UpAxis::kZ}), "scale: -1 is out of range"));
  EXPECT_TRUE(says(error({-1.0, 1.0, UpAxis::kZ}), "unit: -1 is out of range"));
  EXPECT_TRUE(says(error({1e6, 1e3, UpAxis::kZ}), "body.step: reaches ("));
  EXPECT_TRUE(says(error({1e6, 1e3, UpAxis::kZ}), "check the unit and the scale"));
}

TEST(FileBodies, AWrongUnitIsSuspected) {
  const Folder folder;
  const auto path = folder.file("body.step");
  tests::writeForeign(box(4, 3, 2), path);
  const auto notes = [&](double scale) {
    ImportOptions options;
    options.placement.scale = scale;
    return importBody(path, options).notes;
  };
  EXPECT_TRUE(notes(1.0).empty());
  EXPECT_TRUE(notes(1250.0).empty());
  EXPECT_EQ(notes(1300.0).back(), "The body is 5,200 mm in size: check the unit of the file.");
  EXPECT_EQ(notes(0.02).back(), "The body is only 0.08 mm in size: check the unit of the file.");
}

TEST(FileBodies, PicturesFollowThePlacedSolids) {
  const Folder folder;
  const auto path = folder.file("assembly.step");
  const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(10.0).Shape();
  writeAssembly(compound({moved(ball, 50, 0, 0), turnedAboutX(moved(ball, 0, 0, 30))}), path);
  ImportPlacement placement;
  placement.scale = 2.0;
  placement.up = UpAxis::kY;
  const FileBodies found = listBodies(path, placement, ListedSurface::kCoarse);
  ASSERT_EQ(found.bodies.size(), 2U);
  const std::array<Vector3d, 2> centres{Vector3d(100, 0, 0), Vector3d(0, 0, -60)};
  for (std::size_t i = 0; i < 2; ++i) {
    const FileBody& body = found.bodies[i];
    EXPECT_GT(body.surface.size(), 50U);
    double enclosed = 0.0;
    for (const auto& [a, b, c] : body.surface)
      enclosed += body.positions[a].dot(body.positions[b].cross(body.positions[c])) / 6.0;
    EXPECT_NEAR(enclosed, body.volume, 0.1 * body.volume);  // outwards
    for (const Vector3d& p : body.positions) EXPECT_NEAR((p - centres[i]).norm(), 20.0, 1e-6);
  }
}

TEST(FileBodies, ListingReadsNothingThatCrashes) {
  const Folder folder;
  EXPECT_TRUE(
      says(errorOf([&] { listBodies(folder.file("none.step")); }), "there is no such file"));
  EXPECT_TRUE(says(errorOf([&] { listBodies(folder.file("none.xyz")); }), "must end in .step"));
  const auto path = folder.file("body.step");
  tests::writeForeign(compound({box(1, 2, 3), moved(box(4, 5, 6), 10, 0, 0)}), path);
  const std::string text = tests::readText(path);
  for (int part = 1; part < 8; ++part) {
    tests::writeText(path, text.substr(0, text.size() * part / 8));
    EXPECT_TRUE(says(errorOf([&] { listBodies(path); }), "body.step: ")) << part;
  }
  tests::writeText(path, text);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(listBodies(path, {}, ListedSurface::kNone, {stop.get_token(), {}}), Cancelled);
}

}  // namespace
}  // namespace palpa::modeling
