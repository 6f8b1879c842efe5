// Compressed operators of quadratic triangles beside dense ones: time of assembly and
// factorisation, of three Green's columns, memory, and the difference of these columns.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/core/setup/boundary_setup.h"
#include "app/core/setup/project_geometry.h"
#include "bem/compressed/make_problem.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/problem/greens_columns.h"
#include "bem/quadratic/quadratic_discretisation.h"
#include "bench/sphere.h"
#include "bench/timing.h"
#include "modeling/mesh/mesh.h"
#include "modeling/project/mesh_foci.h"
#include "modeling/project/project_file.h"

namespace {

using namespace palpa;
using Eigen::MatrixXd;

/// Wall and processor time, s.
struct Times {
  double wall = 0, processor = 0;
};
template <class Work>
Times timesOf(const Work& work) {
  Times times;
  times.processor = bench::processorSecondsFor([&] { times.wall = bench::secondsFor(work); });
  return times;
}

struct Settings {
  bem::CompressionOptions compression;
  int mostDenseNodes = 4000;
  double tolerance = 1e-6;  ///< of integrals
  Job job;
};

constexpr double kMega = 1e6;

/// Three unit forces on the free node that is farthest from the supports' side.
std::vector<int> topmostDofs(const bem::Discretisation& on, const bem::DegreesOfFreedom& dofs) {
  int best = -1;
  for (int k = 0; k < on.displacementCount(); ++k)
    if (dofs.isFree(k) && (best < 0 || on.places()[k].z() > on.places()[best].z())) best = k;
  return {3 * best, 3 * best + 1, 3 * best + 2};
}

/// Unit forces on the free nodes nearest to the one of some unit forces: a block of columns.
std::vector<int> blockAround(int dof, const bem::Discretisation& on,
                             const bem::DegreesOfFreedom& dofs) {
  const Eigen::Vector3d middle = on.places()[dof / 3];
  std::vector<int> nodes;
  for (int k = 0; k < on.displacementCount(); ++k)
    if (dofs.isFree(k)) nodes.push_back(k);
  std::sort(nodes.begin(), nodes.end(), [&](int a, int b) {
    return (on.places()[a] - middle).squaredNorm() < (on.places()[b] - middle).squaredNorm();
  });
  nodes.resize(std::min<std::size_t>(nodes.size(), bem::GreensColumns::kBlock));
  std::vector<int> block;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) block.push_back(3 * node + axis);
  return block;
}

/// Times of columns, and how far the displacements of the loaded nodes and all unknowns are from
/// refined ones.
void measureColumns(const bem::CompressedReferenceProblem& problem, const std::vector<int>& dofs,
                    const Job& job) {
  using Effort = bem::ReferenceProblem::Effort;
  MatrixXd refined;
  for (const auto& [what, effort] :
       {std::pair("refined", Effort::kRefined), std::pair("fast", Effort::kFast),
        std::pair("rough", Effort::kRough)}) {
    MatrixXd columns;
    const Times times = timesOf([&] { columns = problem.greensColumns(dofs, effort, job); });
    if (effort == Effort::kRefined) refined = columns;
    const auto compliance = [&](const MatrixXd& of) { return of(dofs, Eigen::all).eval(); };
    std::printf(
        "    %3zu columns, %-7s: %6.2f s (%6.2f); compliance differs by %.1e, fields by %.1e\n",
        dofs.size(), what, times.wall, times.processor,
        (compliance(columns) - compliance(refined)).norm() / compliance(refined).norm(),
        (columns - refined).norm() / refined.norm());
  }
}

void measure(const std::string& name, const modeling::Project& project, const Settings& settings) {
  const app::ProjectGeometry geometry(project);
  const app::BoundarySetup setup = app::makeBoundarySetup(
      geometry, modeling::mesh(project.body, project.mesh, geometry.regions(), settings.job,
                               modeling::meshFoci(project)));
  const auto* on = dynamic_cast<const bem::QuadraticDiscretisation*>(setup.discretisation.get());
  if (!on) {
    std::printf("%s: not of quadratic triangles\n", name.c_str());
    return;
  }
  bem::ProblemInputs inputs{setup.conditions.ofSlot, setup.material, {settings.tolerance}};
  std::unique_ptr<bem::CompressedReferenceProblem> compressed;
  bem::ReferenceProblemTimes parts;
  const Times made = timesOf([&] {
    compressed = bem::makeCompressedReferenceProblem(*on, inputs, settings.compression,
                                                     settings.job, &parts);
  });
  const std::vector<int> dofs = topmostDofs(*on, compressed->dofs());
  const auto sizes = compressed->operators().sizes();
  std::printf("%-20s n %6d  assembly %6.2f s  factors %6.2f s  (processor %6.1f s)\n", name.c_str(),
              on->displacementCount(), parts.assemble, parts.factorise, made.processor);
  std::printf(
      "    MB: %6.0f = far %.0f (%d blocks, mean rank %.1f, %d bases) + near %.0f + averaged %.0f "
      "+ factors "
      "%.0f (mean rank %.1f)\n",
      static_cast<double>(compressed->bytes()) / kMega, static_cast<double>(sizes.far) / kMega,
      sizes.farBlocks, sizes.meanRank, sizes.bases, static_cast<double>(sizes.near) / kMega,
      static_cast<double>(sizes.averaged) / kMega,
      static_cast<double>(compressed->factors().bytes()) / kMega, compressed->factors().meanRank());
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("    peak before columns %.0f MB\n",
              static_cast<double>(usage.ru_maxrss) * 1024 / kMega);
  measureColumns(*compressed, dofs, settings.job);
  measureColumns(*compressed, blockAround(dofs[0], *on, compressed->dofs()), settings.job);
  std::fflush(stdout);
  if (on->displacementCount() > settings.mostDenseNodes) return;
  inputs.precision = bem::Precision::kSingle;
  std::unique_ptr<bem::ReferenceProblem> dense;
  const Times madeDense =
      timesOf([&] { dense = bem::makeDenseReferenceProblem(*on, inputs, settings.job, &parts); });
  MatrixXd expected;
  const Times solvedDense = timesOf([&] {
    expected = dense->greensColumns(dofs, bem::ReferenceProblem::Effort::kRefined, settings.job);
  });
  const MatrixXd columns =
      compressed->greensColumns(dofs, bem::ReferenceProblem::Effort::kRefined, settings.job);
  // Displacement of the loaded node per unit of traction: the inverse of the force.
  const MatrixXd forces = columns.middleRows(dofs[0], 3).inverse(),
                 expectedForces = expected.middleRows(dofs[0], 3).inverse();
  std::printf(
      "    dense: assembly %6.2f s  factors %6.2f s  (processor %6.1f s)  3 columns %5.2f s  %.0f "
      "MB; difference of columns %.1e, of forces %.1e\n",
      parts.assemble, parts.factorise, madeDense.processor, solvedDense.wall,
      static_cast<double>(dense->bytes()) / kMega, (columns - expected).norm() / expected.norm(),
      (forces - expectedForces).norm() / expectedForces.norm());
  const bem::BoundaryField field = dense->dofs().expand(expected, MatrixXd());
  const MatrixXd exact = dense->residual(field, settings.job);
  std::printf("    difference of products %.1e\n",
              (compressed->residual(field, settings.job) - exact).norm() / exact.norm());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{
      "Times reference problems with compressed operators of quadratic triangles beside dense "
      "ones. Spheres with about 6 cells^2 nodes, and project files."};
  std::vector<int> cells;
  std::vector<std::string> files;
  Settings settings;
  options.add_option("--cells", cells,
                     "cells along a cube edge of the sphere's mesh; without files 18, 26 and 41");
  options.add_option("projects", files, "project files")->check(CLI::ExistingFile);
  options.add_option("--dense-up-to", settings.mostDenseNodes, "nodes of a dense problem, at most");
  options.add_option("--operators", settings.compression.operators,
                     "tolerance of the operators; 0: chosen");
  options.add_option("--factors", settings.compression.factors, "tolerance of the factors");
  options.add_option("--tile", settings.compression.tileNodes, "nodes per tile; 0: automatic");
  options.add_option("--threads", settings.job.threads, "0: all cores");
  CLI11_PARSE(options, argc, argv);
  if (cells.empty() && files.empty()) cells = {18, 26, 41};
  for (const int count : cells) {
    modeling::Project project = bench::sphereProject(count);
    project.mesh.engine = modeling::Engine::kQuadratic;
    measure("sphere", project, settings);
  }
  for (const std::string& file : files) {
    const modeling::Project project = modeling::readProject(file);
    measure(project.name, project, settings);
  }
  return 0;
}
