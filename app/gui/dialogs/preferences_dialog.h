#pragma once

#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <array>

#include "app/gui/base/settings.h"

namespace palpa::gui {

/// Theme, units and limits. The theme changes immediately as a preview, everything else with OK.
/// Cancel restores the theme.
class PreferencesDialog : public QDialog {
  Q_OBJECT

 public:
  PreferencesDialog(Settings& settings, QWidget* parent);

 public Q_SLOTS:
  void accept() override;
  void reject() override;

 private:
  QWidget* makeUnits();
  QWidget* makeLimits();
  QWidget* makeCacheRow();
  void showCacheSize();
  QDoubleSpinBox* makeSizeField(const QString& name, double value, const QString& special);

  Settings& settings_;
  Theme themeBefore_;
  QComboBox* theme_;
  std::array<QComboBox*, kQuantityCount> units_{};  // null without a choice
  QSpinBox* threads_ = nullptr;
  QDoubleSpinBox* memory_ = nullptr;
  QDoubleSpinBox* cache_ = nullptr;
  QLabel* cacheSize_ = nullptr;
  QPushButton* clearCache_ = nullptr;
  QSpinBox* autosave_ = nullptr;
};

}  // namespace palpa::gui
