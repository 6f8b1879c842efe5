// What touching costs, beside the goals: force updates, sliding tools, the whole field, the running
// loop from input to force, and a touch dragged around the sphere.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/core/live/touch_field.h"
#include "app/core/live/touch_stepper.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/system/memory.h"
#include "app/core/system/priority.h"
#include "bem/contact/bilateral_contact_solver.h"
#include "bem/triangle/triangle_contact_surface.h"
#include "bench/latency_table.h"
#include "bench/measurement_table.h"
#include "bench/sphere.h"
#include "bench/timing.h"
#include "bench/touch_latency.h"
#include "bench/touch_slide.h"
#include "modeling/mesh/mesh.h"

namespace {

using namespace palpa;
using Eigen::Vector3d;
using Kind = bem::ContactTool::Kind;
using Command = app::TouchCommand;
using bench::medianSecondsFor;
using bench::secondsFor;
using bench::sphereProject;

/// A problem that was never solved: its columns are made up. What a field costs does not depend on
/// the numbers, and at 10,000 nodes the true ones take minutes.
class MadeUp final : public bem::ReferenceProblem {
 public:
  explicit MadeUp(bem::DegreesOfFreedom dofs) : ReferenceProblem(std::move(dofs), {1, 0}) {}
  Eigen::MatrixXd residual(const bem::BoundaryField& field, const Job&) const override {
    return Eigen::MatrixXd::Constant(dofs().count(), field.u.cols(), 1e-3);
  }
  Eigen::MatrixXd correction(const Eigen::MatrixXd& residual, const Job&) const override {
    return residual;
  }
  double conditionEstimate(const Job&) const override { return 1; }
  std::size_t bytes() const override { return 0; }
  void write(const ByteSink&) const override {}
};

class Bench {
 public:
  /// The field alone, with made-up columns.
  static nlohmann::json largeField(int cells) {
    Bench bench;
    const modeling::Project project = sphereProject(cells);
    const auto setup = app::makeBoundarySetup(
        app::ProjectGeometry(project),
        modeling::mesh(project.body, project.mesh, modeling::meshRegions(project)));
    const auto problem = std::make_shared<MadeUp>(bem::DegreesOfFreedom(
        setup.mesh(), setup.meshSlots(), setup.conditions.ofSlot, setup.material));
    const bem::TriangleContactSurface surface(setup.mesh(), setup.meshSlots(), problem->dofs());
    bem::GreensColumns columns(problem);
    const bem::BoundaryField base{Eigen::VectorXd::Zero(3 * setup.mesh().nodeCount()),
                                  Eigen::VectorXd::Zero(3 * setup.meshSlots().count())};
    std::vector<app::TouchSnapshot::Patch> patches;
    for (const Vector3d& at : bench::pointsOnSphere(10)) {
      const bem::ContactMask mask = bem::makeContactMask(surface, at, 3);
      columns.compute(mask.nodes, {});
      patches.push_back({mask.point, mask.radius, Vector3d::UnitZ()});
    }
    bem::FieldEvaluator evaluator(surface, columns, base);
    bem::BoundaryField field = base;
    for (int k = 0; k < 2; ++k) evaluator.evaluate(patches, false, field);
    bench.head(setup.mesh().nodeCount(), "columns made up");
    bench.add("displacements everywhere, 10 grabs", "kHz",
              1e-3 / medianSecondsFor([&] { evaluator.evaluate(patches, false, field); }), ">= 1");
    return bench.json();
  }

  explicit Bench(const modeling::Project& project) : model_(app::buildTouchModel(project, {}, {})) {
    head(model_->setup().discretisation->displacementCount(),
         model_->setup().splines ? "splines, E = 0.1 MPa, nu = 0.45" : "E = 0.1 MPa, nu = 0.45");
    add("surface for contacts, made once", "ms",
        1e3 * secondsFor([&] { body_ = std::make_shared<app::TouchableModel>(model_); }));
  }

  void forces() {
    for (const int count : {1, 10, 50}) {
      app::TouchStepper stepper(body_);
      bem::BilateralContactSolver exact(model_->problem(), model_->setup().meshSlots(),
                                        model_->rest().field);
      app::TouchId id = 0;
      int last = 0;
      for (const Vector3d& at : bench::pointsOnSphere(count)) {
        stepper.apply({Command::Kind::kBegin, ++id, {Kind::kGrab, 3}, at, -0.02 * at});
        last = exact.addGrab(bem::makeContactMask(body_->surface(), at, 3), Vector3d(-0.02 * at));
      }
      prepare(stepper);
      stepper.step();
      double depth = 0;
      const std::string contacts = std::to_string(count) + (count > 1 ? " grabs" : " grab");
      const double update = medianSecondsFor([&] {
        stepper.apply({Command::Kind::kSet, id, {}, {0, 0, 0}, {0, 0, depth += 1e-4}});
        stepper.step();
      });
      add("step, " + contacts, "kHz", 1e-3 / update,
          count == 10   ? ">= 10"
          : count == 50 ? ">= 1"
                        : "");
      add("  exact solver, forces alone", "kHz",
          1e-3 / medianSecondsFor([&] {
            exact.setDisplacement(last, {0, 0, depth += 1e-4});
            exact.forces();
          }));
      if (count == 10) fields(stepper, exact);
    }
  }

  void slides(const std::string& csv) {
    struct Case {
      std::string what;
      bem::ContactTool tool;
      double depth;
    };
    std::ofstream file;
    if (!csv.empty()) file.open(csv);
    if (file) file << "tool,angle_rad,force_N,fx_N,fy_N,fz_N\n";
    for (const Case& each : {Case{"finger 6 mm", {Kind::kPush, 6, 0}, 1.5},
                             Case{"finger 6 mm friction 0.3", {Kind::kPush, 6, 0.3}, 1.5},
                             Case{"ball 10 mm", {Kind::kBall, 10, 0}, 1.5},
                             Case{"ball 10 mm friction 0.3", {Kind::kBall, 10, 0.3}, 1.5}}) {
      const bench::Slide slide = bench::dragAround(body_, each.tool, each.depth);
      std::vector<double> times;
      int failed = 0, patches = 0;
      for (const auto& sample : slide.samples) {
        times.push_back(1e6 * sample.seconds);
        failed += sample.isConverged ? 0 : 1;
        patches = std::max(patches, sample.patches);
        if (file)
          file << each.what << ',' << sample.angle << ',' << sample.force.norm() << ','
               << sample.force[0] << ',' << sample.force[1] << ',' << sample.force[2] << '\n';
      }
      const bench::Quantiles cost = bench::quantilesOf(std::move(times));
      add("sliding " + each.what + ", step p50", "us", cost.p50);
      add("  p99", "us", cost.p99, "< 1000");
      add("  largest force", "N", slide.largestForce());
      add("  largest jump between 1 ms samples", "%",
          100 * slide.largestJump() / slide.largestForce());
      add("  of its magnitude", "%", 100 * slide.largestMagnitudeJump() / slide.largestForce());
      add("  largest kink of its magnitude", "%", 100 * slide.largestKink() / slide.largestForce());
      add("  masks at most", "", patches);
      if (failed > 0) add("  steps without convergence", "", failed, "0");
    }
    if (!csv.empty() && !file) std::fprintf(stderr, "%s cannot be written\n", csv.c_str());
  }

  void loop(double seconds) {
    for (const bool computesAll : {false, true}) {
      const auto report =
          bench::measureLatency(model_, 10, std::chrono::duration<double>(seconds), computesAll);
      const std::string beside = computesAll ? ", columns computed beside" : "";
      add("first force, no columns before" + beside, "ms", 1e3 * report.firstForce);
      add("running loop, 10 grabs" + beside, "Hz", report.rate, ">= 1000");
      add("  input to force, p50", "ms", 1e3 * report.inside.all.p50);
      add("  p99", "ms", 1e3 * report.inside.all.p99, "< 1");
      add("  largest of " + std::to_string(report.inside.all.count), "ms",
          1e3 * report.inside.all.largest);
      add("  until another thread has it, p50", "ms", 1e3 * report.latency.p50);
      add("  p99", "ms", 1e3 * report.latency.p99);
      add("  fields displayed meanwhile", "Hz", report.displayed / seconds);
      if (computesAll) add("  columns at the end", "%", 100 * report.columnsReady);
      bench::printLatencies(report.inside);
    }
  }

  void firstForces() {
    constexpr int kPlaces = 5;
    const auto report = [this](const std::string& tool, const bem::ContactTool& with,
                               const std::string& what, Eigen::Index answersPlacesFrom) {
      bench::NewPlaces times = bench::touchNewPlaces(model_, with, kPlaces, answersPlacesFrom);
      const bench::Quantiles first = bench::quantilesOf(std::move(times.first)),
                             settled = bench::quantilesOf(std::move(times.settled));
      add("first force of new places, " + tool + ", " + what + ", median", "s", first.p50);
      add("  largest of " + std::to_string(first.count), "s", first.largest);
      add("  until it stays within 1 %, median", "s", settled.p50);
      add("  largest", "s", settled.largest);
    };
    for (const auto& [tool, with] :
         {std::pair<std::string, bem::ContactTool>{"grab", {Kind::kGrab, 3}},
          std::pair<std::string, bem::ContactTool>{"ball", {Kind::kBall, 10, 0}}}) {
      report(tool, with, "answered alone", 0);
      report(tool, with, "with columns", std::numeric_limits<Eigen::Index>::max());
    }
  }

  nlohmann::json json() const { return {{"nodes", nodes_}, {"rows", rows_}}; }

 private:
  Bench() = default;

  void head(int nodes, const char* remark) {
    nodes_ = nodes;
    std::printf("\nn = %d nodes, sphere R = 25 mm, %s\n", nodes_, remark);
    std::printf("  %-52s %14s  %s\n", "what", "measured", "goal");
  }

  void prepare(app::TouchStepper& stepper) const {
    while (!stepper.missing().empty()) body_->columns()->compute(stepper.missing(), {});
  }

  void fields(app::TouchStepper& stepper, const bem::BilateralContactSolver& exact) {
    app::TouchField field(body_);
    app::TouchSnapshot snapshot;
    stepper.describe(snapshot);
    field.displacements(snapshot);  // the masks are new
    field.displacements(snapshot);  // and stay: they are kept
    add("displacements everywhere, 10 grabs", "kHz",
        1e-3 / medianSecondsFor([&] { field.displacements(snapshot); }), ">= 1");
    add("displacements and tractions", "kHz",
        1e-3 / medianSecondsFor([&] { field.field(snapshot); }));
    add("with reactions, energy and balance", "ms",
        1e3 * medianSecondsFor([&] { field.describe(snapshot); }));
    add("displacements, all 10 just moved", "ms", 1e3 * medianSecondsFor([&] {
                                                    app::TouchField fresh(body_);
                                                    fresh.displacements(snapshot);
                                                  }));
    const Eigen::VectorXd forces = exact.forces();
    add("  exact solver, whole field", "kHz",
        1e-3 / medianSecondsFor([&] { exact.field(forces); }));
  }

  void add(const std::string& what, const std::string& unit, double value,
           const std::string& goal = "") {
    std::printf("  %-52s %10.4g %-4s %s\n", what.c_str(), value, unit.c_str(), goal.c_str());
    std::fflush(stdout);
    rows_.push_back({{"what", what}, {"value", value}, {"unit", unit}, {"goal", goal}});
  }

  std::shared_ptr<const app::TouchModel> model_;
  std::shared_ptr<app::TouchableModel> body_;
  int nodes_ = 0;
  nlohmann::json rows_ = nlohmann::json::array();
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Times what touching the clamped sphere costs."};
  std::vector<int> cells{10, 20};
  double seconds = 10;
  int large = 45, quadratic = 0;
  std::string csv, json, tablePath;
  bool onlySlides = false;
  double elementLength = 0;
  options.add_option("--cells", cells,
                     "cells along a cube edge of the sphere's mesh; n is about 6 cells^2");
  options.add_option("--large", large, "cells for the field of a large mesh; 0: none");
  options.add_option("--quadratic", quadratic,
                     "cells of a sphere of quadratic triangles whose new places are touched");
  options.add_option("--seconds", seconds, "how long the loop runs; 0: not at all")
      ->check(CLI::Range(0.0, 3600.0));
  options.add_option("--csv", csv, "the forces of the slides around the sphere, of the last mesh");
  options
      .add_option("--splines", elementLength,
                  "slides around the sphere with splines, too, of elements of this length, mm")
      ->check(CLI::PositiveNumber);
  options.add_flag("--only-slides", onlySlides, "nothing but the slides around the sphere");
  options.add_option("--json", json, "all rows as JSON");
  options.add_option("--table", tablePath,
                     "adds bench;n;what;value;unit;goal of all rows to a file");
  CLI11_PARSE(options, argc, argv);

  app::lowerPriorityOfLoadedThreads();
  app::reuseFreedMemory();
  nlohmann::json all = nlohmann::json::array();
  for (const int count : cells) {
    Bench bench(sphereProject(count));
    if (!onlySlides) bench.forces();
    bench.slides(csv);
    if (seconds > 0 && !onlySlides) bench.loop(seconds);
    all.push_back(bench.json());
  }
  if (elementLength > 0) {
    modeling::Project project = sphereProject(cells.empty() ? 10 : cells.back());
    project.mesh.engine = modeling::Engine::kSplines;
    project.mesh.elementLength = elementLength;
    Bench bench(project);
    bench.slides("");
    all.push_back(bench.json());
  }
  if (quadratic > 0) {
    modeling::Project project = sphereProject(quadratic);
    project.mesh.engine = modeling::Engine::kQuadratic;
    Bench bench(project);
    bench.firstForces();
    all.push_back(bench.json());
  }
  if (large > 0 && !onlySlides) all.push_back(Bench::largeField(large));
  bench::MeasurementTable table;
  table.open(tablePath, "palpa-touch-bench");
  for (const auto& each : all)
    for (const auto& row : each["rows"]) {
      std::ostringstream text;
      text << row["value"].get<double>() << ' ' << row["unit"].get<std::string>();
      table.add(each["nodes"], row["what"], text.str(), row["goal"]);
    }
  if (json.empty()) return 0;
  std::ofstream file(json);
  if (file << all.dump(2) << '\n') return 0;
  std::fprintf(stderr, "%s cannot be written\n", json.c_str());
  return 3;
}
