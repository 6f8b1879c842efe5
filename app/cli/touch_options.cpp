#include "app/cli/touch_options.h"

#include <algorithm>
#include <charconv>

#include "app/cli/errors.h"
#include "app/cli/suggestion.h"
#include "app/cli/values.h"
#include "app/core/results/state_series.h"
#include "app/core/results/tool_trajectory.h"
#include "app/core/results/touch.h"
#include "app/core/setup/project_geometry.h"
#include "modeling/project/proposed_support.h"
#include "modeling/project/touch_place.h"

namespace palpa::cli {
namespace {

using modeling::TouchKind;
using modeling::TouchKindInfo;

constexpr const char* kUsualDepth = "1%";

int parseNode(const std::string& text) {
  int node = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), node);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || node < 0) {
    throw UsageError("--node: expected the number of a node (0, 1, …), found '" + text + "'");
  }
  return node;
}

/// A length of --depth in mm.
double parseDepth(const std::string& text, double size) {
  const bool isShare = !text.empty() && text.back() == '%';
  const double number = parsePositive("--depth", isShare ? text.substr(0, text.size() - 1) : text);
  return isShare ? number / 100 * size : number;
}

/// In the order of TouchOptions::Which.
constexpr const char* kNames[] = {"--at",    "--kind",   "--displace",
                                  "--force", "--radius", "--friction"};

double parseFriction(const std::string& text) {
  if (text.empty()) return 0;
  const double friction = parseNumber("--friction", text);
  if (friction < 0 || friction > modeling::kMaxFriction)
    throw UsageError("--friction: expected a number from 0 to 10, found '" + text + "'");
  return friction;
}

/// The names of kinds that fulfil a condition, with separators.
template <class Condition>
std::string namesOf(const char* separator, Condition condition) {
  std::string names;
  for (const TouchKindInfo& info : modeling::kTouchKinds)
    if (condition(info)) names += (names.empty() ? "" : separator) + std::string(info.name);
  return names;
}

const char* describe(TouchKind kind) {
  switch (kind) {
    case TouchKind::kGrab:
      return "(default) moves the place";
    case TouchKind::kForce:
      return "pulls with a force (default with --force)";
    case TouchKind::kPush:
      return "presses with a fingertip that slides";
    case TouchKind::kBall:
      return "presses with a rigid ball that slides";
    case TouchKind::kPin:
      return "keeps the place where loads leave it";
  }
  return "";
}

std::string kindHelp() {
  std::string text;
  for (const TouchKindInfo& info : modeling::kTouchKinds)
    text += (text.empty() ? "" : "; ") + std::string(info.name) + ": " + describe(info.kind);
  return text;
}

TouchKind parseKind(const std::string& text) {
  const std::string name(modeling::presentKindName(text));
  if (const auto kind = modeling::touchKindNamed(name)) return *kind;
  std::vector<std::string> names;
  for (const TouchKindInfo& info : modeling::kTouchKinds) names.emplace_back(info.name);
  throw UsageError("--kind: there is no kind '" + text + "'" + didYouMean(text, names) +
                   "; known are " + namesOf(", ", [](const auto&) { return true; }));
}

}  // namespace

void TouchOptions::declare(CLI::App& options) {
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
  add(kKind, kindHelp().c_str(), "KIND");
  add(kDisplace,
      "Displacement in mm: of a grab from the unloaded shape, of a push or ball from first "
      "contact, of a pin from where loads leave the place",
      "X,Y,Z");
  add(kForce, "Force on the touched place, N, instead of --displace", "X,Y,Z");
  add(kRadius, "Radius of the contact, or of the ball, mm (default: a fingertip's)", "LENGTH");
  add(kFriction, "Coulomb's coefficient of a push or ball, 0 to 10 (default 0)", "NUMBER");
  options
      .add_option("--place", place_,
                  "auto: touch the place opposite to the supports, and press it by --depth along "
                  "its inward normal; without a support, the largest flat face is held")
      ->type_name("auto");
  options
      .add_option("--depth", depth_,
                  "With --place: how far to press, in mm or as a share of the diagonal of the "
                  "body's box (default 1%)")
      ->type_name("LENGTH|SHARE%");
  options.add_option("--node", node_, "Touch one node of the mesh instead of a place")
      ->type_name("K");
  options
      .add_option("--steps", steps_,
                  "Steps along the paths of pushes and balls, 1 to 10000 (default: so that each "
                  "moves by a hundredth of its radius)")
      ->type_name("N");
}

std::vector<TouchOptions::Group> TouchOptions::groups() const {
  std::vector<Group> groups;
  const bool isOne = isPlaced() || option(kAt).values.size() == 1;
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

void TouchOptions::validate() const {
  if (option(kAt).isGiven() + isPlaced() + isNode() > 1)
    throw UsageError("give either --at, --place or --node");
  validatePlace();
  if (!steps_.empty()) steps();
  if (!node_.empty()) {
    validateNode();
  } else if (option(kAt).isGiven() || isPlaced()) {
    touches();
    for (const TouchKindInfo& info : modeling::kTouchKinds)
      if (const auto& kinds = option(kKind).values;
          info.formerName && std::find(kinds.begin(), kinds.end(), info.formerName) != kinds.end())
        noteFormerName("--kind " + std::string(info.formerName),
                       "--kind " + std::string(info.name));
  } else {
    for (std::size_t which = kKind; which < kCount; ++which)
      if (repeated_[which].isGiven())
        throw UsageError(std::string(kNames[which]) + " needs --at (or --place auto, or --node)");
  }
}

void TouchOptions::validateNode() const {
  for (const Which which : {kForce, kRadius, kFriction})
    if (option(which).isGiven())
      throw UsageError(std::string(kNames[which]) +
                       " has no meaning for a single node, which can only be displaced");
  if (option(kKind).isGiven() && parseKind(option(kKind).values.front()) != TouchKind::kGrab)
    throw UsageError("--kind: a single node can only be grabbed");
  if (option(kDisplace).values.size() != 1) throw UsageError("--node needs one --displace");
  parseNode(node_);
  parseVector("--displace", option(kDisplace).values.front());
}

void TouchOptions::validatePlace() const {
  if (isPlaced() && place_ != "auto")
    throw UsageError("--place: expected auto, found '" + place_ +
                     "'; give the coordinates of a place with --at");
  if (depth_.empty()) return;
  if (!isPlaced()) throw UsageError("--depth needs --place auto");
  if (option(kDisplace).isGiven() || option(kForce).isGiven())
    throw UsageError("a touch has either --depth, --displace or --force");
  const TouchKind kind =
      option(kKind).isGiven() ? parseKind(option(kKind).values.front()) : TouchKind::kGrab;
  if (modeling::infoOf(kind).isForce || !modeling::infoOf(kind).needsVector)
    throw UsageError("--kind " + option(kKind).values.front() + " has no --depth");
  parseDepth(depth_, 1);
}

void TouchOptions::place(modeling::Touch& touch, const modeling::Project& project) const {
  const auto [low, high] = modeling::boundingBox(project.body);
  const double size = (high - low).norm();
  const modeling::TouchPlace place = modeling::placeOppositeToSupports(
      project.body, project.supports, touch.radius.value_or(app::radiusOfFirstTouch(size)));
  touch.at = place.position;
  if (!touch.radius) touch.radius = place.radius;
  if (!option(kDisplace).isGiven() && modeling::infoOf(touch.kind).needsVector &&
      !modeling::infoOf(touch.kind).isForce)
    touch.vector = -parseDepth(depth_.empty() ? kUsualDepth : depth_, size) * place.normal;
}

modeling::Touch TouchOptions::touchOf(const Group& group) const {
  const std::string& displacement = group[kDisplace];
  const std::string& force = group[kForce];
  modeling::Touch touch;
  if (!isPlaced()) touch.at = parseVector("--at", group[kAt]);
  if (!group[kKind].empty()) touch.kind = parseKind(group[kKind]);
  if (!displacement.empty() && !force.empty())
    throw UsageError("a touch has either --displace or --force");
  if (touch.kind == TouchKind::kGrab && !force.empty()) touch.kind = TouchKind::kForce;
  const TouchKindInfo& kind = modeling::infoOf(touch.kind);
  if (!kind.presses && !group[kFriction].empty())
    throw UsageError("--friction needs --kind " +
                     namesOf(" or ", [](const TouchKindInfo& each) { return each.presses; }));
  if (!kind.isForce && !force.empty())
    throw UsageError("--kind " + std::string(kind.name) + " has --displace, but no --force");
  const Which which = kind.isForce ? kForce : kDisplace;
  const bool hasDepth = isPlaced() && !kind.isForce;
  if (kind.needsVector && !hasDepth && group[which].empty())
    throw UsageError(group[kKind].empty()
                         ? std::string("a touch needs either --displace or --force")
                         : "--kind " + std::string(kind.name) + " needs " + kNames[which]);
  if (!group[which].empty()) touch.vector = parseVector(kNames[which], group[which]);
  touch.friction = parseFriction(group[kFriction]);
  if (!group[kRadius].empty()) touch.radius = parsePositive("--radius", group[kRadius]);
  return touch;
}

std::vector<modeling::Touch> TouchOptions::touches() const {
  std::vector<modeling::Touch> touches;
  const std::vector<Group> given = groups();
  for (const Group& group : given) {
    touches.push_back(touchOf(group));
    touches.back().name = given.size() == 1 ? "touch" : "touch " + std::to_string(touches.size());
  }
  return touches;
}

modeling::Project TouchOptions::touched(modeling::Project project) const {
  if (option(kAt).isGiven() || isPlaced()) project.touches = touches();
  if (!isPlaced()) return project;
  if (project.supports.empty()) project.supports = {modeling::proposeSupport(project.body).support};
  place(project.touches.front(), project);
  return project;
}

int TouchOptions::steps() const {
  return steps_.empty() ? 0 : parseCount("--steps", steps_, app::kMaxSteps);
}

app::TouchState TouchOptions::play(const app::TouchModel& model, const modeling::Project& project,
                                   const Context& context, const Job& job) const {
  if (!node_.empty()) {
    return app::touchNode(model, parseNode(node_),
                          parseVector("--displace", option(kDisplace).values.front()));
  }
  app::TouchState state = app::playTouches(model, project.touches, steps(), job);
  context.progress.clear();
  return state;
}

std::vector<app::SweepRow> TouchOptions::sweep(const app::TouchModel& model,
                                               const modeling::Project& project, int count,
                                               const Context& context) const {
  std::vector<app::SweepRow> rows;
  app::sweepTouches(model, project.touches, count, steps(), context.job(),
                    [&rows](app::SweepRow row) { rows.push_back(std::move(row)); });
  context.progress.clear();
  return rows;
}

void TouchOptions::writeSeries(const app::TouchModel& model, std::span<const app::SweepRow> rows,
                               const std::string& path, const Context& context) const {
  app::writeSweepSeries(model, rows, steps(), path, context.job());
  context.progress.clear();
}

}  // namespace palpa::cli
