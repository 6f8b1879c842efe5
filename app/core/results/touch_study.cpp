#include "app/core/results/touch_study.h"

#include <span>
#include <utility>

#include "app/core/model/build_touch_model.h"
#include "app/core/results/error_estimate.h"
#include "app/core/results/touch.h"
#include "base/part_of_job.h"
#include "bem/base/error.h"

namespace palpa::app {
bool isPassive(const modeling::Touch& touch) {
  return !modeling::infoOf(touch.kind).needsVector && touch.vector.isZero(0);
}

TouchStudy makeTouchStudy(const modeling::Project& project, std::shared_ptr<const TouchModel> model,
                          const Job& job) {
  if (!model) model = buildTouchModel(project, {}, job);
  TouchStudy study{project, std::move(model), {}, {}, {}};
  const std::span<const modeling::Touch> touches = study.project.touches;
  if (touches.size() > 1)
    for (std::size_t k = 0; k < touches.size(); ++k)
      if (!isPassive(touches[k])) study.alone.push_back({k, {}});
  const std::size_t count = 2 + study.alone.size();

  study.rest = study.model->rest();
  addErrors(*study.model, study.rest, partOfJob(job, 0, 1, count));
  study.together = study.rest;
  if (touches.empty()) return study;
  TouchPlayer player(*study.model);
  Job part = partOfJob(job, 1, 2, count);
  study.together = player.play(touches, 0, part);
  addErrors(*study.model, study.together, part);
  for (std::size_t k = 0; k < study.alone.size(); ++k) {
    TouchStudy::Single& single = study.alone[k];
    part = partOfJob(job, 2 + k, 3 + k, count);
    try {
      single.state = player.play(touches.subspan(single.touch, 1), 0, part);
    } catch (const bem::SolverError& error) {
      throw bem::SolverError(error.kind(), "touch \"" + touches[single.touch].name +
                                               "\" without the other touches: " + error.what());
    }
    addErrors(*study.model, single.state, part);
  }
  return study;
}

}  // namespace palpa::app
