#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "app/view/scene/theme.h"
#include "app/view/viewport/viewport.h"

/// Pictures of a touched body as PNG files: the viewport without a window. Not thread-safe: VTK
/// draws from one thread at a time.
namespace palpa::view {

/// Content of a picture.
struct Picture {
  ViewportBody body;  ///< at rest
  /// Of the displaced body, one per point; empty: at rest.
  std::vector<Eigen::Vector3d> positions, normals;
  std::vector<double> supports;  ///< as Viewport::setRegions() takes them
  /// Without a range the colours reach from the smallest to the largest value.
  std::optional<ScalarField> field;
  /// Cut at rest, with the face where it is drawn.
  std::optional<SectionDrawing> section;
  std::vector<double> sectionValues;  ///< of the field, one per point of the face; may be empty
  std::vector<SampleLabel> samples;
  std::vector<Dimension> dimensions;
  bool hasGhost = false;  ///< the body at rest is shown as a ghost
  LiveArrows arrows;
  GradientDrawing gradient;
  std::vector<ContactRing> rings;
  std::vector<Ball> balls;
  Caption caption;
  CameraView camera;
  /// Points that the picture has room for besides its own content, mm: for other pictures of the
  /// same film.
  std::vector<Eigen::Vector3d> room;
  ViewportTheme theme = ViewportTheme::light();
};

/// Pixels. Words, lines and margins grow with the picture.
struct PictureSize {
  int width = 1200;  ///< 160 … 8192
  int height = 900;  ///< 120 … 8192
};

/// Sets up a viewport for the picture. Throws std::invalid_argument, as the viewport's functions.
void show(const Picture& picture, Viewport& viewport);

/// Draws the picture and writes it as a PNG file, replacing an existing one.
///
/// Needs an X display (a virtual one will do); the result does not depend on the screen's size.
/// Throws std::invalid_argument for a malformed picture or size, NoDisplayError without a display,
/// ViewError if the file cannot be written.
void writePicture(const Picture& picture, const PictureSize& size,
                  const std::filesystem::path& path);

/// The same as the bytes of a PNG file, drawn in a window of the caller, which is resized and whose
/// OpenGL context must be current; null: in a window off the screen, which needs a display.
std::string pictureBytes(const Picture& picture, const PictureSize& size,
                         vtkRenderWindow* window = nullptr);

/// Pictures of `size` each, at least one, side by side in one PNG file.
std::string pictureBytes(std::span<const Picture> pictures, const PictureSize& size);

}  // namespace palpa::view
