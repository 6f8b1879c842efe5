#include "app/cli/state_report.h"

#include <algorithm>
#include <cmath>

#include "app/cli/mesh_report.h"
#include "app/cli/text.h"
#include "app/core/live/touch_table.h"
#include "app/core/results/largest_displacement.h"
#include "app/core/system/memory.h"
#include "app/report/numbers.h"
#include "app/report/state_words.h"
#include "app/report/words.h"

namespace palpa::cli {
namespace {

constexpr double kMebibyte = 1024.0 * 1024.0;

Json toJson(const std::string& name, const bem::Resultant& resultant) {
  return {{"name", name},
          {"force_N", cli::toJson(resultant.force)},
          {"moment_Nmm", cli::toJson(resultant.moment)}};
}

std::string toText(const char* what, const std::string& name, const bem::Resultant& resultant,
                   double error, double lever) {
  return format("%-10s %s: ", what, name.c_str()) + report::resultantText(resultant, error, lever) +
         "\n";
}

Json toJson(const app::TouchState::Contact& contact) {
  Json json;
  if (!contact.name.empty()) json["name"] = contact.name;
  json["kind"] = report::kindName(contact);
  json["status"] = app::nameOf(contact.status);
  json["at_mm"] = cli::toJson(contact.at);
  json["radius_mm"] = contact.radius;
  json["force_N"] = cli::toJson(contact.force);
  json["normal"] = cli::toJson(contact.normal);
  json["normal_force_N"] = contact.normalForce();
  json["tangential_force_N"] = contact.tangentialForce().norm();
  json["displacement_mm"] = cli::toJson(contact.displacement);
  json["deflection_mm"] = cli::toJson(contact.deflection);
  json["stiffness_N_per_mm"] = contact.stiffness;
  if (contact.errorEstimate) json["error_estimate"] = *contact.errorEstimate;
  if (!contact.presses()) return json;
  json["friction"] = contact.friction;
  json["tool_mm"] = cli::toJson(contact.tool);
  json["patch"] = {{"radius_mm", contact.patchRadius()}, {"masks", Json::array()}};
  for (const auto& mask : contact.patch) {
    json["patch"]["masks"].push_back({{"at_mm", cli::toJson(mask.point.position)},
                                      {"radius_mm", mask.radius},
                                      {"force_N", cli::toJson(mask.force)}});
  }
  return json;
}

std::string toText(const app::TouchState::Contact& contact) {
  const char* label = contact.name.empty() ? "touch" : contact.name.c_str();
  std::string text = format("%-10s %s", "contact", label);
  text += std::string(": ") + report::kindName(contact) + ", " + app::nameOf(contact.status) +
          ", at " + cli::toText(contact.at, 4) + " mm";
  if (contact.radius > 0) text += format(", radius %.4g mm", contact.radius);
  if (contact.presses()) text += format(", friction %.4g", contact.friction);
  text += ", moved by " + cli::toText(contact.displacement, 4) + " mm\n";
  const double force = contact.force.norm();
  const double error = contact.errorEstimate.value_or(0);
  const bool isGiven = contact.hasGivenForce();
  const double ofForce = isGiven ? 0 : error;
  text += "           force " + report::rounded(contact.force, ofForce) + " N, |" +
          report::withError(force, ofForce) +
          "| N: " + report::inDecimalsOf(contact.normalForce(), force, ofForce) +
          " N into the body, " +
          report::inDecimalsOf(contact.tangentialForce().norm(), force, ofForce) +
          " N along it; deflection " + report::rounded(contact.deflection.norm(), error) +
          " mm, stiffness " + report::rounded(contact.stiffness, error) + " N/mm\n";
  if (contact.isBall() && !contact.patch.empty())
    text += format("           patch radius %.4g mm, %zu masks\n", contact.patchRadius(),
                   contact.patch.size());
  return text;
}

}  // namespace

Json StateReport::json() const {
  const app::BuildReport& build = model.report();
  const app::LargestDisplacement largest = app::largestDisplacement(model, state);
  Json report{{"nodes", build.nodes}, {"triangles", build.triangles}};
  addTo(report, model.surface().simplification);
  report["engine"] = report::engineName(model.setup().engine);
  report["elements"] = model.setup().discretisation->elementCount();
  report["coefficients"] = model.setup().discretisation->displacementCount();
  report["error_estimate"] = state.errorEstimate ? Json(*state.errorEstimate) : Json();
  report["force_error_estimate"] =
      state.forceErrorEstimate ? Json(*state.forceErrorEstimate) : Json();
  report["supports"] = Json::array();
  for (const auto& support : state.supports) {
    report["supports"].push_back(toJson(support.name, support.resultant));
  }
  report["loads"] = Json::array();
  for (const auto& load : model.setup().loads) {
    report["loads"].push_back(toJson(load.name, load.resultant));
  }
  if (!state.contacts.empty()) {
    report["contacts"] = Json::array();
    for (const auto& contact : state.contacts) {
      report["contacts"].push_back(toJson(contact));
    }
  }
  if (state.path) {
    report["path"] = {{"steps", state.path->steps},
                      {"settling_steps", state.path->settlingSteps},
                      {"converged", true},
                      {"last_change", state.path->change},
                      {"residual", state.path->residual}};
  }
  if (!build.notice.empty()) report["notice"] = build.notice;
  report["balance_N"] = state.balance;
  report["relative_balance"] = state.relativeBalance;
  report["energy_mJ"] = state.energy;
  report["largest_displacement"] = {{"u_mm", largest.length}, {"at_mm", cli::toJson(largest.at)}};
  report["samples"] = Json::array();
  for (const app::FieldSample& sample : samples) {
    report["samples"].push_back({{"at_mm", cli::toJson(sample.at)},
                                 {"nearest_surface_mm", cli::toJson(sample.nearestSurface)},
                                 {"u_mm", cli::toJson(sample.displacement)},
                                 {"traction_MPa", cli::toJson(sample.traction)}});
  }
  if (hasFormerKey) report["probes"] = report["samples"];
  report["seconds"] = {{"mesh", build.meshSeconds},
                       {"assemble", build.assembleSeconds},
                       {"factorise", build.factoriseSeconds},
                       {"solve", build.solveSeconds}};
  if (!state.contacts.empty()) report["seconds"]["touch"] = touchSeconds;
  report["operators"] = {{"storage", build.storage}, {"memory_MiB", build.memory / kMebibyte}};
  report["memory_MiB"] = app::peakMemory() / kMebibyte;
  return report;
}

std::string StateReport::text() const {
  const app::BuildReport& build = model.report();
  const app::LargestDisplacement largest = app::largestDisplacement(model, state);
  const bool isSplines = model.setup().engine == modeling::Engine::kSplines;
  std::string text = (isSplines ? "splines    " : "mesh       ") + report::meshText(model) + "\n" +
                     toText(model.surface().simplification);
  if (!build.notice.empty()) text += "note       " + build.notice + "\n";
  if (state.contacts.empty() && model.setup().loads.empty() && state.energy == 0)
    text += "note       no load acts and nothing is touched, so nothing moves\n";
  for (const auto& contact : state.contacts) {
    text += toText(contact);
  }
  if (state.path) {
    text += format(
        "path       %d steps, then %d at rest; converged: the last changed forces by %.1g of the "
        "largest\n",
        state.path->steps, state.path->settlingSteps, state.path->change);
  }
  for (const auto& load : model.setup().loads)
    text += toText("load", load.name, load.resultant, 0, 0);
  for (const auto& support : state.supports) {
    text += toText("support", support.name, support.resultant, state.forceErrorEstimate.value_or(0),
                   model.setup().mesh().boundingSize());
  }
  text += "balance    " + report::balanceText(state) + "\n";
  // A body at rest has no error.
  if (state.errorEstimate && *state.errorEstimate > 0)
    text += "accuracy   " + report::accuracyText(state) + "\n";
  text += format("energy     %.4g mJ\n", state.energy);
  text += format("largest u  %.4g mm at ", largest.length) + cli::toText(largest.at, 4) + " mm\n";
  for (const app::FieldSample& sample : samples) {
    text += "sample     " + cli::toText(sample.nearestSurface, 5) + " mm: u " +
            cli::toText(sample.displacement) + " mm, traction " + cli::toText(sample.traction) +
            " MPa\n";
  }
  text +=
      format("time       mesh %.2f s, assemble %.2f s, factorise %.2f s, solve %.2f s",
             build.meshSeconds, build.assembleSeconds, build.factoriseSeconds, build.solveSeconds);
  if (!state.contacts.empty()) text += format(", touch %.2f s", touchSeconds);
  text += "; memory " + app::formatBytes(app::peakMemory()) + "\n";
  return text;
}

}  // namespace palpa::cli
