#include "modeling/project/point_selection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/project/field_check.h"
#include "modeling/solid/solid_check.h"

namespace palpa::modeling {
namespace {

using Marks = std::vector<char>;  // one per control point

class Selector {
 public:
  explicit Selector(const Solid& solid) : solid_(solid) {}

  Marks marks(const PointSelection& selection, const std::string& path) const {
    Marks result(solid_.controlPoints().size(), 0);
    for (std::size_t i = 0; i < selection.parts.size(); ++i) {
      const std::string partPath =
          selection.parts.size() == 1 ? path : path + "[" + std::to_string(i) + "]";
      std::visit([&](const auto& part) { add(part, partPath, result); }, selection.parts[i]);
    }
    return result;
  }

 private:
  void add(const PointIndices& part, const std::string& path, Marks& marks) const {
    for (std::size_t k = 0; k < part.indices.size(); ++k) {
      const int index = part.indices[k];
      if (index < 0 || static_cast<std::size_t>(index) >= marks.size())
        throw ModelingError(path + "[" + std::to_string(k) + "]: control point " +
                            std::to_string(index) + " does not exist; the solid has " +
                            std::to_string(marks.size()) + " (0 … " +
                            std::to_string(marks.size() - 1) + ")");
      marks[index] = 1;
    }
  }

  void add(const PatchPoints& part, const std::string& path, Marks& marks) const {
    for (std::size_t k = 0; k < part.patches.size(); ++k) {
      const int found =
          requirePatch(solid_, part.patches[k], path + ".patches[" + std::to_string(k) + "]");
      for (const auto& row : solid_.patches()[found].net)
        for (int index : row) marks[index] = 1;
    }
  }

  void add(const SidePoints& part, const std::string& path, Marks& marks) const {
    const int found = requirePatch(solid_, part.patch, path + ".edge.patch");
    for (int index : sideIndices(solid_.patches()[found], part.side)) marks[index] = 1;
  }

  void add(const NetPoints& part, const std::string& path, Marks& marks) const {
    const int found = requirePatch(solid_, part.patch, path + ".net.patch");
    const auto& net = solid_.patches()[found].net;
    const std::array<int, 2> sizes{static_cast<int>(net.size()),
                                   static_cast<int>(net.front().size())};
    std::array<int, 2> first{0, 0};
    std::array<int, 2> last{sizes[0] - 1, sizes[1] - 1};
    for (int direction = 0; direction < 2; ++direction) {
      if (!part.at[direction]) continue;
      const int row = *part.at[direction];
      const int size = sizes[direction];
      if (row < -size || row >= size)
        throw ModelingError(path + ".net.row[" + std::to_string(direction) + "]: row " +
                            std::to_string(row) + " does not exist; the net of \"" + part.patch +
                            "\" has " + std::to_string(size) + " rows along " +
                            (direction == 0 ? "u" : "v") + " (0 … " + std::to_string(size - 1) +
                            ", or -1 … " + std::to_string(-size) + " from the end)");
      first[direction] = last[direction] = row < 0 ? row + size : row;
    }
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j) marks[net[i][j]] = 1;
  }

  void add(const SlabPoints& part, const std::string& path, Marks& marks) const {
    requireDirection(part.normal, path + ".half_space.normal");
    if (part.above) requireFinite(*part.above, path + ".half_space.above_mm");
    if (part.below) requireFinite(*part.below, path + ".half_space.below_mm");
    where(marks, [&](const Eigen::Vector3d& x) {
      const double height = part.normal.dot(x);
      return (!part.above || height > *part.above) && (!part.below || height < *part.below);
    });
  }

  void add(const BoxPoints& part, const std::string& path, Marks& marks) const {
    requireFinite(part.low, path + ".box_mm[0]");
    requireFinite(part.high, path + ".box_mm[1]");
    where(marks, [&](const Eigen::Vector3d& x) {
      return (x.array() >= part.low.array()).all() && (x.array() <= part.high.array()).all();
    });
  }

  void add(const BallPoints& part, const std::string& path, Marks& marks) const {
    requireFinite(part.center, path + ".sphere_mm.center");
    requirePositive(part.radius, path + ".sphere_mm.radius");
    where(marks, [&](const Eigen::Vector3d& x) { return (x - part.center).norm() <= part.radius; });
  }

  void add(const AllOf& part, const std::string& path, Marks& result) const {
    Marks all(result.size(), 1);
    for (std::size_t k = 0; k < part.selections.size(); ++k) {
      const Marks one = marks(part.selections[k], path + ".all_of[" + std::to_string(k) + "]");
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] && one[i];
    }
    for (std::size_t i = 0; i < all.size(); ++i) result[i] = result[i] || all[i];
  }

  void add(const NoneOf& part, const std::string& path, Marks& result) const {
    Marks any(result.size(), 0);
    for (std::size_t k = 0; k < part.selections.size(); ++k) {
      const Marks one = marks(part.selections[k], path + ".none_of[" + std::to_string(k) + "]");
      for (std::size_t i = 0; i < any.size(); ++i) any[i] = any[i] || one[i];
    }
    for (std::size_t i = 0; i < any.size(); ++i) result[i] = result[i] || !any[i];
  }

  template <class Contains>
  void where(Marks& marks, Contains contains) const {
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (contains(solid_.controlPoints()[i])) marks[i] = 1;
  }

  const Solid& solid_;
};

}  // namespace

std::vector<int> selectPoints(const PointSelection& selection, const Solid& solid,
                              const std::string& path) {
  Marks marks = Selector(solid).marks(selection, path);
  std::vector<int> points;
  const bool listed =
      selection.parts.size() == 1 && std::holds_alternative<PointIndices>(selection.parts.front());
  if (listed) {
    for (int index : std::get<PointIndices>(selection.parts.front()).indices)
      if (std::exchange(marks[index], 0)) points.push_back(index);
  } else {
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (marks[i]) points.push_back(static_cast<int>(i));
  }
  if (points.empty()) throw ModelingError(path + ": no control point is selected");
  return points;
}

}  // namespace palpa::modeling
