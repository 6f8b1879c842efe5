#include "app/gui/dialogs/import_dialog.h"

#include <QDialogButtonBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/widgets/form_row.h"

namespace palpa::gui {
namespace {

constexpr double kMinImportScale = 1e-6;
constexpr double kMaxImportScale = 1e6;

/// As modeling::sizeText(), in the unit of the preferences.
QString sizeShown(const Eigen::Vector3d& size, const ShownUnits& units) {
  const Unit& unit = units.of(Quantity::kLength);
  return QString::fromStdString(modeling::sizeText(size / unit.factor)).replace("mm", unit.symbol);
}

QString upText(modeling::UpAxis up) {
  switch (up) {
    case modeling::UpAxis::kX:
      return ImportDialog::tr("+x becomes up");
    case modeling::UpAxis::kMinusX:
      return ImportDialog::tr("−x becomes up");
    case modeling::UpAxis::kY:
      return ImportDialog::tr("+y becomes up");
    case modeling::UpAxis::kMinusY:
      return ImportDialog::tr("−y becomes up");
    case modeling::UpAxis::kZ:
      return ImportDialog::tr("+z, as in the file");
    case modeling::UpAxis::kMinusZ:
      return ImportDialog::tr("−z becomes up");
  }
  return {};
}

}  // namespace

ImportDialog::ImportDialog(Settings& settings, const QString& file, modeling::FileBodies found,
                           QWidget* parent)
    : QDialog(parent),
      settings_(settings),
      found_(std::move(found)),
      solids_(new QTreeWidget(this)),
      unit_(new QComboBox(this)),
      scale_(new QuantityEdit(Quantity::kNumber, settings, this)),
      up_(new QComboBox(this)),
      result_(new QLabel(this)),
      problem_(new QLabel(this)),
      preview_(new BodiesPreview(this)) {
  setObjectName("import");
  setWindowTitle(tr("Import: %1").arg(QFileInfo(file).fileName()));
  preview_->setMinimumSize(280, 240);
  auto* row = new QHBoxLayout;
  row->addWidget(makeForm(), 1);
  row->addWidget(preview_, 1);
  auto* column = new QVBoxLayout(this);
  column->addLayout(row, 1);
  column->addWidget(makeButtons());
  connect(solids_, &QTreeWidget::currentItemChanged, this, &ImportDialog::showCurrent);
  connect(solids_, &QTreeWidget::itemDoubleClicked, this, &ImportDialog::accept);
  connect(unit_, &QComboBox::currentIndexChanged, this, &ImportDialog::place);
  connect(scale_, &QuantityEdit::edited, this, &ImportDialog::place);
  connect(up_, &QComboBox::currentIndexChanged, this, &ImportDialog::place);
  connect(preview_, &BodiesPreview::picked, this,
          [this](int body) { solids_->setCurrentItem(solids_->topLevelItem(body)); });
  resize(900, 480);
  place();
  solids_->setCurrentItem(solids_->topLevelItem(0));
  solids_->setFocus();
}

QWidget* ImportDialog::makeForm() {
  const bool isMesh = found_.bodies.front().faces == 0;
  solids_->setObjectName("solids");
  solids_->setAccessibleName(tr("Solids"));
  solids_->setRootIsDecorated(false);
  solids_->setAllColumnsShowFocus(true);
  solids_->setUniformRowHeights(true);
  solids_->setColumnCount(kColumns);
  solids_->setHeaderLabels({"#", tr("Solid"), tr("Size"), isMesh ? tr("Triangles") : tr("Faces")});
  solids_->headerItem()->setTextAlignment(kParts, Qt::AlignRight | Qt::AlignVCenter);
  // Long names are elided; sizes are always visible.
  solids_->header()->setStretchLastSection(false);
  solids_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  solids_->header()->setSectionResizeMode(kName, QHeaderView::Stretch);
  for (std::size_t i = 0; i < found_.bodies.size(); ++i) {
    const modeling::FileBody& body = found_.bodies[i];
    auto* item = new QTreeWidgetItem(solids_);
    item->setText(kNumber, QString::number(i + 1));
    item->setText(kName, QString::fromStdString(body.name));
    item->setToolTip(kName, item->text(kName));
    item->setText(kParts, QLocale::c().toString(isMesh ? body.triangles : body.faces));
    item->setTextAlignment(kParts, Qt::AlignRight | Qt::AlignVCenter);
  }
  addUnits();
  scale_->setRange(kMinImportScale, kMaxImportScale);
  scale_->setValue(1.0);
  for (std::size_t i = 0; i < modeling::kUpAxisNames.size(); ++i)
    up_->addItem(upText(static_cast<modeling::UpAxis>(i)));
  up_->setCurrentIndex(static_cast<int>(modeling::UpAxis::kZ));
  auto* form = new QFormLayout;
  addFormRow(form, tr("&Unit:"), unit_, "unit", tr("What a length of 1 in the file means"));
  addFormRow(form, tr("&Scale:"), scale_, "scale", tr("Factor for all lengths"));
  addFormRow(form, tr("U&p:"), up_, "up", tr("Axis of the file that becomes +z"));
  result_->setObjectName("result");
  problem_->setObjectName("problem");
  problem_->setWordWrap(true);
  auto* page = new QWidget(this);
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(solids_, 1);
  column->addLayout(form);
  column->addWidget(result_);
  column->addWidget(problem_);
  return page;
}

void ImportDialog::addUnits() {
  if (found_.statesUnit)
    unit_->addItem(found_.unit > 0.0
                       ? tr("%1, as in the file")
                             .arg(QString::fromStdString(modeling::lengthUnitText(found_.unit)))
                       : tr("Several, as in the file"),
                   0.0);
  unit_->setEnabled(found_.unit > 0.0);
  for (const modeling::LengthUnit& unit : modeling::kLengthUnits)
    unit_->addItem(unit.name, unit.mm);
}

QWidget* ImportDialog::makeButtons() {
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Ok)->setText(tr("&Import"));
  connect(buttons, &QDialogButtonBox::accepted, this, &ImportDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &ImportDialog::reject);
  if (found_.bodies.size() > 1) {
    QPushButton* all = buttons->addButton(tr("Import &all %1 …").arg(found_.bodies.size()),
                                          QDialogButtonBox::ActionRole);
    all->setObjectName("all");
    all->setAutoDefault(false);
    all->setToolTip(tr("Write a project file for each solid and open the selected one"));
    connect(all, &QPushButton::clicked, this, [this] {
      takesAll_ = true;
      accept();
    });
  }
  return buttons;
}

modeling::ImportPlacement ImportDialog::placement() const {
  return {unit_->currentData().toDouble(), scale_->value(),
          static_cast<modeling::UpAxis>(up_->currentIndex())};
}

std::size_t ImportDialog::current() const {
  return static_cast<std::size_t>(
      std::max(0, solids_->indexOfTopLevelItem(solids_->currentItem())));
}

modeling::ImportOptions ImportDialog::options() const {
  modeling::ImportOptions options;
  options.solid = std::to_string(current() + 1);
  options.placement = placement();
  return options;
}

void ImportDialog::place() {
  placed_ = found_;
  const modeling::ImportPlacement by = placement();
  modeling::place(placed_, by.factor(found_.unit), by.up);
  for (std::size_t i = 0; i < placed_.bodies.size(); ++i)
    solids_->topLevelItem(static_cast<int>(i))
        ->setText(kSize, sizeShown(placed_.bodies[i].size(), settings_.units()));
  preview_->showBodies(placed_);
  showCurrent();
}

void ImportDialog::showCurrent() {
  const modeling::FileBody& body = placed_.bodies[current()];
  result_->setText(tr("Size: %1").arg(sizeShown(body.size(), settings_.units())));
  problem_->setText(QString::fromStdString(modeling::sizeWarning(body.size())));
  preview_->mark(current());
}

}  // namespace palpa::gui
