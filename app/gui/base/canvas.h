#pragma once

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include <QImage>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <vector>

namespace palpa::gui {

/// Off-screen render window of VTK with a separate OpenGL context. Its content is read as an image,
/// so that views are ordinary widgets (docs/decisions/018).
class Canvas {
 public:
  /// Needs a QApplication. Without OpenGL isValid() is false and nothing may be drawn.
  Canvas();
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  bool isValid() const { return context_.isValid(); }
  vtkRenderWindow* window() { return window_; }

  /// Required before VTK objects are drawn or destroyed.
  void makeCurrent();
  /// Size in device pixels.
  void resize(const QSize& size);
  QSize size() const;
  /// The last picture, without a copy: valid until the next call of any function.
  QImage image();

 private:
  QOffscreenSurface surface_;
  QOpenGLContext context_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  std::vector<QRgb> pixels_, rows_;  // rows from the bottom, as OpenGL returns them; from the top
};

}  // namespace palpa::gui
