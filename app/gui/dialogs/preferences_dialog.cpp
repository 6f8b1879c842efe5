#include "app/gui/dialogs/preferences_dialog.h"

#include <QDialogButtonBox>
#include <QGridLayout>
#include <QGroupBox>
#include <QVBoxLayout>

#include "app/core/model/model_cache.h"

namespace palpa::gui {
namespace {

constexpr double kMiB = 1024.0 * 1024.0, kGiB = 1024.0 * kMiB;

}  // namespace

PreferencesDialog::PreferencesDialog(Settings& settings, QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      themeBefore_(settings.theme()),
      theme_(new QComboBox(this)) {
  setObjectName("preferences");
  setWindowTitle(tr("Preferences"));
  theme_->setObjectName("theme");
  theme_->addItem(tr("Light"), static_cast<int>(Theme::kLight));
  theme_->addItem(tr("Dark"), static_cast<int>(Theme::kDark));
  theme_->setCurrentIndex(theme_->findData(static_cast<int>(themeBefore_)));
  connect(theme_, &QComboBox::currentIndexChanged, this,
          [this] { settings_.setTheme(static_cast<Theme>(theme_->currentData().toInt())); });
  auto* look = new QGroupBox(tr("Appearance"), this);
  auto* form = new QFormLayout(look);
  form->addRow(tr("&Theme:"), theme_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  connect(buttons, &QDialogButtonBox::accepted, this, &PreferencesDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &PreferencesDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->addWidget(look);
  column->addWidget(makeUnits());
  column->addWidget(makeLimits());
  column->addStretch(1);
  column->addWidget(buttons);
  setMinimumWidth(440);
}

QWidget* PreferencesDialog::makeUnits() {
  auto* group = new QGroupBox(tr("Units"), this);
  // In two columns, so that the dialog fits a small screen.
  auto* grid = new QGridLayout(group);
  int count = 0;
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    const QuantityInfo& quantity = quantities()[i];
    if (quantity.label.isEmpty()) continue;
    units_[i] = new QComboBox(group);
    units_[i]->setObjectName(quantity.key);
    for (const Unit& unit : quantity.units) units_[i]->addItem(unit.symbol);
    units_[i]->setCurrentIndex(settings_.units().chosen[i]);
    auto* label = new QLabel(quantity.label, group);
    label->setBuddy(units_[i]);
    const int row = count / 2, column = 2 * (count % 2);
    grid->addWidget(label, row, column);
    grid->addWidget(units_[i], row, column + 1);
    ++count;
  }
  for (const int column : {1, 3}) grid->setColumnStretch(column, 1);
  grid->setHorizontalSpacing(12);
  auto* note = new QLabel(tr("Project files are always in mm, N and MPa."), group);
  note->setForegroundRole(QPalette::PlaceholderText);
  grid->addWidget(note, (count + 1) / 2, 0, 1, 4);
  return group;
}

QDoubleSpinBox* PreferencesDialog::makeSizeField(const QString& name, double value,
                                                 const QString& special) {
  auto* field = new QDoubleSpinBox(this);
  field->setObjectName(name);
  field->setRange(0, 100000);
  field->setDecimals(1);
  field->setSuffix(tr(" GiB"));
  field->setSpecialValueText(special);
  field->setValue(value);
  return field;
}

QWidget* PreferencesDialog::makeLimits() {
  auto* group = new QGroupBox(tr("Model and files"), this);
  auto* form = new QFormLayout(group);
  threads_ = new QSpinBox(group);
  threads_->setObjectName("threads");
  threads_->setRange(0, 1024);
  threads_->setSpecialValueText(tr("all cores"));
  threads_->setValue(settings_.threads());
  memory_ = makeSizeField("memory", settings_.memoryLimitGiB(), tr("most of the free memory"));
  autosave_ = new QSpinBox(group);
  autosave_->setObjectName("autosave");
  autosave_->setRange(5, 86400);
  autosave_->setSuffix(tr(" s after an edit"));
  autosave_->setValue(settings_.autosaveSeconds());
  form->addRow(tr("Th&reads:"), threads_);
  form->addRow(tr("&Memory of a model:"), memory_);
  QWidget* cacheRow = makeCacheRow();
  form->addRow(tr("&Cache on disk:"), cacheRow);
  static_cast<QLabel*>(form->labelForField(cacheRow))->setBuddy(cache_);
  form->addRow(tr("Sna&pshot for recovery:"), autosave_);
  auto* note = new QLabel(tr("Threads and memory hold for projects opened from now on."), group);
  note->setForegroundRole(QPalette::PlaceholderText);
  form->addRow(note);
  return group;
}

QWidget* PreferencesDialog::makeCacheRow() {
  auto* row = new QWidget(this);
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  cache_ = makeSizeField("cache", settings_.cacheLimitGiB(), tr("no cache"));
  cache_->setToolTip(
      tr("Solved models are kept up to this size, so that a project that is opened "
         "again can be touched at once"));
  cacheSize_ = new QLabel(row);
  cacheSize_->setObjectName("cacheSize");
  clearCache_ = new QPushButton(tr("C&lear"), row);
  clearCache_->setObjectName("clearCache");
  clearCache_->setToolTip(tr("Delete all stored models; projects are not touched"));
  connect(clearCache_, &QPushButton::clicked, this, [this] {
    app::ModelCache(app::defaultCacheFolder(), settings_.cacheLimitGiB() * kGiB).clear();
    showCacheSize();
  });
  line->addWidget(cache_, 1);
  line->addWidget(cacheSize_);
  line->addWidget(clearCache_);
  showCacheSize();
  return row;
}

void PreferencesDialog::showCacheSize() {
  const std::filesystem::path folder = app::defaultCacheFolder();
  const double bytes = folder.empty() ? 0 : app::ModelCache(folder, 0).size();
  cacheSize_->setText(tr("%L1 MiB used").arg(bytes / kMiB, 0, 'f', 0));
  clearCache_->setEnabled(bytes > 0);
}

void PreferencesDialog::accept() {
  ShownUnits units = settings_.units();
  for (std::size_t i = 0; i < kQuantityCount; ++i)
    if (units_[i]) units.chosen[i] = units_[i]->currentIndex();
  settings_.setUnits(units);
  settings_.setThreads(threads_->value());
  settings_.setMemoryLimitGiB(memory_->value());
  settings_.setCacheLimitGiB(cache_->value());
  settings_.setAutosaveSeconds(autosave_->value());
  QDialog::accept();
}

void PreferencesDialog::reject() {
  settings_.setTheme(themeBefore_);
  QDialog::reject();
}

}  // namespace palpa::gui
