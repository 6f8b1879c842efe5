#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "modeling/exchange/profile_fit.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;

/// End of an open path: its number, twice, plus one for the last point.
using End = std::size_t;

Vector2d placeOf(const std::vector<DrawnPath>& paths, End end) {
  const DrawnPath& path = paths[end / 2];
  return end % 2 == 0 ? path.start() : path.end();
}

/// Finds ends near a place by cells as large as the tolerance.
class Ends {
 public:
  Ends(const std::vector<DrawnPath>& paths, double tolerance)
      : paths_(paths), tolerance_(tolerance) {
    for (End end = 0; end < 2 * paths.size(); ++end)
      if (!paths[end / 2].closed) cells_.emplace(cellOf(placeOf(paths, end), 0, 0), end);
  }

  /// The one end that meets this one; the end itself if there is none or more than one.
  End partner(End end) const {
    const Vector2d place = placeOf(paths_, end);
    constexpr int kMaxCompared = 64;
    End found = end;
    int count = 0, compared = 0;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        const auto [from, to] = cells_.equal_range(cellOf(place, i, j));
        for (auto at = from; at != to && count < 2; ++at) {
          if (++compared > kMaxCompared) return end;  // too crowded to tell them apart
          if (at->second == end || (placeOf(paths_, at->second) - place).norm() > tolerance_)
            continue;
          found = at->second;
          ++count;
        }
      }
    return count == 1 ? found : end;
  }

 private:
  struct Cell {
    long long i, j;
    bool operator==(const Cell&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      return static_cast<std::size_t>(cell.i) * 0x9e3779b97f4a7c15ULL ^
             static_cast<std::size_t>(cell.j) * 0xc2b2ae3d27d4eb4fULL;
    }
  };

  Cell cellOf(const Vector2d& p, int i, int j) const {
    return {std::llround(p.x() / tolerance_) + i, std::llround(p.y() / tolerance_) + j};
  }

  const std::vector<DrawnPath>& paths_;
  double tolerance_;
  std::unordered_multimap<Cell, End, Hash> cells_;
};

void reverse(DrawnPath& path) {
  std::reverse(path.pieces.begin(), path.pieces.end());
  for (DrawnPiece& piece : path.pieces) std::reverse(piece.points.begin(), piece.points.end());
}

double area(const DrawnPath& path) {
  const auto [low, high] = boxOf(path);
  return (high - low).prod();
}

}  // namespace

std::vector<DrawnPath> joinedPaths(std::vector<DrawnPath> paths, double tolerance, const Job& job) {
  const Ends ends(paths, tolerance);
  // Only mutual partners join, so that three ends near one another stay apart.
  const auto partner = [&](End end) {
    const End other = ends.partner(end);
    return other != end && ends.partner(other) == end ? other : end;
  };
  std::vector<bool> isTaken(paths.size(), false);
  std::vector<DrawnPath> result;
  for (std::size_t first = 0; first < paths.size(); ++first) {
    job.throwIfCancelled();
    if (isTaken[first]) continue;
    if (paths[first].closed) {
      result.push_back(paths[first]);
      isTaken[first] = true;
      continue;
    }
    // Back to the beginning of the chain, or once around a closed one.
    End begin = 2 * first;
    for (End other = partner(begin); other != begin && other / 2 != first; other = partner(begin))
      begin = other ^ 1U;
    DrawnPath chain;
    for (End at = begin;;) {
      DrawnPath next = paths[at / 2];
      isTaken[at / 2] = true;
      if (at % 2 == 1) reverse(next);
      if (chain.pieces.empty()) {
        chain = std::move(next);
      } else {
        next.pieces.front().points[0] = chain.end();
        chain.pieces.insert(chain.pieces.end(), next.pieces.begin(), next.pieces.end());
      }
      const End last = at ^ 1U, other = partner(last);
      const bool isLine = chain.pieces.size() == 1 && chain.pieces.front().isStraight;
      if (other == begin && !isLine) {
        chain.closed = true;
        chain.pieces.back().points[3] = chain.start();
      }
      if (other == last || isTaken[other / 2]) break;
      at = other;
    }
    result.push_back(std::move(chain));
  }
  std::stable_sort(result.begin(), result.end(), [](const DrawnPath& a, const DrawnPath& b) {
    return a.closed != b.closed ? a.closed : area(a) > area(b);
  });
  return result;
}

}  // namespace palpa::modeling
