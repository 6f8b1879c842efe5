// The exact solutions of analytic.json with both engines, and what the file says of itself.
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <map>

#include "app/verification/analytic_families.h"
#include "app/verification/exact/exact_fields.h"
#include "app/verification/verification.h"
#include "modeling/error.h"

namespace palpa::verification {
namespace {

std::string idOf(const nlohmann::json& entry) {
  return entry.at("id");
}

TEST(AnalyticCases, EveryCaseIsCoveredOnceOrSaysWhyNot) {
  const auto& cases = ReferenceData::builtIn().analytic();
  ASSERT_GE(cases.size(), 83u);
  for (const auto& entry : cases) {
    const std::string id = idOf(entry);
    int covered = 0;
    for (const AnalyticFamily& family : analyticFamilies())
      covered += id == family.name || id.starts_with(std::string(family.name) + "_nu");
    for (const OmittedCases& omitted : omittedCases()) covered += id.starts_with(omitted.prefix);
    EXPECT_EQ(covered, 1) << id;
  }
}

TEST(AnalyticCases, EveryCaseIsPlannedForTheEnginesThatHaveItsBody) {
  const Plan plan = makePlan(ReferenceData::builtIn(), {});
  std::map<std::string, int> triangles, splines;
  for (const Task& task : plan.tasks)
    if (task.engine != "-") ++(task.engine == "splines" ? splines : triangles)[task.name];
  // Of 83 exact cases 9 half-spaces, 5 pairs of bodies in contact and 2 cavities are not run; there
  // are 5 finite element cases and a series.
  EXPECT_EQ(triangles.size(), 83u - 16u + 5u + 1u);
  // Hollow bodies are triangles' alone.
  EXPECT_EQ(splines.size(), triangles.size() - 5);
  for (const auto& [name, count] : splines) EXPECT_EQ(count, 1) << name;
  EXPECT_EQ(plan.omitted.size(), 16u + 5u);
  for (const Omitted& omitted : plan.omitted) EXPECT_FALSE(omitted.reason.empty());
}

void expectPasses(const Result& result) {
  for (const Check& check : result.checks) {
    std::printf("%-42s %-9s %-6s n %4d  %-12s %.1e\n", result.name.c_str(), result.engine.c_str(),
                result.data.c_str(), result.coefficients, check.quantity.c_str(), check.value);
    EXPECT_TRUE(check.passes()) << result.name << ", " << result.engine << ", " << result.data
                                << ": " << check.quantity << " " << check.value << " for "
                                << check.bound;
  }
}

class AnalyticFamilies : public ::testing::TestWithParam<AnalyticFamily> {};

TEST_P(AnalyticFamilies, AreReproduced) {
  Selection selection;
  selection.names = {std::string(GetParam().name)};
  int solved = 0;
  for (const Task& task : makePlan(ReferenceData::builtIn(), selection).tasks) {
    const Result result = task.run({});
    ASSERT_FALSE(result.checks.empty());
    expectPasses(result);
    solved += result.engine == "triangles" || result.engine == "splines";
  }
  EXPECT_GE(solved, GetParam().splines ? 2 : 1);
}

INSTANTIATE_TEST_SUITE_P(Cases, AnalyticFamilies, ::testing::ValuesIn(analyticFamilies()),
                         [](const auto& family) {
                           std::string name(family.param.name);
                           std::erase_if(name, [](char c) { return c == '_' || c == '.'; });
                           return name;
                         });

TEST(Convergence, BothEnginesReachTheirOrders) {
  Selection selection;
  selection.names = {"convergence_sphere"};
  const Plan plan = makePlan(ReferenceData::builtIn(), selection);
  ASSERT_EQ(plan.tasks.size(), 2u);
  for (const Task& task : plan.tasks) {
    const Result result = task.run({});
    EXPECT_EQ(result.steps.size(), 5u);
    EXPECT_EQ(result.checks.size(), 3u);  // two errors and an order
    expectPasses(result);
    for (std::size_t k = 1; k < result.steps.size(); ++k)
      EXPECT_LT(result.steps[k].error, result.steps[k - 1].error);
  }
}

TEST(Verification, AnUnknownNameIsRefusedWithThoseThatAreKnown) {
  Selection selection;
  selection.names = {"patch_linear_box", "patch_linear_bottle"};
  try {
    makePlan(ReferenceData::builtIn(), selection);
    FAIL() << "no error";
  } catch (const modeling::ModelingError& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.kind(), modeling::ModelingError::Kind::kNotFound);
    for (const char* word :
         {"patch_linear_bottle", "kelvin_exterior_sphere", "c_sph_pole", "convergence_sphere"})
      EXPECT_NE(message.find(word), std::string::npos) << word;
  }
}

TEST(Verification, NumbersThatAreNoneDoNotPass) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((Check{"", nan, 1}.passes()));
  EXPECT_FALSE((Check{"", nan, 1, true}.passes()));
  EXPECT_TRUE((Check{"", 0.5, 1}.passes()));
  EXPECT_FALSE((Check{"", 0.5, 1, true}.passes()));
  EXPECT_EQ(worse(0.5, nan), std::numeric_limits<double>::infinity());
  EXPECT_EQ(worse(0.5, 0.7), 0.7);
  // Of several checks the one nearest to its bound is shown, a failing one first of all.
  const Result result{"", "", "", 0, {{"a", 0.9, 1}, {"b", 3, 4}, {"c", 5, 4.9, true}}, {}, 0};
  EXPECT_EQ(result.nearest().quantity, "c");
  const Result failing{"", "", "", 0, {{"a", 0, 0}, {"b", nan, 4}}, {}, 0};
  EXPECT_EQ(failing.nearest().quantity, "b");
}

}  // namespace
}  // namespace palpa::verification
