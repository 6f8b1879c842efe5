#include "modeling/solid/solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "modeling/error.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

/// Message of the error for a box changed by `change`; empty if it is accepted.
std::string faultOf(
    const std::function<void(std::vector<Eigen::Vector3d>&, std::vector<Patch>&)>& change) {
  const Solid box = makeBox({4.0, 3.0, 2.0});
  std::vector<Eigen::Vector3d> points = box.controlPoints();
  std::vector<Patch> patches = box.patches();
  change(points, patches);
  try {
    Solid(points, patches);
  } catch (const ModelingError& error) {
    return error.what();
  }
  return "";
}

testing::AssertionResult begins(const std::string& text, const std::string& start) {
  if (text.rfind(start, 0) == 0) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "\"" << text << "\" does not begin with \"" << start << "\"";
}

TEST(Solid, AcceptsAnUnchangedBox) {
  EXPECT_EQ(faultOf([](auto&, auto&) {}), "");
}

TEST(Solid, NamesABadPoint) {
  EXPECT_TRUE(begins(faultOf([](auto& points, auto&) { points[7].y() = std::nan(""); }),
                     "solid.control_points_mm[7][1]: nan is not a finite number"));
}

TEST(Solid, NamesBadKnots) {
  EXPECT_TRUE(begins(
      faultOf([](auto&, auto& patches) { patches[2].knots[0] = {0, 0, 0, 0, 0.5, 0.4, 1, 1}; }),
      "solid.patches[2].knots[0][5]: 0.4 is smaller than the knot before it (0.5)"));
  EXPECT_TRUE(
      begins(faultOf([](auto&, auto& patches) { patches[1].knots[1].pop_back(); }),
             "solid.patches[1].knots[1]: 7 knots, but 4 control points of degree 3 need 8"));
  EXPECT_TRUE(begins(faultOf([](auto&, auto& patches) { patches[1].knots[1][7] = 2.0; }),
                     "solid.patches[1].knots[1][6]: 1 differs from the last knot"));
  EXPECT_TRUE(begins(
      faultOf([](auto&, auto& patches) { patches[0].knots[0] = std::vector<double>(8, 1.0); }),
      "solid.patches[0].knots[0][7]: 1 equals the first knot"));
}

TEST(Solid, RefusesAKnotRepeatedMoreThanTheDegree) {
  // A 4 × 4 net of degree 1 with a double inner knot would be disconnected there.
  EXPECT_TRUE(begins(faultOf([](auto&, auto& patches) {
                       patches[0].degree[0] = 1;
                       patches[0].knots[0] = {0, 0, 0.5, 0.5, 1, 1};
                     }),
                     "solid.patches[0].knots[0][3]: 0.5 occurs more than 1 times"));
}

TEST(Solid, NamesBadNetsAndDegrees) {
  EXPECT_TRUE(begins(faultOf([](auto&, auto& patches) { patches[3].net[2].pop_back(); }),
                     "solid.patches[3].net[2]: 3 indices, but the first row has 4"));
  EXPECT_TRUE(begins(faultOf([](auto&, auto& patches) { patches[3].net[2][1] = 56; }),
                     "solid.patches[3].net[2][1]: index 56 is out of range"));
  EXPECT_TRUE(begins(faultOf([](auto&, auto& patches) { patches[3].net.pop_back(); }),
                     "solid.patches[3].net: 3 rows, but degree 3 in u needs at least 4"));
  EXPECT_TRUE(begins(faultOf([](auto&, auto& patches) { patches[0].degree[1] = 6; }),
                     "solid.patches[0].degree[1]: 6 is outside 1 … 5"));
  EXPECT_TRUE(begins(faultOf([](auto&, auto& patches) { patches[1].name = patches[0].name; }),
                     "solid.patches[1].name: \"side_xmin\" is already the name of a patch"));
}

TEST(Solid, RefusesAnOpenSolid) {
  const std::string fault = faultOf([](auto&, auto& patches) { patches.pop_back(); });
  EXPECT_NE(fault.find("a solid must be closed"), std::string::npos) << fault;
}

TEST(Solid, RefusesDifferentKnotsAlongACommonEdge) {
  const std::string fault = faultOf([](auto&, auto& patches) {
    // A different degree and knots of the same net size in one patch only.
    patches[5].degree[0] = 2;
    patches[5].knots[0] = {0, 0, 0, 0.5, 1, 1, 1};
  });
  EXPECT_NE(fault.find("shares these points with degree"), std::string::npos) << fault;
}

TEST(Solid, AcceptsKnotsThatDifferByAnAffineMap) {
  EXPECT_EQ(faultOf([](auto&, auto& patches) {
              for (double& knot : patches[5].knots[0]) knot = 3.0 + 7.0 * knot;
            }),
            "");
}

TEST(Solid, RefusesMixedAndInwardOrientation) {
  const auto turn = [](Patch& patch) {
    auto net = patch.net;
    for (std::size_t i = 0; i < net.size(); ++i)
      for (std::size_t j = 0; j < net.size(); ++j) net[i][j] = patch.net[j][i];
    patch.net = net;
  };
  EXPECT_NE(faultOf([&](auto&, auto& patches) {
              turn(patches[2]);
            }).find("normal is opposite to the normal"),
            std::string::npos);
  EXPECT_TRUE(begins(faultOf([&](auto&, auto& patches) {
                       for (Patch& patch : patches) turn(patch);
                     }),
                     "solid.patches: the enclosed volume is -2"));
}

TEST(Solid, KnowsItsEdges) {
  const Solid box = makeBox({4.0, 3.0, 2.0});
  ASSERT_EQ(box.edges().size(), 12U);
  for (std::size_t e = 0; e < box.edges().size(); ++e)
    for (const PatchEdge& use : box.edges()[e].uses)
      EXPECT_EQ(box.edgeOf(use.patch, use.side), static_cast<int>(e));
}

}  // namespace
}  // namespace palpa::modeling
