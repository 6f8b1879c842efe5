#include "app/gui/dialogs/export_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QStandardItemModel>

namespace palpa::gui {

using modeling::FileFormat;
using modeling::FileFormatInfo;
ExportDialog::ExportDialog(const modeling::Project& project, QWidget* parent, Subject subject)
    : QDialog(parent),
      format_(new QComboBox(this)),
      surface_(new QComboBox(this)),
      places_(new QSpinBox(this)),
      size_(new QSpinBox(this)),
      form_(new QFormLayout(this)) {
  setObjectName("export");
  setWindowTitle(subject == Subject::kBody ? tr("Export") : tr("Export deformed solid"));
  const bool isSolid = std::holds_alternative<modeling::Solid>(project.body);
  format_->setObjectName("format");
  for (const FileFormatInfo& info : modeling::kFileFormats) {
    const bool isProject = info.kind == modeling::FileKind::kProject;
    if (!info.canWrite || (isProject && subject == Subject::kBody) ||
        (isPage(info) && subject != Subject::kBody))
      continue;
    format_->addItem(QString("%1: %2").arg(info.name, tr(info.use)), static_cast<int>(info.format));
    auto* items = qobject_cast<QStandardItemModel*>(format_->model());
    items->item(format_->count() - 1)->setEnabled(isSolid || isWritableMesh(info) || isPage(info));
  }
  format_->setCurrentIndex(isSolid ? 0 : format_->findData(static_cast<int>(FileFormat::kStl)));
  surface_->setObjectName("surface");
  if (!isSolid)
    surface_->addItem(tr("The body's own triangles"),
                      static_cast<int>(ExportedSurface::kOwnTriangles));
  surface_->addItem(tr("The surface as it is drawn: fine"),
                    static_cast<int>(ExportedSurface::kDrawnSurface));
  surface_->addItem(tr("The mesh of the model: %1 mm edges").arg(project.mesh.edgeLength),
                    static_cast<int>(ExportedSurface::kModelMesh));

  using Limits = app::TouchPageSettings;
  places_->setObjectName("places");
  places_->setRange(Limits::kMinPlaces, Limits::kMaxPlaces);
  places_->setValue(Limits{}.places);
  size_->setObjectName("pageSize");
  size_->setRange(static_cast<int>(Limits::kMinSize), static_cast<int>(Limits::kMaxSize));
  size_->setValue(static_cast<int>(Limits{}.megabytes));
  size_->setSuffix(tr(" MB"));

  form_->setSizeConstraint(QLayout::SetMinimumSize);
  form_->addRow(tr("&Format:"), format_);
  form_->addRow(tr("&Triangles:"), surface_);
  form_->addRow(tr("Touch &places:"), places_);
  form_->addRow(tr("At &most:"), size_);
  auto* note = new QLabel(
      isSolid ? tr("Lengths are in mm. Supports, loads and touches stay in the project file.")
              : tr("This is a mesh body. It has no patches, so it cannot be exported as STEP, IGES "
                   "or BREP. Lengths are in mm."),
      this);
  note->setObjectName("note");
  note->setWordWrap(true);
  note->setMinimumWidth(380);
  form_->addRow(note);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Choose &file …"));
  form_->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(format_, &QComboBox::currentIndexChanged, this, &ExportDialog::update);
  update();
}

const modeling::FileFormatInfo& ExportDialog::format() const {
  return infoOf(static_cast<FileFormat>(format_->currentData().toInt()));
}

QString ExportDialog::ending() const {
  return format().endings.front();
}

QString ExportDialog::filter() const {
  return QString("%1 (*%2)").arg(format().name, ending());
}

ExportedSurface ExportDialog::surface() const {
  return static_cast<ExportedSurface>(surface_->currentData().toInt());
}

app::TouchPageSettings ExportDialog::page() const {
  app::TouchPageSettings settings;
  settings.places = places_->value();
  settings.megabytes = size_->value();
  return settings;
}

void ExportDialog::update() {
  surface_->setEnabled(isWritableMesh(format()));
  // Shown for pages alone, so that the dialog stays short.
  for (QSpinBox* each : {places_, size_}) {
    each->setVisible(isPage(format()));
    if (QWidget* label = form_->labelForField(each)) label->setVisible(isPage(format()));
  }
}

}  // namespace palpa::gui
