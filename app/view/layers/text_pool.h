#pragma once

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/view/layers/text.h"

/// Texts that change often. Internal to app/view.
namespace palpa::view {

/// Texts in one style in the overlay of a renderer. The actors are kept, also the
/// hidden ones; VTK draws the image of a text again only if its words or the style change.
class TextPool {
 public:
  explicit TextPool(vtkRenderer* overlay) : overlay_(overlay) {}
  ~TextPool();
  TextPool(const TextPool&) = delete;
  TextPool& operator=(const TextPool&) = delete;

  /// Texts stay where they are; new ones are hidden until they are placed.
  void set(const std::vector<std::string>& texts, const TextStyle& style);
  std::size_t size() const { return used_; }
  /// Width and height in pixels; zero without words.
  const Eigen::Vector2d& extent(std::size_t index) const { return entries_[index].extent; }
  /// Shows it with its upper left corner at `corner`, in pixels from the top left of a picture of
  /// that height.
  void place(std::size_t index, const Eigen::Vector2d& corner, int pictureHeight);
  /// Not to be called for a text that is placed again before the next picture: VTK would draw its
  /// image again.
  void hide(std::size_t index);
  void hideAll();

 private:
  struct Entry {
    vtkSmartPointer<vtkTextActor> actor;
    std::string words;
    Eigen::Vector2d extent = Eigen::Vector2d::Zero();
  };

  vtkRenderer* overlay_;
  std::vector<Entry> entries_;
  std::size_t used_ = 0;
  TextStyle style_;
};

}  // namespace palpa::view
