#include "app/core/results/state_series.h"

#include <cmath>
#include <utility>

#include "app/core/results/touch.h"

namespace palpa::app {

modeling::MeshFile stateMesh(const TouchModel& model, const bem::BoundaryField& field) {
  const bem::BoundaryMesh& mesh = model.setup().mesh();
  const bem::BoundaryField onMesh = model.setup().discretisation->valuesOnMesh(field);
  modeling::MeshFile file{mesh.nodes, mesh.triangles, {}, {}};
  const auto u = onMesh.u.col(0);
  file.pointData.push_back({"displacement_mm", 3, {u.begin(), u.end()}});
  modeling::MeshData tractions{"traction_MPa", 3, {}};
  for (const auto& slots : model.setup().meshSlots().ofCorner) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const int slot : slots) mean += onMesh.p.col(0).segment<3>(3 * slot) / 3;
    tractions.values.insert(tractions.values.end(), mean.begin(), mean.end());
  }
  file.triangleData.push_back(std::move(tractions));
  return file;
}

void writeSweepSeries(const TouchModel& model, std::span<const SweepRow> rows, int steps,
                      const std::filesystem::path& collection, const Job& job) {
  modeling::MeshSeries series(collection);
  TouchPlayer player(model);
  Job quiet = job;
  quiet.progress = {};
  for (const SweepRow& row : rows) {
    job.throwIfCancelled();
    series.add(stateMesh(model, player.play(row.touches, steps, quiet).field), row.share);
    job.report(Phase::kTouch,
               static_cast<double>(series.size()) / static_cast<double>(rows.size()));
  }
  job.throwIfCancelled();
  series.commit();
}

ReplaySeries::ReplaySeries(std::shared_ptr<const TouchableModel> model, double rate,
                           const std::filesystem::path& collection)
    : field_(std::move(model)), rate_(rate), series_(collection) {}

void ReplaySeries::add(const TouchSnapshot& snapshot, std::uint64_t step) {
  constexpr double kStepsPerSecond = 1000;
  const auto due = static_cast<std::uint64_t>(
      std::llround(kStepsPerSecond * static_cast<double>(series_.size()) / rate_));
  if (step < due) return;
  series_.add(stateMesh(field_.model()->model(), field_.field(snapshot)),
              static_cast<double>(step) / kStepsPerSecond);
}

}  // namespace palpa::app
