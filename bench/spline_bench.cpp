// Splines against triangles at equal error, in one run: a sphere whose lower sixth is held, with
// the field of a point force outside it as exact solution. Time from geometry to touchable:
// assembly and factorisation.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "app/core/setup/to_spline_surface.h"
#include "bem/dense/make_reference_problem.h"
#include "bem/model/traction_projection.h"
#include "bem/problem/reference_problem.h"
#include "bem/spline/spline_projection.h"
#include "bem/triangle/kelvin.h"
#include "bench/measurement_table.h"
#include "modeling/mesh/mesh.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/shapes/primitives.h"

namespace {

using namespace palpa;
using Eigen::Vector3d;

const bem::Material kMaterial{0.1, 0.3};
const Vector3d kSource{20, 15, 40}, kForce{0.03, -0.02, 0.06};
constexpr int kRounds = 3;
constexpr double kLong = 3;  ///< s; what takes longer is done once

Vector3d exactDisplacement(const Vector3d& x) {
  return bem::kelvinDisplacement(kSource, x, kMaterial).transpose() * kForce;
}
Vector3d exactTraction(const Vector3d& x, const Vector3d& n) {
  return bem::kelvinTraction(kSource, x, n, kMaterial).transpose() * kForce;
}
bool isHeld(const Vector3d& x) {
  return x.z() < -std::max(std::abs(x.x()), std::abs(x.y()));
}
bem::SlotCondition conditionOf(int tag) {
  return tag == 1 ? bem::SlotCondition::kFixed : bem::SlotCondition::kTraction;
}

struct Row {
  const char* engine;
  int n;
  double error, assemble, factorise;
  double seconds() const { return assemble + factorise; }
};

/// Relative L2 error from values at quadrature points.
struct ErrorSum {
  double error = 0, scale = 0;
  void add(const Vector3d& found, const Vector3d& exact, double weight) {
    error += weight * (found - exact).squaredNorm();
    scale += weight * exact.squaredNorm();
  }
  double relative() const { return std::sqrt(error / scale); }
};

/// The fastest of some rounds: the least disturbed by other programs.
template <class Build>
std::unique_ptr<bem::ReferenceProblem> fastest(const Build& build, Row& row) {
  std::unique_ptr<bem::ReferenceProblem> problem;
  row.assemble = row.factorise = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds && (round == 0 || row.seconds() < kLong); ++round) {
    problem.reset();
    bem::ReferenceProblemTimes times;
    problem = build(times);
    if (times.assemble + times.factorise >= row.seconds()) continue;
    row.assemble = times.assemble;
    row.factorise = times.factorise;
  }
  return problem;
}

Row triangles(double edgeLength, const Job& job) {
  const modeling::Body body = modeling::makeSphere(25);
  modeling::MeshSettings settings;
  settings.edgeLength = edgeLength;
  const modeling::SurfaceMesh surface = modeling::mesh(body, settings, {});
  bem::BoundaryMesh mesh{surface.positions, surface.triangles, surface.smoothingGroupOfTriangle,
                         std::vector<int>(surface.triangles.size(), 0)};
  for (int t = 0; t < mesh.triangleCount(); ++t)
    if (isHeld(mesh.point(t, Vector3d::Constant(1.0 / 3)))) mesh.tags[t] = 1;
  const bem::TractionSlots slots(mesh);
  bem::BoundaryConditions given(mesh, slots);
  for (int s = 0; s < slots.count(); ++s) given.ofSlot[s] = conditionOf(slots.slots[s].tag);
  for (int k = 0; k < mesh.nodeCount(); ++k)
    given.displacement.segment<3>(3 * k) = exactDisplacement(mesh.nodes[k]);
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  given.traction =
      projectTraction(mesh, slots, {all, exactTraction, std::numeric_limits<double>::infinity()});
  Row row{"triangles", mesh.nodeCount(), 0, 0, 0};
  const auto problem = fastest(
      [&](bem::ReferenceProblemTimes& times) {
        return bem::makeDenseReferenceProblem(
            mesh, slots, {given.ofSlot, kMaterial, {}, bem::Precision::kAutomatic}, job, &times);
      },
      row);
  const bem::BoundaryField field = problem->solveField(problem->dofs().knownField(given));
  ErrorSum sum;
  bem::visitQuadraturePoints(mesh, all, std::numeric_limits<double>::infinity(),
                             [&](int t, const Vector3d& weights, double weight) {
                               Vector3d u = Vector3d::Zero();
                               for (int k = 0; k < 3; ++k)
                                 u += weights[k] *
                                      field.u.col(0).segment<3>(3 * mesh.triangles[t][k]);
                               sum.add(u, exactDisplacement(mesh.point(t, weights)), weight);
                             });
  row.error = sum.relative();
  return row;
}

Row splines(int controlPoints, int degree, const Job& job) {
  modeling::Primitive primitive;
  primitive.shape = modeling::SphereShape{25};
  primitive.degree = degree;
  primitive.controlPoints = controlPoints;
  bem::SplineSurface surface = app::splineSurfaceOf(modeling::makePrimitive(primitive));
  for (int e = 0; e < surface.elementCount(); ++e) {
    const bem::SplineElement& element = surface.elements()[e];
    const bem::ElementPlace middle{e, (element.lower[0] + element.upper[0]) / 2,
                                   (element.lower[1] + element.upper[1]) / 2};
    if (isHeld(surface.evaluate(middle).position)) surface.setTag(e, 1);
  }
  const bem::SplineTractions tractions(surface);
  bem::BoundaryConditions given(surface.coefficientCount(), tractions.slots.count());
  for (int s = 0; s < tractions.slots.count(); ++s)
    given.ofSlot[s] = conditionOf(tractions.slots.slots[s].tag);
  given.displacement = projectDisplacement(
      surface, [](const Vector3d& x, const Vector3d&) { return exactDisplacement(x); });
  std::vector<int> all(surface.elements().size());
  std::iota(all.begin(), all.end(), 0);
  given.traction = projectTraction(surface, tractions, all, exactTraction,
                                   std::numeric_limits<double>::infinity());
  Row row{degree == 3 ? "cubic" : "quadratic", surface.coefficientCount(), 0, 0, 0};
  const auto problem = fastest(
      [&](bem::ReferenceProblemTimes& times) {
        return bem::makeDenseReferenceProblem(
            surface, tractions, {given.ofSlot, kMaterial, {1e-5}, bem::Precision::kAutomatic}, job,
            &times);
      },
      row);
  const bem::BoundaryField field = problem->solveField(problem->dofs().knownField(given));
  ErrorSum sum;
  std::vector<double> basis;
  bem::visitSplinePoints(
      surface, all, 4, std::numeric_limits<double>::infinity(),
      [&](const bem::ElementPlace& place, const bem::SurfaceJet& jet, double weight) {
        surface.evaluateBasis(place, basis);
        Vector3d u = Vector3d::Zero();
        for (std::size_t f = 0; f < basis.size(); ++f)
          u += basis[f] * field.u.col(0).segment<3>(3 * surface.functions(place.element)[f]);
        sum.add(u, exactDisplacement(jet.position), weight);
      });
  row.error = sum.relative();
  return row;
}

/// Seconds that an engine needs for an error, between its rows (straight in logarithms); NaN when
/// no row is as good.
double secondsFor(const std::vector<Row>& rows, double error) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].error > error) continue;
    if (k == 0) return rows[0].seconds();
    const Row &a = rows[k - 1], &b = rows[k];
    const double share = std::log(a.error / error) / std::log(a.error / b.error);
    return a.seconds() * std::pow(b.seconds() / a.seconds(), share);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options{"Splines against triangles at equal error"};
  Job job;
  std::string tablePath;
  options.add_option("--threads", job.threads, "0: all cores");
  options.add_option("--table", tablePath,
                     "adds bench;n;what;value;unit;goal of the ratios to a file");
  CLI11_PARSE(options, argc, argv);

  bench::MeasurementTable table;
  table.open(tablePath, "palpa-spline-bench");
  std::vector<Row> triangle, cubic, quadratic;
  for (const double edge : {11.0, 7.0, 5.0, 3.5, 2.5, 2.0, 1.4})
    triangle.push_back(triangles(edge, job));
  for (const int points : {5, 6, 7, 9, 11}) quadratic.push_back(splines(points, 2, job));
  for (const int points : {5, 6, 7, 9, 11}) cubic.push_back(splines(points, 3, job));
  std::printf("%-10s %6s %10s %10s %10s %10s\n", "engine", "n", "error", "assemble s",
              "factorise s", "sum s");
  for (const auto* list : {&triangle, &quadratic, &cubic})
    for (const Row& row : *list)
      std::printf("%-10s %6d %10.2e %10.4f %10.4f %10.4f\n", row.engine, row.n, row.error,
                  row.assemble, row.factorise, row.seconds());
  for (const auto& [error, target] : {std::pair(3e-3, 10), {5e-4, 30}}) {
    const double slow = secondsFor(triangle, error);
    const double fast = std::fmin(secondsFor(cubic, error), secondsFor(quadratic, error));
    std::printf("error %.0e: triangles %.4f s, splines %.4f s, ratio %.1f (target >= %d)\n", error,
                slow, fast, slow / fast, target);
    char what[64], text[32];
    std::snprintf(what, sizeof what, "triangles over splines at an error of %.0e", error);
    std::snprintf(text, sizeof text, "%.1f", slow / fast);
    table.add(0, what, text, ">= " + std::to_string(target));
  }
}
