#pragma once

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "app/view/viewport_scene.h"

/// VTK's arrays from plain ones. Internal to app/view.
namespace palpa::view {

/// Copies the points (as float) into the array, which keeps its identity: what is drawn from it
/// follows without being made again.
void assign(const std::vector<Eigen::Vector3d>& from, vtkFloatArray* to);
void assign(const std::vector<Eigen::Vector3d>& from, vtkPoints* to);

vtkSmartPointer<vtkPoints> makeFloatPoints();

/// Each line once: neighbouring patches name their common border both, forwards or backwards, with
/// points of their own. Drawn twice, it would be stippled where the two cover different pixels.
std::vector<std::vector<int>> distinctLines(const std::vector<std::vector<int>>& lines,
                                            const std::vector<Eigen::Vector3d>& positions);

vtkSmartPointer<vtkCellArray> polylines(const std::vector<std::vector<int>>& lines);
vtkSmartPointer<vtkCellArray> segments(const std::vector<std::array<int, 2>>& lines);

/// Blends the actor in the order in which actors were added to the renderer. VTK's own way for
/// translucent ones costs two passes over the whole picture, as long as the rest of it takes to
/// draw in software; lines and handles need no sorting.
void blendInOrder(vtkActor* actor);

/// An unlit actor for lines of `points`, in front of surfaces that contain them, blended in order.
/// The width is set by the caller.
vtkSmartPointer<vtkActor> makeLineActor(vtkPoints* points, vtkCellArray* lines);

void setColour(vtkActor* actor, const Colour& colour);

/// The mixture (1 - t) a + t b.
Colour mixed(const Colour& a, const Colour& b, double t);

}  // namespace palpa::view
