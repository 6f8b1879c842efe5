#pragma once

#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "app/core/live/touchable_model.h"

namespace palpa::app {

/// bem::StiffnessMap::compliances() of a whole body, for a fingertip of that radius (mm), with all
/// its columns: minutes for large meshes. Phases "Green's function" and "stiffness". Throws
/// SolverError (kTooLarge) when there is no memory for the columns, Cancelled.
std::vector<double> stiffnessMap(const std::shared_ptr<const TouchModel>& model, double radius,
                                 const Job& job);

/// Computes the stiffness map of a body in the background, on one thread of low priority, while its
/// columns come: what is known is handed out some times a second, until all of it is.
class StiffnessWorker {
 public:
  struct Result {
    std::shared_ptr<const TouchableModel> body;
    double radius = 0;                ///< mm, of the fingertip
    std::vector<double> compliances;  ///< bem::StiffnessMap::compliances()
    double ready = 0;                 ///< 0 … 1, of the free nodes
  };
  /// `receive` is called on the worker's thread.
  explicit StiffnessWorker(std::function<void(Result)> receive) : receive_(std::move(receive)) {}
  ~StiffnessWorker() { stop(); }
  StiffnessWorker(const StiffnessWorker&) = delete;
  StiffnessWorker& operator=(const StiffnessWorker&) = delete;

  /// Begins anew; what runs is stopped. Does not wait longer than a node takes.
  void start(std::shared_ptr<const TouchableModel> body, double radius);
  /// Afterwards nothing is handed out.
  void stop();

 private:
  void run(const std::stop_token& stop, const std::shared_ptr<const TouchableModel>& body,
           double radius) const;

  std::function<void(Result)> receive_;
  std::jthread thread_;
};

}  // namespace palpa::app
