#include "app/core/results/touch_sweep.h"

#include <stdexcept>
#include <utility>

#include "app/core/live/touch_table.h"
#include "app/core/results/touch.h"
#include "base/part_of_job.h"
#include "base/text.h"

namespace palpa::app {
namespace {

/// A name as a field of a table.
std::string quotedField(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace

std::vector<modeling::Touch> scaled(std::span<const modeling::Touch> touches, double share) {
  std::vector<modeling::Touch> result(touches.begin(), touches.end());
  for (modeling::Touch& touch : result) touch.vector *= share;
  return result;
}

void sweepTouches(const TouchModel& model, std::span<const modeling::Touch> touches, int count,
                  int steps, const Job& job, const std::function<void(SweepRow)>& seen) {
  if (count < 1 || count > kMaxSweepSteps)
    throw std::invalid_argument("a sweep has 1 to 1000 steps");
  TouchPlayer player(model);
  for (int k = 0; k <= count; ++k) {
    job.throwIfCancelled();
    const auto number = static_cast<std::size_t>(k), all = static_cast<std::size_t>(count) + 1;
    const Job part = partOfJob(job, number, number + 1, all);
    SweepRow row;
    row.share = static_cast<double>(k) / count;
    row.touches = scaled(touches, row.share);
    TouchState state = player.play(row.touches, steps, part);
    row.contacts = std::move(state.contacts);
    row.energy = state.energy;
    seen(std::move(row));
    job.report(Phase::kTouch, (k + 1.0) / (count + 1));
  }
}

void writeSweep(std::span<const SweepRow> rows, std::ostream& out) {
  out << "share,touch,kind,status,given,given_unit,force_N,normal_force_N,tangential_force_N,"
         "force_x_N,force_y_N,force_z_N,displacement_mm,displacement_x_mm,displacement_y_mm,"
         "displacement_z_mm,deflection_mm,stiffness_N_per_mm,patch_radius_mm,energy_mJ\n";
  const auto number = [&out](double value) { out << ',' << numberText(value); };
  for (const SweepRow& row : rows)
    for (std::size_t k = 0; k < row.contacts.size(); ++k) {
      const modeling::Touch& touch = row.touches[k];
      const TouchState::Contact& contact = row.contacts[k];
      const modeling::TouchKindInfo& kind = modeling::infoOf(touch.kind);
      out << numberText(row.share) << ',' << quotedField(touch.name) << ',' << kind.name << ','
          << nameOf(contact.status);
      number(touch.vector.norm());
      out << (kind.isForce ? ",N" : ",mm");
      number(contact.force.norm());
      number(contact.normalForce());
      number(contact.tangentialForce().norm());
      for (int axis = 0; axis < 3; ++axis) number(contact.force[axis]);
      number(contact.displacement.norm());
      for (int axis = 0; axis < 3; ++axis) number(contact.displacement[axis]);
      number(contact.deflection.norm());
      number(contact.stiffness);
      number(contact.patchRadius());
      number(row.energy);
      out << '\n';
    }
}

}  // namespace palpa::app
