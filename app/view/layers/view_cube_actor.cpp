#include "app/view/layers/view_cube_actor.h"

#include <vtkCoordinate.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkTexturedActor2D.h>

#include <algorithm>
#include <cmath>

#include "app/view/layers/vtk_arrays.h"

namespace palpa::view {
namespace {

constexpr double kWidest = 1.04;  // of a face, for the longest word
constexpr double kFontSize = 26;  // of the pictures of words, per pixel ratio; drawn at about half
constexpr double kMinFacing = 0.32;  // cosine; words on faces turned farther away are left out
constexpr double kOpacity = 0.94;

struct Name {
  Eigen::Vector3i face;
  const char* word;
};
/// As the standard views are called.
const std::array<Name, 6> kNames{{{{0, -1, 0}, "Front"},
                                  {{0, 1, 0}, "Back"},
                                  {{-1, 0, 0}, "Left"},
                                  {{1, 0, 0}, "Right"},
                                  {{0, 0, 1}, "Top"},
                                  {{0, 0, -1}, "Bottom"}}};

}  // namespace

ViewCubeActor::ViewCubeActor(vtkRenderer* overlay) {
  for (std::size_t i = 0; i < words_.size(); ++i) {
    Word& word = words_[i];
    word.face = kNames[i].face;
    word.quad = vtkSmartPointer<vtkPolyData>::New();
    auto points = makeFloatPoints();
    points->SetNumberOfPoints(4);
    word.quad->SetPoints(points);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({0, 1, 2, 3});
    word.quad->SetPolys(cells);
    vtkNew<vtkFloatArray> places;
    places->SetNumberOfComponents(2);
    for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
      places->InsertNextTuple2(u, v);
    word.quad->GetPointData()->SetTCoords(places);
    word.texture = vtkSmartPointer<vtkTexture>::New();
    word.texture->InterpolateOn();
    word.texture->MipmapOn();
    word.texture->SetColorModeToDirectScalars();
    vtkNew<vtkCoordinate> pixels;
    pixels->SetCoordinateSystemToDisplay();
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(word.quad);
    mapper->SetTransformCoordinate(pixels);
    mapper->TransformCoordinateUseDoubleOn();
    vtkNew<vtkTexturedActor2D> actor;
    actor->SetMapper(mapper);
    actor->SetTexture(word.texture);
    actor->VisibilityOff();
    overlay->AddActor2D(actor);
    word.actor = actor;
  }
}

void ViewCubeActor::setVisible(bool visible) {
  visible_ = visible;
  if (visible) return;
  for (const Word& word : words_) word.actor->VisibilityOff();
}

void ViewCubeActor::setTheme(const ViewportTheme& theme, double pixelRatio) {
  theme_ = theme;
  pixelRatio_ = pixelRatio;
  areWordsDrawn_ = false;
}

void ViewCubeActor::drawWords() {
  if (areWordsDrawn_) return;
  areWordsDrawn_ = true;
  vtkNew<vtkTextProperty> style;
  style->SetFontFamilyToArial();
  style->SetBold(true);
  style->SetFontSize(static_cast<int>(std::lround(kFontSize * pixelRatio_)));
  style->SetColor(theme_.text[0], theme_.text[1], theme_.text[2]);
  constexpr int kDotsPerInch = 72;  // a point of the font is a pixel
  std::array<Eigen::Vector2d, 6> sizes;
  double widest = 1;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    vtkNew<vtkImageData> picture;
    std::array<int, 2> size{1, 1};
    vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
    if (!renderer ||
        !renderer->RenderString(style, kNames[i].word, picture, size.data(), kDotsPerInch))
      continue;
    words_[i].texture->SetInputData(picture);
    // The picture may be larger than the word.
    const std::array<int, 3> all = {picture->GetDimensions()[0], picture->GetDimensions()[1], 1};
    vtkDataArray* places = words_[i].quad->GetPointData()->GetTCoords();
    const double u = static_cast<double>(size[0]) / all[0];
    const double v = static_cast<double>(size[1]) / all[1];
    places->SetTuple2(1, u, 0);
    places->SetTuple2(2, u, v);
    places->SetTuple2(3, 0, v);
    places->Modified();
    sizes[i] = {size[0], size[1]};
    widest = std::max(widest, sizes[i].x());
  }
  for (std::size_t i = 0; i < words_.size(); ++i) words_[i].share = kWidest / widest * sizes[i];
}

void ViewCubeActor::update(const Turntable& camera, FlatShapes& shapes) {
  if (!visible_) return;
  drawWords();
  const Colour light = mixed(theme_.backgroundTop, {1, 1, 1}, 0.35);
  const Colour shade = mixed(theme_.backgroundBottom, theme_.text, 0.22);
  for (const ViewCubePolygon& polygon : viewCubePolygons(camera, pixelRatio_)) {
    const bool isHovered = hovered_ == polygon.part;
    const bool isArrow = polygon.part.arrow != ViewCubePart::Arrow::kNone;
    const int edges = polygon.part.towards.cwiseAbs().sum();
    Colour colour = isArrow ? mixed(theme_.backgroundTop, theme_.text, 0.45)
                            : mixed(shade, light, std::clamp(polygon.facing, 0.0, 1.0));
    if (edges > 1) colour = mixed(colour, theme_.text, 0.10);
    if (isHovered) colour = kHighlightColour;
    shapes.addPolygon(polygon.corners, colour, kOpacity);
    const double width = std::max(1.0, std::round(pixelRatio_));
    for (std::size_t i = 0; i < polygon.corners.size() && !isArrow; ++i)
      shapes.addLine(polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()], width,
                     mixed(shade, theme_.text, 0.35), 0.55);
  }
  for (Word& word : words_) {
    const double facing = -camera.axes().forward.dot(word.face.cast<double>());
    const bool isShown = facing > kMinFacing;
    word.actor->SetVisibility(isShown);
    if (!isShown) continue;
    const ViewCubeLabel label = viewCubeLabel(word.face, camera, pixelRatio_);
    const Eigen::Vector2d along = word.share.x() * label.along;
    const Eigen::Vector2d up = word.share.y() * label.up;
    const std::array<Eigen::Vector2d, 4> corners{
        label.middle - along - up, label.middle + along - up, label.middle + along + up,
        label.middle - along + up};
    for (std::size_t k = 0; k < corners.size(); ++k)
      word.quad->GetPoints()->SetPoint(static_cast<vtkIdType>(k), corners[k].x(),
                                       camera.height() - corners[k].y(), 0);
    word.quad->GetPoints()->Modified();
    word.quad->Modified();
  }
}

}  // namespace palpa::view
