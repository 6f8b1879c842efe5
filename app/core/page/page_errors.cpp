#include "app/core/page/page_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "app/core/results/press_error.h"

namespace palpa::app {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Places at which forces of one touch, of pairs of touches, and whole fields are compared: tens of
/// microseconds, a millisecond and tens of milliseconds each.
constexpr std::size_t kForceSamples = 1000, kCouplingSamples = 150, kFieldSamples = 32;
/// Places beside supports, and others, at which the error of the model is estimated.
constexpr std::size_t kModelSamples = 32;
/// Of these, the ones that count for a triangle.
constexpr std::size_t kModelNeighbours = 3;
/// From the largest error of the samples to the stated one, because samples miss the worst place.
constexpr double kMargin = 1.5;
/// The same for forces of one touch. Of 100 other points of a coarse cylinder, four are above 1.5
/// times, none above 2.5 times.
constexpr double kForceMargin = 2.5;
/// Below this the error comes from the single precision of the Green's columns and of the file.
constexpr double kMinDeviation = 2e-4;
/// Depth of a touch, in its radii, to whose force the error by the displacement without touches is
/// related.
constexpr double kDepth = 0.1;

double largest(const Matrix3d& matrix) {
  return matrix.jacobiSvd().singularValues()[0];
}

void raise(double& most, double value) {
  most = std::max(most, value);
}

/// Relative error of forces of all unit displacements: f_page - f = (S_page^-1 S - 1) f.
double forceError(const Matrix3d& ofPage, const Matrix3d& exact) {
  return largest(ofPage.ldlt().solve(exact) - Matrix3d::Identity());
}

/// Error of the force by a displacement without touches that is off by `off` (mm), over the force
/// of a touch of `depth` (mm); `own`: compliance of the touch.
double loadError(const Vector3d& off, const Matrix3d& own, double depth) {
  const Matrix3d stiffness = own.inverse();
  return (stiffness * off).norm() * std::sqrt(3.0) / (depth * stiffness.norm());
}

struct Sample {
  TouchPage::Point at;
  bem::SurfacePoint place;
  Matrix3d own;
  Vector3d loaded;
};

class Measurement {
 public:
  Measurement(TouchPage& page, const TouchModel& model, const PageSurface& surface,
              PageSolutions& solutions, double from, const Job& job)
      : page_(page),
        model_(model),
        surface_(surface),
        solutions_(solutions),
        from_(from),
        job_(job) {
    for (std::size_t t = 0; t < page.triangles.size(); ++t)
      if (page.isTouchable[t]) touchable_.push_back(static_cast<int>(t));
  }

  void run() {
    chooseSamples();
    findDeviations();
    measureForces();
    report(0.3);
    measureCouplings();
    report(0.5);
    measureFields();
    estimateModel();
  }

 private:
  void report(double fraction) const { job_.report(Phase::kTouch, from_ + (1 - from_) * fraction); }

  /// Random places: every triangle is as probable as every other, so that small triangles, which
  /// are where much changes, have as many samples.
  void chooseSamples() {
    std::mt19937 generator(11);
    std::exponential_distribution<double> uniform;  // its shares are uniform in a triangle
    for (std::size_t k = 0; k < kForceSamples && !touchable_.empty(); ++k) {
      job_.throwIfCancelled();
      TouchPage::Point point{touchable_[generator() % touchable_.size()]};
      for (double& weight : point.weights) weight = uniform(generator);
      point.weights /= point.weights.sum();
      const bem::SurfacePoint place = surface_.at(point);
      if (const auto own = solutions_.own(place))
        samples_.push_back({point, place, own->compliance, own->loaded});
    }
  }

  /// Error of the force of a touch of kDepth by an interpolated compliance and displacement.
  double errorOf(const Matrix3d& ofPage, const Vector3d& loadedOfPage, const Matrix3d& exact,
                 const Vector3d& loaded) const {
    return forceError(ofPage, exact) +
           loadError(loadedOfPage - loaded, exact, kDepth * page_.radius);
  }

  /// How far the force in the middle of a triangle is from the force by the quadratic functions
  /// through corners and edges: the largest error of the triangles around.
  void findDeviations() {
    std::vector<double> around(page_.positions.size(), kMinDeviation);
    for (const int t : touchable_) {
      const auto triangle = static_cast<std::size_t>(t);
      Matrix3d middle = Matrix3d::Zero();
      Eigen::Vector3f loaded = Eigen::Vector3f::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        const auto edge = page_.edges[triangle][k], corner = page_.triangles[triangle][k];
        middle += (4 * TouchPage::symmetric(page_.ownAtEdges[edge]) -
                   TouchPage::symmetric(page_.own[corner])) /
                  9;
        loaded += (4 * page_.meanLoadedAtEdges[edge] - page_.meanLoaded[corner]) / 9;
      }
      const double here =
          errorOf(middle, loaded.cast<double>(), TouchPage::symmetric(page_.ownAtMiddles[triangle]),
                  page_.meanLoadedAtMiddles[triangle].cast<double>());
      for (const std::uint16_t corner : page_.triangles[triangle]) raise(around[corner], here);
    }
    deviations_.assign(page_.triangles.size(), kMinDeviation);
    for (const int t : touchable_)
      for (const std::uint16_t corner : page_.triangles[static_cast<std::size_t>(t)])
        raise(deviations_[static_cast<std::size_t>(t)], around[corner]);
  }

  void measureForces() {
    double factor = 0;
    for (const Sample& sample : samples_)
      raise(factor, errorOf(page_.ownCompliance(sample.at), page_.loadedAt(sample.at), sample.own,
                            sample.loaded) /
                        deviations_[static_cast<std::size_t>(sample.at.triangle)]);
    page_.forceErrors.assign(page_.triangles.size(), 0);
    std::vector<double> stated;
    for (const int t : touchable_) {
      stated.push_back(kForceMargin * factor * deviations_[static_cast<std::size_t>(t)]);
      page_.forceErrors[static_cast<std::size_t>(t)] = static_cast<float>(stated.back());
    }
    std::sort(stated.begin(), stated.end());
    page_.errors.samples = static_cast<int>(samples_.size());
    if (stated.empty()) return;
    page_.errors.force = stated.back();
    page_.errors.typicalForce = stated[stated.size() / 2];
  }

  /// Pairs that overlap are one touch.
  void measureCouplings() {
    const std::size_t count = std::min(kCouplingSamples, samples_.size());
    std::vector<bem::SurfacePoint> places;
    for (std::size_t k = 0; k < count; ++k) places.push_back(samples_[k].place);
    const Eigen::MatrixXd exact = solutions_.between(places);
    for (std::size_t a = 0; a < count; ++a) {
      job_.throwIfCancelled();
      for (std::size_t b = 0; b < a; ++b) {
        const Vector3d &atA = places[a].position, &atB = places[b].position;
        if ((atA - atB).norm() < page_.radius) continue;
        const Matrix3d block =
            exact.block<3, 3>(3 * static_cast<Index>(a), 3 * static_cast<Index>(b));
        raise(
            page_.errors.coupling[page_.couplingClass(atA, atB)],
            kMargin * largest(page_.couplingOf(samples_[a].at, samples_[b].at) - block) /
                std::sqrt(TouchPage::sizeOf(samples_[a].own) * TouchPage::sizeOf(samples_[b].own)));
      }
    }
  }

  void measureFields() {
    const std::size_t count = std::min(kFieldSamples, samples_.size());
    std::vector<bem::ContactMask> masks;
    for (std::size_t k = 0; k < count; ++k) masks.push_back(solutions_.mask(samples_[k].place));
    std::vector<double> errors;
    solutions_.forEach(
        masks,
        [&](std::size_t k, const Eigen::MatrixXd& u) {
          Eigen::MatrixX3d wrong = page_.fieldOf(samples_[k].at);
          for (Index axis = 0; axis < 3; ++axis)
            wrong.col(axis) -= surface_.vertexField(u.col(axis));
          double worst = 0;
          for (Index row = 0; row < wrong.rows(); row += 3)
            raise(worst, largest(wrong.middleRows<3>(row)));
          errors.push_back(worst / largest(samples_[k].own));
        },
        [&](double fraction) { report(0.5 + 0.5 * fraction); }, job_);
    if (errors.empty()) return;
    std::sort(errors.begin(), errors.end());
    page_.errors.typicalField = errors[errors.size() / 2];
    page_.errors.field = kMargin * errors.back();
  }

  /// The estimate varies over the body, and is largest beside supports and edges: every triangle
  /// has the largest one of the nearest samples; triangles
  /// beside supports and others are kept apart.
  void estimateModel() {
    std::vector<Vector3d> places;
    std::vector<OrientedPoint> points;
    std::vector<bool> isNear;
    std::array<std::size_t, 2> counts{};
    for (const Sample& sample : samples_) {
      const bool isHere = isBesideSupport(sample.at);
      if (counts[isHere]++ >= kModelSamples) continue;
      places.push_back(sample.place.position);
      points.push_back({page_.positionOf(sample.at), page_.normalOf(sample.at)});
      isNear.push_back(isHere);
    }
    const std::vector<PressError> errors = estimatePressErrors(model_, places, page_.radius, job_);
    page_.modelErrors.assign(page_.triangles.size(), 0);
    std::vector<double> stated;
    for (const int t : touchable_) {
      job_.throwIfCancelled();
      const OrientedPoint here{page_.positionOf({t}), page_.normalOf({t})};
      const bool isHere = isBesideSupport({t});
      std::vector<std::pair<double, double>> near;  // distance, error
      for (std::size_t k = 0; k < points.size(); ++k)
        if (isNear[k] == isHere)
          near.emplace_back(orientedDistance(here, points[k], page_.radius), errors[k].relative);
      const std::size_t count = std::min(kModelNeighbours, near.size());
      std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count),
                        near.end());
      double error = 0;
      for (std::size_t k = 0; k < count; ++k) raise(error, near[k].second);
      page_.modelErrors[static_cast<std::size_t>(t)] = static_cast<float>(error);
      stated.push_back(error);
    }
    std::sort(stated.begin(), stated.end());
    if (stated.empty()) return;
    page_.errors.model = stated.back();
    page_.errors.typicalModel = stated[stated.size() / 2];
    job_.report(Phase::kErrorEstimate, 1);
  }

  bool isBesideSupport(const TouchPage::Point& point) const {
    return isNearSupport(model_.setup(), page_.positionOf(point), page_.radius);
  }

  TouchPage& page_;
  const TouchModel& model_;
  const PageSurface& surface_;
  PageSolutions& solutions_;
  double from_;
  const Job& job_;
  std::vector<int> touchable_;      // triangles
  std::vector<double> deviations_;  // per triangle
  std::vector<Sample> samples_;
};

}  // namespace

void measurePageErrors(TouchPage& page, const TouchModel& model, const PageSurface& surface,
                       PageSolutions& solutions, double from, const Job& job) {
  Measurement(page, model, surface, solutions, from, job).run();
}

}  // namespace palpa::app
