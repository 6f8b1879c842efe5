#include <gtest/gtest.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Builder.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <random>
#include <thread>

#include "modeling/error.h"
#include "modeling/exchange/cad_export.h"
#include "modeling/exchange/import.h"
#include "modeling/shapes/primitives.h"
#include "tests/modeling/cad_files.h"
#include "tests/modeling/cad_shapes.h"

namespace palpa::modeling {
namespace {

using tests::Folder;
using tests::says;

const std::array<const char*, 3> kFormats{"body.step", "body.igs", "body.brep"};

/// Message of the error; "accepted" if there is none.
std::string errorOf(const std::filesystem::path& path) {
  return tests::errorOf([&] { importBody(path); });
}

TEST(CadBadFiles, AreRefusedWithTheirNameAndTheReason) {
  const Folder folder;
  const auto path = [&](const char* name) { return folder.file(name); };
  EXPECT_TRUE(says(errorOf(path("none.step")), "none.step: there is no such file"));
  EXPECT_TRUE(says(errorOf(path("none.xyz")), "the name must end in .step"));
  std::filesystem::create_directory(path("folder.step"));
  EXPECT_TRUE(says(errorOf(path("folder.step")), "is not a file"));
  for (const char* format : kFormats) {
    tests::writeText(path(format), "");
    EXPECT_TRUE(says(errorOf(path(format)), "is empty"));
    tests::writeText(path(format), "solid cube\nfacet normal 0 0 1\n");
    EXPECT_TRUE(says(errorOf(path(format)), std::string(format) + ": ")) << format;
    tests::writeText(path(format), std::string(100000, '\xff'));
    EXPECT_NE(errorOf(path(format)), "accepted");
  }
  tests::writeText(path("other.step"), "solid cube\n");
  EXPECT_TRUE(says(errorOf(path("other.step")), "is not a STEP file"));
}

TEST(CadBadFiles, StepTextIsCheckedWithItsLine) {
  const Folder folder;
  const auto path = folder.file("a.step");
  const auto withData = [&](const std::string& data) {
    tests::writeText(
        path, "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + data + "\nENDSEC;\nEND-ISO-10303-21;\n");
    return errorOf(path);
  };
  EXPECT_TRUE(says(withData("#1=A(#2);"), "line 5: refers to #2, which is not in the file"));
  EXPECT_TRUE(says(withData("#1=A(#2);\n#2=B(#1);"), "refers to itself in a cycle"));
  EXPECT_TRUE(says(withData("#1=A();\n#1=A();"), "line 6: #1 is defined twice"));
  EXPECT_TRUE(says(withData("#1=A(();"), "line 5: a closing parenthesis is missing"));
  EXPECT_TRUE(says(withData("#1=A('open);"), "cut off in a text in quotes"));
  EXPECT_TRUE(says(withData("#1=A(" + std::string(1000, '(')), "nested too deeply"));
  EXPECT_TRUE(says(withData("#99999999999999999999=A();"), "is too long"));
  EXPECT_NE(withData("#1=A('it''s; #7',/* #8 */ 3);"),
            "accepted");  // well formed, but without a shape
  EXPECT_TRUE(says(withData("#1=A('it''s; #7',/* #8 */ 3);"), "shape"));
}

TEST(CadBadFiles, MessagesAreNotOpenCascades) {
  // OpenCASCADE itself prints "Not a Curve table".
  const Folder folder;
  const auto path = folder.file("body.brep");
  tests::writeForeign(tests::quarterPipe(), path);
  std::string text = tests::readText(path);
  const std::string heading = "\nCurve2ds ";
  const std::size_t count = text.find(heading) + heading.size();
  ASSERT_LT(count, text.size());
  tests::writeText(path, text.replace(count, text.find('\n', count) - count, "1"));
  EXPECT_EQ(errorOf(path).find(path.string() + ": "), 0U) << errorOf(path);
}

TEST(CadBadFiles, TruncatedFilesAreErrors) {
  const Folder folder;
  for (const char* format : kFormats) {
    tests::writeForeign(tests::quarterPipe(), folder.file(format));
    const std::string text = tests::readText(folder.file(format));
    // The last characters contain no data.
    for (int part = 1; part <= 12; ++part) {
      tests::writeText(folder.file(format), text.substr(0, text.size() * part / 12 - 12));
      EXPECT_TRUE(says(errorOf(folder.file(format)), format)) << part;
    }
  }
}

TEST(CadBadFiles, DamagedFilesAreErrorsOrBodies) {
  // Some of these files crash OpenCASCADE; the importer must survive.
  const Folder folder;
  std::mt19937 random(5);
  for (const char* format : kFormats) {
    tests::writeForeign(tests::quarterPipe(), folder.file(format));
    const std::string text = tests::readText(folder.file(format));
    for (int i = 0; i < 25; ++i) {
      std::string damaged = text;
      for (int changed = 0; changed < 3;) {
        char& c = damaged[random() % damaged.size()];
        if (!std::isdigit(static_cast<unsigned char>(c))) continue;
        c = static_cast<char>('0' + random() % 10);
        ++changed;
      }
      tests::writeText(folder.file(format), damaged);
      const std::string message = errorOf(folder.file(format));
      EXPECT_TRUE(message == "accepted" || says(message, format)) << message;
    }
  }
}

TEST(CadBadFiles, OpenShellsAndSeveralSolidsAreNamed) {
  const Folder folder;
  const BRep_Builder builder;
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(40.0, 30.0, 20.0).Shape();
  TopoDS_Compound open;
  builder.MakeCompound(open);
  int faces = 0;
  for (TopExp_Explorer f(box, TopAbs_FACE); f.More(); f.Next())
    if (++faces < 6) builder.Add(open, f.Current());
  TopoDS_Compound two;
  builder.MakeCompound(two);
  builder.Add(two, box);
  builder.Add(two, BRepPrimAPI_MakeBox(gp_Pnt(50, 0, 0), 1.0, 2.0, 3.0).Shape());
  TopoDS_Compound none;
  builder.MakeCompound(none);
  for (TopExp_Explorer e(box, TopAbs_EDGE); e.More(); e.Next()) builder.Add(none, e.Current());
  for (const char* format : {"body.step", "body.brep"}) {
    tests::writeForeign(open, folder.file(format));
    // The missing face is the one at z = 20; the midpoints of its edges lie on its border.
    EXPECT_TRUE(says(errorOf(folder.file(format)), "the surface is not closed: an edge near ("));
    EXPECT_TRUE(says(errorOf(folder.file(format)), ", 20) mm belongs to one face only"));
    tests::writeForeign(two, folder.file(format));
    EXPECT_TRUE(says(errorOf(folder.file(format)), "contains 2 solids"));
    tests::writeForeign(none, folder.file(format));
    EXPECT_TRUE(says(errorOf(folder.file(format)), "contains no faces"));
  }
}

TEST(CadBadFiles, CancellingStopsImportAndExport) {
  const Folder folder;
  const auto path = folder.file("a.step");
  const Solid sphere = makeSphere(10);
  exportCad(sphere, path);
  const std::string before = tests::readText(path);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(importCad(path, {}, {stop.get_token(), {}}), Cancelled);
  EXPECT_THROW(exportCad(sphere, path, "", {stop.get_token(), {}}), Cancelled);
  EXPECT_EQ(tests::readText(path), before);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.step.new")));
  // Stops from inside, when the second stage reports its progress.
  std::stop_source later;
  const Job job{later.get_token(), [&](Phase, double) { later.request_stop(); }};
  EXPECT_THROW(importCad(path, {}, job), Cancelled);
}

TEST(CadBadFiles, ThreadsMayImportAndExportConcurrently) {
  const Folder folder;
  std::array<std::size_t, 4> points{};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      const auto path = folder.file("a" + std::to_string(i) + (i % 2 ? ".step" : ".igs"));
      exportCad(makeSphere(10 + i, 5 + i), path);
      points[i] = std::get<Solid>(importCad(path).body).controlPoints().size();
    });
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(points[i], makeSphere(10, 5 + i).controlPoints().size());
}

}  // namespace
}  // namespace palpa::modeling
