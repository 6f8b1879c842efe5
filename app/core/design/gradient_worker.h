#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/core/design/stiffness_gradient.h"
#include "app/core/design/surface_gradient.h"
#include "base/worker_thread.h"

namespace palpa::app {

/// Computes the gradient of the stiffness of one touch in the background, on threads of low
/// priority. Keeps what belongs to the last model, so that further touches on it are quicker.
class GradientWorker {
 public:
  struct Request {
    std::shared_ptr<const TouchModel> model;
    std::shared_ptr<const modeling::Project> project;  ///< of the model
    StiffnessRule rule;
    /// The solid that the rule belongs to, with as many control points as the model's: the rule is
    /// carried to the model along with the material. Null: the rule is on the model.
    std::shared_ptr<const modeling::Solid> from;
    std::shared_ptr<const DrawnBody> drawn;  ///< of the model, for Result::surface; may be null
  };
  struct Result {
    std::uint64_t number = 0;  ///< of the request
    StiffnessRule rule;        ///< on the model
    double stiffness = 0;      ///< N/mm
    /// N/mm per mm, one column per control point. Empty in the first result, which has the
    /// stiffness alone; an incremental update has no other, as its gradient needs a full rebuild.
    Eigen::Matrix3Xd gradient;
    std::vector<double> surface;  ///< SurfaceGradient::values(), with a gradient and `drawn`
    double seconds = 0;           ///< since the start of the computation
    std::string problem;          ///< why there is no stiffness or gradient; empty: nothing wrong
  };
  /// `receive` is called on the worker's thread. `threads` of a computation; 0: all cores.
  explicit GradientWorker(std::function<void(Result)> receive, int threads = 0);

  /// Starts a computation and stops the one before, whose results are dropped. Returns its number.
  /// Does not wait.
  std::uint64_t start(Request request);
  /// Stops, and releases the models. Results may still arrive, with old numbers. Does not wait.
  void clear();

 private:
  /// What all touches on a model share.
  struct OfModel {
    std::shared_ptr<const TouchModel> model;
    std::unique_ptr<bem::ContactSurface> surface;
    std::unique_ptr<StiffnessGradients> gradients;  // null until needed
    std::shared_ptr<const DrawnBody> drawn;
    std::unique_ptr<SurfaceGradient> onSurface;  // of `drawn`
  };
  void run(std::uint64_t number, const Request& request, const Job& job);
  void compute(const Request& request, const Job& job, Result& result);

  std::function<void(Result)> receive_;
  const int threads_;
  std::uint64_t number_ = 0;
  OfModel ofModel_;  // only the worker's thread uses it
  WorkerThread worker_;
};

}  // namespace palpa::app
