#include "app/view/viewport/picture.h"

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "app/view/files/display.h"
#include "app/view/files/errors.h"
#include "app/view/files/png.h"
#include "app/view/scene/colour_map.h"
#include "base/atomic_file.h"

namespace palpa::view {
namespace {

/// Everything is drawn this many times larger and averaged down: smooth edges, lines and words on
/// every driver, whatever its multisampling does.
constexpr int kSupersampling = 2;

/// Device pixels per logical pixel, of the picture that is written. Small pictures keep readable
/// words; large ones grow them.
double pixelRatioOf(const PictureSize& size) {
  constexpr double kMaxRatio = 8;
  const double scale = std::min(size.width / 1200.0, size.height / 900.0);
  return std::clamp(1.5 * scale, 0.85, kMaxRatio);
}

void requireSize(const PictureSize& size) {
  const bool isValid =
      size.width >= 160 && size.width <= 8192 && size.height >= 120 && size.height <= 8192;
  if (!isValid) throw std::invalid_argument("a picture is 160x120 to 8192x8192 pixels large");
}

/// With its range, and extremes unless they are given.
ScalarField completed(ScalarField field) {
  field.range = colourRange(field);
  if (!field.values.empty() && !field.extremes) {
    const auto [low, high] = std::minmax_element(field.values.begin(), field.values.end());
    // Rounding noise reads as 0.
    const double negligible = 1e-6 * std::max(std::abs(*low), std::abs(*high));
    const auto cleaned = [&](double value) { return std::abs(value) < negligible ? 0.0 : value; };
    field.extremes = {cleaned(*low), cleaned(*high)};
  }
  return field;
}

}  // namespace

void show(const Picture& picture, Viewport& viewport) {
  viewport.setTheme(picture.theme);
  viewport.setGridVisible(false);
  viewport.setBody(picture.body);
  if (!picture.positions.empty()) viewport.moveBody(picture.positions, picture.normals);
  viewport.setRegions(picture.supports, {});
  viewport.setSection(picture.section);
  if (picture.field) viewport.setField(completed(*picture.field));
  if (!picture.sectionValues.empty()) viewport.setSectionValues(picture.sectionValues);
  viewport.setSampleLabels(picture.samples);
  viewport.setDimensions(picture.dimensions);
  std::vector<Eigen::Vector3d> room = picture.room;
  if (picture.hasGhost) {
    ViewportBody ghost = picture.body;
    ghost.knotLines.clear();
    viewport.setGhost(ghost);
    room.insert(room.end(), ghost.positions.begin(), ghost.positions.end());
  }
  viewport.setLiveArrows(picture.arrows);
  viewport.setGradient(picture.gradient);
  viewport.setContactRings(picture.rings);
  viewport.setBalls(picture.balls);
  viewport.setCaption(picture.caption);
  viewport.frame(picture.camera, room);
}

namespace {

/// Draws a picture; `window`: see pictureBytes().
Pixels draw(const Picture& picture, const PictureSize& size, vtkRenderWindow* window) {
  requireSize(size);
  vtkSmartPointer<vtkRenderWindow> own;
  if (!window) {
    requireDisplay();
    own = vtkSmartPointer<vtkRenderWindow>::New();
    own->SetOffScreenRendering(1);
    window = own;
  }
  window->SetSize(kSupersampling * size.width, kSupersampling * size.height);
  Viewport viewport(window, kSupersampling * pixelRatioOf(size));
  show(picture, viewport);
  viewport.render();
  return pixelsOf(window, kSupersampling);
}

}  // namespace

std::string pictureBytes(const Picture& picture, const PictureSize& size, vtkRenderWindow* window) {
  const Pixels pixels = draw(picture, size, window);
  return pngBytes(std::span(&pixels, 1));
}

std::string pictureBytes(std::span<const Picture> pictures, const PictureSize& size) {
  std::vector<Pixels> images;
  for (const Picture& each : pictures) images.push_back(draw(each, size, nullptr));
  return pngBytes(images);
}

void writePicture(const Picture& picture, const PictureSize& size,
                  const std::filesystem::path& path) {
  const std::string bytes = pictureBytes(picture, size);
  try {
    replaceFile(bytes, path);
  } catch (const FileError&) {
    throw ViewError("cannot write the picture " + path.string() +
                    "; check that its folder exists and can be written");
  }
}

}  // namespace palpa::view
