#include "app/view/flat.h"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

namespace palpa::view {
namespace {

void addFlat(const std::vector<Eigen::Vector2d>& corners, bool filled, const Colour& colour,
             double width, double opacity, vtkRenderer* overlay) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(corners.size()));
  for (const Eigen::Vector2d& corner : corners) {
    cells->InsertCellPoint(points->InsertNextPoint(corner.x(), corner.y(), 0));
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  if (filled) {
    shape->SetPolys(cells);
  } else {
    shape->SetLines(cells);
  }
  vtkNew<vtkCoordinate> pixels;
  pixels->SetCoordinateSystemToDisplay();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shape);
  mapper->SetTransformCoordinate(pixels);
  mapper->TransformCoordinateUseDoubleOn();
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  actor->GetProperty()->SetOpacity(opacity);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  overlay->AddActor2D(actor);
}

}  // namespace

void addFlatLine(const std::vector<Eigen::Vector2d>& points, const Colour& colour, double width,
                 vtkRenderer* overlay) {
  addFlat(points, false, colour, width, 1, overlay);
}

void addFlatPolygon(const std::vector<Eigen::Vector2d>& points, const Colour& colour,
                    vtkRenderer* overlay) {
  addFlat(points, true, colour, 1, 1, overlay);
}

void addFlatRectangle(const Rectangle& r, const Colour& colour, vtkRenderer* overlay,
                      double opacity) {
  addFlat({{r.left, r.bottom}, {r.right, r.bottom}, {r.right, r.top}, {r.left, r.top}}, true,
          colour, 1, opacity, overlay);
}

}  // namespace palpa::view
