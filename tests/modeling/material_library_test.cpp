#include "modeling/project/material_library.h"

#include <gtest/gtest.h>

#include <set>

#include "modeling/error.h"
#include "modeling/project/shore_hardness.h"
#include "modeling/shapes/primitives.h"

namespace palpa::modeling {
namespace {

TEST(MaterialLibrary, EveryMaterialIsUsableAndHasASource) {
  std::set<std::string> names;
  for (const LibraryMaterial& entry : materialLibrary()) {
    Project project;
    project.body = makeBox({1, 1, 1});
    project.material = entry.material;
    EXPECT_NO_THROW(checkProject(project)) << entry.material.name;
    EXPECT_TRUE(names.insert(entry.material.name).second) << entry.material.name;
    EXPECT_FALSE(entry.reference.empty()) << entry.material.name;
    EXPECT_FALSE(entry.note.empty()) << entry.material.name;
  }
  EXPECT_GE(names.size(), 10u);
}

TEST(MaterialLibrary, RubbersFollowGentsRelation) {
  for (const double shore : {30.0, 50.0, 70.0}) {
    const auto& rubber = libraryMaterial("rubber, " + std::to_string(int(shore)) + " shore a");
    EXPECT_NEAR(rubber.material.youngsModulus, youngsModulusOfShoreA(shore), 0.005) << shore;
  }
}

TEST(MaterialLibrary, TheModulusGrowsWithTheHardness) {
  // By hand: 0.0981 (56 + 304.9344) / (0.137505 (254 - 101.6)).
  EXPECT_NEAR(youngsModulusOfShoreA(40), 35.40767 / 20.95576, 1e-5);
  EXPECT_EQ(estimatedModulusOfShoreA(40), 1.690);
  for (double shore = kMinShoreA; shore < kMaxShoreA; ++shore)
    EXPECT_LT(youngsModulusOfShoreA(shore), youngsModulusOfShoreA(shore + 1));
}

TEST(MaterialLibrary, AnUnknownNameListsTheKnownOnes) {
  try {
    libraryMaterial("cheese");
    FAIL();
  } catch (const ModelingError& error) {
    EXPECT_EQ(error.kind(), ModelingError::Kind::kNotFound);
    EXPECT_NE(std::string(error.what()).find("\"Liver\""), std::string::npos);
  }
}

}  // namespace
}  // namespace palpa::modeling
