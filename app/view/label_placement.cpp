#include "app/view/label_placement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpa::view {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A label of `size` whose centre lies in direction `d` and whose border is `gap` from the anchor.
Rectangle beside(const Eigen::Vector2d& anchor, const Eigen::Vector2d& d, double gap,
                 const Eigen::Vector2d& size) {
  // Support function of the box: how far its border is from its centre, along d.
  const double reach = 0.5 * (std::abs(d.x()) * size.x() + std::abs(d.y()) * size.y());
  const Eigen::Vector2d center = anchor + (gap + reach) * d;
  return {center.x() - size.x() / 2, center.y() - size.y() / 2, center.x() + size.x() / 2,
          center.y() + size.y() / 2};
}

Rectangle movedInside(Rectangle r, const Rectangle& bounds) {
  const double dx = std::max(bounds.left - r.left, 0.0) - std::max(r.right - bounds.right, 0.0);
  const double dy = std::max(bounds.bottom - r.bottom, 0.0) - std::max(r.top - bounds.top, 0.0);
  return {r.left + dx, r.bottom + dy, r.right + dx, r.top + dy};
}

}  // namespace

Occupancy::Occupancy(int width, int height, double cell)
    : cell_(cell),
      columns_(std::max(1, static_cast<int>(std::ceil(width / cell)))),
      rows_(std::max(1, static_cast<int>(std::ceil(height / cell)))),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
             Cover::kNothing) {}

void Occupancy::mark(int column, int row, Cover cover) {
  if (column < 0 || column >= columns_ || row < 0 || row >= rows_) return;
  Cover& cell = cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)];
  cell = std::max(cell, cover);
}

void Occupancy::addTriangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                            const Eigen::Vector2d& c, Cover cover) {
  addSegment(a, b, cover);
  addSegment(b, c, cover);
  addSegment(c, a, cover);
  const Eigen::Vector2d low = a.cwiseMin(b).cwiseMin(c) / cell_;
  const Eigen::Vector2d high = a.cwiseMax(b).cwiseMax(c) / cell_;
  const double area = cross(b - a, c - a);
  if (area == 0) return;
  const int lastRow = std::min(rows_ - 1, static_cast<int>(high.y()));
  const int lastColumn = std::min(columns_ - 1, static_cast<int>(high.x()));
  for (int row = std::max(0, static_cast<int>(low.y())); row <= lastRow; ++row) {
    for (int column = std::max(0, static_cast<int>(low.x())); column <= lastColumn; ++column) {
      const Eigen::Vector2d p(cell_ * (column + 0.5), cell_ * (row + 0.5));
      const bool inside = cross(b - a, p - a) / area >= 0 && cross(c - b, p - b) / area >= 0 &&
                          cross(a - c, p - c) / area >= 0;
      if (inside) mark(column, row, cover);
    }
  }
}

void Occupancy::addSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b, Cover cover) {
  const int steps = 1 + std::min(10000, static_cast<int>(2 * (b - a).norm() / cell_));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p = a + (b - a) * (static_cast<double>(i) / steps);
    mark(static_cast<int>(std::floor(p.x() / cell_)), static_cast<int>(std::floor(p.y() / cell_)),
         cover);
  }
}

void Occupancy::addRectangle(const Rectangle& r, Cover cover) {
  for (int row = static_cast<int>(r.bottom / cell_); row <= static_cast<int>(r.top / cell_);
       ++row) {
    for (int column = static_cast<int>(r.left / cell_); column <= static_cast<int>(r.right / cell_);
         ++column) {
      mark(column, row, cover);
    }
  }
}

double Occupancy::meanCover(const Rectangle& r) const {
  int sum = 0;
  int all = 0;
  const int lastRow = std::min(rows_ - 1, static_cast<int>(r.top / cell_));
  const int lastColumn = std::min(columns_ - 1, static_cast<int>(r.right / cell_));
  for (int row = std::max(0, static_cast<int>(r.bottom / cell_)); row <= lastRow; ++row) {
    for (int column = std::max(0, static_cast<int>(r.left / cell_)); column <= lastColumn;
         ++column) {
      ++all;
      sum += static_cast<int>(
          cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)]);
    }
  }
  return all == 0 ? 0.0 : static_cast<double>(sum) / all;
}

Rectangle placeLabel(const LabelWish& wish, const Rectangle& bounds, const Occupancy& occupancy) {
  constexpr int kDirections = 16;
  const double start =
      wish.towards.norm() > 0 ? std::atan2(wish.towards.y(), wish.towards.x()) : 0.0;
  Rectangle best{};
  double leastCost = std::numeric_limits<double>::infinity();
  for (const double distance : {1.0, 2.5, 5.0, 9.0, 14.0}) {
    for (int i = 0; i < kDirections; ++i) {
      // 0, +1, -1, +2, … sixteenths of a turn away from the wished direction.
      const double turn = (i + 1) / 2 * (i % 2 ? 1 : -1) * 2 * std::numbers::pi / kDirections;
      const Eigen::Vector2d direction(std::cos(start + turn), std::sin(start + turn));
      const Rectangle wished = beside(wish.anchor, direction, distance * wish.gap, wish.size);
      const Rectangle candidate = movedInside(wished, bounds);
      const double shifted =
          std::hypot(candidate.left - wished.left, candidate.bottom - wished.bottom);
      // Covering another label is worst, then being far away, then covering the body.
      const double cost = 6 * occupancy.meanCover(candidate) + distance + 0.7 * std::abs(turn) +
                          3 * shifted / std::max(wish.gap, 1.0);
      if (cost < leastCost) {
        leastCost = cost;
        best = candidate;
      }
    }
  }
  return best;
}

}  // namespace palpa::view
