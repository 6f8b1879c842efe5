#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/job.h"

namespace palpa::modeling {

/// Content of a mesh file: points and polygons without guaranteed topology.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;  ///< in the file's unit
  std::vector<int> corners;             ///< of all polygons, one after the other; valid indices
  std::vector<int> ends;                ///< per polygon, end of its corners in `corners`
  std::vector<int> groups;              ///< per polygon; empty if there is only one group
  std::vector<std::string> groupNames;  ///< as in the file, distinct

  int polygonCount() const { return static_cast<int>(ends.size()); }
  std::span<const int> polygon(int i) const {
    const int begin = i == 0 ? 0 : ends[i - 1];
    return std::span(corners).subspan(begin, ends[i] - begin);
  }
  /// Ends the polygon whose corners were added last. Throws ModelingError if limits are exceeded.
  void closePolygon();
};

/// Parsers of the three formats. Memory stays below a small multiple of the size of `bytes` for any
/// content. They throw ModelingError (without the file's name) if the content is malformed;
/// Cancelled.
PolygonSoup parseStl(std::string_view bytes, const Job& job);
PolygonSoup parseObj(std::string_view bytes, const Job& job);
PolygonSoup parsePly(std::string_view bytes, const Job& job);

}  // namespace palpa::modeling
