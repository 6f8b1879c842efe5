#pragma once

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// VTK's arrays from plain ones. Internal to app/view.
namespace palpa::view {

/// Copies the points (as float) into the array, which keeps its identity: its actors follow
/// without being created again.
void assign(const std::vector<Eigen::Vector3d>& from, vtkFloatArray* to);
void assign(const std::vector<Eigen::Vector3d>& from, vtkPoints* to);

vtkSmartPointer<vtkPoints> makeFloatPoints();

/// Each line once: two neighbouring patches list their common border, forwards or backwards, with
/// separate points. Drawn twice, it would be stippled where the two cover different pixels.
/// Lines that continue each other are joined.
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
/// Replaces the lines of such an actor; without lines it is hidden.
void showLines(vtkActor* actor, const std::vector<std::vector<int>>& lines);

void setColour(vtkActor* actor, const Colour& colour);

}  // namespace palpa::view
