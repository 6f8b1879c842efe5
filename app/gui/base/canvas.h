#pragma once

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>

#include <QImage>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <vector>

namespace palpa::gui {

/// A render window of VTK on an OpenGL context of its own that nobody sees, and what was drawn into
/// it as an image: the view is then a widget like any other (docs/decisions/018).
class Canvas {
 public:
  /// Needs the application. Without OpenGL isValid() is false and nothing may be drawn.
  Canvas();
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  bool isValid() const { return context_.isValid(); }
  vtkRenderWindow* window() { return window_; }

  /// VTK's objects may be drawn and destroyed afterwards.
  void makeCurrent();
  /// Device pixels.
  void resize(const QSize& size);
  QSize size() const;
  /// What was drawn last, without a copy: valid until the next call of any function.
  QImage image();

 private:
  QOffscreenSurface surface_;
  QOpenGLContext context_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  std::vector<QRgb> pixels_, rows_;  // as OpenGL gives them; from the top
};

}  // namespace palpa::gui
