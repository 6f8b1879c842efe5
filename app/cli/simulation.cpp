#include "app/cli/simulation.h"

#include <charconv>

#include "app/cli/errors.h"
#include "app/cli/suggestion.h"
#include "app/cli/values.h"
#include "app/core/results/tool_trajectory.h"
#include "app/core/results/touch.h"

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

/// In the order of TouchInput::Which.
constexpr const char* kNames[] = {"--at",    "--kind",   "--displace",
                                  "--force", "--radius", "--friction"};

double parseFriction(const std::string& text) {
  if (text.empty()) return 0;
  const double friction = parseNumber("--friction", text);
  if (friction < 0 || friction > modeling::kMaxFriction)
    throw UsageError("--friction: expected a number from 0 to 10, found '" + text + "'");
  return friction;
}

/// What the options of a touch say; empty: not given.
decltype(modeling::Touch::action) actionOf(const std::string& kind, const std::string& displacement,
                                           const std::string& force, const std::string& friction) {
  const bool isPushing = kind == "push" || kind == "probe";
  if (!isPushing && !kind.empty() && kind != "grab" && kind != "force" && kind != "pin") {
    const std::string near = didYouMean(kind, {"grab", "push", "probe", "force", "pin"});
    throw UsageError("--kind: there is no kind '" + kind + "'" + near +
                     "; known are grab, push, probe, force, pin");
  }
  if (!friction.empty() && !isPushing) throw UsageError("--friction needs --kind push or probe");
  if (!displacement.empty() && !force.empty())
    throw UsageError("a touch has either --displace or --force");
  if (kind == "force" || (!force.empty() && !isPushing && kind != "pin")) {
    if (force.empty()) throw UsageError("--kind force needs --force");
    return modeling::TouchForce{parseVector("--force", force)};
  }
  if (!force.empty()) throw UsageError("--kind " + kind + " has --displace, but no --force");
  if (kind == "pin")
    return modeling::TouchPin{displacement.empty() ? Eigen::Vector3d::Zero()
                                                   : parseVector("--displace", displacement)};
  if (displacement.empty())
    throw UsageError(isPushing ? "--kind " + kind + " needs --displace"
                               : "a touch needs either --displace or --force");
  const Eigen::Vector3d vector = parseVector("--displace", displacement);
  if (kind == "push") return modeling::TouchPush{vector, parseFriction(friction)};
  if (kind == "probe") return modeling::TouchProbe{vector, parseFriction(friction)};
  return modeling::TouchDisplacement{vector};
}

}  // namespace

Job jobOf(const Context& context) {
  Job job;
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
  app_ = &options;
  const auto add = [&](Which which, const char* help, const char* type) {
    Repeated& one = repeated_[which];
    one.option = options.add_option(kNames[which], one.values, help)
                     ->type_name(type)
                     ->expected(1)
                     ->allow_extra_args(false)
                     ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  add(kAt,
      "Place on the surface to touch, mm; given again, it begins another touch, to which the "
      "options after it belong",
      "X,Y,Z");
  add(kKind,
      "grab (default): moves the place; force: pulls with a force (default with --force); push: a "
      "fingertip, and probe: a ball, that press but do not pull, and slide; pin: holds the place",
      "KIND");
  add(kDisplace,
      "Displacement in mm: of a grab from the unloaded shape, of a push or probe from first "
      "contact, of a pin from where loads leave the place",
      "X,Y,Z");
  add(kForce, "Force on the touched place, N, instead of --displace", "X,Y,Z");
  add(kRadius, "Radius of the contact, or of the ball, mm (default: a fingertip's)", "LENGTH");
  add(kFriction, "Coulomb's coefficient of a push or probe, 0 to 10 (default 0)", "NUMBER");
  options.add_option("--node", node_, "Touch one node of the mesh instead of a place")
      ->type_name("K");
  options
      .add_option("--steps", steps_,
                  "Steps along the ways of pushes and probes, 1 to 10000 (default: so that each "
                  "moves by a hundredth of its radius)")
      ->type_name("N");
}

std::vector<TouchInput::Group> TouchInput::groups() const {
  std::vector<Group> groups;
  const bool isOne = option(kAt).values.size() == 1;
  if (isOne) groups.emplace_back();  // whatever the order
  std::array<std::size_t, kCount> next{};
  for (const CLI::Option* parsed : app_->parse_order()) {
    for (std::size_t which = 0; which < kCount; ++which) {
      if (repeated_[which].option != parsed) continue;
      if (which == kAt && !isOne) groups.emplace_back();
      if (groups.empty())
        throw UsageError(std::string(kNames[which]) +
                         " stands before the first --at; with several touches the options of each "
                         "follow its --at");
      std::string& value = groups.back()[which];
      if (!value.empty())
        throw UsageError(std::string(kNames[which]) + " is given twice for one touch");
      value = repeated_[which].values.at(next[which]++);
      if (value.empty()) throw UsageError(std::string(kNames[which]) + ": is empty");
    }
  }
  return groups;
}

void TouchInput::validate() const {
  if (option(kAt).isGiven() && !node_.empty()) throw UsageError("give either --at or --node");
  if (!steps_.empty()) steps();
  if (!node_.empty()) {
    validateNode();
  } else if (option(kAt).isGiven()) {
    touches();
  } else {
    for (std::size_t which = kKind; which < kCount; ++which)
      if (repeated_[which].isGiven())
        throw UsageError(std::string(kNames[which]) + " needs --at (or --node)");
  }
}

void TouchInput::validateNode() const {
  for (const Which which : {kForce, kRadius, kFriction})
    if (option(which).isGiven())
      throw UsageError(std::string(kNames[which]) +
                       " has no meaning for a single node, which can only be displaced");
  if (option(kKind).isGiven() && option(kKind).values.front() != "grab")
    throw UsageError("--kind: a single node can only be grabbed");
  if (option(kDisplace).values.size() != 1) throw UsageError("--node needs one --displace");
  parseNode(node_);
  parseVector("--displace", option(kDisplace).values.front());
}

std::vector<modeling::Touch> TouchInput::touches() const {
  std::vector<modeling::Touch> touches;
  const std::vector<Group> given = groups();
  for (const Group& group : given) {
    modeling::Touch touch;
    touch.name = given.size() == 1 ? "touch" : "touch " + std::to_string(touches.size() + 1);
    touch.at = parseVector("--at", group[kAt]);
    touch.action = actionOf(group[kKind], group[kDisplace], group[kForce], group[kFriction]);
    if (!group[kRadius].empty()) touch.radius = parsePositive("--radius", group[kRadius]);
    touches.push_back(std::move(touch));
  }
  return touches;
}

modeling::Project TouchInput::touched(modeling::Project project) const {
  if (option(kAt).isGiven()) project.touches = touches();
  return project;
}

int TouchInput::steps() const {
  if (steps_.empty()) return 0;
  int steps = 0;
  const char* end = steps_.data() + steps_.size();
  const auto result = std::from_chars(steps_.data(), end, steps);
  if (result.ec != std::errc() || result.ptr != end || steps < 1 || steps > app::kMaxSteps)
    throw UsageError("--steps: expected a whole number from 1 to " +
                     std::to_string(app::kMaxSteps) + ", found '" + steps_ + "'");
  return steps;
}

app::TouchState TouchInput::play(const app::TouchModel& model, const modeling::Project& project,
                                 const Context& context) const {
  if (!node_.empty()) {
    return app::touchNode(model, parseNode(node_),
                          parseVector("--displace", option(kDisplace).values.front()));
  }
  app::TouchState state =
      app::playTouches(model, touched(project).touches, steps(), jobOf(context));
  context.progress.clear();
  return state;
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

std::vector<app::FieldSample> ProbeInput::read(const app::TouchModel& model,
                                         const app::TouchState& state) const {
  std::vector<app::FieldSample> results;
  for (const Eigen::Vector3d& at : parseVectors("--probe", probes_)) {
    results.push_back(app::sampleField(model, state, at));
  }
  return results;
}

}  // namespace palpa::cli
