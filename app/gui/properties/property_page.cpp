#include "app/gui/properties/property_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QTimer>
#include <QVBoxLayout>
#include <utility>

#include "app/core/system/priority.h"
#include "app/gui/base/appearance.h"
#include "app/gui/document/editor.h"
#include "app/gui/widgets/vector_edit.h"

namespace palpa::gui {
namespace {

constexpr int kPatience = 300;  // ms until a value that is being computed is no longer shown

/// Removes the location in the project ("supports[0].where: …"): the message stands at its field.
QString withoutPlace(QString message) {
  static const QRegularExpression place(QStringLiteral(R"(^[a-z_0-9.\[\]]+: )"));
  message.remove(place);
  if (!message.isEmpty()) message[0] = message[0].toUpper();
  return message;
}

}  // namespace

void shrinkable(QComboBox& box) {
  box.setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box.setMinimumContentsLength(8);
  box.setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void leaveLettersToMenus(QWidget& panel) {
  static const QRegularExpression letter(QStringLiteral("&(?!&)"));
  for (QLabel* label : panel.findChildren<QLabel*>())
    if (label->buddy()) label->setText(label->text().remove(letter));
  for (QAbstractButton* button : panel.findChildren<QAbstractButton*>())
    button->setText(button->text().remove(letter));
}

PropertyPage::PropertyPage(const Workspace& workspace)
    : workspace_(workspace), form_(new QFormLayout(this)) {
  form_->setContentsMargins(12, 4, 12, 12);
  form_->setHorizontalSpacing(10);
  form_->setVerticalSpacing(6);
  form_->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
}

Editor& PropertyPage::editor() const {
  return workspace_.editor;
}

QString PropertyPage::shownLength(double length) const {
  return shown(length, Quantity::kLength, workspace_.settings.units(), 5);
}

void PropertyPage::refresh() {
  if (isRetired_) return;
  for (const auto& show : shows_) show();
}

void PropertyPage::refreshSlowValues() {
  if (isRetired_) return;
  for (const auto& show : slowShows_) show();
}

void PropertyPage::forgetTyping() {
  for (QLineEdit* edit : findChildren<QLineEdit*>()) edit->setModified(false);
  for (QLabel* label : findChildren<QLabel*>("refusal")) label->hide();
}

void PropertyPage::retire() {
  isRetired_ = true;
  for (const auto& worker : workers_) worker->cancel();
  // A field that loses the focus while it is removed would apply its input to another item.
  for (QWidget* widget : findChildren<QWidget*>()) widget->blockSignals(true);
}

bool PropertyPage::attempt(QWidget* field, const std::function<bool()>& work) {
  if (isRetired_) return false;
  QString refusal;
  const auto connection = connect(&editor(), &Editor::refused, this,
                                  [&refusal](const QString& message) { refusal = message; });
  const bool done = work();
  disconnect(connection);
  if (isRetired_) return done;  // `work` replaced the page
  for (QLabel* label : findChildren<QLabel*>("refusal")) label->hide();
  if (!done) {
    if (auto* label = field->parentWidget()->findChild<QLabel*>("refusal")) {
      label->setText(withoutPlace(refusal));
      label->show();
    }
    refresh();
  }
  return done;
}

template <class Value>
void PropertyPage::set(QWidget* field, const Set<Value>& set, const Value& value) {
  attempt(field, [&] { return set(value); });
}

void PropertyPage::addSection(const QString& title, const QString& name) {
  auto* heading = new QLabel(title, this);
  heading->setObjectName("heading");
  heading->setProperty("section", name);
  heading->setContentsMargins(0, form_->rowCount() > 0 ? 12 : 4, 0, 2);
  QFont bold = font();
  bold.setWeight(QFont::DemiBold);
  heading->setFont(bold);
  form_->addRow(heading);
}

void PropertyPage::addField(const QString& label, const QString& name, QWidget* field,
                            bool isWide) {
  field->setObjectName(name);
  field->setAccessibleName(label);
  // The label below the field shows the reason of a refusal.
  auto* cell = new QWidget(this);
  auto* column = new QVBoxLayout(cell);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  auto* text = label.isEmpty() ? nullptr : new QLabel(label, isWide ? cell : this);
  if (text) text->setBuddy(field);
  if (text && isWide) column->addWidget(text);
  field->setParent(cell);
  column->addWidget(field);
  auto* refusal = new QLabel(cell);
  refusal->setObjectName("refusal");
  refusal->setWordWrap(true);
  refusal->hide();
  column->addWidget(refusal);
  if (text && !isWide)
    form_->addRow(text, cell);
  else
    form_->addRow(cell);
}

QuantityEdit* PropertyPage::addQuantity(const QString& label, const QString& name,
                                        Quantity quantity, Get<double> get, Set<double> put) {
  auto* edit = new QuantityEdit(quantity, workspace_.settings, this);
  addField(label, name, edit);
  shows_.push_back([edit, get] { edit->setValue(get()); });
  connect(edit, &QuantityEdit::edited, this,
          [this, edit, put](double value) { set(edit, put, value); });
  return edit;
}

VectorEdit* PropertyPage::addVector(const QString& label, const QString& name, Quantity quantity,
                                    Get<Eigen::Vector3d> get, Set<Eigen::Vector3d> put) {
  auto* edit = new VectorEdit(quantity, workspace_.settings, this);
  addField(label, name, edit, true);
  shows_.push_back([edit, get] { edit->setValue(get()); });
  connect(edit, &VectorEdit::edited, this,
          [this, edit, put](const Eigen::Vector3d& value) { set(edit, put, value); });
  return edit;
}

void PropertyPage::addText(const QString& label, const QString& name, Get<QString> get,
                           Set<QString> put) {
  auto* edit = new QLineEdit(this);
  addField(label, name, edit);
  shows_.push_back([edit, get] {
    if (edit->hasFocus() && edit->isModified()) return;
    const QString text = get();
    if (edit->text() != text) edit->setText(text);
    edit->setModified(false);
  });
  connect(edit, &QLineEdit::editingFinished, this, [this, edit, put] {
    if (!edit->isModified()) return;
    edit->setModified(false);
    set(edit, put, edit->text());
  });
}

QSpinBox* PropertyPage::addCount(const QString& label, const QString& name, int least, int most,
                                 Get<int> get, Set<int> put) {
  auto* box = new QSpinBox(this);
  box->setRange(least, most);
  box->setKeyboardTracking(false);
  addField(label, name, box);
  shows_.push_back([box, get] {
    const QSignalBlocker blocker(box);
    box->setValue(get());
  });
  connect(box, &QSpinBox::valueChanged, this,
          [this, box, put](int value) { set(box, put, value); });
  return box;
}

QComboBox* PropertyPage::addChoice(const QString& label, const QString& name,
                                   const QStringList& choices, Get<int> get, Set<int> put) {
  auto* box = new QComboBox(this);
  box->addItems(choices);
  shrinkable(*box);
  addField(label, name, box);
  shows_.push_back([box, get] { box->setCurrentIndex(get()); });
  connect(box, &QComboBox::activated, this, [this, box, put](int value) { set(box, put, value); });
  return box;
}

void PropertyPage::addCheck(const QString& text, const QString& name, Get<bool> get,
                            Set<bool> put) {
  auto* box = new QCheckBox(text, this);
  addField({}, name, box);
  shows_.push_back([box, get] { box->setChecked(get()); });
  connect(box, &QCheckBox::clicked, this, [this, box, put](bool value) { set(box, put, value); });
}

QLabel* PropertyPage::makeFact(const QString& label, const QString& name) {
  auto* fact = new QLabel(this);
  fact->setObjectName(name);
  fact->setAccessibleName(label);
  fact->setWordWrap(true);
  fact->setTextInteractionFlags(Qt::TextSelectableByMouse);
  form_->addRow(label, fact);
  return fact;
}

void PropertyPage::explain(QWidget* field, const QString& tip) {
  // A field with a refused text shows the reason; otherwise Qt shows the tip of its cell.
  QWidget* cell = form_->indexOf(field) >= 0 ? field : field->parentWidget();
  cell->setToolTip(tip);
  if (QWidget* label = form_->labelForField(cell)) label->setToolTip(tip);
}

QLabel* PropertyPage::addFact(const QString& label, const QString& name, Get<QString> get) {
  QLabel* fact = makeFact(label, name);
  shows_.push_back([fact, get] { fact->setText(get()); });
  return fact;
}

void PropertyPage::addSlowFact(const QString& label, const QString& name, Get<QString> get) {
  QLabel* fact = makeFact(label, name);
  slowShows_.push_back([fact, get] { fact->setText(get()); });
}

void PropertyPage::addComputedFact(const QString& label, const QString& name,
                                   std::function<Work()> prepare) {
  QLabel* fact = makeFact(label, name);
  WorkerThread& worker =
      *workers_.emplace_back(std::make_unique<WorkerThread>(app::lowerThreadPriority));
  // Numbers of the values that were asked for and that is shown.
  struct State {
    int wanted = 0, shown = 0;
  };
  const auto state = std::make_shared<State>();
  slowShows_.push_back([fact, &worker, state, prepare = std::move(prepare)] {
    const int number = ++state->wanted;
    QTimer::singleShot(kPatience, fact, [fact, state, number] {
      if (state->wanted == number && state->shown != number) fact->setText(QStringLiteral("…"));
    });
    worker.replace([fact, state, number, work = prepare()](const std::stop_token& stop) {
      try {
        const QString text = work({stop, {}, 1});
        const auto show = [fact, state, number, text] {
          if (state->wanted != number) return;
          state->shown = number;
          fact->setText(text);
        };
        QMetaObject::invokeMethod(fact, show, Qt::QueuedConnection);
      } catch (const Cancelled&) {
        // Another value is wanted, or none.
      }
    });
  });
}

void PropertyPage::addNote(const QString& text) {
  auto* note = new QLabel(text, this);
  note->setWordWrap(true);
  note->setForegroundRole(QPalette::PlaceholderText);
  form_->addRow(note);
}

void PropertyPage::addButton(const QString& text, const QString& name, const QString& picture,
                             std::function<void()> work) {
  auto* button = new QPushButton(text, this);
  if (!picture.isEmpty()) button->setIcon(icon(picture));
  button->setAutoDefault(false);
  addField({}, name, button);
  button->setAccessibleName(QString(text).remove('&'));
  connect(button, &QPushButton::clicked, this, std::move(work));
}

}  // namespace palpa::gui
