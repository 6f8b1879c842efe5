#include "bench/gradient_times.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "base/parallel.h"
#include "bench/plain_boundary_form.h"
#include "bench/timing.h"

namespace palpa::bench {
namespace {

using Eigen::Matrix3Xd;

/// Times of repeated work, ms.
class Samples {
 public:
  template <class Work>
  void add(const Work& work) {
    double processor = 0;
    clock_.push_back(1e3 * secondsFor([&] { processor = processorSecondsFor(work); }));
    processor_.push_back(1e3 * processor);
  }
  void print(const char* name) const {
    std::printf("  %-42s %8.3f %8.3f   %8.3f %8.3f\n", name, least(processor_), median(processor_),
                least(clock_), median(clock_));
    std::fflush(stdout);
  }

 private:
  static double least(const std::vector<double>& times) {
    return *std::min_element(times.begin(), times.end());
  }
  static double median(const std::vector<double>& times) { return quantilesOf(times).p50; }
  std::vector<double> processor_, clock_;
};

/// Times of the parts of the plain form, ms.
class Parts {
 public:
  void add(const PlainBoundaryTimes& times) {
    const std::array<double, 4> parts{times.states, times.density, times.masks, times.sum};
    for (std::size_t k = 0; k < parts.size(); ++k) times_[k].push_back(1e3 * parts[k]);
  }
  void print() const {
    const std::array<const char*, 4> names{
        "  states of both fields at the points", "  Eshelby's tensor at the points",
        "  motion of the masks", "  sum over the control points"};
    for (std::size_t k = 0; k < names.size(); ++k)
      std::printf("  %-42s %8.3f %8.3f\n", names[k],
                  *std::min_element(times_[k].begin(), times_[k].end()),
                  quantilesOf(times_[k]).p50);
  }

 private:
  std::array<std::vector<double>, 4> times_;
};

}  // namespace

void printGradientTimes(const std::string& name, const modeling::Project& project,
                        const app::TouchModel& model, const app::StiffnessRule& rule, int repeats,
                        const Job& job) {
  Samples prepared, form, plain, newer, fields, adjoint;
  Parts parts;
  prepared.add([&] { app::StiffnessGradients(project, model, job); });
  const app::StiffnessGradients gradients(project, model, job);
  app::ContactStiffness stiffness;
  for (int k = 0; k < 5; ++k)
    fields.add([&] {
      stiffness = contactStiffness(*model.problem(), gradients.contactSurface(), rule, job);
    });
  Matrix3Xd baseline, result;
  for (int k = 0; k < std::min(repeats, 5); ++k)
    form.add([&] { app::BoundaryGradient(gradients.surface(), model); });
  result = gradients.boundaryForm(stiffness, job);  // prepares
  PlainBoundaryTimes times;
  for (int k = 0; k < repeats; ++k) {
    plain.add(
        [&] { baseline = plainBoundaryForm(gradients.surface(), model, stiffness, job, &times); });
    parts.add(times);
    newer.add([&] { result = gradients.boundaryForm(stiffness, job); });
  }
  for (int k = 0; k < std::min(repeats, 5); ++k)
    adjoint.add([&] { gradients.gradient(stiffness, job); });
  double load = 0;
  getloadavg(&load, 1);
  std::printf(
      "%s, %s: %d coefficients, %d control points, %d surface points, %d threads, load %.1f\n"
      "  %-42s %17s   %17s\n  %-42s %8s %8s   %8s %8s\n",
      name.c_str(), rule.name.c_str(), model.problem()->dofs().nodeCount(),
      static_cast<int>(result.cols()), gradients.surface().sampler.pointCount(), workerCount(job),
      load, "ms", "processor", "clock", "", "least", "median", "least", "median");
  prepared.print("once per model: gradients");
  form.print("once per model: boundary form");
  fields.print("fields of the touch");
  plain.print("boundary form, plain");
  parts.print();
  newer.print("boundary form, prepared");
  adjoint.print("discrete adjoint");
  std::printf("  largest difference of the forms over the largest value: %.1g\n",
              (result - baseline).cwiseAbs().maxCoeff() / baseline.cwiseAbs().maxCoeff());
}

}  // namespace palpa::bench
