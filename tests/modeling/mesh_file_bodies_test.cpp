// Choosing among the bodies of a mesh file, its unit, scale and orientation.
#include <gtest/gtest.h>

#include "modeling/exchange/import.h"
#include "tests/modeling/cad_files.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector3d;
using tests::Folder;
using tests::says;

/// OBJ text of cubes, one after the other.
class Cubes {
 public:
  Cubes& add(const Vector3d& at, double size, const std::string& group = "") {
    if (!group.empty()) text_ += "o " + group + "\n";
    for (int i = 0; i < 8; ++i) {
      const Vector3d p = at + size * Vector3d(i & 1, (i >> 1) & 1, i >> 2);
      text_ += "v " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " +
               std::to_string(p.z()) + "\n";
    }
    for (const std::array<int, 4>& n : std::vector<std::array<int, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
      text_ += "f";
      for (const int corner : n) text_ += " " + std::to_string(first_ + corner);
      text_ += "\n";
    }
    first_ += 8;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  int first_ = 1;
};

ImportedBody importSolid(const std::filesystem::path& path, const std::string& solid,
                         const ImportPlacement& placement = {}) {
  ImportOptions options;
  options.solid = solid;
  options.placement = placement;
  return importBody(path, options);
}

std::string errorOf(const std::filesystem::path& path, const std::string& solid,
                    const ImportPlacement& placement = {}) {
  return tests::errorOf([&] { importSolid(path, solid, placement); });
}

TEST(MeshFileBodies, ClosedSurfacesAreListedWithTheirCavities) {
  const Folder folder;
  const auto path = folder.file("cubes.obj");
  // A cube with a cavity that contains another cube, and a cube beside them.
  tests::writeText(
      path,
      Cubes().add({2, 2, 2}, 2).add({0, 0, 0}, 10).add({1, 1, 1}, 8).add({20, 0, 0}, 1).text());
  const FileBodies found = listBodies(path, {}, ListedSurface::kCoarse);
  ASSERT_EQ(found.bodies.size(), 3U);
  EXPECT_FALSE(found.statesUnit);
  const std::array<double, 3> volumes{8.0, 1000.0 - 512.0, 1.0};
  const std::array<int, 3> triangles{12, 24, 12};
  for (std::size_t i = 0; i < 3; ++i) {
    const FileBody& body = found.bodies[i];
    EXPECT_EQ(body.name, "solid_" + std::to_string(i + 1));
    EXPECT_NEAR(body.volume, volumes[i], 1e-12);
    EXPECT_EQ(body.triangles, triangles[i]);
    EXPECT_EQ(body.surface.size(), static_cast<std::size_t>(triangles[i]));
    EXPECT_EQ(body.positions.size(), static_cast<std::size_t>(triangles[i] / 12 * 8));
    const ImportedBody read = importSolid(path, std::to_string(i + 1));
    EXPECT_NEAR(volume(read.body), volumes[i], 1e-12);
    EXPECT_EQ(read.name, "cubes_solid_" + std::to_string(i + 1));
    EXPECT_TRUE(says(read.notes.front(), "Read solid " + std::to_string(i + 1) + " of 3"));
  }
  EXPECT_EQ(found.bodies[2].low, Vector3d(20, 0, 0));
  EXPECT_EQ(found.bodies[2].high, Vector3d(21, 1, 1));
}

TEST(MeshFileBodies, GroupsNameTheBodiesTheyContain) {
  const Folder folder;
  const auto path = folder.file("parts.obj");
  tests::writeText(path, Cubes().add({0, 0, 0}, 10, "pot").add({20, 0, 0}, 1, "lid").text());
  const FileBodies found = listBodies(path);
  ASSERT_EQ(found.bodies.size(), 2U);
  EXPECT_EQ(found.bodies[0].name, "pot");
  EXPECT_EQ(found.bodies[1].name, "lid");
  const ImportedBody lid = importSolid(path, "lid");
  EXPECT_EQ(lid.name, "lid");
  EXPECT_NEAR(volume(lid.body), 1.0, 1e-12);
  // One group is no division into faces: sharp edges divide the cube.
  EXPECT_EQ(patchNames(lid.body).size(), 6U);
}

TEST(MeshFileBodies, SeveralBodiesWithoutAChoiceAreListedInTheError) {
  const Folder folder;
  const auto path = folder.file("parts.obj");
  tests::writeText(path, Cubes().add({0, 0, 0}, 10, "pot").add({20, 0, 0}, 1, "lid").text());
  EXPECT_TRUE(
      says(errorOf(path, ""),
           "parts.obj: contains 2 solids, but a project has one body; choose one: 1 \"pot\" "
           "of 10 × 10 × 10 mm; 2 \"lid\" of 1 × 1 × 1 mm"));
  EXPECT_TRUE(says(errorOf(path, "", {25.4, 1.0, UpAxis::kZ}), "of 254 × 254 × 254 mm"));
  EXPECT_TRUE(says(errorOf(path, "3"), "parts.obj: has no solid \"3\"; its solids are 1 \"pot\""));
  std::string many;
  Cubes cubes;
  for (int i = 0; i < 30; ++i) cubes.add({2.0 * i, 0, 0}, 1);
  tests::writeText(path, cubes.text());
  EXPECT_TRUE(says(errorOf(path, ""), "; and 10 more"));
}

TEST(MeshFileBodies, UnitScaleAndUpDirectionArePlaced) {
  const Folder folder;
  const auto path = folder.file("cube.obj");
  tests::writeText(path, Cubes().add({1, 2, 3}, 1).text());
  const ImportPlacement placement{25.4, 2.0, UpAxis::kY};
  const auto [low, high] = boundingBox(importSolid(path, "", placement).body);
  // (x, y, z) becomes (x, -z, y).
  EXPECT_LT((low - 50.8 * Vector3d(1, -4, 2)).norm(), 1e-9) << low.transpose();
  EXPECT_LT((high - 50.8 * Vector3d(2, -3, 3)).norm(), 1e-9) << high.transpose();
  const FileBody listed = listBodies(path, placement).bodies.front();
  EXPECT_LT((listed.low - low).norm() + (listed.high - high).norm(), 1e-9);
  EXPECT_NEAR(listed.volume, std::pow(50.8, 3), 1e-6);
  EXPECT_TRUE(says(errorOf(path, "", {0.0, 1e10, UpAxis::kZ}), "scale: 1e+10 is out of range"));
  EXPECT_TRUE(says(errorOf(path, "", {1e6, 1e3, UpAxis::kZ}), "check the unit"));
  EXPECT_EQ(importSolid(path, "", {1000.0, 10.0, UpAxis::kZ}).notes.back(),
            "The body is 10,000 mm in size: check the unit of the file.");
}

}  // namespace
}  // namespace palpa::modeling
