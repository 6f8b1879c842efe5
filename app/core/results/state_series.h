#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "app/core/live/touch_field.h"
#include "app/core/live/touch_snapshot.h"
#include "app/core/model/touch_model.h"
#include "app/core/results/touch_sweep.h"
#include "base/job.h"
#include "modeling/exchange/mesh_series.h"

// States as meshes with data: single ones, and over time for ParaView.
namespace palpa::app {

/// The mesh of a model at rest with a field: "displacement_mm" at the nodes and "traction_MPa" of
/// the triangles, as their mean, because the traction jumps across edges.
modeling::MeshFile stateMesh(const TouchModel& model, const bem::BoundaryField& field);

/// Writes the states of a sweep as a series of stateMesh(); the time is the share. Plays their
/// touches again. `steps`: of TouchPlayer::play(). Phase of progress: "touch". Throws as
/// TouchPlayer::play() and modeling::MeshSeries; Cancelled.
void writeSweepSeries(const TouchModel& model, std::span<const SweepRow> rows, int steps,
                      const std::filesystem::path& collection, const Job& job);

/// Writes a replay as a series of stateMesh(), `rate` pictures per second of the recording. Throws
/// as modeling::MeshSeries.
class ReplaySeries {
 public:
  static constexpr double kMinRate = 1, kMaxRate = 1000, kUsualRate = 30;

  /// `rate`: kMinRate … kMaxRate.
  ReplaySeries(std::shared_ptr<const TouchableModel> model, double rate,
               const std::filesystem::path& collection);

  /// The snapshot after a step of 1 ms, from 0, in their order; writes it if it is its turn, with
  /// the time in seconds.
  void add(const TouchSnapshot& snapshot, std::uint64_t step);
  std::size_t size() const { return series_.size(); }
  void commit() { series_.commit(); }

 private:
  TouchField field_;
  double rate_;
  modeling::MeshSeries series_;
};

}  // namespace palpa::app
