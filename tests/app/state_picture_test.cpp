// Labels of pictures: forces end at the digit that their errors make uncertain.
#include "app/report/state_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/core/model/build_touch_model.h"
#include "modeling/project/project_file.h"

namespace palpa::report {
namespace {

std::vector<std::string> labels(const view::Picture& picture) {
  std::vector<std::string> all;
  for (const view::ForceArrow& arrow : picture.arrows.arrows) all.push_back(arrow.label);
  return all;
}

bool contains(const std::vector<std::string>& labels, const char* label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

TEST(StatePicture, LabelsEndAtTheError) {
  modeling::Project project = modeling::readProject(PALPA_PROJECTS "/sphere.json");
  project.mesh.edgeLength = 8;
  const auto model = app::buildTouchModel(project, {}, {});
  app::TouchState state = model->rest();
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  app::TouchState::Contact contact{
      model->setup().mesh().nodes.front(), 0, {0, 0, -0.23512}, none, none, 0};
  state.contacts = {contact};
  state.supports.front().resultant.force = {0, 0, 0.23512};
  PictureOptions options;
  options.showReactions = true;
  EXPECT_TRUE(contains(labels(makePicture(project, model, state, options)), "0.235 N"));

  state.contacts.front().errorEstimate = 0.08;
  state.forceErrorEstimate = 0.6;
  std::vector<std::string> shown = labels(makePicture(project, model, state, options));
  EXPECT_TRUE(contains(shown, "0.24 N"));
  EXPECT_TRUE(contains(shown, "0.2 N")) << "the reaction";

  // What the user gave has no error, and small errors leave the three digits.
  state.contacts.front().kind = modeling::TouchKind::kForce;
  state.forceErrorEstimate = 1e-5;
  shown = labels(makePicture(project, model, state, options));
  EXPECT_EQ(std::count(shown.begin(), shown.end(), "0.235 N"), 2);
}

}  // namespace
}  // namespace palpa::report
