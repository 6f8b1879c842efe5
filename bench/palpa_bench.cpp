// Times every stage from a mesh to a touch, side by side with a plain scalar assembly in the same
// run, and prints one table with the targets beside the measurements.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "app/core/model/model_cache.h"
#include "app/core/setup/boundary_setup.h"
#include "app/core/system/memory.h"
#include "base/parallel.h"
#include "bem/base/instruction_set.h"
#include "bem/contact/bilateral_contact_solver.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/problem/greens_columns.h"
#include "bem/triangle/triangle_contact_surface.h"
#include "bench/cancel_latency.h"
#include "bench/measurement_table.h"
#include "bench/plain_assembly.h"
#include "bench/sphere.h"
#include "bench/timing.h"
#include "modeling/mesh/display_mesh.h"
#include "modeling/mesh/geometry_check.h"
#include "modeling/mesh/mesh.h"
#include "modeling/mesh/mesh_follow.h"
#include "modeling/shapes/primitives.h"

namespace {

using namespace palpa;
using bench::medianSecondsFor;
using bench::pointsOnSphere;
using bench::secondsFor;
using bench::sphereProject;
using Eigen::Vector3d;

app::BoundarySetup sphereSetup(int cellsPerCubeEdge) {
  const modeling::Project project = sphereProject(cellsPerCubeEdge);
  return app::makeBoundarySetup(
      app::ProjectGeometry(project),
      modeling::mesh(project.body, project.mesh, modeling::meshRegions(project)));
}

struct Row {
  std::string what, measured, target;
};

class Bench {
 public:
  Bench(const Job& job, bool withAllColumns, bench::MeasurementTable& table)
      : job_(job), all_(withAllColumns), table_(table) {}

  void run(int cells) {
    const app::BoundarySetup setup = sphereSetup(cells);
    const int n = setup.mesh().nodeCount();
    const double pairs = static_cast<double>(n) * setup.mesh().triangleCount();
    rows_.clear();
    const double loose = plain(setup, bench::looseAccuracy());
    const double same = plain(setup, bench::sameAccuracy());
    bem::ReferenceProblemTimes times;
    std::shared_ptr<const bem::ReferenceProblem> problem;
    double build = 0;
    // The first round pays for memory the operating system has to find; both are shown.
    const double cold = secondsFor([&] { problem = build_(setup, times); });
    problem.reset();
    build = secondsFor([&] { problem = build_(setup, times); });
    const double ours = times.assemble / pairs * 1e9;
    add("assembly, as used", "%.1f ns/pair", ours, "<= 40");
    add("plain scalar, same tolerance", "%.0f ns/pair", same, "");
    add("  ratio to ours, same tolerance", "%.1f", same / ours, ">= 10");
    add("plain scalar, 3 and 7 points", "%.0f ns/pair", loose, "");
    add("  ratio to ours, 3 and 7 points", "%.1f", loose / ours, "");
    add("assembly", "%.3f s", times.assemble, "");
    add("factorisation", "%.3f s", times.factorise, "");
    touches(setup, problem, build, cold, n);
    const double singleMatrix = 4 * std::pow(3.0 * n, 2);
    modeller(cells, n);
    cache(setup, *problem);
    add("memory of the model", "%.0f MiB", static_cast<double>(problem->bytes()) / (1 << 20), "");
    add("  in single (3n)^2 matrices", "%.2f", static_cast<double>(problem->bytes()) / singleMatrix,
        n > 9000 ? "<= 3" : "");
    if (all_) {
      bem::GreensColumns columns(problem);
      std::vector<int> nodes(n);
      std::iota(nodes.begin(), nodes.end(), 0);
      add("all columns of Xi", "%.2f s", secondsFor([&] { columns.compute(nodes, job_); }),
          n > 2000 && n < 3000 ? "<= 10" : "");
    }
    problem.reset();
    if (n > 2000 && n < 3000)
      for (const auto& stopped : bench::measureCancel(sphereProject(cells), job_.threads, 5))
        add("stopped in \"" + std::string(nameOf(stopped.phase)) + "\"", "%.0f ms",
            stopped.seconds * 1e3, "<= 100");
    print(n, setup.mesh().triangleCount());
  }

 private:
  std::unique_ptr<bem::ReferenceProblem> build_(const app::BoundarySetup& setup,
                                                bem::ReferenceProblemTimes& times) const {
    return bem::makeDenseReferenceProblem(
        setup.mesh(), setup.meshSlots(),
        {setup.conditions.ofSlot, setup.material, {}, bem::Precision::kAutomatic}, job_, &times);
  }

  /// Times the plain assembly on a sample of the collocation points; ns per pair.
  double plain(const app::BoundarySetup& setup, const bench::PlainAccuracy& accuracy) const {
    const int n = setup.mesh().nodeCount();
    const double pairs = static_cast<double>(n) * setup.mesh().triangleCount();
    const int sample = std::max(8, static_cast<int>(std::min(1.0, 1e6 / pairs) * n));
    std::vector<Vector3d> points;
    for (int k = 0; k < sample; ++k)
      points.push_back(
          setup.mesh().nodes[static_cast<std::size_t>(static_cast<double>(k) * n / sample)]);
    Eigen::MatrixXd H, G;
    const double seconds = secondsFor([&] {
      bench::assemblePlain(setup.mesh(), setup.meshSlots(), points, setup.material, accuracy, H, G,
                           job_);
    });
    return seconds / (static_cast<double>(sample) * setup.mesh().triangleCount()) * 1e9;
  }

  void touches(const app::BoundarySetup& setup,
               const std::shared_ptr<const bem::ReferenceProblem>& problem, double build,
               double cold, int n) {
    const auto& dofs = problem->dofs();
    const bem::BoundaryField zero{Eigen::VectorXd::Zero(3 * n),
                                  Eigen::VectorXd::Zero(3 * setup.meshSlots().count())};
    const std::vector<int> nodeDofs{0, 1, 2};
    const double column = medianSecondsFor([&] { problem->greensColumns(nodeDofs); });
    add("3 columns of Xi (one node)", "%.1f ms", column * 1e3, "");
    const char* target = n > 900 && n < 1300 ? "<= 0.5" : n > 2300 && n < 2800 ? "<= 3" : "";
    add("mesh to touchable", "%.2f s", build + column, target);
    add("  with memory never used before", "%.2f s", cold + column, "");
    const bem::TriangleContactSurface surface(setup.mesh(), setup.meshSlots(), dofs);
    for (const int count : {10, 50}) {
      bem::BilateralContactSolver solver(problem, setup.meshSlots(), zero);
      int last = 0;
      for (const Vector3d& at : pointsOnSphere(count))
        last = solver.addGrab(bem::makeContactMask(surface, at, 3), Vector3d(-0.02 * at));
      double depth = 0;
      const double update = medianSecondsFor([&] {
        solver.setDisplacement(last, Vector3d(0, 0, depth += 1e-4));
        solver.forces();
      });
      const std::string contacts = std::to_string(count) + " contacts";
      add("force update, " + contacts, "%.1f kHz", 1e-3 / update, count == 10 ? ">= 10" : ">= 1");
      if (count > 10) continue;
      const Eigen::VectorXd forces = solver.forces();
      const double field = medianSecondsFor([&] { solver.field(forces); });
      add("full field, " + contacts, "%.2f kHz", 1e-3 / field, n > 9000 ? ">= 1" : "");
    }
  }

  /// What opening a project again costs instead of assembling and factorising; not measured where a
  /// second model finds no place beside the first.
  void cache(const app::BoundarySetup& setup, const bem::ReferenceProblem& problem) {
    if (static_cast<double>(problem.bytes()) > 0.85 * app::availableMemory()) return;
    const auto folder = std::filesystem::temp_directory_path() / "palpa-bench-cache";
    app::ModelCache stored(folder, 64e9);
    stored.clear();
    const bem::ProblemInputs inputs{setup.conditions.ofSlot, setup.material};
    const auto key = app::ModelCache::keyOf(*setup.discretisation, inputs);
    add("writing the stored model", "%.2f s", secondsFor([&] { stored.write(key, problem, job_); }),
        "");
    std::string notice;
    add("reading the stored model", "%.3f s",
        medianSecondsFor([&] { stored.read(key, *setup.discretisation, inputs, job_, notice); }),
        "");
    add("  size of its file", "%.0f MiB", stored.size() / (1 << 20), "");
    stored.clear();
  }

  /// What happens between a drag of a control point and the assembly.
  void modeller(int cells, int n) {
    const modeling::Solid sphere = modeling::makeSphere(25);
    const std::vector<modeling::MeshRegion> regions{
        {"base", modeling::Region::below(Vector3d::UnitZ(), -20), true}};
    modeling::MeshSettings settings;
    settings.edgeLength = 25 * std::numbers::pi / 2 / cells;
    modeling::SurfaceMesh mesh;
    const double meshing =
        medianSecondsFor([&] { mesh = modeling::mesh(sphere, settings, regions); });
    std::vector<Vector3d> points = sphere.controlPoints();
    std::max_element(points.begin(), points.end(), [](const Vector3d& a, const Vector3d& b) {
      return a.z() < b.z();
    })->z() += 1;
    const modeling::Solid moved = sphere.withControlPoints(points);
    const double follow =
        medianSecondsFor([&] { modeling::followSolid(mesh, sphere, moved, regions); });
    const double check = medianSecondsFor([&] { modeling::checkGeometry(mesh, sphere); });
    const double display = medianSecondsFor([&] { modeling::displayMesh(mesh, sphere); });
    add("meshing", "%.0f ms", meshing * 1e3, "");
    add("following one moved control point", "%.2f ms", follow * 1e3, "");
    add("geometry check", "%.0f ms", check * 1e3, n > 2300 && n < 2800 ? "<= 50" : "");
    add("display mesh", "%.0f ms", display * 1e3, "");
  }

  void add(const std::string& what, const char* format, double value, const std::string& target) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    rows_.push_back({what, text, target});
  }

  void print(int nodes, int triangles) {
    std::printf("\nn = %d nodes, %d triangles\n", nodes, triangles);
    std::printf("  %-34s %16s  %s\n", "what", "measured", "target");
    for (const Row& row : rows_) {
      std::printf("  %-34s %16s  %s\n", row.what.c_str(), row.measured.c_str(), row.target.c_str());
      table_.add(nodes, row.what, row.measured, row.target);
    }
    std::fflush(stdout);
  }

  Job job_;
  bool all_;
  bench::MeasurementTable& table_;
  std::vector<Row> rows_;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Times the stages from a mesh to a touch on the clamped sphere."};
  std::vector<int> cells{8, 11, 14, 15, 22, 23};
  bool large = false, withoutAll = false;
  int threads = 0;
  std::string tablePath;
  options.add_option("--cells", cells,
                     "cells along a cube edge of the sphere's mesh; n is about 5 cells^2");
  options.add_flag("--large", large, "also n = 5,000 and 10,000 (needs 12 GiB of memory)");
  options.add_flag("--without-greens-function", withoutAll, "skip computing all of Xi");
  options.add_option("--threads", threads, "0: all cores");
  options.add_option("--table", tablePath,
                     "adds bench;n;what;value;unit;goal of all rows to a file");
  CLI11_PARSE(options, argc, argv);
  if (large) cells.insert(cells.end(), {31, 44});

  bench::MeasurementTable table;
  table.open(tablePath, "palpa-bench");
  app::reuseFreedMemory();
  Job job;
  job.threads = threads;
  std::printf("instruction set %s, %d threads, sphere R = 25 mm fixed below z = -20 mm\n",
              bem::instructionSetName(), workerCount(job));
  for (const int count : cells) Bench(job, !withoutAll && count < 30, table).run(count);
  return 0;
}
