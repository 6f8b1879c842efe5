// palpa-coverage: stated against true errors over random bodies (docs/verification.md).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/field_sample.h"
#include "app/core/results/touch.h"
#include "bench/coverage/random_case.h"
#include "modeling/error.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/project/project_file.h"

namespace palpa::bench {
namespace {

using Eigen::Vector3d;
using modeling::Engine;
using nlohmann::json;

struct Solution {
  int unknowns = 0;
  app::StateError stated;
  double balance = 0;
  std::vector<Vector3d> displacements;  ///< at the places
  std::vector<Vector3d> forces;         ///< of the contacts, or the reaction without one
  double widening = 1;                  ///< of the touch's mask
  double seconds = 0;
};

Solution solve(const modeling::Project& project, const std::vector<Vector3d>& places,
               bool wantsEstimate) {
  const auto start = std::chrono::steady_clock::now();
  const auto model = app::buildTouchModel(project, {}, {});
  app::TouchState state =
      project.touches.empty() ? model->rest() : app::playTouches(*model, project.touches);
  Solution solution;
  solution.unknowns = model->setup().discretisation->displacementCount();
  if (wantsEstimate) solution.stated = app::estimateErrors(*model, state);
  solution.balance = state.relativeBalance;
  for (const Vector3d& place : places)
    solution.displacements.push_back(app::sampleField(*model, state, place).displacement);
  for (const auto& contact : state.contacts) {
    solution.forces.push_back(contact.force);
    if (!contact.isBall() && project.touches.front().radius)
      solution.widening = contact.radius / *project.touches.front().radius;
  }
  if (state.contacts.empty())
    for (const auto& support : state.supports) solution.forces.push_back(support.resultant.force);
  solution.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return solution;
}

/// Some 400 places all over the surface: nodes of a mesh. With 70 places, one that lies on the
/// border of a support by chance decided on the error of the whole field.
std::vector<Vector3d> placesOn(const modeling::Body& body, double size) {
  modeling::MeshSettings settings;
  settings.engine = Engine::kTriangles;
  settings.edgeLength = size / 6;
  return modeling::mesh(body, settings).positions;
}

/// Relative error of displacements: root mean squares.
double fieldError(const Solution& solution, const Solution& truth) {
  double error = 0, scale = 0;
  for (std::size_t k = 0; k < truth.displacements.size(); ++k) {
    error += (solution.displacements[k] - truth.displacements[k]).squaredNorm();
    scale += truth.displacements[k].squaredNorm();
  }
  return std::sqrt(error / scale);
}

/// Relative error of forces, over the largest.
double forceError(const Solution& solution, const Solution& truth) {
  double largest = 0, error = 0;
  for (const Vector3d& force : truth.forces) largest = std::max(largest, force.norm());
  for (std::size_t k = 0; k < truth.forces.size(); ++k)
    error = std::max(error, (solution.forces[k] - truth.forces[k]).norm() / largest);
  return error;
}

double errorOf(const Solution& solution, const Solution& truth) {
  return std::max(fieldError(solution, truth), forceError(solution, truth));
}

/// Edge length that gives about so many nodes, mm.
double edgeLengthFor(modeling::Project project, double nodes, double size) {
  const auto regions = modeling::meshRegions(project);
  project.mesh.edgeLength = 4 * size / std::sqrt(nodes);
  for (int step = 0; step < 4; ++step) {
    const auto count = static_cast<double>(
        modeling::mesh(project.body, project.mesh, regions, {}, modeling::meshFoci(project))
            .positions.size());
    if (count > 0.9 * nodes && count < 1.05 * nodes) break;
    project.mesh.edgeLength *= std::clamp(std::sqrt(count / nodes), 0.5, 2.0);
  }
  return project.mesh.edgeLength;
}

struct Variant {
  std::string name;
  Engine engine;
  double nodes;     ///< of triangles
  double accuracy;  ///< of splines
};

/// A coarse and a fine variant of each engine; odd cases run the coarse ones, even cases the fine.
const std::vector<Variant>& variants(std::uint64_t number) {
  static const std::array<std::vector<Variant>, 2> all{
      {{{"quadratic 800", Engine::kQuadratic, 800, 0},
        {"triangles 1500", Engine::kTriangles, 1500, 0},
        {"splines 0.01", Engine::kSplines, 0, 0.01}},
       {{"quadratic 400", Engine::kQuadratic, 400, 0},
        {"triangles 600", Engine::kTriangles, 600, 0},
        {"splines 0.03", Engine::kSplines, 0, 0.03}}}};
  return all[number % 2];
}

/// `action`: of the cases that are run, `engines`: beginnings of the names of variants; empty: all.
json run(std::uint64_t number, double truthNodes, const std::string& action,
         const std::vector<std::string>& engines) {
  json result{{"number", number}};
  try {
    RandomCase random = randomCase(number);
    if (!action.empty() && random.action != action) return {};
    result.update({{"shape", random.shape},
                   {"support", random.support},
                   {"action", random.action},
                   {"nu", random.project.material.poissonRatio}});
    modeling::Project& project = random.project;
    const auto [low, high] = modeling::boundingBox(project.body);
    const double size = (high - low).norm() / 2;
    const std::vector<Vector3d> places = placesOn(project.body, size);
    const auto set = [&](Engine engine, double nodes, double accuracy) {
      project.mesh = {};
      project.mesh.engine = engine;
      if (engine == Engine::kSplines) {
        project.mesh.accuracy = accuracy;
        project.mesh.edgeLength = size / 10;
      } else {
        project.mesh.edgeLength = edgeLengthFor(project, nodes, size);
      }
    };
    set(Engine::kQuadratic, truthNodes, 0);
    const Solution truth = solve(project, places, false);
    result["truth"] = {{"unknowns", truth.unknowns}, {"seconds", truth.seconds}};
    for (const Variant& variant : variants(number)) {
      if (!engines.empty() && std::ranges::none_of(engines, [&](const std::string& engine) {
            return std::string_view(variant.name).starts_with(engine);
          }))
        continue;
      try {
        set(variant.engine, variant.nodes, variant.accuracy);
        const Solution solution = solve(project, places, true);
        // A wider mask is another touch; the program says so beside the error.
        if (solution.widening > 1.01 * truth.widening)
          throw modeling::ModelingError("the mask is wider than wished");
        result["variants"][variant.name] = {{"edge_length", project.mesh.edgeLength},
                                            {"unknowns", solution.unknowns},
                                            {"stated", solution.stated.largest()},
                                            {"stated_field", solution.stated.field},
                                            {"stated_contacts", solution.stated.contacts},
                                            {"balance", solution.balance},
                                            {"true_field", fieldError(solution, truth)},
                                            {"true_force", forceError(solution, truth)},
                                            {"true", errorOf(solution, truth)},
                                            {"widening", solution.widening},
                                            {"seconds", solution.seconds}};
      } catch (const std::exception& error) {
        result["variants"][variant.name] = {{"failed", error.what()}};
      }
    }
  } catch (const std::exception& error) {
    result["failed"] = error.what();
  }
  return result;
}

/// Stated over true errors of one engine.
struct Ratios {
  std::vector<double> ratios, errors;
  int failed = 0;

  double share(double least) const {
    const auto count = std::count_if(ratios.begin(), ratios.end(),
                                     [least](double ratio) { return ratio >= least; });
    return 100 * static_cast<double>(count) / static_cast<double>(ratios.size());
  }
  static double quantile(std::vector<double> values, double part) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
  }
};

/// One line per engine.
void summarise(const std::vector<json>& results) {
  std::map<std::string, Ratios> byEngine;
  int invalid = 0;
  for (const json& result : results) {
    if (!result.contains("variants")) {
      ++invalid;
      continue;
    }
    for (const auto& [variant, of] : result["variants"].items()) {
      const std::string engine = variant.substr(0, variant.find(' '));
      Ratios& list = byEngine[engine];
      if (of.contains("failed")) {
        ++list.failed;
        continue;
      }
      const double error = std::max(of["true"].get<double>(), 1e-12);
      list.ratios.push_back(of["stated"].get<double>() / error);
      list.errors.push_back(error);
    }
  }
  std::printf("%-22s  %6s  %9s  %9s  %6s  %7s  %6s  %11s  %10s\n", "engine", "cases", "covered %",
              ">= half %", "least", "median", "90 %", "true median", "wider mask");
  for (const auto& [name, list] : byEngine)
    if (!list.ratios.empty())
      std::printf("%-22s  %6zu  %9.1f  %9.1f  %6.2f  %7.1f  %6.1f  %11.1e  %10d\n", name.c_str(),
                  list.ratios.size(), list.share(1), list.share(0.5),
                  Ratios::quantile(list.ratios, 0), Ratios::quantile(list.ratios, 0.5),
                  Ratios::quantile(list.ratios, 0.9), Ratios::quantile(list.errors, 0.5),
                  list.failed);
  std::printf("%d numbers without a valid body or truth\n", invalid);
}

/// Shares of a few cases, in per cent, whose errors must be covered, and stated at half at least.
constexpr double kMinCovered = 85, kMinHalf = 95;

bool coversEnough(const std::vector<json>& results) {
  std::map<std::string, Ratios> byEngine;
  for (const json& result : results) {
    if (!result.contains("variants")) continue;
    for (const auto& [variant, of] : result["variants"].items())
      if (of.contains("stated"))
        byEngine[variant.substr(0, variant.find(' '))].ratios.push_back(
            of["stated"].get<double>() / std::max(of["true"].get<double>(), 1e-12));
  }
  return byEngine.size() == 3 &&
         std::all_of(byEngine.begin(), byEngine.end(), [](const auto& engine) {
           return engine.second.share(1) >= kMinCovered && engine.second.share(0.5) >= kMinHalf;
         });
}

}  // namespace
}  // namespace palpa::bench

int main(int argc, char** argv) {
  using namespace palpa::bench;
  CLI::App options("Stated against true errors of displacements and forces over random bodies.");
  std::uint64_t first = 1, count = 10;
  double truthNodes = 3500;
  std::string file, project, action;
  std::vector<std::string> engines;
  bool isSummary = false, isCheck = false;
  options.add_option("--first", first, "number of the first case");
  options.add_option("--cases", count, "how many");
  options.add_option("--truth-nodes", truthNodes,
                     "of the mesh of quadratic triangles that counts as true");
  options.add_option("-o", file, "one line of JSON per case; cases that it holds are left out");
  options.add_option("--project", project, "only write the first case as a project file");
  options.add_option("--action", action, "only cases with grab, force, ball or bump");
  options.add_option("--engine", engines, "only these of quadratic, splines and triangles");
  options.add_flag("--summary", isSummary, "only print the table of the file");
  options.add_flag("--check", isCheck,
                   "exit with 1 unless the stated errors cover enough of the true ones");
  CLI11_PARSE(options, argc, argv);
  if (!project.empty()) {
    palpa::modeling::writeProject(randomCase(first).project, project);
    return 0;
  }
  std::map<std::uint64_t, nlohmann::json> results;
  if (!file.empty()) {
    std::ifstream known(file);
    for (std::string line; std::getline(known, line);) {
      const nlohmann::json result = nlohmann::json::parse(line);
      results[result.at("number")] = result;
    }
  }
  for (std::uint64_t number = first; !isSummary && number < first + count; ++number) {
    if (results.contains(number)) continue;
    const nlohmann::json result = run(number, truthNodes, action, engines);
    if (result.is_null()) continue;
    results[number] = result;
    if (!file.empty()) std::ofstream(file, std::ios::app) << result.dump() << '\n';
    std::fprintf(stderr, "%s\n", result.dump().c_str());
  }
  std::vector<nlohmann::json> all;
  for (const auto& [number, result] : results) all.push_back(result);
  summarise(all);
  return isCheck && !coversEnough(all) ? 1 : 0;
}
