#include "app/cli/sweep_report.h"

#include "app/cli/text.h"
#include "app/core/live/touch_table.h"

namespace palpa::cli {

Json sweepJson(std::span<const app::SweepRow> rows) {
  Json list = Json::array();
  for (const app::SweepRow& row : rows) {
    Json contacts = Json::array();
    for (std::size_t k = 0; k < row.contacts.size(); ++k) {
      const app::TouchState::Contact& contact = row.contacts[k];
      const modeling::TouchKindInfo& kind = modeling::infoOf(row.touches[k].kind);
      contacts.push_back({{"name", contact.name},
                          {"status", app::nameOf(contact.status)},
                          {kind.isForce ? "given_force_N" : "given_displace_mm",
                           cli::toJson(row.touches[k].vector)},
                          {"force_N", cli::toJson(contact.force)},
                          {"displacement_mm", cli::toJson(contact.displacement)},
                          {"deflection_mm", cli::toJson(contact.deflection)},
                          {"stiffness_N_per_mm", contact.stiffness}});
    }
    list.push_back({{"share", row.share}, {"energy_mJ", row.energy}, {"contacts", contacts}});
  }
  return list;
}

std::string sweepText(std::span<const app::SweepRow> rows) {
  if (rows.empty()) return {};
  std::string text =
      format("sweep      %zu steps: given, force, into the body, stiffness\n", rows.size() - 1);
  for (const app::SweepRow& row : rows)
    for (std::size_t k = 0; k < row.contacts.size(); ++k) {
      const app::TouchState::Contact& contact = row.contacts[k];
      const modeling::Touch& touch = row.touches[k];
      text += format("           %s: %.4g %s, %.4g N, %.4g N, %.4g N/mm, %s\n", touch.name.c_str(),
                     touch.vector.norm(), modeling::infoOf(touch.kind).isForce ? "N" : "mm",
                     contact.force.norm(), contact.normalForce(), contact.stiffness,
                     app::nameOf(contact.status));
    }
  return text;
}

}  // namespace palpa::cli
