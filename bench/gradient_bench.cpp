// Gradients of the stiffness of touches by the control points: error against central differences
// of full rebuilds in random directions, and time.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "app/core/design/carried_stiffness.h"
#include "app/core/design/stiffness_gradient.h"
#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "bench/gradient_times.h"
#include "bench/timing.h"
#include "modeling/project/project_file.h"

namespace {

using namespace palpa;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

struct Options {
  int directions = 20;
  double step = 1e-3;  // of the body's size
  unsigned seed = 1;
  bool isVerbose = false;
  int times = 0;  // repetitions; 0: errors
};

/// Independent motions of all control points, mm.
Matrix3Xd randomMotion(std::size_t count, double size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Matrix3Xd motion(3, static_cast<Eigen::Index>(count));
  for (double& each : motion.reshaped()) each = size * normal(random);
  return motion;
}

std::vector<Vector3d> moved(const std::vector<Vector3d>& points, const Matrix3Xd& by) {
  std::vector<Vector3d> result = points;
  for (std::size_t k = 0; k < points.size(); ++k) result[k] += by.col(static_cast<Eigen::Index>(k));
  return result;
}

void measureTimes(const std::string& name, const modeling::Project& project, int repeats,
                  const Job& job) {
  const auto model = app::buildTouchModel(project, {}, job);
  for (const auto& contact : app::playTouches(*model, project.touches, 0, job).contacts)
    bench::printGradientTimes(name, project, *model, app::stiffnessRuleOf(contact), repeats, job);
}

void measure(const std::string& name, const modeling::Project& project, const Options& options,
             const Job& job) {
  const auto model = app::buildTouchModel(project, {}, job);
  const auto& solid = std::get<modeling::Solid>(model->body());
  const auto [low, high] = modeling::boundingBox(project.body);
  const double size = (high - low).norm();
  std::unique_ptr<app::StiffnessGradients> gradients;
  const double make = bench::secondsFor(
      [&] { gradients = std::make_unique<app::StiffnessGradients>(project, *model, job); });
  const app::TouchState state = app::playTouches(*model, project.touches, 0, job);
  for (const auto& contact : state.contacts) {
    const app::StiffnessRule rule = app::stiffnessRuleOf(contact);
    const auto stiffness =
        app::contactStiffness(*model->problem(), gradients->contactSurface(), rule, job);
    Matrix3Xd gradient = gradients->gradient(stiffness, job);
    const double seconds =
        bench::secondsFor([&] { gradient = gradients->gradient(stiffness, job); });
    Matrix3Xd boundary;
    const double boundarySeconds =
        bench::medianSecondsFor([&] { boundary = gradients->boundaryForm(stiffness, job); });
    double scaling = 0;
    for (std::size_t k = 0; k < solid.controlPoints().size(); ++k)
      scaling += solid.controlPoints()[k].dot(gradient.col(static_cast<Eigen::Index>(k)));
    std::printf(
        "%s, %s: k %.5g N/mm (%.5g shown), |sum g| %.2g of sum |g|, scaling %.4f k; %d points, "
        "made in %.0f ms, gradient %.0f ms, boundary form %.2f ms\n",
        name.c_str(), rule.name.c_str(), stiffness.value, contact.stiffness,
        gradient.rowwise().sum().norm() / gradient.colwise().norm().sum(),
        scaling / stiffness.value, gradients->surface().sampler.pointCount(), 1e3 * make,
        1e3 * seconds, 1e3 * boundarySeconds);
    std::mt19937 random(options.seed);
    double square = 0, errorSquare = 0, worst = 0, boundarySquare = 0;
    for (int direction = 0; direction < options.directions; ++direction) {
      const Matrix3Xd motion =
          randomMotion(solid.controlPoints().size(), options.step * size, random);
      const auto at = [&](double sign) {
        return app::movedStiffness(project, *model, rule,
                                   moved(solid.controlPoints(), sign * motion), job);
      };
      const double difference = (at(1) - at(-1)) / 2;
      const double predicted = gradient.cwiseProduct(motion).sum();
      square += difference * difference;
      errorSquare += std::pow(predicted - difference, 2);
      boundarySquare += std::pow(boundary.cwiseProduct(motion).sum() - difference, 2);
      worst = std::max(worst, std::abs(predicted - difference));
      if (options.isVerbose)
        std::printf("  %2d: difference %12.5g, gradient %12.5g (%.3f)\n", direction, difference,
                    predicted, predicted / difference);
      std::fflush(stdout);
    }
    if (options.directions > 0) {
      const double rms = std::sqrt(square / options.directions);
      std::printf(
          "  change %.2g of k; error rms %.2f %%, worst %.2f %% of the rms change; boundary form "
          "%.1f %%\n",
          rms / stiffness.value, 100 * std::sqrt(errorSquare / square), 100 * worst / rms,
          100 * std::sqrt(boundarySquare / square));
    }
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App options("Errors and times of gradients of stiffness");
  std::vector<std::string> files, engines{"automatic"};
  Options settings;
  int threads = 0;
  double edge = 0;
  options.add_option("FILE", files, "Project files")->required();
  options.add_option("--engine", engines, "Engines: automatic, splines, triangles, quadratic");
  options.add_option("--directions", settings.directions, "Random directions per project");
  options.add_option("--step", settings.step, "Motion of a control point over the body's size");
  options.add_option("--seed", settings.seed, "Seed of the random directions");
  options.add_option("--threads", threads, "Threads; 0: all cores");
  options.add_option("--times", settings.times,
                     "Print times of so many repetitions, by parts, instead of errors");
  options.add_option("--edge", edge, "Edge length of triangles, mm; 0: as in the file");
  options.add_flag("--verbose", settings.isVerbose, "Print every direction");
  CLI11_PARSE(options, argc, argv);
  Job job;
  job.threads = threads;
  int result = 0;
  for (const std::string& file : files)
    for (const std::string& engine : engines) {
      modeling::Project project = modeling::readProject(file);
      if (engine == "splines") project.mesh.engine = modeling::Engine::kSplines;
      if (engine == "triangles") project.mesh.engine = modeling::Engine::kTriangles;
      if (engine == "quadratic") project.mesh.engine = modeling::Engine::kQuadratic;
      if (edge > 0) project.mesh.edgeLength = edge;
      try {
        if (settings.times > 0)
          measureTimes(file + " " + engine, project, settings.times, job);
        else
          measure(file + " " + engine, project, settings, job);
      } catch (const std::exception& error) {  // say, a step that folds the body
        std::fprintf(stderr, "%s %s: %s\n", file.c_str(), engine.c_str(), error.what());
        result = 1;
      }
    }
  return result;
}
