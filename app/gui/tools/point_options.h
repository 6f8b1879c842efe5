#pragma once

#include <QKeySequence>
#include <QObject>
#include <QWidget>
#include <array>

#include "app/gui/document/editor.h"

namespace palpa::gui {

/// Options shared by the tools for control points: kind of selection and points that follow a
/// motion.
class PointOptions : public QObject {
  Q_OBJECT

 public:
  enum class Pick { kPoints, kPatches, kEdges };
  struct PickInfo {
    Pick pick;
    const char* icon;
    QString name, menuText;
    QKeySequence key;
    QString tip;
  };
  /// All kinds of picking.
  static std::array<PickInfo, 3> pickInfos();

  /// Plane normal to x, y or z, through the origin or through the centre of the body's box.
  enum class Mirror { kOff, kX, kY, kZ, kMiddleX, kMiddleY, kMiddleZ };

  explicit PointOptions(QObject* parent) : QObject(parent) {}

  Pick pick() const { return pick_; }
  void setPick(Pick pick);

  bool hasFalloff() const { return hasFalloff_; }
  void setHasFalloff(bool has);
  double falloff() const { return falloff_; }  ///< mm, above 0
  void setFalloff(double radius);

  Mirror mirror() const { return mirror_; }
  void setMirror(Mirror mirror);

  /// True if dragged places snap to points, edges and the grid; Ctrl reverses it during a motion.
  bool snaps() const { return snaps_; }
  void setSnaps(bool snaps);

  modeling::Reach reach(const modeling::Solid& solid) const;

  /// Fields for all options, owned by `parent`; they follow changes.
  QWidget* makeWidget(const Settings& settings, QWidget* parent);

 Q_SIGNALS:
  void changed();

 private:
  template <class Value>
  void set(Value& member, Value value);

  Pick pick_ = Pick::kPoints;
  bool hasFalloff_ = false;
  double falloff_ = 20;
  Mirror mirror_ = Mirror::kOff;
  bool snaps_ = false;
};

}  // namespace palpa::gui
