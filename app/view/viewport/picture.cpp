#include "app/view/picture.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/view/arrows.h"
#include "app/view/body.h"
#include "app/view/camera_fit.h"
#include "app/view/colour_map.h"
#include "app/view/contact_layer.h"
#include "app/view/corner_axes.h"
#include "app/view/display.h"
#include "app/view/flat.h"
#include "app/view/label_placement.h"
#include "app/view/png.h"
#include "app/view/scalar_bar.h"
#include "app/view/text.h"

namespace palpa::view {
namespace {

/// Everything is drawn this many times larger and averaged down: smooth edges, lines and text on
/// every driver, the same whatever its multisampling does.
constexpr int kSupersampling = 2;

/// Lengths of the layout in pixels of the large drawing.
struct Layout {
  int width;
  int height;
  double pixel;     ///< a hairline
  double fontSize;  ///< of plain text
  double margin;    ///< around everything

  explicit Layout(const PictureOptions& options)
      : width(kSupersampling * options.width), height(kSupersampling * options.height) {
    const double scale = std::min(options.width / 1200.0, options.height / 900.0);
    pixel = kSupersampling * std::max(scale, 0.7);
    // Small pictures keep readable text; large ones grow it with the picture.
    fontSize = kSupersampling * std::max(18 * scale, 10.0);
    margin = 1.3 * fontSize;
  }
};

double diagonal(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d low = points.front();
  Eigen::Vector3d high = points.front();
  for (const Eigen::Vector3d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).norm();
}

/// Title and captions; returns what remains of the picture between them.
Rectangle addTexts(const SurfaceScene& scene, const Layout& layout, vtkRenderer* overlay) {
  Rectangle rest{layout.margin, layout.margin, layout.width - layout.margin,
                 layout.height - layout.margin};
  if (!scene.title.empty()) {
    const auto title = makeText(scene.title, {1.3 * layout.fontSize, true});
    rest.top -= textSize(title, overlay).y();
    placeText(title, {rest.left, rest.top}, overlay);
    rest.top -= 0.6 * layout.fontSize;
  }
  // Captions stand beside the corner axes, on its right.
  const double axesSide = 5.2 * layout.fontSize;
  const Rectangle axes{rest.left - 0.4 * layout.margin, rest.bottom - 0.4 * layout.margin,
                       rest.left - 0.4 * layout.margin + axesSide,
                       rest.bottom - 0.4 * layout.margin + axesSide};
  addCornerAxes(scene.camera, axes, 0.87 * layout.fontSize, layout.pixel, overlay);
  const double left = axes.right + 0.8 * layout.fontSize;
  double bottom = rest.bottom;
  for (auto line = scene.captions.rbegin(); line != scene.captions.rend(); ++line) {
    const auto text = makeText(*line, {layout.fontSize});
    placeText(text, {left, bottom}, overlay);
    bottom += 1.4 * layout.fontSize;
  }
  if (!scene.supportLabel.empty() && !scene.supports.empty()) {
    const double side = 0.8 * layout.fontSize;
    const auto text = makeText(scene.supportLabel, {layout.fontSize});
    addFlatRectangle({left, bottom + 0.1 * side, left + side, bottom + 1.1 * side}, kSupportColour,
                     overlay);
    placeText(text, {left + 1.6 * side, bottom}, overlay);
    bottom += 1.4 * layout.fontSize;
  }
  rest.bottom = std::max(bottom, axes.top) + 0.3 * layout.fontSize;
  return rest;
}

/// The scalar bar on the right; returns what remains of `area`.
Rectangle addScalarBar(const SurfaceScene& scene, const Rectangle& area, const Layout& layout,
                       vtkRenderer* overlay) {
  if (!scene.field) return area;
  const double height = std::min(0.86 * area.height(), 26 * layout.fontSize);
  const ScalarBar bar(*scene.field, height, layout.fontSize, layout.pixel, overlay);
  const double left = area.right - bar.width();
  bar.draw({left, area.top - 0.5 * (area.height() - height)});
  Rectangle rest = area;
  rest.right = left - 1.2 * layout.fontSize;
  return rest;
}

Occupancy occupied(const std::vector<Eigen::Vector3d>& shape, const SurfaceScene& scene,
                   const Layout& layout, vtkRenderer* renderer) {
  Occupancy occupancy(layout.width, layout.height, 0.25 * layout.fontSize);
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(shape.size());
  for (const Eigen::Vector3d& point : shape) pixels.push_back(toPixels(point, renderer));
  for (const Triangle& t : scene.triangles) {
    occupancy.addTriangle(pixels[static_cast<std::size_t>(t[0])],
                          pixels[static_cast<std::size_t>(t[1])],
                          pixels[static_cast<std::size_t>(t[2])], Cover::kBody);
  }
  return occupancy;
}

/// Averages blocks of kSupersampling² pixels.
vtkSmartPointer<vtkImageData> reduced(vtkUnsignedCharArray* large, const PictureOptions& options) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(options.width, options.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const unsigned char* source = large->GetPointer(0);
  auto* target = static_cast<unsigned char*>(image->GetScalarPointer());
  const auto rowLength = static_cast<std::size_t>(kSupersampling * options.width);
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (int dy = 0; dy < kSupersampling; ++dy) {
          for (int dx = 0; dx < kSupersampling; ++dx) {
            const auto row = static_cast<std::size_t>(kSupersampling * y + dy);
            const auto column = static_cast<std::size_t>(kSupersampling * x + dx);
            sum += source[3 * (row * rowLength + column) + channel];
          }
        }
        constexpr int kBlock = kSupersampling * kSupersampling;
        *target++ = static_cast<unsigned char>((sum + kBlock / 2) / kBlock);
      }
    }
  }
  return image;
}

void requireSize(const PictureOptions& options) {
  const bool valid = options.width >= 160 && options.width <= 8192 && options.height >= 120 &&
                     options.height <= 8192;
  if (!valid) throw std::invalid_argument("a picture is 160x120 to 8192x8192 pixels large");
}

}  // namespace

void renderToPng(const SurfaceScene& scene, const std::filesystem::path& path,
                 const PictureOptions& options) {
  scene.validate();
  requireSize(options);
  requireDisplay();

  const Layout layout(options);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetDPI(72);
  window->SetSize(layout.width, layout.height);
  window->SetNumberOfLayers(4);
  vtkNew<vtkRenderer> background;
  vtkNew<vtkRenderer> body;
  vtkNew<vtkRenderer> shineThrough;
  vtkNew<vtkRenderer> overlay;
  int layer = 0;
  for (vtkRenderer* renderer : {background.Get(), body.Get(), shineThrough.Get(), overlay.Get()}) {
    renderer->SetLayer(layer++);
    window->AddRenderer(renderer);
  }
  background->GradientBackgroundOn();
  background->SetBackground(0.90, 0.92, 0.945);
  background->SetBackground2(1, 1, 1);
  background->SetActiveCamera(body->GetActiveCamera());
  shineThrough->SetActiveCamera(body->GetActiveCamera());

  const std::vector<Eigen::Vector3d> shape = scene.deformedPositions();
  const double size = diagonal(scene.positions);
  const double longest = scene.arrowLength * size;
  const LiveArrows live{scene.arrows, scene.fullForce};
  const std::vector<PlacedArrow> arrows =
      scene.fullForce > 0 ? placeLiveArrows(live, longest) : placeArrows(scene.arrows, longest);
  ProbeBalls balls(body);
  balls.set(scene.balls);
  std::vector<Eigen::Vector3d> seen = shape;
  seen.insert(seen.end(), scene.room.begin(), scene.room.end());
  if (scene.showUndeformed) {
    seen.insert(seen.end(), scene.positions.begin(), scene.positions.end());
  }
  for (const PlacedArrow& arrow : arrows) {
    seen.push_back(arrow.tail);
    seen.push_back(arrow.tip);
  }

  const Rectangle middle = addTexts(scene, layout, overlay);
  const Rectangle area = addScalarBar(scene, middle, layout, overlay);
  // Labels of arrows may use this border.
  const double border = 1.6 * layout.fontSize;
  const Rectangle target{area.left + border, area.bottom + 0.3 * border, area.right - border,
                         area.top - border};
  fitCamera(scene.camera, seen, target, layout.width, layout.height, body);

  addLights(background);
  addLights(body);
  addLights(shineThrough);
  if (scene.showUndeformed) addGhost(scene, background);
  addBody(scene, body, layout.pixel);
  addArrows(arrows, size, 1.0, body);
  addArrows(arrows, size, 0.22, shineThrough);
  Occupancy occupancy = occupied(shape, scene, layout, body);
  addArrowLabels(arrows, 1.1 * layout.fontSize, area, occupancy, body, overlay);

  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, layout.width - 1, layout.height - 1, 1, pixels);
  writePng(reduced(pixels, options), path);
}

}  // namespace palpa::view
