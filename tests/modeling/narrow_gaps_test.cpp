#include "modeling/mesh/narrow_gaps.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "modeling/body/mesh_body.h"
#include "modeling/mesh/divided_triangles.h"
#include "modeling/mesh/small_features.h"

namespace palpa::modeling {
namespace {

constexpr double kDepth = 10;  // of the block along y, mm
constexpr int kSlitBelow = 2;  // faces of the slit
constexpr int kSlitAbove = 4;

/// A block of 20 x 10 x 10 mm with a slit from one side, 12 mm deep, with these widths at its mouth
/// and at its end. Faces 0 to 7 are the sides of its profile, 8 and 9 its ends.
FacedTriangles blockWithSlit(double width, double atEnd) {
  const double profile[8][2] = {{0, 0},         {20, 0},         {20, 5},  {8, 5},
                                {8, 5 + atEnd}, {20, 5 + width}, {20, 10}, {0, 10}};
  FacedTriangles block;
  for (const double y : {0.0, kDepth})
    for (const auto& [x, z] : profile) block.positions.emplace_back(x, y, z);
  const auto add = [&](int a, int b, int c, int face) {
    block.triangles.push_back({a, b, c});
    block.faceOfTriangle.push_back(face);
  };
  for (int k = 0; k < 8; ++k) {
    const int next = (k + 1) % 8;
    add(k, next, next + 8, k);
    add(k, next + 8, k + 8, k);
  }
  constexpr int kEnd[6][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 7}, {4, 5, 6}, {4, 6, 7}};
  for (const auto& [a, b, c] : kEnd) {
    add(a, c, b, 8);
    add(a + 8, b + 8, c + 8, 9);
  }
  for (auto& t : block.triangles) std::swap(t[1], t[2]);
  return block;
}

FacedTriangles blockWithSlit(double width) {
  return blockWithSlit(width, width);
}

/// Throws if the surface is not closed and manifold.
MeshBody bodyOf(const FacedTriangles& surface) {
  MeshBody::Data data{surface.positions, surface.triangles, surface.faceOfTriangle, {}};
  for (int face = 0; face < 10; ++face) data.faceNames.push_back("face_" + std::to_string(face));
  return MeshBody(data);
}

double areaOf(const FacedTriangles& surface, std::size_t t) {
  const auto& [a, b, c] = surface.triangles[t];
  return 0.5 * (surface.positions[b] - surface.positions[a])
                   .cross(surface.positions[c] - surface.positions[a])
                   .norm();
}

TEST(NarrowGaps, AreFilled) {
  const FacedTriangles block = blockWithSlit(0.1);
  ASSERT_NEAR(volume(bodyOf(block)), 2000 - 12, 1e-9);
  const auto [filled, gaps] = withoutNarrowGaps(block, 0.3, {});
  EXPECT_EQ(gaps, 1);
  // At its mouths the plate ends a tenth of the gap's width inside.
  FacedTriangles outside = filled;
  for (int& face : outside.faceOfTriangle) face = 0;
  MeshBody::Data data{outside.positions, outside.triangles, outside.faceOfTriangle, {"all"}};
  EXPECT_NEAR(volume(MeshBody(data)), 2000, 0.1);
}

TEST(NarrowGaps, WedgesAreFilledWhereTheyAreNarrow) {
  // 0.1 to 0.9 mm wide, so that the third up to 0.3 mm is filled.
  const FacedTriangles block = blockWithSlit(0.9, 0.1);
  const auto [filled, gaps] = withoutNarrowGaps(block, 0.3, {});
  EXPECT_EQ(gaps, 1);
  MeshBody::Data data{filled.positions, filled.triangles, {}, {"all"}};
  data.faceOfTriangle.assign(filled.triangles.size(), 0);
  const double slit = 12 * 10 * (0.1 + 0.9) / 2, narrow = 3 * 10 * (0.1 + 0.3) / 2;
  EXPECT_NEAR(volume(MeshBody(data)), 2000 - slit + narrow, 0.5 * narrow);
}

TEST(NarrowGaps, KeepTheFacesOfTheBody) {
  const auto [filled, gaps] = withoutNarrowGaps(blockWithSlit(0.1), 0.3, {});
  ASSERT_EQ(gaps, 1);
  for (std::size_t t = 0; t < filled.triangles.size(); ++t) {
    const auto& [a, b, c] = filled.triangles[t];
    const Eigen::Vector3d middle =
        (filled.positions[a] + filled.positions[b] + filled.positions[c]) / 3;
    if (middle.z() < 1e-9) {
      EXPECT_EQ(filled.faceOfTriangle[t], 0);
    }
    if (middle.x() < 1e-9) {
      EXPECT_EQ(filled.faceOfTriangle[t], 7);
    }
  }
}

TEST(NarrowGaps, WiderOnesStay) {
  const FacedTriangles block = blockWithSlit(0.5);
  for (const double narrowest : {0.0, 0.3}) {
    const auto [surface, gaps] = withoutNarrowGaps(block, narrowest, {});
    EXPECT_EQ(gaps, 0);
    EXPECT_EQ(surface.triangles, block.triangles);
  }
}

TEST(NarrowGaps, AreNotFilledAtKeptFaces) {
  const FacedTriangles block = blockWithSlit(0.1);
  // The sides of the gap.
  for (const int kept : {kSlitBelow, kSlitAbove})
    EXPECT_EQ(withoutNarrowGaps(block, 0.3, {kept}).gaps, 0) << kept;
  // Its end, and one of its mouths: the plate ends before.
  for (const int kept : {3, 8}) {
    const auto [filled, gaps] = withoutNarrowGaps(block, 0.3, {kept});
    EXPECT_EQ(gaps, 1) << kept;
    const double missing = 2000 - volume(bodyOf(filled));
    EXPECT_GT(missing, 0.05) << kept;
    EXPECT_LT(missing, 2.5) << kept;
    double before = 0, after = 0;
    for (std::size_t t = 0; t < block.triangles.size(); ++t)
      if (block.faceOfTriangle[t] == kept) before += areaOf(block, t);
    for (std::size_t t = 0; t < filled.triangles.size(); ++t)
      if (filled.faceOfTriangle[t] == kept) after += areaOf(filled, t);
    EXPECT_NEAR(after, before, 1e-9) << kept;
  }
}

TEST(NarrowGaps, LeaveTheSameSurfaceWhereverItLiesInMemory) {
  // Turned, so that faces are flat up to rounding only.
  FacedTriangles block = blockWithSlit(0.3, 0.05);
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  for (Eigen::Vector3d& x : block.positions) x = turn * x;
  const FacedTriangles first = withoutNarrowGaps(block, 0.35, {}).surface;
  std::vector<std::vector<char>> between;
  for (int k = 1; k < 20; ++k) {
    for (int some = 0; some < 50; ++some)
      between.emplace_back(static_cast<std::size_t>(137 * k + 31 * some));
    const FacedTriangles again = withoutNarrowGaps(block, 0.35, {}).surface;
    EXPECT_EQ(again.positions, first.positions);
    EXPECT_EQ(again.triangles, first.triangles);
  }
}

TEST(NarrowGaps, AreStoppedByTheJob) {
  std::stop_source source;
  source.request_stop();
  Job job;
  job.stop = source.get_token();
  EXPECT_THROW(withoutNarrowGaps(blockWithSlit(0.1), 0.3, {}, job), Cancelled);
}

TEST(NarrowGaps, CountAsFilledHoles) {
  const MeshBody body = bodyOf(blockWithSlit(0.1));
  const LengthAt two = [](const Eigen::Vector3d&) { return 2.0; };
  const SimplifiedSurface simplified =
      withoutSmallFeatures(body, two, two, {}, ThinPlaces::kRemoved);
  EXPECT_TRUE(simplified.isNeeded);
  EXPECT_EQ(simplified.filledHoles, 1);
  EXPECT_EQ(withoutSmallFeatures(body, two, two, {}, ThinPlaces::kKept).filledHoles, 0);
  // A body of which nothing is to be left out.
  const LengthAt none = [](const Eigen::Vector3d&) { return 0.0; };
  EXPECT_EQ(withoutSmallFeatures(body, none, none, {}, ThinPlaces::kRemoved).filledHoles, 0);
}

TEST(DividedTriangles, HaveNoLongEdgesAndTheSameSurface) {
  const FacedTriangles block = blockWithSlit(0.1);
  const auto pieces = dividedTriangles(block, 1.5, 100'000);
  ASSERT_TRUE(pieces);
  for (const auto& triangle : pieces->triangles)
    for (int k = 0; k < 3; ++k)
      EXPECT_LE((pieces->positions[triangle[k]] - pieces->positions[triangle[(k + 1) % 3]]).norm(),
                1.5);
  EXPECT_NEAR(volume(bodyOf(*pieces)), volume(bodyOf(block)), 1e-9);
  EXPECT_NEAR(area(bodyOf(*pieces)), area(bodyOf(block)), 1e-9);
  EXPECT_FALSE(dividedTriangles(block, 1.5, 100));
}

}  // namespace
}  // namespace palpa::modeling
