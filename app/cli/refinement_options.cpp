#include "app/cli/refinement_options.h"

#include "app/cli/errors.h"
#include "app/cli/text.h"
#include "app/cli/values.h"
#include "app/report/numbers.h"
#include "base/count_text.h"

namespace palpa::cli {
namespace {

using End = app::RefinedTouch::End;

/// A relative error.
double parseShare(const std::string& option, const std::string& text) {
  const bool isPercent = !text.empty() && text.back() == '%';
  const double number = parsePositive(option, isPercent ? text.substr(0, text.size() - 1) : text);
  const double share = isPercent ? number / 100 : number;
  if (share >= 1) throw UsageError(option + ": expected less than 100%, found '" + text + "'");
  return share;
}

const char* nameOf(End end) {
  switch (end) {
    case End::kReached:
      return "reached";
    case End::kMeshes:
      return "meshes";
    case End::kNoFiner:
      return "no_finer_mesh";
    case End::kTime:
      return "time";
    case End::kMemory:
      return "memory";
    case End::kFailed:
      return "failed";
  }
  return "";
}

std::string endText(const app::RefinedTouch& touch, const app::ErrorGoal& goal) {
  switch (touch.end) {
    case End::kReached:
      return "";
    case End::kMeshes:
      return format("not reached with %zu meshes", touch.steps.size());
    case End::kNoFiner:
      return "shorter elements give no finer mesh";
    case End::kTime:
      return format("a finer mesh would take longer than the %.4g s of --time-limit", goal.seconds);
    case End::kMemory:
      return "a finer mesh does not fit into the memory";
    case End::kFailed:
      return "a finer mesh failed: " + touch.reason;
  }
  return "";
}

}  // namespace

void RefinementOptions::declare(CLI::App& options) {
  options
      .add_option("--force-error", error_,
                  "Make the mesh finer until the estimated error of the forces is at most this "
                  "share")
      ->type_name("SHARE%");
  options
      .add_option("--time-limit", seconds_,
                  "With --force-error: time for all meshes, s (default 60)")
      ->type_name("SECONDS");
}

void RefinementOptions::validate() const {
  if (!isGiven() && !seconds_.empty()) throw UsageError("--time-limit needs --force-error");
  if (isGiven()) goal();
}

app::ErrorGoal RefinementOptions::goal() const {
  app::ErrorGoal goal;
  if (!isGiven()) {
    goal.maxMeshes = 1;
    return goal;
  }
  goal.error = parseShare("--force-error", error_);
  if (!seconds_.empty()) goal.seconds = parsePositive("--time-limit", seconds_);
  return goal;
}

Json refinementJson(const app::RefinedTouch& touch, const app::ErrorGoal& goal) {
  Json meshes = Json::array();
  for (const app::RefinementStep& step : touch.steps)
    meshes.push_back({{"edge_length_mm", step.mesh.edgeLength},
                      {"nodes", step.nodes},
                      {"coefficients", step.coefficients},
                      {"force_error_estimate", step.error},
                      {"seconds", step.seconds}});
  Json json{{"wished", goal.error},
            {"end", nameOf(touch.end)},
            {"meshes", std::move(meshes)},
            {"taken", touch.taken}};
  if (!touch.reason.empty()) json["reason"] = touch.reason;
  return json;
}

std::string refinementText(const app::RefinedTouch& touch, const app::ErrorGoal& goal) {
  const bool isSplines = touch.model->setup().splines != nullptr;
  std::string text = format("refined    error of forces at most %.3g %%:", 100 * goal.error);
  const char* separator = " ";
  for (const app::RefinementStep& step : touch.steps) {
    text += separator + countText(isSplines ? step.coefficients : step.nodes) +
            (isSplines ? " coefficients " : " nodes ") + report::percentText(step.error);
    separator = ", ";
  }
  const std::string end = endText(touch, goal);
  return text + (end.empty() ? "" : "; " + end) + "\n";
}

}  // namespace palpa::cli
