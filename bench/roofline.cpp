// How close the assembly is to what the machine can do: floating-point operations per pair of
// collocation point and element, counted from the kernels themselves, over the time they take,
// beside the peak of the same machine in the same run.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/core/setup/boundary_setup.h"
#include "app/core/system/memory.h"
#include "base/parallel.h"
#include "bem/base/instruction_set.h"
#include "bem/linalg/lu_factorisation.h"
#include "bem/spline/spline_assembly.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/spline/spline_quadrature.h"
#include "bem/triangle/assembly.h"
#include "bench/flop_count.h"
#include "bench/measurement_table.h"
#include "bench/processor_peak.h"
#include "bench/sphere.h"
#include "bench/timing.h"

// After flop_count.h, whose functions it calls.
#include "bem/triangle/flat_triangle_integrals.h"
#include "modeling/mesh/mesh.h"

namespace {

using namespace palpa;
using bench::Counted;
using Eigen::Vector3d;

constexpr double kTriangleTolerance = 1e-7, kSplineTolerance = 1e-5;

app::BoundarySetup setupOf(const modeling::Project& project) {
  return app::makeBoundarySetup(
      app::ProjectGeometry(project),
      modeling::mesh(project.body, project.mesh, modeling::meshRegions(project)));
}

/// Operations of integrating one pair of point and triangle, by the way it is done.
struct TriangleOperations {
  /// From the integrals to the blocks of T and U in the tile (addElement() in assembly_loop.h): per
  /// basis function 6 for the traces, 21 for U, 60 for T.
  static constexpr long kAdd = 3 * (6 + 21 + 60);
  long rule7, rule16, closedForm;

  TriangleOperations() {
    const double corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0.2, 0.9, 0.1}};
    const bem::FlatTriangle triangle = bem::makeFlatTriangle(corners);
    const Counted x[3] = {3.0, 4.0, 5.0};
    bem::TriangleIntegrals<Counted> out;
    const auto countOf = [&](const auto& integrate) {
      Counted::operations = 0;
      integrate();
      return Counted::operations + kAdd;
    };
    const auto byRule = [&](const auto& products, const auto& points) {
      return countOf([&] {
        bem::PlacedRule<std::extent_v<std::remove_reference_t<decltype(products.weight)>>> rule{};
        rule.productWeight = products.weight;
        for (std::size_t q = 0; q < points.size(); ++q)
          for (int i = 0; i < 3; ++i) rule.point[q][i] = points[q].barycentric[i];
        integrateByRule(triangle, &corners[0][0], rule, x, out);
      });
    };
    rule7 = byRule(bem::RuleProducts<7>(bem::triangleRule7().data()), bem::triangleRule7());
    rule16 = byRule(bem::RuleProducts<16>(bem::triangleRule16().data()), bem::triangleRule16());
    closedForm = countOf([&] { bem::integrateClosedForm<Counted>(triangle, x, out); });
  }
};

class Roofline {
 public:
  Roofline(const Job& job, const std::string& table) : job_(job) {
    table_.open(table, "palpa-roofline");
  }

  void machine() {
    const int threads = workerCount(job_);
    peak_ = bench::peakFlopsPerCore(threads);
    std::printf("%s, %d threads\n", bem::instructionSetName(), threads);
    add("peak of a core, double precision", peak_ / 1e9, "GFLOP/s");
    add("memory bandwidth of all cores", bench::memoryBandwidth(threads) / 1e9, "GB/s");
  }

  void triangles(int cells) {
    const app::BoundarySetup setup = setupOf(bench::sphereProject(cells));
    const bem::BoundaryMesh& mesh = setup.mesh();
    const auto points =
        setup.discretisation->degreesOfFreedom(setup.conditions.ofSlot, setup.material)
            .collocationPoints(mesh, setup.meshSlots());
    const double seconds = coreSecondsFor([&] {
      bem::assemble<float>(mesh, setup.meshSlots(), points, setup.material, {kTriangleTolerance},
                           job_);
    });
    // As quadratureRange() in assembly.cpp, for batches of 8 points as with AVX-512: the nearest of
    // them decides.
    const double from16 = 0.68 * std::pow(kTriangleTolerance, -1.0 / 8),
                 from7 = 0.75 * std::pow(kTriangleTolerance, -1.0 / 5);
    constexpr std::size_t kLanes = 8;
    const TriangleOperations operations;
    double pairs = 0, with7 = 0, with16 = 0;
    for (int t = 0; t < mesh.triangleCount(); ++t) {
      const Vector3d centroid = mesh.point(t, Vector3d::Constant(1.0 / 3));
      double radius = 0;
      for (const int node : mesh.triangles[t])
        radius = std::max(radius, (mesh.nodes[node] - centroid).norm());
      for (std::size_t first = 0; first < points.size(); first += kLanes) {
        const std::size_t count = std::min(kLanes, points.size() - first);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = first; k < first + count; ++k)
          nearest = std::min(nearest, (points[k].position - centroid).norm() / radius);
        const auto lanes = static_cast<double>(count);
        pairs += lanes;
        (nearest >= from7 ? with7 : with16) += nearest >= from16 ? lanes : 0;
      }
    }
    const double closed = pairs - with7 - with16;
    const double perPair = (with7 * static_cast<double>(operations.rule7) +
                            with16 * static_cast<double>(operations.rule16) +
                            closed * static_cast<double>(operations.closedForm)) /
                           pairs;
    std::printf("triangles, n = %zu\n", points.size());
    add("triangles: pairs by 7 points", 100 * with7 / pairs, "%");
    add("triangles: pairs by 16 points", 100 * with16 / pairs, "%");
    add("triangles: pairs in closed form", 100 * closed / pairs, "%");
    add("triangles: operations per pair, 7 points", static_cast<double>(operations.rule7), "");
    add("triangles: operations per pair, 16 points", static_cast<double>(operations.rule16), "");
    add("triangles: operations per pair, closed form", static_cast<double>(operations.closedForm),
        "");
    add("triangles: operations per pair, mean", perPair, "");
    add("triangles: core time per pair", 1e9 * seconds / pairs, "ns");
    share("triangles", perPair * pairs / seconds);
    add("triangles: bytes of H and G written per pair",
        2 * 9.0 * sizeof(float) * static_cast<double>(points.size()) * mesh.nodeCount() / pairs,
        "B");
  }

  /// LU factors in single precision, as models of more than 800 nodes have them.
  void factorisation(int nodes) {
    const Eigen::Index size = 3 * nodes;
    bem::LargeMatrix<float> matrix(size, size);
    matrix.view().setRandom();
    const double seconds = bench::processorSecondsFor(
        [&] { const bem::LuFactorisation<float> factors(std::move(matrix), job_); });
    const double flops = 2.0 / 3 * std::pow(static_cast<double>(size), 3) / seconds;
    add("factorisation, single precision: operations per second of a core", flops / 1e9, "GFLOP/s");
    add("factorisation: share of the peak, twice the peak of double precision",
        100 * flops / (2 * peak_), "%");
  }

  /// Splines as a project has them that asks for nothing.
  void splines() {
    modeling::Project project = bench::sphereProject(10);
    project.mesh = {};
    project.mesh.engine = modeling::Engine::kSplines;
    const app::BoundarySetup setup = setupOf(project);
    const bem::SplineSurface& surface = setup.splines->surface();
    const bem::SplineTractions& tractions = setup.splines->tractions();
    const bem::WeightedEquations equations = splineEquations(
        surface, tractions,
        setup.splines->degreesOfFreedom(setup.conditions.ofSlot, setup.material).extraSlots());
    const double seconds = coreSecondsFor([&] {
      bem::assemble<float>(surface, tractions, equations, setup.material, {kSplineTolerance}, job_);
    });
    const bem::SplineQuadrature quadrature(surface, kSplineTolerance);
    const auto workspace = quadrature.makeWorkspace();
    bem::ElementQuadrature::Workspace& work = *workspace;
    // A sample of the points: each costs as much as in the assembly.
    SplinePairs kinds[3] = {{"prepared rules"}, {"divided elements"}, {"elements with the point"}};
    constexpr std::size_t kEvery = 16;
    for (std::size_t p = 0; p < equations.points.size(); p += kEvery)
      for (int e = 0; e < surface.elementCount(); ++e) {
        const bem::ElementPlace* inside = bem::placeIn(equations.points[p], e);
        const int used = quadrature.points(e, equations.points[p].position, inside, work).used;
        SplinePairs& kind = kinds[inside ? 2 : used <= kMaxPrepared ? 0 : 1];
        kind.pairs.push_back({static_cast<int>(p), e});
        kind.points += used;
        kind.operations +=
            splineOperations(used, inside, static_cast<int>(surface.functions(e).size()));
      }
    double pairs = 0, quadraturePoints = 0, operations = 0, sampled = 0;
    for (SplinePairs& kind : kinds) {
      pairs += static_cast<double>(kind.pairs.size());
      quadraturePoints += kind.points;
      operations += kind.operations;
      kind.seconds = coreSecondsFor([&] {
        for (const auto& [p, e] : kind.pairs)
          quadrature.integrate(e, equations.points[p].position,
                               bem::placeIn(equations.points[p], e), work);
      });
      sampled += kind.seconds;
    }
    const double all = static_cast<double>(equations.points.size()) * surface.elementCount();
    std::printf("splines, n = %d\n", surface.coefficientCount());
    add("splines: coefficients", surface.coefficientCount(), "");
    add("splines: elements", surface.elementCount(), "");
    add("splines: points where the equation is demanded",
        static_cast<double>(equations.points.size()), "");
    add("splines: quadrature points per pair", quadraturePoints / pairs, "");
    for (const SplinePairs& kind : kinds) {
      const std::string name = std::string("splines, ") + kind.name;
      add(name + ": of the pairs", 100 * static_cast<double>(kind.pairs.size()) / pairs, "%");
      add(name + ": of the time", 100 * kind.seconds / sampled, "%");
      add(name + ": quadrature points",
          kind.points / std::max<double>(1, static_cast<double>(kind.pairs.size())), "");
      add(name + ": operations per second of a core", kind.operations / kind.seconds / 1e9,
          "GFLOP/s");
    }
    add("splines: of the assembly in these loops", 100 * sampled / seconds * all / pairs, "%");
    add("splines: operations per pair, mean", operations / pairs, "");
    add("splines: core time per pair", 1e9 * seconds / all, "ns");
    share("splines", operations / pairs * all / seconds);
  }

 private:
  static constexpr int kMaxPrepared = 36;  ///< quadrature points of rules that are kept

  /// Pairs of a point and an element that are integrated in the same way.
  struct SplinePairs {
    const char* name;
    std::vector<std::pair<int, int>> pairs{};
    double points = 0, operations = 0, seconds = 0;
  };

  /// Of kelvin_sums_loop.h, for cubic functions. Per quadrature point 57 for Kelvin's kernels; 16
  /// sums times the functions along u and then v (tensor rules) or times all functions (polar
  /// rules), fused; where points are not prepared, about 400 to place each. 15 per function to add
  /// the sums to their coefficients.
  static double splineOperations(int used, bool isInside, int functions) {
    constexpr double kKernels = 57, kSums = 2 * 16, kPlace = 400, kAdd = 15;
    const double along = std::sqrt(functions), add = kAdd * functions;
    if (isInside) return used * (kKernels + kSums * functions + kPlace) + add;
    const double perDirection = std::sqrt(used);
    const bool isPrepared = used <= kMaxPrepared;
    const double n = isPrepared ? perDirection : bem::SplineQuadrature::kMaxPoints;
    return used * (kKernels + kSums * (along + functions / n) + (isPrepared ? 0 : kPlace)) + add;
  }

  /// Processor time, so that other programs do not matter: the least of three.
  template <class Work>
  static double coreSecondsFor(const Work& work) {
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 3; ++round)
      least = std::min(least, bench::processorSecondsFor(work));
    return least;
  }

  void share(const std::string& engine, double flops) {
    add(engine + ": operations per second of a core", flops / 1e9, "GFLOP/s");
    add(engine + ": share of the peak", 100 * flops / peak_, "%");
  }

  void add(const std::string& what, double value, const std::string& unit) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4g%s%s", value, unit.empty() ? "" : " ", unit.c_str());
    std::printf("  %-52s %s\n", what.c_str(), text);
    std::fflush(stdout);
    table_.add(0, what, text, "");
  }

  Job job_;
  bench::MeasurementTable table_;
  double peak_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Shares of the machine's peak that the assembly reaches."};
  Job job;
  int cells = 22;
  std::string table;
  options.add_option("--cells", cells, "cells along a cube edge of the sphere's mesh");
  options.add_option("--threads", job.threads, "0: all cores");
  options.add_option("--table", table, "adds bench;n;what;value;unit;goal of all rows to a file");
  CLI11_PARSE(options, argc, argv);
  app::reuseFreedMemory();
  Roofline roofline(job, table);
  roofline.machine();
  roofline.triangles(cells);
  roofline.splines();
  roofline.factorisation(2400);
  return 0;
}
