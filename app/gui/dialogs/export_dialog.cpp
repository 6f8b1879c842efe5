#include "app/gui/dialogs/export_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QStandardItemModel>
#include <algorithm>
#include <string_view>

namespace palpa::gui {
namespace {

struct Format {
  const char* ending;
  const char* name;
  bool isCad;
};

constexpr Format kFormats[] = {
    {".json", QT_TR_NOOP("Palpa project: patches to go on modelling"), true},
    {".step", QT_TR_NOOP("STEP: exact patches, for CAD"), true},
    {".iges", QT_TR_NOOP("IGES: exact patches, for older CAD"), true},
    {".brep", QT_TR_NOOP("BREP: exact patches, OpenCASCADE"), true},
    {".stl", QT_TR_NOOP("STL: triangles, for 3D printing"), false},
    {".obj", QT_TR_NOOP("OBJ: triangles, for rendering"), false},
    {".ply", QT_TR_NOOP("PLY: triangles"), false},
    {".vtp", QT_TR_NOOP("VTP: triangles, for ParaView"), false}};

}  // namespace

ExportDialog::ExportDialog(const modeling::Project& project, QWidget* parent, Subject subject)
    : QDialog(parent), format_(new QComboBox(this)), surface_(new QComboBox(this)) {
  setObjectName("export");
  setWindowTitle(subject == Subject::kBody ? tr("Export") : tr("Export deformed solid"));
  const bool isSolid = std::holds_alternative<modeling::Solid>(project.body);
  format_->setObjectName("format");
  for (const Format& format : kFormats) {
    if (std::string_view(format.ending) == ".json" && subject == Subject::kBody) continue;
    format_->addItem(tr(format.name), QString(format.ending));
    auto* items = qobject_cast<QStandardItemModel*>(format_->model());
    items->item(format_->count() - 1)->setEnabled(isSolid || !format.isCad);
  }
  format_->setCurrentIndex(isSolid ? 0 : format_->findData(".stl"));
  surface_->setObjectName("surface");
  if (!isSolid)
    surface_->addItem(tr("The body's own triangles"),
                      static_cast<int>(ExportedSurface::kOwnTriangles));
  surface_->addItem(tr("The surface as it is drawn: fine"),
                    static_cast<int>(ExportedSurface::kDrawnSurface));
  surface_->addItem(tr("The mesh of the model: %1 mm edges").arg(project.mesh.edgeLength),
                    static_cast<int>(ExportedSurface::kModelMesh));

  auto* form = new QFormLayout(this);
  form->setSizeConstraint(QLayout::SetMinimumSize);
  form->addRow(tr("&Format:"), format_);
  form->addRow(tr("&Triangles:"), surface_);
  auto* note = new QLabel(
      isSolid ? tr("Lengths are in mm. Supports, loads and touches stay in the project file.")
              : tr("This is a mesh body. It has no patches, so it cannot be exported as STEP, IGES "
                   "or BREP. Lengths are in mm."),
      this);
  note->setObjectName("note");
  note->setWordWrap(true);
  note->setMinimumWidth(380);
  form->addRow(note);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Choose &file …"));
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(format_, &QComboBox::currentIndexChanged, this, &ExportDialog::update);
  update();
}

QString ExportDialog::ending() const {
  return format_->currentData().toString();
}

QString ExportDialog::filter() const {
  return format_->currentText().section(':', 0, 0) + " (*" + ending() + ")";
}

ExportedSurface ExportDialog::surface() const {
  return static_cast<ExportedSurface>(surface_->currentData().toInt());
}

void ExportDialog::update() {
  const auto* format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                    [this](const Format& each) { return ending() == each.ending; });
  surface_->setEnabled(!format->isCad);
}

}  // namespace palpa::gui
