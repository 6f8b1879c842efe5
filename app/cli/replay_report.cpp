#include "app/cli/replay_report.h"

#include <algorithm>

#include "app/cli/text.h"
#include "app/core/live/touch_table.h"
#include "app/core/model/contact_kind.h"

namespace palpa::cli {
namespace {

double seconds(std::uint64_t step) {
  return 1e-3 * static_cast<double>(step);
}

}  // namespace

ReplayReport::ReplayReport(const app::RecordingFile& file, app::RecordedModel present)
    : recorded_(file.model),
      present_(std::move(present)),
      steps_(file.recording.steps),
      commands_(file.recording.entries.size()) {
  if (std::string warning = app::differenceOf(recorded_, present_); !warning.empty())
    warnings_.push_back(std::move(warning));
  if (file.recording.modelChanges > 0)
    warnings_.emplace_back("the model was replaced while it was recorded; its forces are others");
  if (file.recording.isFull)
    warnings_.emplace_back("the end of the recording was lost, it was too long");
}

ReplayReport::Contact& ReplayReport::find(const app::TouchSnapshot::Contact& contact,
                                          std::uint64_t step) {
  // Present contacts are the last ones of the list.
  const auto found = std::find_if(contacts_.rbegin(), contacts_.rend(),
                                  [&](const Contact& each) { return each.id == contact.id; });
  if (found != contacts_.rend()) return *found;
  Contact& fresh = contacts_.emplace_back();
  fresh.id = contact.id;
  fresh.tool = contact.tool;
  fresh.first = step;
  return fresh;
}

void ReplayReport::add(const app::TouchSnapshot& snapshot, std::uint64_t step) {
  if (!snapshot.isConverged) ++unconverged_;
  for (const auto& contact : snapshot.touched()) {
    Contact& seen = find(contact, step);
    seen.last = step;
    if (std::find(seen.statuses.begin(), seen.statuses.end(), contact.status) ==
        seen.statuses.end())
      seen.statuses.push_back(contact.status);
    const double force = contact.force.norm();
    if (force <= seen.largest) continue;
    seen.largest = force;
    seen.largestStep = step;
    seen.largestForce = contact.force;
    seen.largestAt = contact.point.position;
  }
}

Json ReplayReport::json() const {
  const auto describe = [](const app::RecordedModel& model) {
    return Json{{"name", model.name}, {"key", model.key}, {"nodes", model.nodes}};
  };
  Json report{{"model", describe(present_)},
              {"recorded_model", describe(recorded_)},
              {"steps", steps_},
              {"duration_s", seconds(steps_)},
              {"commands", commands_},
              {"unconverged_steps", unconverged_},
              {"contacts", Json::array()}};
  for (const Contact& contact : contacts_) {
    Json one{{"contact", contact.id},
             {"kind", app::infoOf(contact.tool.kind).name},
             {"radius_mm", contact.tool.radius},
             {"friction", contact.tool.friction},
             {"from_s", seconds(contact.first)},
             {"to_s", seconds(contact.last)},
             {"statuses", Json::array()},
             {"largest_force",
              {{"N", contact.largest},
               {"time_s", seconds(contact.largestStep)},
               {"force_N", cli::toJson(contact.largestForce)},
               {"at_mm", cli::toJson(contact.largestAt)}}}};
    for (const auto status : contact.statuses) one["statuses"].push_back(app::nameOf(status));
    report["contacts"].push_back(std::move(one));
  }
  report["warnings"] = warnings_;
  return report;
}

std::string ReplayReport::text() const {
  std::string text = format("recording  %.3f s, %zu commands, %zu contacts\n", seconds(steps_),
                            commands_, contacts_.size());
  for (const std::string& warning : warnings_) text += "warning    " + warning + "\n";
  for (const Contact& contact : contacts_) {
    text += format("contact    %u: %s, radius %.4g mm", contact.id,
                   app::infoOf(contact.tool.kind).name, contact.tool.radius);
    if (contact.tool.friction > 0) text += format(", friction %.4g", contact.tool.friction);
    text += format(", %.3f … %.3f s", seconds(contact.first), seconds(contact.last));
    for (const auto status : contact.statuses)
      text += std::string(&status == contact.statuses.data() ? ": " : ", ") + app::nameOf(status);
    text += format("\n           largest force %.4g N after %.3f s: ", contact.largest,
                   seconds(contact.largestStep)) +
            cli::toText(contact.largestForce, 4) + " N at " + cli::toText(contact.largestAt, 4) +
            " mm\n";
  }
  if (unconverged_ > 0)
    text += format("steps      %llu did not meet the laws of contact and kept the forces before\n",
                   static_cast<unsigned long long>(unconverged_));
  return text;
}

}  // namespace palpa::cli
