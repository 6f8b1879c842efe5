#pragma once

#include <optional>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/press_error.h"

namespace palpa::app {

/// Estimated error of a model and its size: two of them give the order of convergence.
struct AccuracySample {
  int coefficients = 0;  ///< of displacement
  TouchError error;
};

/// Requested and reached accuracy of a model, the reason for a difference, and mesh settings that
/// reach the requested one.
struct AccuracyAdvice {
  double requested = 0;  ///< relative error: MeshSettings::accuracy
  double reached = 0;    ///< estimated relative error of touches (estimateTouchError())

  /// Limit of the reached accuracy.
  enum class Limit {
    kNone,  ///< none: the requested accuracy is reached
    /// The number of spline coefficients that builds of a few seconds allow.
    kBuildTime,
    kTouch,          ///< triangles that cannot represent a fingertip, so contacts are wider
    kElementLength,  ///< the size of the spline elements that the project sets
    kEdgeLength,     ///< the edge length of the triangles
    kElementSize,    ///< the size of the spline elements that the accuracy leads to
  };
  Limit limit = Limit::kNone;

  /// Finer settings; none if the requested accuracy is reached or no finer mesh fits the memory.
  std::optional<modeling::MeshSettings> mesh;
  bool isEnough = false;    ///< true if `mesh` is expected to reach the requested accuracy
  double expected = 0;      ///< relative error expected with `mesh`
  bool hasSplines = false;  ///< the model, and the one with `mesh`
  double coefficients = 0;  ///< of displacement with `mesh`, about; with triangles nodes
  double bytes = 0;         ///< memory with `mesh`, about
  double seconds = 0;       ///< to build the model with `mesh`, about; 0: unknown
  double neededBytes = 0;   ///< memory to reach the requested accuracy, about
  double usableBytes = 0;   ///< memory that can be used; 0: unknown
  double order = 0;         ///< assumed or observed order of convergence
};

/// Advice for a model of `project`. The error is assumed to fall like a power of the lengths of
/// elements (with triangles as soon as contacts are no wider than fingertips): with the order that
/// `former`, a sample of the same project with another mesh, and this model show, otherwise with
/// the usual order of the engine. `options`: precision and memory limit. Cost: a few spline
/// refinements or estimates of nodes. Throws Cancelled.
AccuracyAdvice adviseAccuracy(const modeling::Project& project, const TouchModel& model,
                              const TouchError& error, const std::optional<AccuracySample>& former,
                              const BuildOptions& options, const Job& job);

}  // namespace palpa::app
