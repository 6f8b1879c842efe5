// Every reason for which a CAD file is refused, each with a small file made for it: the message
// names the place and what to do.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <gp_Pln.hxx>

#include "modeling/exchange/cad_answer.h"
#include "modeling/exchange/cad_mesh.h"
#include "modeling/exchange/import.h"
#include "modeling/exchange/sandboxed_read.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/cad_files.h"

namespace palpa::modeling {
namespace {

using tests::Folder;
using tests::says;

std::string errorOf(const std::filesystem::path& path) {
  return tests::errorOf([&] { importBody(path); });
}

TopoDS_Shape moved(const TopoDS_Shape& shape, double x) {
  gp_Trsf by;
  by.SetTranslation({x, 0, 0});
  return shape.Moved(by);
}

/// A shell of the faces as a solid.
TopoDS_Solid solidOf(const std::vector<TopoDS_Shape>& faces) {
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const TopoDS_Shape& face : faces) builder.Add(shell, face);
  shell.Closed(true);
  TopoDS_Solid solid;
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

std::vector<TopoDS_Shape> facesOf(const TopoDS_Shape& shape) {
  std::vector<TopoDS_Shape> faces;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) faces.push_back(f.Current());
  return faces;
}

TEST(CadRefusals, TextsThatAreNoStepFile) {
  const Folder folder;
  const auto path = folder.file("a.step");
  const auto withData = [&](const std::string& data) {
    tests::writeText(
        path, "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + data + "\nENDSEC;\nEND-ISO-10303-21;\n");
    return errorOf(path);
  };
  EXPECT_TRUE(says(withData("#=A();"), "line 5: expected a number after #; export the file again"));
  EXPECT_TRUE(says(withData("#1 A();"), "line 5: expected = after the number of an instance"));
  EXPECT_TRUE(says(withData("#1=A);"), "line 5: an opening parenthesis is missing; export"));
  EXPECT_TRUE(says(withData("#1=A();\n/* open"), "line 6: a comment has no end; export"));
  tests::writeText(path, "ISO-10303-21;\nDATA;\n#1=A()");
  EXPECT_TRUE(says(errorOf(path), "the file is cut off: a statement has no semicolon at its end"));
  tests::writeText(path, "ISO-10303-21;\nDATA;\n#1=A();\n");
  EXPECT_TRUE(says(errorOf(path), "the file is cut off: END-ISO-10303-21 is missing at its end; "));
  tests::writeText(path, "solid cube\n");
  EXPECT_TRUE(says(errorOf(path), "begin with ISO-10303-21: export it again, or correct its end"));
  EXPECT_TRUE(says(withData("#1=A();"), "contains no readable shape; export the part as a solid"));
  std::string faces;
  for (int i = 1; i <= 20001; ++i) faces += "#" + std::to_string(i) + "=ADVANCED_FACE();\n";
  EXPECT_TRUE(says(withData(faces), "has 20001 faces; at most 20000 are read: simplify the part"));
}

TEST(CadRefusals, TextsThatAreNoIgesFile) {
  const Folder folder;
  const auto path = folder.file("a.igs");
  const auto line = [](char section, int number, const std::string& text = "") {
    char end[20];
    std::snprintf(end, sizeof end, "%c%7d\n", section, number);
    return text + std::string(72 - text.size(), ' ') + end;
  };
  const auto error = [&](const std::string& text) {
    tests::writeText(path, text);
    return errorOf(path);
  };
  EXPECT_TRUE(says(error("solid\n"), "line 1: is not an IGES file, whose lines have 80 columns; "));
  const std::string start = line('S', 1);
  EXPECT_TRUE(says(error(start + "G\n"), "line 2: has fewer than 80 columns; the file is damaged"));
  EXPECT_TRUE(says(error(start + line('X', 1)), "line 2: column 73 names no section (S, G, D, P,"));
  EXPECT_TRUE(says(error(start + line('G', 7)), "line 2: the number of the line is not 1; export"));
  EXPECT_TRUE(says(error(start + line('G', 1)), "the file is cut off: the section T is missing"));
  EXPECT_TRUE(
      says(error(start + line('G', 1) + line('T', 1, "S      1G      2D      0P      0")),
           "line 3: does not agree with the number of lines in section G; export the file"));
}

TEST(CadRefusals, TextsThatAreNoBrepFile) {
  const Folder folder;
  const auto path = folder.file("a.brep");
  tests::writeText(path, "solid cube\n");
  EXPECT_TRUE(says(errorOf(path), "CASCADE Topology is missing at its beginning: export it again"));
  tests::writeForeign(BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape(), path);
  const std::string text = tests::readText(path);
  const auto with = [&](const std::string& word, const std::string& other) {
    std::string changed = text;
    tests::writeText(path, changed.replace(changed.find(word), word.size(), other));
    return errorOf(path);
  };
  EXPECT_TRUE(says(with("\nSurfaces ", "\nsurfaces "), "the section Surfaces is missing; export"));
  EXPECT_TRUE(
      says(with("\nSurfaces 6", "\nSurfaces 9999"),
           "the section Surfaces cannot have the number of entries that it states; export"));
  tests::writeText(
      path, text.substr(0, text.find('*', text.find("TShapes")) + 1) + std::string(500, '\n'));
  EXPECT_TRUE(says(errorOf(path), "the file is cut off: it has 1 of "));
  EXPECT_TRUE(says(errorOf(path), " shapes; export it again"));
  // Well-formed for the check, but the first curve has an unknown kind.
  const std::size_t curves = text.find("\nCurves ");
  const std::size_t curve = text.find('\n', curves + 1) + 1;
  std::string unknown = text;
  unknown[curve] = 'x';
  tests::writeText(path, unknown);
  EXPECT_NE(errorOf(path), "accepted");
  EXPECT_TRUE(says(errorOf(path), "a.brep: "));
}

TEST(CadRefusals, FilesThatAreTooLarge) {
  const Folder folder;
  const auto path = folder.file("a.step");
  tests::writeText(path, "ISO-10303-21;");
  std::filesystem::resize_file(path, std::uintmax_t{257} << 20);  // takes no space on the disk
  EXPECT_TRUE(says(errorOf(path), "a.step: has 257 MiB; at most 256 MiB are read: simplify"));
  const auto mesh = folder.file("a.stl");
  tests::writeText(mesh, "solid");
  std::filesystem::resize_file(mesh, std::uintmax_t{513} << 20);
  EXPECT_TRUE(says(errorOf(mesh), "a.stl: "));
  EXPECT_TRUE(says(errorOf(mesh), " bytes; at most 536870912 are "));
  // Faces of a file without a count in its text.
  const BRep_Builder builder;
  TopoDS_Compound many;
  builder.MakeCompound(many);
  const auto faces = facesOf(BRepPrimAPI_MakeBox(1.0, 1.0, 1.0).Shape());
  for (int i = 0; i < 3334; ++i)
    for (const TopoDS_Shape& face : faces) builder.Add(many, moved(face, 2.0 * i));
  tests::writeForeign(many, folder.file("a.brep"));
  EXPECT_TRUE(
      says(errorOf(folder.file("a.brep")), "has 20004 faces; at most 20000 are read: simp"));
}

TEST(CadRefusals, SizesThatNoPartHas) {
  const Folder folder;
  const auto path = folder.file("a.brep");
  tests::writeForeign(BRepPrimAPI_MakeBox(3e7, 1.0, 1.0).Shape(), path);
  EXPECT_TRUE(says(errorOf(path),
                   "a.brep: the shape has a size of 3e+07 mm; expected 0.000001 "
                   "mm … 20 km: correct the unit in the program that made the file"));
}

TEST(CadRefusals, ShapesThatEncloseNothing) {
  const Folder folder;
  const auto path = folder.file("a.brep");
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(40.0, 30.0, 20.0).Shape();
  const auto faces = facesOf(box);
  // Two faces with the same border.
  const TopoDS_Wire border = TopoDS::Wire(TopExp_Explorer(faces[0], TopAbs_WIRE).Current());
  const gp_Pln plane(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0));
  tests::writeForeign(solidOf({BRepBuilderAPI_MakeFace(plane, border).Shape(),
                               BRepBuilderAPI_MakeFace(plane, border).Shape().Reversed()}),
                      path);
  const std::string flat = errorOf(path);
  EXPECT_NE(flat, "accepted");
  EXPECT_TRUE(says(flat, "a.brep: ")) << flat;
  EXPECT_TRUE(says(flat, " encloses no volume; give it a thickness")) << flat;
  EXPECT_TRUE(says(flat, "the solid near (")) << flat;
  // A solid without faces beside a loose face.
  const BRep_Builder builder;
  TopoDS_Solid empty;
  builder.MakeSolid(empty);
  TopoDS_Compound both;
  builder.MakeCompound(both);
  builder.Add(both, empty);
  builder.Add(both, faces[0]);
  tests::writeForeign(both, path);
  EXPECT_TRUE(says(errorOf(path), "contains no surface; export the part as a solid"));
  // Two chambers with a common wall.
  BRepBuilderAPI_Sewing sewing(1e-6);
  sewing.SetNonManifoldMode(true);
  for (const TopoDS_Shape& face : faces) sewing.Add(face);
  const auto others = facesOf(BRepPrimAPI_MakeBox(gp_Pnt(40, 0, 0), 5, 30, 20));
  for (std::size_t i = 1; i < others.size(); ++i) sewing.Add(others[i]);  // the first is the wall
  sewing.Perform();
  tests::writeForeign(solidOf(facesOf(sewing.SewedShape())), path);
  EXPECT_TRUE(says(errorOf(path),
                   " belongs to 3 faces; a body has two at each edge: separate "
                   "bodies that touch, remove inner walls"));
  EXPECT_TRUE(says(errorOf(path), "an edge near (40, "));
}

TEST(CadRefusals, AFaceThatCannotBeTriangulatedIsNamed) {
  // A plane without a border.
  const TopoDS_Shape plane = BRepBuilderAPI_MakeFace(gp_Pln()).Shape();
  auto faces = facesOf(BRepPrimAPI_MakeBox(40.0, 30.0, 20.0).Shape());
  faces.push_back(plane);
  const std::string error = tests::errorOf([&] {
    makeMeshBody(solidOf(faces), {"a", "b", "c", "d", "e", "f", "endless"}, 0.1, {});
  });
  EXPECT_EQ(error,
            "no closed triangulation was found: OpenCASCADE cannot triangulate the face "
            "\"endless\"; repair this face, or export the part as STL");
}

TEST(CadRefusals, AFileThatNeedsTooMuchTime) {
  const Folder folder;
  const auto path = folder.file("a.brep");
  tests::writeForeign(BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape(), path);
  const std::string text = tests::readText(path);
  const std::string words =
      "a.brep: OpenCASCADE needs longer than 1e-06 s for the file; it is damaged or too "
      "complicated: simplify the part, or export it in another format";
  EXPECT_TRUE(says(tests::errorOf([&] { importInSandbox(path, text, {}, 1e-6, {}); }), words));
  EXPECT_TRUE(says(
      tests::errorOf([&] { listInSandbox(path, text, ListedSurface::kNone, 1e-6, {}); }), words));
  const auto nobody = [](std::size_t, const BodyOutcome&) { ADD_FAILURE(); };
  EXPECT_TRUE(says(tests::errorOf([&] { importAllInSandbox(path, text, 1, {}, nobody, 1e-6, {}); }),
                   words));
}

TEST(CadRefusals, TheAnswerOfPalpaReadCadIsChecked) {
  const std::string damaged = "the answer of palpa-read-cad is damaged: ";
  for (const char* line : {"{", "{}", "[]", "[1]", R"(["begun"])", R"(["begun", "one"])",
                           R"(["ended", 1, 2])", R"(["finished", 1])", R"(["body", {}])"})
    EXPECT_TRUE(says(tests::errorOf([&] { answerFrom(line); }), damaged)) << line;
  EXPECT_TRUE(says(tests::errorOf([] {
                     answerFrom(R"(["list", {"unit": 1, "states_unit": true, "bodies": []}])");
                   }),
                   "it lists no body"));
  FileBodies found;
  found.bodies.resize(1);
  found.bodies[0].surface = {{0, 1, 2}};
  EXPECT_TRUE(
      says(tests::errorOf([&] { answerFrom(toLine(found)); }), "a corner is not in the list"));
}

TEST(CadRefusals, OtherSolidsAreReadWhenOneCrashesOpenCascade) {
  ImportedBody box;
  box.body = makeBox({1, 2, 3});
  std::vector<std::size_t> runs;
  // Crashes at the solids 1 and 2.
  const auto run = [&](std::size_t first, const TakeAnswer& take) -> std::optional<ModelingError> {
    runs.push_back(first);
    for (std::size_t i = first; i < 4; ++i) {
      take(SolidBegun{i});
      if (i == 1 || i == 2) return ModelingError("crashes at " + std::to_string(i));
      take(SolidEnded{i, {box, ""}});
    }
    return std::nullopt;
  };
  std::vector<std::string> problems;
  importBehindCrashes(4, run, [&](std::size_t index, const BodyOutcome& outcome) {
    EXPECT_EQ(index, problems.size());
    EXPECT_EQ(outcome.imported.has_value(), outcome.problem.empty());
    problems.push_back(outcome.problem);
  });
  EXPECT_EQ(problems, (std::vector<std::string>{"", "crashes at 1", "crashes at 2", ""}));
  EXPECT_EQ(runs, (std::vector<std::size_t>{0, 2, 3}));
  const auto crash = [](std::size_t, const TakeAnswer&) {
    return std::optional(ModelingError("at once"));
  };
  const auto nobody = [](std::size_t, const BodyOutcome&) { ADD_FAILURE(); };
  EXPECT_EQ(tests::errorOf([&] { importBehindCrashes(4, crash, nobody); }), "at once");
}

TEST(CadRefusals, OneOfSeveralSolidsDoesNotStopTheOthers) {
  const Folder folder;
  const auto path = folder.file("a.brep");
  const BRep_Builder builder;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape();
  const auto faces = facesOf(box);
  TopoDS_Compound parts;
  builder.MakeCompound(parts);
  builder.Add(parts, box);
  builder.Add(parts, moved(solidOf({faces[0], faces[1], faces[2]}), 10.0));
  builder.Add(parts, moved(box, 20.0));
  tests::writeForeign(parts, path);
  int reads = 0;
  const Job job{{}, [&](Phase phase, double done) {
                  if (phase == Phase::kRead && done == 0.0) ++reads;
                }};
  std::vector<BodyOutcome> outcomes;
  importBodies(
      path, 4, {},
      [&](std::size_t index, BodyOutcome outcome) {
        EXPECT_EQ(index, outcomes.size());
        outcomes.push_back(std::move(outcome));
      },
      job);
  EXPECT_LE(reads, 2) << "the beginning and the end of one reading report the same";
  ASSERT_EQ(outcomes.size(), 4U);
  ASSERT_TRUE(outcomes[0].imported && outcomes[2].imported);
  EXPECT_EQ(outcomes[0].imported->name, "a_solid_1");
  EXPECT_NEAR(volume(outcomes[2].imported->body), 6.0, 1e-9);
  EXPECT_TRUE(says(outcomes[1].problem, "a.brep: the surface is not closed: an edge near (1"));
  EXPECT_TRUE(says(outcomes[3].problem, "a.brep: has only 3 solids now; list them again"));
}

}  // namespace
}  // namespace palpa::modeling
