#pragma once

#include <string>
#include <utility>
#include <vector>

#include "modeling/shapes/shape_sketch.h"

namespace palpa::modeling {

/// Sections of a shape with the steps of undo and redo. Steps that change nothing are not recorded.
class SketchHistory {
 public:
  explicit SketchHistory(std::vector<SketchSection> sections) {
    steps_.push_back({std::move(sections), {}});
  }

  const std::vector<SketchSection>& present() const { return steps_[now_].sections; }

  /// Records a step and drops the steps that were undone. If `continues`, it replaces the last step
  /// of the same name: one drag, one step.
  void record(std::vector<SketchSection> sections, const std::string& name,
              bool continues = false) {
    if (sections == present()) return;
    steps_.resize(now_ + 1);
    if (!(continues && now_ > 0 && steps_[now_].name == name)) {
      if (steps_.size() > kMaxSteps) steps_.erase(steps_.begin());
      steps_.push_back({});
    }
    steps_.back() = {std::move(sections), name};
    now_ = steps_.size() - 1;
  }

  /// Removes the last step as if it had never been made: a drag that was cancelled.
  void drop() {
    if (!canUndo()) return;
    steps_.resize(now_);
    --now_;
  }

  bool canUndo() const { return now_ > 0; }
  bool canRedo() const { return now_ + 1 < steps_.size(); }
  /// Name of the step that undo() takes back, and of the step that redo() repeats.
  const std::string& undoName() const { return steps_[now_].name; }
  const std::string& redoName() const { return steps_[now_ + 1].name; }
  void undo() { now_ -= canUndo() ? 1 : 0; }
  void redo() { now_ += canRedo() ? 1 : 0; }

 private:
  static constexpr std::size_t kMaxSteps = 500;
  struct Step {
    std::vector<SketchSection> sections;
    std::string name;
  };

  std::vector<Step> steps_;
  std::size_t now_ = 0;
};

}  // namespace palpa::modeling
