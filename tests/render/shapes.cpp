#include "tests/render/shapes.h"

#include <algorithm>
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

Shape cylinder(double radius, double height, int around, int along) {
  Shape shape;
  PointCollector points(shape);
  const auto at = [&](double r, int i, double z) {
    const double angle = 2 * std::numbers::pi * i / around;
    return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z);
  };
  const int rings = std::max(1, along / 3);
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < along; ++k) {
      const double low = height * k / along;
      const double high = height * (k + 1) / along;
      points.quad(at(radius, i, low), at(radius, i + 1, low), at(radius, i + 1, high),
                  at(radius, i, high));
    }
    for (int k = 0; k < rings; ++k) {
      const double inner = radius * k / rings;
      const double outer = radius * (k + 1) / rings;
      points.quad(at(inner, i, height), at(outer, i, height), at(outer, i + 1, height),
                  at(inner, i + 1, height));
      points.quad(at(inner, i, 0), at(inner, i + 1, 0), at(outer, i + 1, 0), at(outer, i, 0));
    }
  }
  // The innermost ring's quads have collapsed to triangles.
  std::erase_if(shape.triangles, [](const view::Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
  return shape;
}

std::vector<int> trianglesWhere(const Shape& shape,
                                const std::function<bool(const Eigen::Vector3d&)>& inside) {
  std::vector<int> chosen;
  for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
    const view::Triangle& t = shape.triangles[i];
    const bool all = std::all_of(t.begin(), t.end(), [&](int corner) {
      return inside(shape.positions[static_cast<std::size_t>(corner)]);
    });
    if (all) chosen.push_back(static_cast<int>(i));
  }
  return chosen;
}

std::vector<Eigen::Vector3d> bump(const Shape& shape, const Eigen::Vector3d& center, double radius,
                                  const Eigen::Vector3d& peak) {
  std::vector<Eigen::Vector3d> values;
  for (const Eigen::Vector3d& p : shape.positions) {
    const double rho = (p - center).norm() / radius;
    const double weight = rho < 1 ? std::pow(1 - rho * rho, 2) : 0.0;
    values.push_back(weight * peak);
  }
  return values;
}

std::vector<double> norms(const std::vector<Eigen::Vector3d>& vectors) {
  std::vector<double> values;
  for (const Eigen::Vector3d& v : vectors) values.push_back(v.norm());
  return values;
}

}  // namespace palpa::render_tests
