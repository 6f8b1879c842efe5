#include <QHBoxLayout>
#include <QLabel>

#include "app/gui/dialogs/import_profile_dialog.h"
#include "app/gui/dialogs/new_solid_dialog.h"
#include "app/gui/dialogs/primitive_kinds.h"
#include "app/gui/dialogs/profile_dialog.h"
#include "modeling/shapes/shape_sketch.h"

// The row of NewSolidDialog in which profiles are chosen, drawn and imported.

namespace palpa::gui {

void NewSolidDialog::addProfileRow() {
  profile_ = new QComboBox(this);
  profile_->setObjectName("profile");
  for (const auto& profile : primitiveKind(shownKind_).profiles) profile_->addItem(profile.title);
  profile_->addItem(tr("From a file …"));
  // An existing shape may have any profile.
  if (!kinds_->isVisibleTo(this)) {
    profile_->insertItem(0, tr("As it is"));
    profile_->setCurrentIndex(0);
    ownShape_ = primitive_.shape;
  }
  editProfile_ = new QPushButton(tr("&Edit …"), this);
  editProfile_->setObjectName("editProfile");
  editProfile_->setToolTip(tr("Draw and edit the curve, or import it from an SVG or DXF file"));
  editProfile_->setAutoDefault(false);
  connect(editProfile_, &QPushButton::clicked, this, &NewSolidDialog::editProfile);
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(profile_, 1);
  layout->addWidget(editProfile_);
  form_->insertRow(0, tr("&Profile:"), row);
  qobject_cast<QLabel*>(form_->labelForField(row))->setBuddy(profile_);
  connect(profile_, &QComboBox::activated, this, &NewSolidDialog::chooseProfile);
}

void NewSolidDialog::editProfile() {
  readFields();
  ProfileDialog dialog(settings_, primitive_, this);
  if (dialog.exec() == QDialog::Accepted) setProfile(dialog.primitive());
}

void NewSolidDialog::setProfile(const modeling::Primitive& primitive) {
  primitive_ = primitive;
  // The list names it, so that its examples can be chosen again.
  if (ownShape_)
    profile_->setItemText(0, tr("Own profile"));
  else
    profile_->insertItem(0, tr("Own profile"));
  profile_->setCurrentIndex(0);
  ownShape_ = primitive_.shape;
  preview_->lookAgain();
  update();
}

void NewSolidDialog::chooseProfile(int index) {
  const auto& profiles = primitiveKind(shownKind_).profiles;
  const int first = profile_->count() - 1 - static_cast<int>(profiles.size());
  if (index == profile_->count() - 1) {
    try {
      const auto sections = importSections(settings_, modeling::sketchUseOf(primitive_), *this);
      if (!sections) return;
      readFields();
      setProfile(modeling::withSections(primitive_, *sections));
    } catch (const std::exception& error) {
      showProblem(QString::fromStdString(error.what()));
    }
    return;
  }
  if (index >= first)
    primitive_.shape = profiles[static_cast<std::size_t>(index - first)].shape;
  else if (ownShape_)
    primitive_.shape = *ownShape_;
  preview_->lookAgain();
  showLengths();
  update();
}

}  // namespace palpa::gui
