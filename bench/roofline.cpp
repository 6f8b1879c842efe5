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
#include <vector>

#include "app/core/boundary_setup.h"
#include "app/core/memory.h"
#include "bem/assembly.h"
#include "bem/instruction_set.h"
#include "bem/parallel.h"
#include "bem/spline/spline_assembly.h"
#include "bem/spline/spline_discretisation.h"
#include "bem/spline/spline_quadrature.h"
#include "bench/flop_count.h"
#include "bench/measurement_table.h"
#include "bench/processor_peak.h"
#include "bench/sphere.h"
#include "bench/timing.h"

// After flop_count.h, whose functions it calls.
#include "bem/flat_triangle_integrals.h"

namespace {

using namespace palpa;
using bench::Counted;
using Eigen::Vector3d;

constexpr double kTriangleTolerance = 1e-7, kSplineTolerance = 1e-5;

app::BoundarySetup setupOf(const modeling::Project& project) {
  return app::makeBoundarySetup(
      project, modeling::mesh(project.body, project.mesh, modeling::meshRegions(project)));
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
  Roofline(const bem::Job& job, const std::string& table) : job_(job) {
    table_.open(table, "palpa-roofline");
  }

  void machine() {
    const int threads = bem::workerCount(job_);
    peak_ = bench::peakFlops(threads);
    std::printf("%s, %d threads\n", bem::instructionSetName(), threads);
    add("peak, fused multiply-adds in double precision", peak_ / 1e9, "GFLOP/s");
    add("memory bandwidth", bench::memoryBandwidth(threads) / 1e9, "GB/s");
  }

  void triangles(int cells) {
    const app::BoundarySetup setup = setupOf(bench::sphereProject(cells));
    const bem::BoundaryMesh& mesh = setup.mesh();
    const auto points =
        setup.discretisation->degreesOfFreedom(setup.conditions.ofSlot, setup.material)
            .collocationPoints(mesh, setup.meshSlots());
    const double seconds = bench::medianSecondsFor([&] {
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
    add("triangles: time per pair", 1e9 * seconds / pairs, "ns");
    share("triangles", perPair * pairs / seconds);
    add("triangles: bytes of H and G written per pair",
        2 * 9.0 * sizeof(float) * static_cast<double>(points.size()) * mesh.nodeCount() / pairs,
        "B");
  }

  /// The sphere of the window's beginning: splines at their usual accuracy.
  void splines() {
    modeling::Project project = bench::sphereProject(10);
    project.mesh = {};
    project.mesh.engine = modeling::Engine::splines;
    const app::BoundarySetup setup = setupOf(project);
    const bem::SplineSurface& surface = setup.splines->surface();
    const bem::SplineTractions& tractions = setup.splines->tractions();
    const bem::SplineEquations equations = splineEquations(
        surface, tractions,
        setup.splines->degreesOfFreedom(setup.conditions.ofSlot, setup.material).extraSlots());
    const double seconds = bench::medianSecondsFor([&] {
      bem::assemble<float>(surface, tractions, equations, setup.material, {kSplineTolerance}, job_);
    });
    const bem::SplineQuadrature quadrature(surface, kSplineTolerance);
    bem::SplineQuadrature::Workspace work;
    // A sample: each point of it costs as much as in the assembly.
    double pairs = 0, quadraturePoints = 0, operations = 0;
    constexpr std::size_t kEvery = 16;
    for (std::size_t p = 0; p < equations.points.size(); p += kEvery)
      for (int e = 0; e < surface.elementCount(); ++e) {
        const auto& places = equations.points[p].places;
        const auto inside = std::find_if(places.begin(), places.end(),
                                         [e](const auto& place) { return place.element == e; });
        const int used = quadrature
                             .points(e, equations.points[p].position,
                                     inside == places.end() ? nullptr : &*inside, work)
                             .used;
        pairs += 1;
        quadraturePoints += used;
        operations += splineOperations(used, inside != places.end(),
                                       static_cast<int>(surface.functions(e).size()));
      }
    const double all = static_cast<double>(equations.points.size()) * surface.elementCount();
    std::printf("splines, n = %d\n", surface.coefficientCount());
    add("splines: coefficients", surface.coefficientCount(), "");
    add("splines: elements", surface.elementCount(), "");
    add("splines: points where the equation is demanded",
        static_cast<double>(equations.points.size()), "");
    add("splines: quadrature points per pair", quadraturePoints / pairs, "");
    add("splines: operations per pair, mean", operations / pairs, "");
    add("splines: time per pair", 1e9 * seconds / all, "ns");
    add("splines: time per quadrature point", 1e9 * seconds / all * pairs / quadraturePoints, "ns");
    share("splines", operations / pairs * all / seconds);
  }

 private:
  /// Of spline_kernel_loop.h, for cubic functions. Per quadrature point 57 for Kelvin's kernels; 16
  /// sums times the functions along u and then v (tensor rules) or times all functions (polar
  /// rules), fused; where points are not prepared, about 400 to place each. 15 per function to add
  /// the sums to their coefficients.
  static double splineOperations(int used, bool isInside, int functions) {
    constexpr double kKernels = 57, kSums = 2 * 16, kPlace = 400, kAdd = 15;
    const double along = std::sqrt(functions), add = kAdd * functions;
    if (isInside) return used * (kKernels + kSums * functions + kPlace) + add;
    const double perDirection = std::sqrt(used);
    const bool isPrepared = used <= 36;
    const double n = isPrepared ? perDirection : bem::SplineQuadrature::kMost;
    return used * (kKernels + kSums * (along + functions / n) + (isPrepared ? 0 : kPlace)) + add;
  }

  void share(const std::string& engine, double flops) {
    add(engine + ": operations per second", flops / 1e9, "GFLOP/s");
    add(engine + ": share of the peak", 100 * flops / peak_, "%");
  }

  void add(const std::string& what, double value, const std::string& unit) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4g%s%s", value, unit.empty() ? "" : " ", unit.c_str());
    std::printf("  %-52s %s\n", what.c_str(), text);
    std::fflush(stdout);
    table_.add(0, what, text, "");
  }

  bem::Job job_;
  bench::MeasurementTable table_;
  double peak_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Shares of the machine's peak that the assembly reaches."};
  bem::Job job;
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
  return 0;
}
