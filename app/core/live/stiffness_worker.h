#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "app/core/live/touchable_model.h"
#include "base/job.h"
#include "base/worker_thread.h"

namespace palpa::app {

/// bem::StiffnessMap::compliances() of a model, for a fingertip of the given radius (mm). Computes
/// all columns: minutes for large meshes. Phases "Green's function" and "stiffness". Throws
/// SolverError (kTooLarge) if there is no memory for the columns, Cancelled.
std::vector<double> stiffnessMap(const std::shared_ptr<const TouchModel>& model, double radius,
                                 const Job& job);

/// Computes the stiffness map of a model in the background, on one thread of low priority, while
/// its columns are computed; hands out the part that is known a few times a second, until all of it
/// is.
class StiffnessWorker {
 public:
  struct Result {
    std::shared_ptr<const TouchableModel> model;
    double radius = 0;                ///< mm, of the fingertip
    std::vector<double> compliances;  ///< bem::StiffnessMap::compliances()
    double ready = 0;                 ///< 0 … 1, of the free nodes
  };
  /// `receive` is called on the worker's thread.
  explicit StiffnessWorker(std::function<void(Result)> receive);

  /// Starts from the beginning; stops a computation that runs. Waits at most for one node.
  void start(std::shared_ptr<const TouchableModel> model, double radius);
  /// No result is handed out afterwards.
  void stop();

 private:
  void run(const std::stop_token& stop, const std::shared_ptr<const TouchableModel>& model,
           double radius) const;

  std::function<void(Result)> receive_;
  WorkerThread worker_;
};

}  // namespace palpa::app
