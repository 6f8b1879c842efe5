#include "bem/quadratic/border_coordinates.h"

#include <algorithm>
#include <cmath>

namespace palpa::bem {

using Eigen::ArrayXd;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

Vector3d barycentric(const Vector2d& at) {
  return {1 - at[0] - at[1], at[0], at[1]};
}

}  // namespace

double BorderCoordinates::root(const Vector2d& local) const {
  if (isPlain()) return 1;
  const double own = barycentric(local)[corner_];
  return kind_ == Kind::kEdge ? own : 1 - own;
}

Vector2d BorderCoordinates::geometric(const Vector2d& local) const {
  if (isPlain()) return local;
  const double s = root(local);
  Vector3d lambda = (kind_ == Kind::kEdge ? 1 + s : s) * barycentric(local);
  lambda[corner_] = kind_ == Kind::kEdge ? s * s : 1 - s * s;
  return lambda.tail<2>();
}

Matrix2d BorderCoordinates::derivative(const Vector2d& local) const {
  if (isPlain()) return Matrix2d::Identity();
  const double s = root(local), sign = kind_ == Kind::kEdge ? 1 : -1;
  const Vector3d mu = barycentric(local);
  Matrix2d result;
  for (int direction = 0; direction < 2; ++direction) {
    const Vector3d change = direction == 0 ? Vector3d(-1, 1, 0) : Vector3d(-1, 0, 1);
    const double ds = sign * change[corner_];
    Vector3d lambda = (kind_ == Kind::kEdge ? 1 + s : s) * change + ds * mu;
    lambda[corner_] = sign * 2 * s * ds;
    result.col(direction) = lambda.tail<2>();
  }
  return result;
}

void BorderCoordinates::map(const Eigen::Ref<const ArrayXd>& u, const Eigen::Ref<const ArrayXd>& v,
                            Mapped& mapped) const {
  ArrayXd& s = mapped.root;
  if (isPlain()) {
    mapped.u = u;
    mapped.v = v;
    s.setOnes(u.size());
    mapped.determinant.setOnes(u.size());
    return;
  }
  if (corner_ == 0)
    s = 1 - u - v;
  else
    s = corner_ == 1 ? u : v;
  // With the coordinates (mu_i, mu_corner) the matrix of derivatives is triangular.
  if (kind_ == Kind::kEdge) {
    mapped.u = (1 + s) * u;
    mapped.v = (1 + s) * v;
    mapped.determinant = 2 * s * (1 + s);
    if (corner_ > 0) (corner_ == 1 ? mapped.u : mapped.v) = s.square();
  } else {
    s = 1 - s;
    mapped.u = s * u;
    mapped.v = s * v;
    mapped.determinant = 2 * s.square();
    if (corner_ > 0) (corner_ == 1 ? mapped.u : mapped.v) = 1 - s.square();
  }
}

Vector2d BorderCoordinates::local(const Vector2d& geometric) const {
  if (isPlain()) return geometric;
  const Vector3d lambda = barycentric(geometric);
  const double own = lambda[corner_];
  const double s = std::sqrt(std::clamp(kind_ == Kind::kEdge ? own : 1 - own, 0.0, 1.0));
  if (kind_ == Kind::kVertex && s == 0) return geometric;
  Vector3d mu = lambda / (kind_ == Kind::kEdge ? 1 + s : s);
  mu[corner_] = kind_ == Kind::kEdge ? s : 1 - s;
  return mu.tail<2>();
}

Vector2d BorderCoordinates::awayFromBorder(const Vector2d& local, double least) const {
  const double s = root(local);
  if (s >= least) return local;
  Vector3d mu = barycentric(local);
  if (kind_ == Kind::kEdge) {
    mu *= (1 - least) / (1 - s);
    mu[corner_] = least;
  } else {
    mu = s > 0 ? Vector3d(least / s * mu) : Vector3d::Constant(least / 2);
    mu[corner_] = 1 - least;
  }
  return mu.tail<2>();
}

}  // namespace palpa::bem
