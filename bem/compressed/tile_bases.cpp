#include "bem/compressed/tile_bases.h"

#include <array>
#include <cstring>

#include "base/parallel.h"
#include "bem/base/team_data.h"

namespace palpa::bem {

using Eigen::MatrixXf;

void TileBases::append(const Place& place, const MatrixXf& tile, Team::Bytes& to) const {
  const std::array<int, 2> where{place.row, place.column};
  appendValues(where.data(), where.size(), to);
  appendValues(tile.data(), static_cast<std::size_t>(tile.size()), to);
}

void TileBases::addFrom(const Team::Bytes& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    std::array<int, 2> where{};
    std::memcpy(where.data(), bytes.data() + at, sizeof where);
    at += sizeof where;
    MatrixXf part(sizes_[where[0]], sizes_[where[1]]);
    const auto size = static_cast<std::size_t>(part.size()) * sizeof(float);
    std::memcpy(part.data(), bytes.data() + at, size);
    at += size;
    MatrixXf& sum = ready_[{where[0], where[1]}];
    if (sum.size() == 0)
      sum = std::move(part);
    else
      sum += part;
  }
}

void TileBases::collect(const std::vector<Place>& places, const Job& job) {
  if (!team_) return;
  std::vector<MatrixXf> made(places.size());
  parallelFor(static_cast<std::ptrdiff_t>(places.size()), job, [&](std::ptrdiff_t k) {
    LowRankTile tile = makeTile_(places[k].row, places[k].column);
    if (!tile.isZero()) made[k] = toDense(std::move(tile));
  });
  std::vector<Team::Bytes> to(static_cast<std::size_t>(team_->count()));
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (made[k].size() == 0) continue;
    for (int m = 0; m < team_->count(); ++m)
      if (places[k].owner == kAll || places[k].owner == m) append(places[k], made[k], to[m]);
    made[k].resize(0, 0);
  }
  ready_.clear();
  // In the order of the members, so that all get the same sums.
  for (const Team::Bytes& bytes : team_->exchange(to)) addFrom(bytes);
}

void TileBases::collectStep(int k, const Job& job) {
  if (!team_) return;
  std::vector<Place> places{{k, k, kAll}};
  for (int other = k + 1; other < static_cast<int>(sizes_.size()); ++other) {
    places.push_back({other, k, other % team_->count()});
    places.push_back({k, other, other % team_->count()});
  }
  collect(places, job);
}

LowRankTile TileBases::take(int row, int column) {
  if (!team_) return makeTile_(row, column);
  const auto found = ready_.find({row, column});
  if (found == ready_.end() || found->second.size() == 0)
    return {MatrixXf::Zero(sizes_[row], sizes_[column]), {}};
  return {std::move(found->second), {}};
}

}  // namespace palpa::bem
