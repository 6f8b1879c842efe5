#include "app/view/layers/text_pool.h"

#include <cmath>

namespace palpa::view {

TextPool::~TextPool() {
  for (const Entry& entry : entries_) overlay_->RemoveActor2D(entry.actor);
}

void TextPool::set(const std::vector<std::string>& texts, const TextStyle& style) {
  if (!(style == style_)) {
    for (const Entry& entry : entries_) overlay_->RemoveActor2D(entry.actor);
    entries_.clear();
    style_ = style;
  }
  while (entries_.size() < texts.size()) {
    Entry& entry = entries_.emplace_back();
    entry.actor = makeText("", style);
    entry.actor->VisibilityOff();
    overlay_->AddActor2D(entry.actor);
  }
  used_ = texts.size();
  for (std::size_t i = 0; i < texts.size(); ++i) {
    Entry& entry = entries_[i];
    if (entry.words == texts[i]) continue;
    entry.words = texts[i];
    entry.actor->SetInput(entry.words.c_str());
    entry.extent = entry.words.empty() ? Eigen::Vector2d(0, 0) : textSize(entry.actor, overlay_);
  }
  for (std::size_t i = used_; i < entries_.size(); ++i) hide(i);
}

void TextPool::place(std::size_t index, const Eigen::Vector2d& corner, int pictureHeight) {
  const Entry& entry = entries_[index];
  entry.actor->SetVisibility(!entry.words.empty());
  entry.actor->SetPosition(std::round(corner.x()),
                           std::round(pictureHeight - corner.y() - entry.extent.y()));
}

void TextPool::hide(std::size_t index) {
  entries_[index].actor->VisibilityOff();
}

void TextPool::hideAll() {
  for (const Entry& entry : entries_) entry.actor->VisibilityOff();
}

}  // namespace palpa::view
