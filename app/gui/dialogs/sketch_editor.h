#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <vector>

#include "modeling/shapes/primitive.h"
#include "modeling/shapes/sketch_history.h"

namespace palpa::gui {

/// Error in one of the sections.
struct SketchProblem {
  int section = 0;
  QString text;  ///< a sentence, without the path of the value
  std::optional<Eigen::Vector2d> location;
};

/// The profiles of a shape while they are edited: sections, the present one, the selected points,
/// undo. Every edit is one step with a name; steps of a drag are joined.
class SketchEditor : public QObject {
  Q_OBJECT

 public:
  /// For a shape with modeling::hasProfile().
  SketchEditor(const modeling::Primitive& primitive, QObject* parent);

  modeling::SketchUse use() const { return use_; }
  const std::vector<modeling::SketchSection>& sections() const { return history_.present(); }
  int sectionIndex() const { return section_; }
  const modeling::ProfileSketch& sketch() const { return sections()[section_].profile; }
  const std::vector<int>& selection() const { return selection_; }
  bool isSelected(int point) const;
  bool isModified() const { return history_.canUndo(); }

  /// The primitive with the present sections. Throws ModelingError if a section has no curve.
  modeling::Primitive primitive() const;

  /// The first error of the sections, each by itself, with the rules of a file.
  const std::optional<SketchProblem>& problem() const { return problem_; }

  void select(std::vector<int> points);
  void selectAll();
  /// Selects the point after (1) or before (-1) the selected one.
  void step(int direction);

  /// Changes the present curve. If `continues`, the edit joins the last step of this name.
  void edit(const QString& name, const std::function<void(modeling::ProfileSketch&)>& change,
            bool continues = false);
  void removeSelected();
  /// Makes the selected points corners, or smooth if all are corners.
  void toggleCorners();
  /// Inserts a point on the curve after each selected point.
  void insertAfterSelected();
  /// Mirrors the curve left to right (axis 0) or top to bottom (1) about the middle of its box; a
  /// revolved profile only upside down.
  void flip(int axis);
  /// Adds the mirror image about the line x = 0 or y = 0 to an open curve; false if no end lies on
  /// it.
  bool addMirrorImage(int axis);
  /// Scales the box of the curve along an axis, about the origin.
  void setExtent(int axis, double extent);

  void setSection(int index);
  void setHeight(int index, double z);
  void addSection();
  void removeSection();
  /// Replaces all sections of a loft, or the only section.
  void replace(const QString& name, std::vector<modeling::SketchSection> sections);

  bool canUndo() const { return history_.canUndo(); }
  bool canRedo() const { return history_.canRedo(); }
  QString undoName() const;
  QString redoName() const;
  void undo();
  void redo();
  /// Removes the last step: its drag was cancelled.
  void drop();

 Q_SIGNALS:
  void changed();
  void selectionChanged();

 private:
  void record(std::vector<modeling::SketchSection> sections, const QString& name,
              bool continues = false);
  void afterChange();
  void check();

  modeling::Primitive original_;
  modeling::SketchUse use_;
  modeling::SketchHistory history_;
  int section_ = 0;
  std::vector<int> selection_;
  std::optional<SketchProblem> problem_;
};

/// A message of modeling as a sentence, without the path at its beginning.
QString sketchSentence(const QString& message);

}  // namespace palpa::gui
