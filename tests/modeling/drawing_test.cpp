// Curves of DXF and SVG files, and the profiles through them.
#include "modeling/exchange/drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "modeling/error.h"
#include "modeling/exchange/profile_import.h"
#include "modeling/project/text_file.h"
#include "modeling/shapes/profile.h"
#include "modeling/shapes/profile_sketch.h"
#include "shape_checks.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
const std::filesystem::path kFolder = PALPA_TEST_DATA "/drawings";

std::string svg(
    const std::string& content,
    const std::string& attributes = "width=\"100mm\" height=\"100mm\" viewBox=\"0 0 100 100\"") {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + attributes + ">\n" + content + "\n</svg>\n";
}

std::string dxf(const std::string& entities, const std::string& header = {}) {
  return header + "  0\nSECTION\n  2\nENTITIES\n" + entities + "  0\nENDSEC\n  0\nEOF\n";
}

std::string dxfUnit(int unit) {
  return "  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n" + std::to_string(unit) +
         "\n  0\nENDSEC\n";
}

DrawnPath onlyPathOf(const Drawing& drawing) {
  EXPECT_EQ(drawing.paths.size(), 1U);
  return drawing.paths.at(0);
}

std::string refusalOf(const std::function<void()>& read) {
  try {
    read();
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "no error";
}

std::string svgRefusal(const std::string& text) {
  return refusalOf([&] { readSvg(text, "a.svg"); });
}

std::string dxfRefusal(const std::string& text) {
  return refusalOf([&] { readDxf(text, "a.dxf"); });
}

/// Area inside a closed path, from many samples.
double areaOf(const DrawnPath& path) {
  double sum = 0.0;
  constexpr int kSamples = 200;
  for (const DrawnPiece& piece : path.pieces)
    for (int k = 0; k < kSamples; ++k) {
      const Vector2d a = piece.at(static_cast<double>(k) / kSamples);
      const Vector2d b = piece.at(static_cast<double>(k + 1) / kSamples);
      sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
  return std::abs(sum);
}

/// Largest difference of the distance to `centre` from `radius`.
double errorOfCircle(const DrawnPath& path, const Vector2d& centre, double radius) {
  double error = 0.0;
  for (const DrawnPiece& piece : path.pieces)
    for (double t : {0.0, 0.2, 0.5, 0.7, 1.0})
      error = std::max(error, std::abs((piece.at(t) - centre).norm() - radius));
  return error;
}

double areaOfCurve(const ProfileCurve& curve) {
  const Profile profile(curve, "profile");
  double sum = 0.0;
  constexpr int kSamples = 20'000;
  for (int k = 0; k < kSamples; ++k) {
    const Vector2d a = profile.point(static_cast<double>(k) / kSamples);
    const Vector2d b = profile.point(static_cast<double>(k + 1) / kSamples);
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return std::abs(sum);
}

TEST(Svg, LengthsAreInMillimetresAndUpwards) {
  const DrawnPath line = onlyPathOf(readSvg(svg("<line x1='10' y1='90' x2='30' y2='80'/>"), "a"));
  EXPECT_LT((line.start() - Vector2d(10, 10)).norm(), 1e-12);
  EXPECT_LT((line.end() - Vector2d(30, 20)).norm(), 1e-12);
  const DrawnPath inches = onlyPathOf(
      readSvg(svg("<line x1='0' y1='0' x2='1in' y2='0'/>", "width=\"2in\" height=\"1in\""), "a"));
  EXPECT_NEAR(inches.end().x(), 25.4, 1e-12);
  EXPECT_NEAR(inches.end().y(), 25.4, 1e-12);
  const DrawnPath pixels = onlyPathOf(readSvg(svg("<line x2='96'/>", ""), "a"));
  EXPECT_NEAR(pixels.end().x(), 25.4, 1e-12);
  // The box of another shape than the page is centred, as xMidYMid states.
  const DrawnPath fitted = onlyPathOf(
      readSvg(svg("<line x2='10'/>", "width=\"40mm\" height=\"20mm\" viewBox=\"0 0 10 10\""), "a"));
  EXPECT_LT((fitted.start() - Vector2d(10, 20)).norm(), 1e-12);
  EXPECT_LT((fitted.end() - Vector2d(30, 20)).norm(), 1e-12);
}

TEST(Svg, EveryCommandOfAPath) {
  // The same outline by absolute and by relative commands.
  const auto path = [](const std::string& data) {
    return onlyPathOf(readSvg(svg("<path d=\"" + data + "\"/>"), "a"));
  };
  const DrawnPath absolute =
      path("M10 10H50V30C50,40 40,50 30,50S10,40 10,30Q5,25 10,20T10,12A2 1 0 0 1 10 10Z");
  const DrawnPath relative =
      path("m10 10h40v20c0,10-10,20-20,20s-20-10-20-20q-5-5 0-10t0-8a2 1 0 010-2z");
  ASSERT_EQ(absolute.pieces.size(), relative.pieces.size());
  EXPECT_TRUE(absolute.closed);
  EXPECT_TRUE(relative.closed);
  for (std::size_t i = 0; i < absolute.pieces.size(); ++i)
    for (double t : {0.0, 0.4, 1.0})
      EXPECT_LT((absolute.pieces[i].at(t) - relative.pieces[i].at(t)).norm(), 1e-9) << i;
  // S and T reflect the handle before them.
  EXPECT_LT((absolute.pieces[3].points[1] - Vector2d(20, 50)).norm(), 1e-12);
  // Lines after M, numbers without blanks, several subpaths
  EXPECT_EQ(path("M.5.5 10-3 1e1,4z").pieces.size(), 3U);
  EXPECT_EQ(readSvg(svg("<path d='M0 0 9 0z m20 0 9 9 0 3z l5 5'/>"), "a").paths.size(), 3U);
}

TEST(Svg, ShapesHaveTheirAreas) {
  const auto area = [](const std::string& element) {
    return areaOf(onlyPathOf(readSvg(svg(element), "a")));
  };
  EXPECT_NEAR(area("<circle cx='20' cy='20' r='10'/>"), kPi * 100, 1e-2);
  EXPECT_NEAR(area("<ellipse cx='20' cy='20' rx='10' ry='5' transform='rotate(33)'/>"), kPi * 50,
              1e-2);
  EXPECT_NEAR(area("<rect x='3' y='4' width='20' height='10'/>"), 200, 1e-9);
  EXPECT_NEAR(area("<rect width='20' height='10' rx='2'/>"), 200 - (4 - kPi) * 4, 1e-3);
  EXPECT_NEAR(area("<polygon points='0,0 10,0 0,10'/>"), 50, 1e-9);
  EXPECT_NEAR(area("<path d='M 0 10 A 10 10 0 0 1 10 0 L 10 10 Z'/>"), kPi * 25, 1e-3);
  EXPECT_NEAR(area("<path d='M 0 10 A 10 10 0 1 0 10 0 L 10 10 Z'/>"), kPi * 75, 1e-2);
  // Radii that are too small grow until the arc reaches its end.
  EXPECT_NEAR(area("<path d='M 0 10 A 1 1 0 0 1 20 10 Z'/>"), kPi * 50, 1e-2);
}

TEST(Svg, TransformsNest) {
  const DrawnPath line =
      onlyPathOf(readSvg(svg("<g transform='translate(10,20)'><g transform='rotate(90) scale(2,3)'>"
                             "<line x2='5' y2='1' transform='matrix(1 0 0 1 1 0)'/></g></g>"),
                         "a"));
  // (1, 0) → scaled (2, 0) → turned (0, 2) → moved (10, 22), upwards (10, 78)
  EXPECT_LT((line.start() - Vector2d(10, 78)).norm(), 1e-9);
  EXPECT_LT((line.end() - Vector2d(7, 68 + 2 - 2)).norm(), 1e-9);
}

TEST(Svg, AFileOfADrawingProgram) {
  const Drawing drawing = readDrawing(kFolder / "bracket.svg");
  ASSERT_EQ(drawing.paths.size(), 2U);
  EXPECT_EQ(drawing.paths[0].layer, "Outline");
  EXPECT_EQ(drawing.paths[1].layer, "Hole");
  EXPECT_EQ(drawing.skipped, (std::map<std::string, int>{{"hidden", 1}, {"text", 1}}));
  EXPECT_EQ(drawing.paths[0].origin, "line 10: <path>");
  EXPECT_LT((drawing.paths[0].start() - Vector2d(10, 75)).norm(), 1e-9);
  EXPECT_NEAR(areaOf(drawing.paths[1]), kPi * 24, 1e-2);
}

TEST(Svg, ErrorsNameTheLineAndTheElement) {
  EXPECT_EQ(svgRefusal(svg("<path d='M 0 0 L 5 x'/>")),
            "a.svg: line 2: <path>: character 11: expected a number at \"x\"");
  EXPECT_EQ(svgRefusal(svg("<path d='L 5 5'/>")),
            "a.svg: line 2: <path>: character 2: a path begins with M at \" 5 5\"");
  EXPECT_EQ(svgRefusal(svg("<circle r='10%'/>"))
                .rfind("a.svg: line 2: <circle>: r: the length \"10%\"", 0),
            0U);
  EXPECT_EQ(
      svgRefusal(svg("<rect width='2' height='nan'/>")).rfind("a.svg: line 2: <rect>: height: ", 0),
      0U);
  EXPECT_EQ(svgRefusal(svg("<g transform='turn(3)'/>"))
                .rfind("a.svg: line 2: <g>: the transform \"turn\"", 0),
            0U);
  EXPECT_EQ(
      svgRefusal(svg("<text/><use/>")),
      "a.svg: there is no line or curve that can become a profile; it has 1 text, 1 use: convert "
      "texts to paths: unlink clones (use)");
  const std::string whole = svg("<path d='M 0 0 L 5 5'/>");
  EXPECT_NE(svgRefusal(whole.substr(0, whole.size() - 5)).find("this is not a complete SVG file"),
            std::string::npos);
  EXPECT_NE(svgRefusal("<html/>").find("does not begin with <svg>"), std::string::npos);
}

TEST(Svg, HostileFilesAreRefused) {
  EXPECT_NE(svgRefusal(svg("<path d='M 0 0 L 1e999 0'/>")).find("too large or too small"),
            std::string::npos);
  EXPECT_NE(svgRefusal(svg("<path d='M 0 0 L 1e300 0'/>")).find("beyond ±1e+06 mm"),
            std::string::npos);
  EXPECT_NE(svgRefusal(svg("<g transform='scale(1e200)'><g transform='scale(1e200)'>"
                           "<line x2='1'/></g></g>"))
                .find("beyond ±1e+06 mm"),
            std::string::npos);
  std::string nested;
  for (int i = 0; i < 300; ++i) nested += "<g>";
  EXPECT_NE(svgRefusal(svg(nested)).find("nested more than 200 deep"), std::string::npos);
  std::string zigzag = "<path d='M 0 0";
  for (int i = 0; i < 60'000; ++i) zigzag += " 1 1 0 0";
  EXPECT_NE(svgRefusal(svg(zigzag + "'/>")).find("more than 100000 lines"), std::string::npos);
  // A billion characters by nested entities
  std::string entities = "<!DOCTYPE svg [<!ENTITY a0 \"0123456789\">";
  for (int i = 1; i < 9; ++i) {
    entities += "<!ENTITY a" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) entities += "&a" + std::to_string(i - 1) + ";";
    entities += "\">";
  }
  EXPECT_NE(svgRefusal(entities + "]>" + svg("<desc>&a8;</desc>")).find("a.svg: line "),
            std::string::npos);
}

TEST(Dxf, EveryEntity) {
  const auto read = [](const std::string& entity) { return onlyPathOf(readDxf(dxf(entity), "a")); };
  const DrawnPath line = read("  0\nLINE\n 10\n1\n 20\n2\n 11\n3\n 21\n4\n");
  EXPECT_EQ(line.start(), Vector2d(1, 2));
  EXPECT_EQ(line.end(), Vector2d(3, 4));
  const DrawnPath circle = read("  0\nCIRCLE\n 10\n1\n 20\n2\n 40\n5\n");
  EXPECT_TRUE(circle.closed);
  EXPECT_LT(errorOfCircle(circle, {1, 2}, 5), 5 * kArcError);
  const DrawnPath arc = read("  0\nARC\n 10\n1\n 20\n2\n 40\n5\n 50\n350\n 51\n80\n");
  EXPECT_LT(errorOfCircle(arc, {1, 2}, 5), 5 * kArcError);
  EXPECT_NEAR(arc.start().y(), 2 - 5 * std::sin(kPi / 18), 1e-9);
  EXPECT_NEAR(arc.end().x(), 1 + 5 * std::cos(80 * kPi / 180), 1e-9);
  const DrawnPath half = read(
      "  0\nELLIPSE\n 10\n0\n 20\n0\n 11\n0\n 21\n10\n 40\n0.5\n 41\n0\n 42\n3.141592653589793\n");
  EXPECT_LT((half.start() - Vector2d(0, 10)).norm(), 1e-9);
  EXPECT_LT((half.pieces[2].at(1.0) - Vector2d(-5, 0)).norm(), 1e-9);
  EXPECT_LT((half.end() - Vector2d(0, -10)).norm(), 1e-9);
  // A bulge of 1 is a half circle to the right of the way.
  const DrawnPath slot =
      read("  0\nLWPOLYLINE\n 90\n2\n 70\n1\n 10\n0\n 20\n0\n 42\n1\n 10\n10\n 20\n0\n 42\n1\n");
  EXPECT_TRUE(slot.closed);
  EXPECT_LT(errorOfCircle(slot, {5, 0}, 5), 5 * kArcError);
  EXPECT_LT((slot.pieces[2].at(1.0) - Vector2d(5, -5)).norm(), 1e-9);
}

TEST(Dxf, SplinesAreExactOrWithinTheStatedError) {
  const std::string cubicSpline =
      "  0\nSPLINE\n 70\n8\n 71\n3\n 40\n0\n 40\n0\n 40\n0\n 40\n0\n 40\n1\n 40\n2\n 40\n2\n "
      "40\n2\n 40\n2\n"
      " 10\n0\n 20\n0\n 10\n5\n 20\n10\n 10\n10\n 20\n-10\n 10\n15\n 20\n4\n 10\n20\n 20\n0\n";
  const DrawnPath path = onlyPathOf(readDxf(dxf(cubicSpline), "a"));
  ASSERT_EQ(path.pieces.size(), 2U);
  const Profile exact(checks::cubic({{0, 0}, {5, 10}, {10, -10}, {15, 4}, {20, 0}}), "a");
  for (double t : {0.0, 0.3, 0.5, 0.9, 1.0}) {
    EXPECT_LT((path.pieces[0].at(t) - exact.point(0.5 * t)).norm(), 1e-9);
    EXPECT_LT((path.pieces[1].at(t) - exact.point(0.5 + 0.5 * t)).norm(), 1e-9);
  }
  // A quarter circle is rational.
  const std::string quarter =
      "  0\nSPLINE\n 70\n4\n 71\n2\n 40\n0\n 40\n0\n 40\n0\n 40\n1\n 40\n1\n 40\n1\n"
      " 41\n1\n 41\n0.7071067811865476\n 41\n1\n 10\n9\n 20\n0\n 10\n9\n 20\n9\n 10\n0\n 20\n9\n";
  EXPECT_LT(errorOfCircle(onlyPathOf(readDxf(dxf(quarter), "a")), {0, 0}, 9), 9e-6);
}

TEST(Dxf, UnitsLayersAndPlanes) {
  const std::string line = "  0\nLINE\n  8\ncut\n 10\n0\n 20\n0\n 11\n1\n 21\n0\n";
  EXPECT_NEAR(onlyPathOf(readDxf(dxf(line, dxfUnit(1)), "a")).end().x(), 25.4, 1e-12);
  EXPECT_NEAR(onlyPathOf(readDxf(dxf(line, dxfUnit(6)), "a")).end().x(), 1000, 1e-12);
  EXPECT_EQ(readDxf(dxf(line), "a").unit, "mm (the file states no unit)");
  EXPECT_EQ(onlyPathOf(readDxf(dxf(line), "a")).layer, "cut");
  // From below, x points to the other side for entities with planes.
  const DrawnPath arc = onlyPathOf(readDxf(
      dxf("  0\nARC\n 10\n5\n 20\n0\n 40\n1\n 50\n0\n 51\n90\n210\n0\n220\n0\n230\n-1\n"), "a"));
  EXPECT_LT((arc.start() - Vector2d(-6, 0)).norm(), 1e-9);
  EXPECT_LT((arc.end() - Vector2d(-5, 1)).norm(), 1e-9);
  EXPECT_NE(dxfRefusal(dxf("  0\nCIRCLE\n 10\n0\n 20\n0\n 40\n1\n210\n1\n220\n0\n230\n0\n"))
                .find("line 6: CIRCLE: the entity does not lie in a plane z = const"),
            std::string::npos);
}

TEST(Dxf, AFileOfADraughtingProgram) {
  const ProfileDrawing drawing = readProfileDrawing(kFolder / "plate.dxf");
  ASSERT_EQ(drawing.paths.size(), 2U);
  EXPECT_TRUE(drawing.paths[0].closed);
  EXPECT_NEAR(areaOf(drawing.paths[0]), 60 * 40 - (4 - kPi) * 64, 1e-2);
  EXPECT_NEAR(areaOf(drawing.paths[1]), kPi * 25, 1e-3);
  EXPECT_EQ(drawing.layers, (std::vector<std::string>{"holes", "outline"}));
  EXPECT_EQ(drawing.skipped, (std::map<std::string, int>{{"TEXT", 1}, {"hidden", 1}}));
  EXPECT_EQ(readProfileDrawing(kFolder / "plate.dxf", "holes").paths.size(), 1U);
  EXPECT_NE(refusalOf([] {
              readProfileDrawing(kFolder / "plate.dxf", "cut");
            }).find("no line or curve on the layer \"cut\"; the layers are \"holes\", \"outline\""),
            std::string::npos);
  const ProfileDrawing slot = readProfileDrawing(kFolder / "slot.dxf");
  ASSERT_EQ(slot.paths.size(), 1U);
  EXPECT_NEAR(areaOf(slot.paths[0]), 600 + kPi * 50, 1e-3);
  // Three entities meet end to end, in inches.
  const ProfileDrawing bottle = readProfileDrawing(kFolder / "bottle.dxf");
  ASSERT_EQ(bottle.paths.size(), 1U);
  EXPECT_FALSE(bottle.paths[0].closed);
  const auto [low, high] = ProfileSketch(fitPath(bottle, 0, {0.01, 0.0}).curve).box();
  EXPECT_NEAR(high.y() - low.y(), 2.6 * 25.4, 0.02);
}

TEST(Dxf, ErrorsNameTheLine) {
  EXPECT_EQ(dxfRefusal(dxf("  0\nCIRCLE\n 10\n0\n 20\nx\n 40\n1\n")),
            "a.dxf: line 10: expected a number, found \"x\"; export the file again");
  EXPECT_EQ(dxfRefusal(dxf("  0\nCIRCLE\n 10\n0\n 20\n0\n")),
            "a.dxf: line 6: CIRCLE: the value with group code 40 is missing");
  EXPECT_NE(dxfRefusal(dxf("  0\nCIRCLE\n 10\n0\n 20\n0\n 40\nnan\n")).find("line 12: "),
            std::string::npos);
  EXPECT_NE(dxfRefusal(dxf("  0\nCIRCLE\n 10\n0\n 20\n0\n 40\n-1\n")).find("expected > 0"),
            std::string::npos);
  EXPECT_NE(
      dxfRefusal(dxf("  0\nLINE\n 10\n0\n 20\n0\n 11\n1e300\n 21\n0\n")).find("beyond ±1e+06 mm"),
      std::string::npos);
  EXPECT_NE(dxfRefusal("  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n 10\n0\n").find("it is incomplete"),
            std::string::npos);
  EXPECT_NE(dxfRefusal("some text\nmore text\n").find("line 1: "), std::string::npos);
  EXPECT_NE(dxfRefusal("AutoCAD Binary DXF\r\n\x1a").find("save it as text"), std::string::npos);
  EXPECT_EQ(dxfRefusal(dxf("  0\nINSERT\n  2\nbolt\n  0\nTEXT\n  1\nhi\n")),
            "a.dxf: there is no line or curve that can become a profile; it has 1 INSERT, 1 TEXT: "
            "explode "
            "the blocks (INSERT)");
  EXPECT_NE(dxfRefusal(dxf("  0\nSPLINE\n 71\n3\n 40\n0\n 10\n0\n 20\n0\n"))
                .find("line 6: SPLINE: 1 control points"),
            std::string::npos);
  EXPECT_NE(dxfRefusal(dxf("  0\nLINE\n", dxfUnit(19))).find("the unit number 19"),
            std::string::npos);
}

TEST(ProfileFit, LinesAreExact) {
  const DrawnPath path =
      onlyPathOf(readSvg(svg("<polygon points='0,0 40,0 40,12 12,12 12,40 0,40'/>"), "a"));
  const FittedProfile fitted = fitProfile(path, {});
  EXPECT_EQ(fitted.curve.degree, 1);
  EXPECT_EQ(fitted.curve.points.size(), 7U);
  EXPECT_EQ(fitted.deviation, 0.0);
  EXPECT_NEAR(areaOfCurve(fitted.curve), 40 * 12 + 12 * 28, 1e-3);
}

TEST(ProfileFit, CurvesStayWithinTheTolerance) {
  const ProfileDrawing plate = readProfileDrawing(kFolder / "plate.dxf");
  std::size_t before = 0;
  for (const double tolerance : {0.1, 0.01, 1e-4}) {
    const FittedProfile fitted = fitPath(plate, 0, {tolerance, 0.0});
    EXPECT_LE(fitted.deviation, tolerance);
    EXPECT_GE(fitted.curve.points.size(), before);
    before = fitted.curve.points.size();
    const Profile profile(fitted.curve, "profile");
    EXPECT_TRUE(profile.isClosed());
    EXPECT_TRUE(profile.corners().empty());
    // The true distance, from the lines and arcs themselves
    double worst = 0.0;
    for (double t = 0.0; t < 1.0; t += 1.0 / 2000) {
      const Vector2d p = (profile.point(t) - Vector2d(30, 20)).cwiseAbs() - Vector2d(22, 12);
      worst = std::max(worst, std::abs(p.cwiseMax(0.0).norm() - 8.0));
    }
    EXPECT_LE(worst, tolerance);
  }
  EXPECT_LT(before, 60U);
  EXPECT_NO_THROW(makePrimitive({ExtrudeShape{fitPath(plate, 0, {0.01, 0.0}).curve, 5}}));
}

TEST(ProfileFit, CornersStayCorners) {
  const ProfileDrawing bracket = readProfileDrawing(kFolder / "bracket.svg", "Outline");
  const FittedProfile fitted = fitPath(bracket, onlyPath(bracket, true), {0.01, 0.0});
  const Profile profile(fitted.curve, "profile");
  // Two at the left; the curve meets the upper lines with a tangent.
  EXPECT_EQ(profile.corners().size(), 2U);
  EXPECT_LE(fitted.deviation, 0.01);
  EXPECT_NO_THROW(makePrimitive({ExtrudeShape{fitted.curve, 5}}));
}

TEST(ProfileFit, ManyShortLinesBecomeASmoothCurve) {
  std::string points;
  for (int i = 0; i < 72; ++i)
    points += std::to_string(50 + 30 * std::cos(i * kPi / 36)) + "," +
              std::to_string(50 + 20 * std::sin(i * kPi / 36)) + " ";
  const DrawnPath path = onlyPathOf(readSvg(svg("<polygon points='" + points + "'/>"), "a"));
  EXPECT_EQ(fitProfile(path, {}).curve.points.size(), 73U);
  const FittedProfile smooth = fitProfile(path, {0.02, 15 * kPi / 180});
  EXPECT_EQ(smooth.curve.degree, 3);
  EXPECT_LT(smooth.curve.points.size(), 40U);
  EXPECT_LT(smooth.deviation, 0.06);
  EXPECT_NEAR(areaOfCurve(smooth.curve), kPi * 600, 2.0);
}

TEST(ProfileFit, TooManyPointsAreRefusedWithTheRemedy) {
  std::string points;
  for (int i = 0; i < 500; ++i)
    points += std::to_string(50 + 30 * std::cos(i * kPi / 250)) + "," +
              std::to_string(50 + 20 * std::sin(i * kPi / 250)) + " ";
  const DrawnPath path = onlyPathOf(readSvg(svg("<polygon points='" + points + "'/>"), "a"));
  EXPECT_EQ(refusalOf([&] { fitProfile(path, {}); }).rfind("the loop needs 501 control points", 0),
            0U);
  EXPECT_LT(fitProfile(path, {0.01, 0.2}).curve.points.size(), 80U);
}

TEST(ProfileImport, AChoiceIsListed) {
  const ProfileDrawing plate = readProfileDrawing(kFolder / "plate.dxf");
  const std::string listed = refusalOf([&] { (void)onlyPath(plate, true); });
  EXPECT_NE(listed.find("the drawing has 2 closed loops; choose one by its number or its layer:"
                        " 1: closed, 60 × 40 mm, layer \"outline\", line "),
            std::string::npos)
      << listed;
  EXPECT_NE(refusalOf([&] { fitPath(plate, 7, {}); }).find("there is no curve number 8"),
            std::string::npos);
  const ProfileDrawing bottle = readProfileDrawing(kFolder / "bottle.dxf");
  EXPECT_EQ(onlyPath(bottle, false), 0U);
  EXPECT_NE(refusalOf([&] { (void)onlyPath(bottle, true); }).find("no closed loop"),
            std::string::npos);
}

TEST(ProfileImport, AnExportedProfileIsReadAsItWas) {
  const ProfileCurve arch = checks::cubic({{0, -10}, {10, 30}, {17, 10}, {17, 0}});
  const ProfileCurve angle = checks::polyline({{-5, 0}, {40, 0}, {40, 12}, {-5, 0}});
  for (const ProfileCurve& curve : {arch, angle, checks::roundCurve(20, 9)}) {
    const Drawing drawing = readSvg(toSvg(curve), "a");
    const FittedProfile fitted = fitProfile(onlyPathOf(drawing), {1e-6, 0.0});
    const Profile before(curve, "before"), after(fitted.curve, "after");
    EXPECT_EQ(before.isClosed(), after.isClosed());
    const auto samples = ProfileSketch(fitted.curve).samples();
    const auto [low, high] = ProfileSketch(curve).box();
    const auto [newLow, newHigh] = ProfileSketch(fitted.curve).box();
    EXPECT_LT((low - newLow).norm() + (high - newHigh).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace palpa::modeling
