#include "app/view/layers/flat_shapes.h"

#include <vtkActor2D.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper2D.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpa::view {

FlatShapes::FlatShapes(vtkRenderer* overlay)
    : points_(makeFloatPoints()),
      colours_(vtkSmartPointer<vtkUnsignedCharArray>::New()),
      data_(vtkSmartPointer<vtkPolyData>::New()) {
  colours_->SetNumberOfComponents(4);
  data_->SetPoints(points_);
  data_->GetCellData()->SetScalars(colours_);
  vtkNew<vtkCoordinate> pixels;
  pixels->SetCoordinateSystemToDisplay();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data_);
  mapper->SetScalarModeToUseCellData();
  mapper->SetTransformCoordinate(pixels);
  mapper->TransformCoordinateUseDoubleOn();
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  overlay->AddActor2D(actor);
}

void FlatShapes::clear(int height) {
  height_ = height;
  points_->Reset();
  colours_->Reset();
  data_->SetPolys(vtkSmartPointer<vtkCellArray>::New());
}

void FlatShapes::addPolygon(const std::vector<Eigen::Vector2d>& corners, const Colour& colour,
                            double opacity) {
  data_->GetPolys()->InsertNextCell(static_cast<int>(corners.size()));
  for (const Eigen::Vector2d& corner : corners) {
    data_->GetPolys()->InsertCellPoint(
        points_->InsertNextPoint(corner.x(), height_ - corner.y(), 0));
  }
  for (const double value : {colour[0], colour[1], colour[2], opacity}) {
    colours_->InsertNextValue(static_cast<unsigned char>(std::lround(255 * value)));
  }
}

void FlatShapes::addLine(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width,
                         const Colour& colour, double opacity) {
  const Eigen::Vector2d along = b - a;
  if (along.norm() == 0) return;
  const Eigen::Vector2d across =
      0.5 * width * Eigen::Vector2d(-along.y(), along.x()) / along.norm();
  addPolygon({a + across, a - across, b - across, b + across}, colour, opacity);
}

void FlatShapes::addDisc(const Eigen::Vector2d& center, double radius, const Colour& colour,
                         double opacity) {
  constexpr int kCorners = 24;
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    corners.push_back(center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  addPolygon(corners, colour, opacity);
}

void FlatShapes::addRectangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                              const Colour& colour, double opacity) {
  addPolygon({a, {b.x(), a.y()}, b, {a.x(), b.y()}}, colour, opacity);
}

void FlatShapes::addFrame(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width,
                          const Colour& colour, double opacity) {
  const Eigen::Vector2d low = a.cwiseMin(b);
  const Eigen::Vector2d high = a.cwiseMax(b);
  addRectangle(low, {high.x(), low.y() + width}, colour, opacity);
  addRectangle({low.x(), high.y() - width}, high, colour, opacity);
  addRectangle({low.x(), low.y() + width}, {low.x() + width, high.y() - width}, colour, opacity);
  addRectangle({high.x() - width, low.y() + width}, {high.x(), high.y() - width}, colour, opacity);
}

void FlatShapes::addPlate(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                          const Colour& frame, const ViewportTheme& theme, double pixelRatio,
                          double frameOpacity) {
  addRectangle(low, high, mixed(theme.backgroundTop, theme.body, 0.05), 0.90);
  addFrame(low, high, std::max(1.0, std::round(pixelRatio)), frame, frameOpacity);
}

void FlatShapes::finish() {
  points_->Modified();
  colours_->Modified();
  data_->Modified();
}

}  // namespace palpa::view
