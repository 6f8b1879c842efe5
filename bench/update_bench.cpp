// Times an edit of one control point until the body can be touched: by an incremental
// update and by a full rebuild, in the same run.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/core/model/build_touch_model.h"
#include "bench/measurement_table.h"
#include "bench/sphere.h"
#include "bench/timing.h"
#include "modeling/project/project_file.h"
#include "modeling/shapes/primitives.h"

namespace {

using namespace palpa;
using Eigen::Vector3d;

/// The control point of a solid nearest to a place is moved by a hundredth of the body's size.
modeling::Project edited(modeling::Project project, const Vector3d& at) {
  auto& solid = std::get<modeling::Solid>(project.body);
  const auto [low, high] = modeling::boundingBox(project.body);
  std::vector<Vector3d> points = solid.controlPoints();
  auto& nearest =
      *std::min_element(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
        return (a - at).squaredNorm() < (b - at).squaredNorm();
      });
  const Vector3d middle = (low + high) / 2;
  nearest += 0.01 * (high - low).norm() * (nearest - middle).normalized();
  project.body = solid.withControlPoints(std::move(points));
  return project;
}

/// The first free place of a model's surface, from the top down.
int topmostFree(const app::TouchModel& model) {
  const auto& places = model.setup().discretisation->places();
  int best = -1;
  for (int k = 0; k < static_cast<int>(places.size()); ++k)
    if (model.problem()->dofs().isFree(k) && (best < 0 || places[k].z() > places[best].z()))
      best = k;
  return best;
}

int movedCount(const app::TouchModel& before, const app::TouchModel& after) {
  const auto &a = before.setup().discretisation->places(),
             &b = after.setup().discretisation->places();
  int count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += a[k] != b[k] ? 1 : 0;
  return count;
}

void measure(const std::string& name, const modeling::Project& project, const Job& job,
             bench::MeasurementTable& table) {
  const auto former = app::buildTouchModel(project, {}, job);
  const int top = topmostFree(*former);
  const modeling::Project moved = edited(project, former->setup().discretisation->places()[top]);
  const std::vector<int> dofs{3 * top, 3 * top + 1, 3 * top + 2};
  std::shared_ptr<const app::TouchModel> model;
  const auto touchable = [&](const auto& make) {
    double best = INFINITY;
    for (int round = 0; round < 3; ++round)
      best = std::min(best, bench::secondsFor([&] {
                        model = make();
                        if (model)
                          model->problem()->greensColumns(
                              dofs, bem::ReferenceProblem::Effort::kFast, job);
                      }));
    return best;
  };
  const double full = touchable([&] { return app::buildTouchModel(moved, {}, job); });
  const int n = model->setup().discretisation->displacementCount();
  const double update =
      touchable([&] { return app::updateTouchModel(moved, project, *former, {}, job); });
  if (!model) {
    std::printf("%-26s %6d %8s  %9.3f %9s\n", name.c_str(), n, "", full, "left");
    return;
  }
  const app::BuildReport& report = model->report();
  std::printf("%-26s %6d %8d  %9.3f %9.3f %6.1f   %.3f %.3f %.3f  %.0e\n", name.c_str(), n,
              movedCount(*former, *model), full, update, full / update,
              report.meshSeconds + report.checkSeconds, report.assembleSeconds, report.solveSeconds,
              *report.residual);
  std::fflush(stdout);
  const auto text = [](const char* format, double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, format, value);
    return std::string(buffer);
  };
  table.add(n, name + ", small edit to touchable", text("%.3f s", update), "<= 0.3");
  table.add(n, name + ", full rebuild over small edit", text("%.1f", full / update), ">= 8");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{
      "Times an edit of one control point until the body can be touched, by an incremental "
      "update and by a full rebuild. Spheres with triangles, and project files."};
  std::vector<int> cells{15, 22};
  std::vector<std::string> files;
  std::string tablePath;
  int threads = 0;
  options.add_option("--cells", cells, "cells along a cube edge of the sphere's mesh");
  options.add_option("projects", files, "project files")->check(CLI::ExistingFile);
  options.add_option("--table", tablePath,
                     "file that gets a line bench;n;what;value;unit;goal per measurement");
  options.add_option("--threads", threads, "0: all cores");
  CLI11_PARSE(options, argc, argv);
  bench::MeasurementTable table;
  table.open(tablePath, "palpa-update-bench");
  Job job;
  job.threads = threads;
  std::printf("%-26s %6s %8s  %9s %9s %6s   %s\n", "body", "n", "moved", "full s", "update s",
              "ratio", "mesh  assemble solve s, residual");
  for (const int count : cells) {
    modeling::Project project = bench::sphereProject(count);
    project.body = modeling::makeSphere(25, 15);
    measure("sphere, triangles", project, job, table);
  }
  for (const std::string& file : files) {
    const modeling::Project project = modeling::readProject(file);
    measure(project.name, project, job, table);
  }
  return 0;
}
