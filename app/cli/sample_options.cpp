#include "app/cli/sample_options.h"

#include "app/cli/errors.h"
#include "app/cli/values.h"

namespace palpa::cli {

void SampleOptions::declare(CLI::App& options) {
  const auto add = [&options](const char* name, std::vector<std::string>& points) {
    return options
        .add_option(name, points,
                    "Point of the surface to report displacement and traction of, mm; any number")
        ->type_name("X,Y,Z")
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  add("--sample", points_);
  add("--probe", formerPoints_)->group("");
}

void SampleOptions::validate() const {
  points();
  if (hasFormerName()) noteFormerName("--probe", "--sample");
}

std::vector<Eigen::Vector3d> SampleOptions::points() const {
  std::vector<Eigen::Vector3d> points = parseVectors("--sample", points_);
  const std::vector<Eigen::Vector3d> former = parseVectors("--probe", formerPoints_);
  points.insert(points.end(), former.begin(), former.end());
  return points;
}

std::vector<app::FieldSample> SampleOptions::evaluate(const app::TouchModel& model,
                                                      const app::TouchState& state) const {
  std::vector<app::FieldSample> samples;
  for (const Eigen::Vector3d& point : points())
    samples.push_back(app::sampleField(model, state, point));
  return samples;
}

}  // namespace palpa::cli
