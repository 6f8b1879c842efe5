#include "app/gui/dialogs/sketch_editor.h"

#include <algorithm>
#include <exception>

#include "modeling/shapes/profile_error.h"

namespace palpa::gui {

using Eigen::Vector2d;
using modeling::ProfileSketch;
using modeling::SketchSection;

QString sketchSentence(const QString& message) {
  // "extrude: profile: the curve …", "loft: sections[1].profile: the curve …"
  QString sentence = message;
  for (qsizetype at = sentence.indexOf(": "); at >= 0 && at < 40; at = sentence.indexOf(": ")) {
    const QString path = sentence.left(at);
    if (path != "revolve" && path != "extrude" && path != "loft" && path != "profile" &&
        !path.startsWith("sections["))
      break;
    sentence.remove(0, at + 2);
  }
  if (!sentence.isEmpty()) sentence[0] = sentence[0].toUpper();
  return sentence;
}

SketchEditor::SketchEditor(const modeling::Primitive& primitive, QObject* parent)
    : QObject(parent),
      original_(primitive),
      use_(modeling::sketchUseOf(primitive)),
      history_(modeling::sectionsOf(primitive)) {
  check();
}

modeling::Primitive SketchEditor::primitive() const {
  return modeling::withSections(original_, sections());
}

bool SketchEditor::isSelected(int point) const {
  return std::find(selection_.begin(), selection_.end(), point) != selection_.end();
}

void SketchEditor::select(std::vector<int> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points == selection_) return;
  selection_ = std::move(points);
  Q_EMIT selectionChanged();
}

void SketchEditor::selectAll() {
  std::vector<int> all(static_cast<std::size_t>(sketch().pointCount()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  select(std::move(all));
}

void SketchEditor::step(int direction) {
  const int count = sketch().pointCount();
  if (count == 0) return;
  const int from = selection_.empty() ? (direction > 0 ? -1 : 0)
                   : direction > 0    ? selection_.back()
                                      : selection_.front();
  select({(from + direction + count) % count});
}

void SketchEditor::record(std::vector<SketchSection> sections, const QString& name,
                          bool continues) {
  history_.record(std::move(sections), name.toStdString(), continues);
  afterChange();
}

void SketchEditor::afterChange() {
  section_ = std::clamp(section_, 0, static_cast<int>(sections().size()) - 1);
  std::erase_if(selection_, [&](int point) { return point >= sketch().pointCount(); });
  check();
  Q_EMIT changed();
  Q_EMIT selectionChanged();
}

void SketchEditor::check() {
  problem_.reset();
  for (std::size_t i = 0; i < sections().size() && !problem_; ++i) {
    const int section = static_cast<int>(i);
    try {
      modeling::checkSection(use_, sections(), i);
    } catch (const modeling::ProfileError& error) {
      problem_ = {section, sketchSentence(QString::fromStdString(error.what())), error.location()};
    } catch (const std::exception& error) {
      problem_ = {section, sketchSentence(QString::fromStdString(error.what())), std::nullopt};
    }
  }
}

void SketchEditor::edit(const QString& name, const std::function<void(ProfileSketch&)>& change,
                        bool continues) {
  std::vector<SketchSection> sections = this->sections();
  change(sections[section_].profile);
  record(std::move(sections), name, continues);
}

void SketchEditor::removeSelected() {
  if (selection_.empty()) return;
  const std::vector<int> points = selection_;
  selection_.clear();
  edit(tr("Delete points"), [&](ProfileSketch& sketch) { sketch.remove(points); });
}

void SketchEditor::toggleCorners() {
  if (selection_.empty()) return;
  const auto isCorner = [&](const ProfileSketch& sketch, int point) {
    return sketch.points()[point].kind == modeling::SketchPointKind::kCorner;
  };
  const bool toSmooth = std::all_of(selection_.begin(), selection_.end(),
                                    [&](int point) { return isCorner(sketch(), point); });
  std::vector<Vector2d> places;
  for (int point : selection_) places.push_back(sketch().points()[point].at);
  const QString name = toSmooth ? tr("Smooth") : tr("Corner");
  edit(name, [&](ProfileSketch& sketch) {
    // A change of kind can turn the numbers; the locations stay.
    for (const Vector2d& place : places)
      for (int i = 0; i < sketch.pointCount(); ++i) {
        if (sketch.points()[i].at != place) continue;
        if (toSmooth)
          sketch.makeSmooth(i);
        else
          sketch.makeCorner(i);
        break;
      }
  });
  std::vector<int> selected;
  for (int i = 0; i < sketch().pointCount(); ++i)
    if (std::find(places.begin(), places.end(), sketch().points()[i].at) != places.end())
      selected.push_back(i);
  select(std::move(selected));
}

void SketchEditor::insertAfterSelected() {
  if (selection_.empty() || !sketch().isCurve()) return;
  const std::vector<int> points = selection_;
  std::vector<Vector2d> fresh;
  edit(tr("Insert points"), [&](ProfileSketch& sketch) {
    for (auto point = points.rbegin(); point != points.rend(); ++point) {
      int run = -1, start = 0;
      for (int i = 0; i <= *point; ++i)
        if (sketch.isOnCurve(i)) {
          ++run;
          start = i;
        }
      if (!sketch.isClosed() && *point + 1 == sketch.pointCount()) continue;
      int end = start + 1;
      while (end < sketch.pointCount() && !sketch.isOnCurve(end)) ++end;
      const double u = (*point - start + 0.5) / (end - start);
      const Vector2d at = sketch.at(run, u);
      fresh.push_back(sketch.points()[sketch.insert({run, u, at})].at);
    }
  });
  std::vector<int> selected;
  for (int i = 0; i < sketch().pointCount(); ++i)
    if (std::find(fresh.begin(), fresh.end(), sketch().points()[i].at) != fresh.end())
      selected.push_back(i);
  select(std::move(selected));
}

void SketchEditor::flip(int axis) {
  const auto [low, high] = sketch().box();
  Vector2d factors(1.0, 1.0);
  factors[axis] = -1.0;
  const Vector2d about = 0.5 * (low + high);
  edit(axis == 0 ? tr("Flip left to right") : tr("Flip upside down"),
       [&](ProfileSketch& sketch) { sketch.scale(factors, about); });
}

bool SketchEditor::addMirrorImage(int axis) {
  const auto [low, high] = sketch().box();
  bool isDone = false;
  edit(tr("Mirror"), [&](ProfileSketch& sketch) {
    isDone = sketch.addMirrorImage(axis, 0.0, 1e-6 * (high - low).maxCoeff());
  });
  return isDone;
}

void SketchEditor::setExtent(int axis, double extent) {
  const auto [low, high] = sketch().box();
  // The width of a revolved profile counts from the axis.
  const double before =
      use_ == modeling::SketchUse::kRevolve && axis == 0 ? high.x() : high[axis] - low[axis];
  if (!(before > 0.0) || !(extent > 0.0)) return;
  Vector2d factors(1.0, 1.0);
  factors[axis] = extent / before;
  edit(tr("Scale"), [&](ProfileSketch& sketch) { sketch.scale(factors, Vector2d::Zero()); });
}

void SketchEditor::setSection(int index) {
  if (index == section_ || index < 0 || index >= static_cast<int>(sections().size())) return;
  section_ = index;
  selection_.clear();
  Q_EMIT changed();
  Q_EMIT selectionChanged();
}

void SketchEditor::setHeight(int index, double z) {
  std::vector<SketchSection> sections = this->sections();
  if (index < 0 || index >= static_cast<int>(sections.size())) return;
  SketchSection moved = std::move(sections[index]);
  moved.z = z;
  sections.erase(sections.begin() + index);
  // Sections are listed from bottom to top.
  const auto place = std::upper_bound(sections.begin(), sections.end(), z,
                                      [](double a, const SketchSection& b) { return a < b.z; });
  section_ = static_cast<int>(place - sections.begin());
  sections.insert(place, std::move(moved));
  record(std::move(sections), tr("Height"));
}

void SketchEditor::addSection() {
  std::vector<SketchSection> sections = this->sections();
  SketchSection fresh = sections[section_];
  const std::size_t next = static_cast<std::size_t>(section_) + 1;
  if (next < sections.size()) {
    fresh.z = 0.5 * (sections[section_].z + sections[next].z);
  } else {
    const double below = section_ > 0 ? sections[section_].z - sections[next - 2].z : 20.0;
    fresh.z += below;
  }
  sections.insert(sections.begin() + static_cast<std::ptrdiff_t>(next), std::move(fresh));
  section_ = static_cast<int>(next);
  selection_.clear();
  record(std::move(sections), tr("Add section"));
}

void SketchEditor::removeSection() {
  std::vector<SketchSection> sections = this->sections();
  if (sections.size() <= 2) return;
  sections.erase(sections.begin() + section_);
  selection_.clear();
  record(std::move(sections), tr("Remove section"));
}

void SketchEditor::replace(const QString& name, std::vector<SketchSection> sections) {
  if (sections.empty()) return;
  selection_.clear();
  record(std::move(sections), name);
}

QString SketchEditor::undoName() const {
  return canUndo() ? QString::fromStdString(history_.undoName()) : QString();
}

QString SketchEditor::redoName() const {
  return canRedo() ? QString::fromStdString(history_.redoName()) : QString();
}

void SketchEditor::undo() {
  history_.undo();
  afterChange();
}

void SketchEditor::drop() {
  history_.drop();
  afterChange();
}

void SketchEditor::redo() {
  history_.redo();
  afterChange();
}

}  // namespace palpa::gui
