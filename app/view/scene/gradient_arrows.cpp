#include "app/view/scene/gradient_arrows.h"

#include <algorithm>

namespace palpa::view {

std::vector<int> pointsWithArrows(const Eigen::Matrix3Xd& gradient) {
  std::vector<int> points;
  if (gradient.cols() == 0) return points;
  const double largest = gradient.colwise().norm().maxCoeff();
  if (!(largest > 0)) return points;
  for (Eigen::Index k = 0; k < gradient.cols(); ++k)
    if (gradient.col(k).norm() >= kMinGradientShare * largest)
      points.push_back(static_cast<int>(k));
  return points;
}

LiveArrows gradientArrows(const Eigen::Matrix3Xd& gradient, std::span<const Eigen::Vector3d> places,
                          const std::function<std::string(double)>& label) {
  LiveArrows arrows;
  const std::vector<int> points = pointsWithArrows(gradient);
  for (const int point : points)
    arrows.arrows.push_back({places[static_cast<std::size_t>(point)],
                             gradient.col(point),
                             ForceArrow::Anchor::kTail,
                             ForceArrow::Role::kGradient,
                             {}});
  if (points.empty()) return arrows;
  std::vector<ForceArrow*> order;
  for (ForceArrow& arrow : arrows.arrows) order.push_back(&arrow);
  const std::size_t labelled = std::min(kGradientLabels, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(labelled),
                    order.end(), [](const ForceArrow* a, const ForceArrow* b) {
                      return a->force.squaredNorm() > b->force.squaredNorm();
                    });
  arrows.fullForce = order.front()->force.norm();
  for (std::size_t k = 0; k < labelled; ++k) order[k]->label = label(order[k]->force.norm());
  return arrows;
}

}  // namespace palpa::view
