#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/touch.h"
#include "app/mpi/mpi_team.h"
#include "app/mpi/rank_options.h"
#include "app/mpi/shared_problem.h"

namespace palpa::mpi {

/// One run of palpa-mpi on one rank; every rank makes the same calls.
class RankRun {
 public:
  RankRun(const RankOptions& options, const MpiTeam& team, Job job)
      : options_(options), team_(team), job_(std::move(job)) {}

  /// Reads the project, computes its model and columns, plays its touches and stores the model.
  /// Throws ModelingError, SolverError, FileError, Cancelled.
  void run();

  // The report, on rank 0 after run().
  std::string text() const;
  nlohmann::ordered_json json() const;

 private:
  std::unique_ptr<bem::ReferenceProblem> makeProblem(const bem::Discretisation& on,
                                                     const bem::ProblemInputs& inputs,
                                                     const Job& job,
                                                     bem::ReferenceProblemTimes* times);
  void checkSameMesh(const bem::Discretisation& on) const;
  void checkMemory(const bem::Discretisation& on) const;
  void computeColumns(const modeling::Project& project);
  void store();
  /// Wall time, and processor time of a rank without waiting for others, s.
  struct Seconds {
    double wall = 0, work = 0;
  };
  /// Seconds until all ranks have done their work.
  template <class Work>
  Seconds timed(const Work& work) const;
  void gatherFigures();

  const RankOptions& options_;
  const MpiTeam& team_;
  const Job job_;
  std::shared_ptr<const app::TouchModel> model_;
  SharedProblem* problem_ = nullptr;  ///< of model_
  bem::ProblemInputs inputs_;
  bem::KnownColumns columns_;
  std::optional<app::TouchState> touched_;
  Seconds columnSeconds_, touchSeconds_, storeSeconds_;
  double assembleWork_ = 0, factoriseWork_ = 0;
  double operatorBytes_ = 0;   ///< of this rank
  std::vector<double> peaks_;  ///< bytes, of each rank
};

}  // namespace palpa::mpi
