#include "tests/reliability/search_user.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <variant>

#include "base/error.h"
#include "modeling/editing/change.h"
#include "modeling/project/project_file.h"
#include "modeling/solid/isoparametric_line.h"

namespace palpa::reliability {
namespace {

using namespace std::chrono_literals;

constexpr auto kSearchPatience = 300s;  // until a stopped search ends

/// The search of one thread, with the errors that a body in a storm may have.
std::optional<app::ShapeResult> search(const modeling::Project& project,
                                       const modeling::Design& design,
                                       const std::stop_token& stop) {
  Job job;
  job.stop = stop;
  job.threads = 1;
  try {
    return app::findShape(project, design, {}, job);
  } catch (const Cancelled&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;  // no support, a touch on a support, …
  }
}

}  // namespace

void SearchUser::act() {
  if (!running_.valid()) {
    begin();
  } else if (running_.wait_for(0s) == std::future_status::ready) {
    take();
  } else if (oneIn(random_, 4)) {
    stop_.request_stop();
    if (campaign_.require(running_.wait_for(kSearchPatience) == std::future_status::ready,
                          "a stopped search for a shape does not end"))
      running_.get();
  } else if (oneIn(random_, 2)) {
    // The user waits for the shape: no edit makes it unfit from now on.
    if (campaign_.require(running_.wait_for(kSearchPatience) == std::future_status::ready,
                          "a search for a shape does not end"))
      take();
  }
}

void SearchUser::begin() {
  if (session_.project().touches.empty()) addTouch();
  const modeling::Project& project = session_.project();
  modeling::Design design;
  for (const modeling::Touch& touch : project.touches)
    design.targets.push_back(
        {touch.name, modeling::DesignTarget::Kind::kStiffness, pickReal(random_, 0.5, 3), {}, 1.0});
  design.largestMovement = pickReal(random_, 0.5, 3);
  design.steps = pick(random_, 1, 3);
  if (oneIn(random_, 3)) design.volume = modeling::Design::Volume::kKept;
  searched_ = std::make_shared<const modeling::Project>(project);
  stop_ = std::stop_source();
  running_ =
      std::async(std::launch::async, [project = searched_, design, stop = stop_.get_token()] {
        return search(*project, design, stop);
      });
  ++begun_;
}

void SearchUser::addTouch() {
  const auto* solid = std::get_if<modeling::Solid>(&session_.project().body);
  if (!solid) return;
  // In the middle of a patch (of all but the first, which is held), towards the body.
  const int patch = pick(random_, 1, static_cast<int>(solid->patches().size()) - 1);
  const auto& knots = solid->patches()[static_cast<std::size_t>(patch)].knots;
  const Eigen::Vector3d at =
      modeling::surfacePoint(*solid, patch, (knots[0].front() + knots[0].back()) / 2,
                             (knots[1].front() + knots[1].back()) / 2);
  modeling::Touch touch;
  touch.name = "search " + std::to_string(begun_);
  touch.at = at;
  touch.radius = 6;
  touch.kind = modeling::TouchKind::kGrab;
  touch.vector = -at.stableNormalized();
  session_.perform(modeling::AddTouch{touch});
}

void SearchUser::take() {
  const Result result = running_.get();
  if (!result) return;
  ++found_;
  for (const double value : result->final.values)
    campaign_.require(std::isfinite(value) && value > 0, "a value of a found shape is odd");
  // Edits meanwhile have made another problem: the shape does not fit.
  if (modeling::compare(*searched_, session_.project()).any() || oneIn(random_, 4)) return;
  accept(*result);
}

void SearchUser::accept(const app::ShapeResult& result) {
  if (result.commands.empty()) return;
  const std::string before = modeling::toJson(session_.project());
  session_.beginGroup("Find a shape");
  for (const modeling::Command& command : result.commands) session_.perform(command);
  session_.endGroup();
  ++accepted_;
  campaign_.require(!modeling::compare(session_.project(), result.project).any(),
                    "the accepted project is not the found one");
  const std::string after = modeling::toJson(session_.project());
  session_.undo();
  campaign_.require(modeling::toJson(session_.project()) == before,
                    "undoing an accepted shape does not restore the project");
  if (oneIn(random_, 2)) return;
  session_.redo();
  campaign_.require(modeling::toJson(session_.project()) == after,
                    "redoing an accepted shape gives another project");
}

}  // namespace palpa::reliability
