#pragma once

#include <memory>

#include "app/gui/view/viewport_widget.h"
#include "modeling/exchange/file_bodies.h"

namespace palpa::gui {

/// View of the bodies of a file with their coarse surfaces; one of several is marked. A click picks
/// a body.
class BodiesPreview : public ViewportWidget {
  Q_OBJECT

 public:
  explicit BodiesPreview(QWidget* parent);
  ~BodiesPreview() override;

  /// `found` is placed already. All bodies are in view, at first along the space diagonal.
  void showBodies(const modeling::FileBodies& found);
  void mark(std::size_t body);

 Q_SIGNALS:
  void picked(int body);

 private:
  class PickTool;
  std::unique_ptr<PickTool> tool_;
  std::vector<int> bodyOfTriangle_;
  std::size_t count_ = 0;
  bool isFresh_ = true;
};

}  // namespace palpa::gui
