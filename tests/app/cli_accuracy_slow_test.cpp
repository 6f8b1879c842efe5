// The example projects, touched with both high-order discretisations and several finenesses.
// scripts/make-accurate-forces makes the forces that they are compared with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/app/cli_runner.h"

namespace palpa::cli_tests {
namespace {

/// Norm of the difference of two JSON lists of three numbers.
double distance(const Json& a, const Json& b) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += std::pow(a[k].get<double>() - b[k].get<double>(), 2);
  return std::sqrt(sum);
}

/// Forces with an estimated error of 0.1 %.
Json accurateContacts(const std::string& project) {
  std::ifstream file(std::filesystem::path(PALPA_TEST_DATA) / "accurate_forces.json");
  return Json::parse(file).at(project);
}

class ExampleAccuracy : public testing::TestWithParam<std::string> {
 protected:
  Runner cli_;
};

TEST_P(ExampleAccuracy, ForcesAreWithinTheirStatedErrorsOfTheMostAccurateOnes) {
  const std::string file = Runner::example(GetParam() + ".json");
  const auto touch = [&](const std::string& options) {
    return cli_.runJson("touch " + file + " " + options);
  };
  const double edge = cli_.runJson("info " + file).at("mesh").at("edge_length_mm").get<double>();
  const Json best = accurateContacts(GetParam());
  for (const std::string& options :
       {std::string("--engine splines --accuracy 0.01"), std::string("--engine quadratic"),
        "--engine quadratic --edge-length " + std::to_string(0.67 * edge)}) {
    SCOPED_TRACE(options);
    const Json touched = touch(options);
    ASSERT_EQ(touched.at("contacts").size(), best.size());
    for (std::size_t k = 0; k < touched.at("contacts").size(); ++k) {
      const Json& contact = touched.at("contacts")[k];
      const double most = norm(best[k].at("force_N"));
      const double off = distance(contact.at("force_N"), best[k].at("force_N"));
      const double stated = contact.at("error_estimate").get<double>();
      std::printf("%s %s: off %.3f %%, stated %.3f %%\n", options.c_str(),
                  contact.at("name").get<std::string>().c_str(), 100 * off / most, 100 * stated);
      EXPECT_LE(off, stated * most) << contact.at("name");
      EXPECT_LE(stated, touched.at("error_estimate").get<double>());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExampleAccuracy, testing::ValuesIn(Runner::exampleNames()),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace palpa::cli_tests
