#include "app/gui/base/canvas.h"

#include <vtkCallbackCommand.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

#include <QOpenGLFunctions>
#include <QSurfaceFormat>
#include <algorithm>

namespace palpa::gui {
namespace {

QSurfaceFormat surfaceFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setOption(QSurfaceFormat::DeprecatedFunctions);  // wide lines in Mesa
  return format;
}

}  // namespace

Canvas::Canvas() {
  surface_.setFormat(surfaceFormat());
  surface_.create();
  context_.setFormat(surfaceFormat());
  if (!context_.create()) return;
  vtkNew<vtkCallbackCommand> current;
  current->SetClientData(this);
  current->SetCallback([](vtkObject*, unsigned long, void* canvas, void*) {
    static_cast<Canvas*>(canvas)->makeCurrent();
  });
  window_->AddObserver(vtkCommand::WindowMakeCurrentEvent, current);
  makeCurrent();
  window_->SetIsCurrent(true);
  window_->SetOwnContext(0);
  window_->OpenGLInitContext();
  window_->SetReadyForRendering(true);
  window_->SetFrameBlitModeToNoBlit();  // the surface is never shown
  // As in VTK's windows: of two shapes at the same depth, the later one is visible.
  window_->GetState()->Reset();
  window_->GetState()->vtkglDepthFunc(GL_LEQUAL);
}

Canvas::~Canvas() {
  if (!isValid()) return;
  makeCurrent();
  window_->Finalize();
  window_->RemoveAllObservers();
  context_.doneCurrent();
}

void Canvas::makeCurrent() {
  if (isValid() && QOpenGLContext::currentContext() != &context_) context_.makeCurrent(&surface_);
}

void Canvas::resize(const QSize& size) {
  window_->SetSize(size.width(), size.height());
}

QSize Canvas::size() const {
  const int* size = const_cast<vtkGenericOpenGLRenderWindow*>(window_.Get())->GetSize();
  return {size[0], size[1]};
}

QImage Canvas::image() {
  const int width = size().width(), height = size().height();
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  rows_.resize(pixels_.size());
  makeCurrent();
  window_->GetState()->PushFramebufferBindings();
  vtkOpenGLFramebufferObject* drawn = window_->GetDisplayFramebuffer();
  drawn->Bind(vtkOpenGLFramebufferObject::GetReadMode());
  drawn->ActivateReadBuffer(0);
  QOpenGLFunctions* gl = context_.functions();
  gl->glPixelStorei(GL_PACK_ALIGNMENT, 4);
  // Layout of QImage's RGB32 and of most frame buffers: no conversion.
  constexpr GLenum kBgra = 0x80E1, kBytes = 0x8367;  // GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV
  gl->glReadPixels(0, 0, width, height, kBgra, kBytes, pixels_.data());
  window_->GetState()->PopFramebufferBindings();
  for (int row = 0; row < height; ++row)
    std::copy_n(pixels_.begin() + static_cast<std::ptrdiff_t>(row) * width, width,
                rows_.begin() + static_cast<std::ptrdiff_t>(height - 1 - row) * width);
  return {reinterpret_cast<const uchar*>(rows_.data()), width, height, 4 * width,
          QImage::Format_RGB32};
}

}  // namespace palpa::gui
