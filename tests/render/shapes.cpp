#include "tests/render/shapes.h"

#include <cmath>
#include <map>
#include <numbers>

namespace palpa::render_tests {
namespace {

/// Gives points at the same place the same number.
class PointCollector {
 public:
  explicit PointCollector(Shape& shape) : shape_(shape) {}

  int add(const Eigen::Vector3d& p) {
    const auto key = std::array<long, 3>{std::lround(p.x() * 1e6), std::lround(p.y() * 1e6),
                                         std::lround(p.z() * 1e6)};
    const auto [entry, isNew] =
        numbers_.try_emplace(key, static_cast<int>(shape_.positions.size()));
    if (isNew) shape_.positions.push_back(p);
    return entry->second;
  }

  void quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
            const Eigen::Vector3d& d) {
    const int i = add(a), j = add(b), k = add(c), l = add(d);
    shape_.triangles.push_back({i, j, k});
    shape_.triangles.push_back({i, k, l});
  }

 private:
  Shape& shape_;
  std::map<std::array<long, 3>, int> numbers_;
};

/// The cube [-1, 1]³ with n × n squares on each face, mapped by `map`.
Shape mappedCube(int n, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& map) {
  Shape shape;
  PointCollector points(shape);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](int i, int j) {
        Eigen::Vector3d p;
        p[axis] = side;
        p[(axis + 1) % 3] = -1 + 2.0 * i / n;
        p[(axis + 2) % 3] = -1 + 2.0 * j / n;
        return map(p);
      };
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          if (side > 0) {
            points.quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
          } else {
            points.quad(corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j));
          }
        }
      }
    }
  }
  return shape;
}

}  // namespace

Shape sphere(double radius, int n) {
  return mappedCube(n, [radius](const Eigen::Vector3d& p) {
    // Equal angles instead of equal steps keep the triangles even.
    const Eigen::Vector3d even = (p.array() * std::numbers::pi / 4).tan();
    return Eigen::Vector3d(radius * even.normalized());
  });
}

Shape box(const Eigen::Vector3d& size, int n) {
  return mappedCube(n, [size](const Eigen::Vector3d& p) {
    const Eigen::Vector3d centred = 0.5 * size.cwiseProduct(p);
    return Eigen::Vector3d(centred + Eigen::Vector3d(0, 0, 0.5 * size.z()));
  });
}

}  // namespace palpa::render_tests
