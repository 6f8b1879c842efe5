#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>

#include <optional>

#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// Colours of the surface. Internal to app/view.
namespace palpa::view {

/// Variant of the shader: colours that are not shown are not computed.
struct SurfaceLook {
  bool isWire = false;
  bool anySupport = false;
  bool anyLoad = false;
  bool anyConflict = false;
  bool anyMark = false;
  bool isCut = false;  ///< the part in front of a section is left out
  std::optional<ScalarField::Colours> field;

  bool operator==(const SurfaceLook&) const = default;
};

/// Share of SurfaceUniforms::edge in the strokes of supports.
inline double strokeStrength(bool hasField) {
  return hasField ? 0.45 : 0.30;
}

/// The numbers the shader needs.
struct SurfaceUniforms {
  double hatchStep = 1;  ///< mm between the strokes of the hatching
  double lineScale = 1;  ///< device pixels per logical pixel
  double ambient = 0, diffuse = 0;
  double tintOpacity = 0;  ///< in the wire picture
  Colour support{}, load{}, conflict{}, body{}, edge{};
};

/// The number in the point array "field" for a share of the way from the lowest value of the
/// colours to the highest: of any size, or NaN, which has no colour.
float placeInColours(double share);

/// An actor for triangles that have colours and the arrays that applyShader() needs.
vtkSmartPointer<vtkActor> makeSurfaceActor(vtkPolyData* surface);

/// Gives an actor a copy of a property that shows both sides: where clusters fold a coarse surface,
/// its other side closes the gaps. `copied`: time of the property that the actor has.
void showBothSides(vtkProperty* property, vtkActor* actor, vtkMTimeType& copied);

/// The actor's mapper has the point arrays "regions" (support, load, place across the hatching,
/// conflict) and
/// "field", and "cut" for a look that is cut: nothing is drawn where it is above zero.
void applyShader(const SurfaceLook& look, vtkActor* surface);
/// Lines on the surface in the colours of the field, or plain.
void applyLineShader(const std::optional<ScalarField::Colours>& field, bool isCut, vtkActor* lines);
void setUniforms(const SurfaceUniforms& numbers, vtkActor* actor);

}  // namespace palpa::view
