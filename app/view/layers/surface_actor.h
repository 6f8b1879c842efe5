#pragma once

#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <optional>
#include <vector>

#include "app/view/layers/coarse_surface.h"
#include "app/view/layers/surface_shader.h"
#include "app/view/layers/vtk_arrays.h"
#include "app/view/scene/scene.h"
#include "app/view/scene/theme.h"

/// The body. Internal to app/view.
namespace palpa::view {

/// Surface, border and knot lines in a renderer. The actors live as long as this object; new shapes
/// are written into their arrays.
class SurfaceActor {
 public:
  explicit SurfaceActor(vtkRenderer* renderer);

  void setBody(const ViewportBody& body);
  void move(const std::vector<Eigen::Vector3d>& positions,
            const std::vector<Eigen::Vector3d>& normals);
  /// One per triangle of the body.
  void setMarks(const std::vector<Mark>& marks);
  /// Viewport::setRegions().
  void setRegions(const std::vector<double>& supports, const std::vector<double>& loads,
                  const std::vector<double>& conflict);
  /// Leaves out the surface where these numbers, one per point, are above zero. Empty: draws all.
  void setCut(const std::vector<double>& distances);
  /// Viewport::setField(); the range is required.
  void setField(const std::optional<ScalarField>& field);
  /// `range` not empty. Only where there is a field.
  void setFieldValues(const std::vector<double>& values, const std::array<double, 2>& range);
  /// Millimetres per logical pixel in the middle of the picture: how wide the hatching is.
  void setScale(double millimetresPerPixel);
  void setRegionsVisible(bool visible);
  /// Draws a large body with fewer triangles.
  void setCoarse(bool coarse);
  /// With these settings, if anything is visible.
  std::size_t drawnTriangles() const;
  /// Of everything; visible at first.
  void setVisible(bool visible);
  void setShading(Shading shading);
  void setTheme(const ViewportTheme& theme);
  void setPixelRatio(double ratio);

 private:
  void colourTriangles();
  void updateLines();
  void updateRegionLooks();
  void updateShader();
  void updateVisibility();

  vtkSmartPointer<vtkPoints> points_;
  vtkSmartPointer<vtkFloatArray> normals_;
  vtkSmartPointer<vtkUnsignedCharArray> colours_;  ///< RGBA of each triangle
  vtkSmartPointer<vtkFloatArray> regions_;  ///< support, load, place across the hatching, conflict
  vtkSmartPointer<vtkFloatArray> field_;    ///< places in the colours: placeInColours()
  vtkSmartPointer<vtkFloatArray> cut_;      ///< distances in front of the section, or empty
  vtkSmartPointer<vtkPolyData> surface_;
  CoarseSurface coarse_;
  vtkSmartPointer<vtkActor> body_, coarseBody_, borders_, knotLines_;
  std::vector<double> supportField_, loadField_, conflictField_;
  std::vector<Mark> marks_;
  bool anyMark_ = false;
  bool isCut_ = false;
  bool regionsVisible_ = true;
  bool isVisible_ = true;
  bool isCoarse_ = false;
  vtkMTimeType coarseLook_ = 0;
  double scale_ = 1;
  std::optional<ScalarField::Colours> fieldColours_;
  bool isLogarithmic_ = false;
  std::optional<SurfaceLook> look_;  ///< which variant the shader is
  Shading shading_ = Shading::kShadedWithEdges;
  ViewportTheme theme_ = ViewportTheme::light();
  double pixelRatio_ = 1;
};

}  // namespace palpa::view
