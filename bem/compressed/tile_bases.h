#pragma once

#include <Eigen/Dense>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "base/job.h"
#include "bem/base/team.h"
#include "bem/compressed/low_rank_tile.h"

namespace palpa::bem {

/// The tiles of a matrix of which each member of a team makes a summand, brought to the member that
/// uses them. Alone, tiles are made when they are taken.
class TileBases {
 public:
  /// Makes tile (row, column), or one without numbers for zero; several threads.
  using MakeTile = std::function<LowRankTile(int row, int column)>;

  /// `sizes`: rows of each tile. All references must outlive the object.
  TileBases(const std::vector<int>& sizes, const MakeTile& makeTile, const Team* team)
      : sizes_(sizes), makeTile_(makeTile), team_(team) {}

  /// True if this member works for row and column `index` of tiles.
  bool isOurs(int index) const { return !team_ || index % team_->count() == team_->index(); }

  struct Place {
    int row, column;
    int owner;  ///< index % count(), or kAll
  };
  static constexpr int kAll = -1;
  /// Makes tiles ready to be taken by their owners; collective. Throws Cancelled.
  void collect(const std::vector<Place>& places, const Job& job);
  /// The tiles of step k of a factorisation: the diagonal for all, row and column for those whose
  /// they are.
  void collectStep(int k, const Job& job);
  /// The tile, once after collect(). Several threads.
  LowRankTile take(int row, int column);

 private:
  void append(const Place& place, const Eigen::MatrixXf& tile, Team::Bytes& to) const;
  void addFrom(const Team::Bytes& bytes);

  const std::vector<int>& sizes_;
  const MakeTile& makeTile_;
  const Team* const team_;
  std::map<std::pair<int, int>, Eigen::MatrixXf> ready_;
};

}  // namespace palpa::bem
