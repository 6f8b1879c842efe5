#include "app/core/model/build_touch_model.h"

#include "app/core/model/model_builder.h"
#include "app/core/system/memory.h"
#include "modeling/editing/change.h"

namespace palpa::app {
namespace {

/// True if control points moved and nothing else changed that a model depends on.
bool isMotion(const modeling::Project& former, const modeling::Project& project) {
  const modeling::Change change = modeling::compare(former, project);
  return std::holds_alternative<modeling::Solid>(project.body) && !change.movedPoints.empty() &&
         !change.topology && !change.edges && !change.patchNames && !change.material &&
         !change.supports && !change.loads && !change.mesh && !change.touches;
}

/// True if memory holds an update, which is at most as large as the former model, and the full
/// model that replaces it.
bool hasMemoryForUpdate(const TouchModel& former) {
  const double available = availableMemory();
  return available <= 0 || 2 * former.report().memory <= 0.85 * available;
}

}  // namespace

std::shared_ptr<const TouchModel> buildTouchModel(const modeling::Project& project,
                                                  const BuildOptions& options, const Job& job,
                                                  const TouchModel* former) {
  job.report(Phase::kMesh, 0);
  ModelBuilder builder(project, options, job);
  builder.prepare();
  builder.makeProblem(former);
  builder.solveAtRest();
  return builder.finish();
}

std::shared_ptr<const TouchModel> updateTouchModel(const modeling::Project& project,
                                                   const modeling::Project& formerProject,
                                                   const TouchModel& former,
                                                   const BuildOptions& options, const Job& job) {
  if (former.report().residual || !isMotion(formerProject, project) || !hasMemoryForUpdate(former))
    return nullptr;
  job.report(Phase::kUpdate, 0);
  const Job quiet{job.stop, {}, job.threads};
  ModelBuilder builder(project, options, quiet);
  if (!builder.moveMesh(std::get<modeling::Solid>(formerProject.body), former)) return nullptr;
  builder.check();
  builder.setUp();
  job.report(Phase::kUpdate, 0.2);
  if (!builder.updateProblem(former)) return nullptr;
  job.report(Phase::kUpdate, 0.5);
  if (!builder.solveUpdateAtRest(former)) return nullptr;
  job.report(Phase::kUpdate, 1);
  return builder.finish();
}

}  // namespace palpa::app
