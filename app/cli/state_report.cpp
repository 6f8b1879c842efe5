#include "app/cli/state_report.h"

#include <algorithm>
#include <cmath>

#include "app/cli/mesh_report.h"
#include "app/cli/text.h"
#include "app/core/live/touch_table.h"
#include "app/core/system/memory.h"
#include "base/count_text.h"
#include "base/number_with_error.h"

namespace palpa::cli {
namespace {

constexpr double kMebibyte = 1024.0 * 1024.0;

Json toJson(const std::string& name, const bem::Resultant& resultant) {
  return {{"name", name},
          {"force_N", cli::toJson(resultant.force)},
          {"moment_Nmm", cli::toJson(resultant.moment)}};
}

/// A number without the digits that its relative error makes uncertain.
std::string rounded(double value, double error) {
  if (!(error > 0)) return format("%.4g", value);
  return withDecimals(value, decimalsFor(value, error * std::abs(value)));
}

std::string rounded(const Eigen::Vector3d& vector, double error) {
  if (!(error > 0)) return cli::toText(vector, 4);
  const double length = vector.norm();
  return cli::toText(vector, digitsFor(length, error * length));
}

/// A number of at most the size of `whole`, with the same decimals.
std::string inDecimalsOf(double value, double whole, double error) {
  if (!(error > 0)) return format("%.4g", value);
  return withDecimals(value, decimalsFor(whole, error * whole));
}

/// "4.72 ± 0.03", without the error where it is not known.
std::string withError(double value, double error) {
  const std::string text = rounded(value, error);
  if (!(error > 0) || value == 0) return text;
  return text + " ± " + errorText(error * value, decimalsFor(value, error * value));
}

/// `error`: relative, 0 for a given load; `lever`: mm, of errors of forces in the moment.
std::string toText(const char* what, const std::string& name, const bem::Resultant& resultant,
                   double error, double lever) {
  const double moment = resultant.moment.norm();
  // A moment below its error is shown as 0.
  const double momentError = error * std::max(moment, lever * resultant.force.norm());
  const int digits = momentError > moment ? 0
                     : momentError > 0    ? digitsFor(moment, momentError)
                                          : 4;
  return format("%-10s %s: force ", what, name.c_str()) + rounded(resultant.force, error) +
         " N, |" + withError(resultant.force.norm(), error) + "| N, moment " +
         (digits > 0 ? cli::toText(resultant.moment, digits) : "(0, 0, 0)") + " N·mm\n";
}

const char* kindName(const app::TouchState::Contact& contact) {
  return contact.kind ? modeling::infoOf(*contact.kind).name : "node";
}

Json toJson(const app::TouchState::Contact& contact) {
  Json json;
  if (!contact.name.empty()) json["name"] = contact.name;
  json["kind"] = kindName(contact);
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
  text += std::string(": ") + kindName(contact) + ", " + app::nameOf(contact.status) + ", at " +
          cli::toText(contact.at, 4) + " mm";
  if (contact.radius > 0) text += format(", radius %.4g mm", contact.radius);
  if (contact.presses()) text += format(", friction %.4g", contact.friction);
  text += ", moved by " + cli::toText(contact.displacement, 4) + " mm\n";
  const double force = contact.force.norm();
  const double error = contact.errorEstimate.value_or(0);
  const bool isGiven = contact.kind && modeling::infoOf(*contact.kind).isForce;
  const double ofForce = isGiven ? 0 : error;
  text += "           force " + rounded(contact.force, ofForce) + " N, |" +
          withError(force, ofForce) +
          "| N: " + inDecimalsOf(contact.normalForce(), force, ofForce) + " N into the body, " +
          inDecimalsOf(contact.tangentialForce().norm(), force, ofForce) +
          " N along it; deflection " + rounded(contact.deflection.norm(), error) +
          " mm, stiffness " + rounded(contact.stiffness, error) + " N/mm\n";
  if (contact.isBall() && !contact.patch.empty())
    text += format("           patch radius %.4g mm, %zu masks\n", contact.patchRadius(),
                   contact.patch.size());
  return text;
}

std::string percentText(double error) {
  return error > 1 ? "more than 100 %" : format("about %.2g %%", 100 * error);
}

/// Parts that are only carried along may have wrong displacements where forces are right.
std::string accuracyText(double largest, double ofForces) {
  constexpr double kMuchSmaller = 0.5;
  if (ofForces > 0 && ofForces < kMuchSmaller * largest)
    return "accuracy   estimated errors: of forces " + percentText(ofForces) +
           ", of displacements " + percentText(largest) + "\n";
  if (largest > 1)
    return "accuracy   the estimated error is " + percentText(largest) +
           ": take smaller elements\n";
  return "accuracy   displacements and forces are good to " + percentText(largest) +
         " (estimated)\n";
}

const char* nameOf(modeling::Engine engine) {
  if (engine == modeling::Engine::kSplines) return "splines";
  return engine == modeling::Engine::kQuadratic ? "quadratic" : "triangles";
}

std::string engineText(const app::TouchModel& model) {
  const app::BuildReport& build = model.report();
  const bem::Discretisation& on = *model.setup().discretisation;
  if (model.setup().engine == modeling::Engine::kTriangles)
    return format("mesh       %s nodes, %s triangles, smallest angle %.1f°\n",
                  countText(build.nodes).c_str(), countText(build.triangles).c_str(),
                  build.quality.smallestAngle);
  if (model.setup().engine == modeling::Engine::kQuadratic)
    return format("mesh       %s nodes, %s quadratic triangles\n", countText(build.nodes).c_str(),
                  countText(on.elementCount()).c_str());
  return format("splines    %s coefficients on %s elements; shown on %s nodes\n",
                countText(on.displacementCount()).c_str(), countText(on.elementCount()).c_str(),
                countText(build.nodes).c_str());
}

/// Largest displacement of a node, and its position.
struct LargestDisplacement {
  double length = 0;  ///< mm
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
};

LargestDisplacement largestDisplacement(const app::TouchModel& model,
                                        const app::TouchState& state) {
  LargestDisplacement largest;
  const Eigen::MatrixXd u = model.setup().discretisation->valuesOnMesh(state.field).u;
  for (int node = 0; node < model.setup().mesh().nodeCount(); ++node) {
    const double length = u.col(0).segment<3>(3 * node).norm();
    if (length > largest.length) largest = {length, model.setup().mesh().nodes[node]};
  }
  return largest;
}

}  // namespace

Json StateReport::json() const {
  const app::BuildReport& build = model.report();
  const LargestDisplacement largest = largestDisplacement(model, state);
  Json report{{"nodes", build.nodes}, {"triangles", build.triangles}};
  addTo(report, model.surface().simplification);
  report["engine"] = nameOf(model.setup().engine);
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
  const LargestDisplacement largest = largestDisplacement(model, state);
  std::string text = engineText(model) + toText(model.surface().simplification);
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
  text += format("balance    %.3g N (%.2g %% of the largest force)\n", state.balance,
                 100 * state.relativeBalance);
  // A body at rest has no error.
  if (state.errorEstimate && *state.errorEstimate > 0)
    text += accuracyText(*state.errorEstimate, state.forceErrorEstimate.value_or(0));
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
