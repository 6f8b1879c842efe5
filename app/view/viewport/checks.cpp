#include "app/view/viewport/checks.h"

#include <stdexcept>
#include <string>

namespace palpa::view {
namespace {

void requirePolylines(const std::vector<std::vector<int>>& lines, int pointCount) {
  for (const std::vector<int>& line : lines) {
    for (const int point : line) {
      require(point >= 0 && point < pointCount, "a line names a point that does not exist");
    }
  }
}

}  // namespace

void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(std::string("viewport: ") + message);
}

void requireValidBody(const ViewportBody& body) {
  const int pointCount = static_cast<int>(body.positions.size());
  require(body.normals.size() == body.positions.size(), "normals need one entry per point");
  for (const Triangle& triangle : body.triangles) {
    for (const int corner : triangle) {
      require(corner >= 0 && corner < pointCount, "a triangle names a point that does not exist");
    }
  }
  requirePolylines(body.borders, pointCount);
  requirePolylines(body.knotLines, pointCount);
}

}  // namespace palpa::view
