#include "app/cli/simulation.h"

#include <charconv>

#include "app/cli/errors.h"
#include "app/cli/values.h"
#include "app/core/touch.h"

namespace palpa::cli {
namespace {

int parseNode(const std::string& text) {
  int node = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), node);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || node < 0) {
    throw UsageError("--node: expected the number of a node (0, 1, …), found '" + text + "'");
  }
  return node;
}

}  // namespace

bem::Job jobOf(const Context& context) {
  bem::Job job;
  job.stop = context.stop;
  job.threads = context.options.threads;
  job.progress = [&progress = context.progress](std::string_view phase, double fraction) {
    progress.show(phase, fraction);
  };
  return job;
}

std::shared_ptr<const app::TouchModel> buildModel(const modeling::Project& project,
                                                  const Context& context) {
  auto model = app::buildTouchModel(project, {}, jobOf(context));
  context.progress.clear();
  return model;
}

void TouchInput::declare(CLI::App& options) {
  options.add_option("--at", at_, "Place on the surface to touch, mm")->type_name("X,Y,Z");
  options.add_option("--node", node_, "Touch one node of the mesh instead of a place")
      ->type_name("K");
  options.add_option("--displace", displacement_, "Displacement of the touched place, mm")
      ->type_name("X,Y,Z");
  options.add_option("--force", force_, "Force on the touched place, N, instead of --displace")
      ->type_name("X,Y,Z");
  options.add_option("--radius", radius_, "Radius of the contact, mm (default: a fingertip's)")
      ->type_name("LENGTH");
  options.add_option("--kind", kind_, "Kind of contact: grab")->type_name("KIND");
}

void TouchInput::validate() const {
  if (kind_ != "grab") throw UsageError("--kind: unknown kind '" + kind_ + "'; known is grab");
  if (!at_.empty() && !node_.empty()) throw UsageError("give either --at or --node");
  if (!isGiven()) {
    if (!displacement_.empty() || !force_.empty() || !radius_.empty()) {
      throw UsageError("--displace, --force and --radius need --at (or --node)");
    }
    return;
  }
  if (displacement_.empty() == force_.empty()) {
    throw UsageError("a touch needs either --displace or --force");
  }
  if (!node_.empty()) {
    if (!force_.empty()) throw UsageError("--node can be displaced, but not pulled with a force");
    if (!radius_.empty()) throw UsageError("--radius has no meaning for a single node");
    parseNode(node_);
    parseVector("--displace", displacement_);
    return;
  }
  touch();
}

modeling::Touch TouchInput::touch() const {
  modeling::Touch touch;
  touch.name = "touch";
  touch.at = parseVector("--at", at_);
  if (!displacement_.empty()) {
    touch.action = modeling::TouchDisplacement{parseVector("--displace", displacement_)};
  } else {
    touch.action = modeling::TouchForce{parseVector("--force", force_)};
  }
  if (!radius_.empty()) touch.radius = parsePositive("--radius", radius_);
  return touch;
}

app::TouchState TouchInput::play(const app::TouchModel& model,
                                 const modeling::Project& project) const {
  if (!node_.empty()) {
    return app::touchNode(model, parseNode(node_), parseVector("--displace", displacement_));
  }
  if (!at_.empty()) {
    const modeling::Touch given = touch();
    return app::playTouches(model, {&given, 1});
  }
  return app::playTouches(model, project.touches);
}

void ProbeInput::declare(CLI::App& options) {
  options
      .add_option("--probe", probes_,
                  "Place on the surface to report displacement and traction of, mm; any number")
      ->type_name("X,Y,Z")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void ProbeInput::validate() const {
  parseVectors("--probe", probes_);
}

std::vector<app::Probe> ProbeInput::read(const app::TouchModel& model,
                                         const app::TouchState& state) const {
  std::vector<app::Probe> results;
  for (const Eigen::Vector3d& at : parseVectors("--probe", probes_)) {
    results.push_back(app::probe(model, state, at));
  }
  return results;
}

}  // namespace palpa::cli
