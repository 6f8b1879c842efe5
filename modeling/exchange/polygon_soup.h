#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/job.h"

namespace palpa::modeling {

/// What a mesh file holds: points and polygons that need not fit together.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;  ///< in the file's unit
  std::vector<int> corners;             ///< of all polygons, one after the other; checked indices
  std::vector<int> ends;                ///< per polygon, where it ends in `corners`
  std::vector<int> groups;              ///< per polygon; empty when there is one group only
  std::vector<std::string> groupNames;  ///< as in the file, distinct

  int polygonCount() const { return static_cast<int>(ends.size()); }
  std::span<const int> polygon(int i) const {
    const int begin = i == 0 ? 0 : ends[i - 1];
    return std::span(corners).subspan(begin, ends[i] - begin);
  }
  /// Ends the polygon whose corners were added last. @throws ModelingError beyond the limits
  void closePolygon();
};

/// The three formats. Memory stays below a small multiple of the size of `bytes`, whatever they
/// say.
/// @throws ModelingError without the file's name
PolygonSoup parseStl(std::string_view bytes, const Job& job);
PolygonSoup parseObj(std::string_view bytes, const Job& job);
PolygonSoup parsePly(std::string_view bytes, const Job& job);

}  // namespace palpa::modeling
