#pragma once

#include <QObject>

#include "app/gui/compare/variant_comparison.h"
#include "app/gui/simulate/simulation_view.h"
#include "app/gui/view/viewport_widget.h"

namespace palpa::gui {

/// Drawing of a comparison: the other variant as a ghost, a common range of colours, and, in
/// Simulate mode, the field of A, of B or their difference.
class ComparisonView : public QObject {
  Q_OBJECT

 public:
  enum class Shown { kA, kB, kDifference };

  ComparisonView(VariantComparison& comparison, Simulation& simulation, SimulationView& pictures,
                 const Settings& settings, ViewportWidget& widget);

  Shown shown() const { return shown_; }
  void setShown(Shown shown);
  /// One range of the colours encloses the values of both variants.
  bool hasCommonColours() const { return hasCommonColours_; }
  void setCommonColours(bool common);
  /// The ghost is deformed by the touches, in Simulate mode.
  bool isDeformed() const { return isDeformed_; }
  void setDeformed(bool deformed);
  /// Why shown() is not shown, or where the difference is left out; empty: nothing to say.
  const QString& note() const { return note_; }

 Q_SIGNALS:
  void changed();

 private:
  /// Smallest share of A's surface with partners on B for a difference.
  static constexpr double kMinShare = 0.2;

  bool isSimulating() const;
  /// shown() if it can be shown now, otherwise kA; sets note_.
  Shown drawable();
  void update();
  void drawFrame();
  void drawShapes();
  void computeValues();
  void clear();
  void explain();
  QString colouredText(const QString& name) const;

  VariantComparison& comparison_;
  Simulation& simulation_;
  SimulationView& pictures_;
  const Settings& settings_;
  ViewportWidget& widget_;
  Shown shown_ = Shown::kA, drawn_ = Shown::kA;
  bool hasCommonColours_ = true, isDeformed_ = true, isDrawing_ = false;
  QString note_;
  std::shared_ptr<const VariantComparison::Result> result_;  // shown
  app::DrawnBody::Shape shapeB_;
  std::vector<double> valuesB_, difference_;  // in the program's units
  double largestB_ = 0;
  app::SurfaceQuantity valuesOf_ = app::SurfaceQuantity::kNone;
  // Bodies of Viewport::setCompared() and Viewport::setStandIn().
  std::shared_ptr<const app::DrawnBody> ghostOf_, standInOf_;
};

}  // namespace palpa::gui
