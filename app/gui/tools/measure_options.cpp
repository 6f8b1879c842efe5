#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>

#include "app/gui/document/measurement_words.h"
#include "app/gui/tools/measure_tool.h"
#include "app/gui/widgets/form_row.h"

namespace palpa::gui {

QWidget* makeMeasureOptions(MeasureTool& tool, Editor& editor, QWidget* parent) {
  auto* options = new QWidget(parent);
  auto* form = new QFormLayout(options);
  form->setContentsMargins(0, 0, 0, 0);
  auto* kind = new QComboBox(options);
  for (const modeling::MeasurementKindInfo& info : modeling::kMeasurementKinds)
    kind->addItem(kindText(info.kind));
  addFormRow(form, MeasureTool::tr("&Kind"), kind, "measureKind",
             MeasureTool::tr("What is measured (Tab)"));
  QObject::connect(kind, &QComboBox::activated, &tool, [&tool](int index) {
    tool.setKind(static_cast<modeling::MeasurementKind>(index));
  });
  auto* take = new QComboBox(options);
  take->addItems({MeasureTool::tr("Points"), MeasureTool::tr("Edges and faces")});
  addFormRow(form, MeasureTool::tr("&Between"), take, "measureBetween",
             MeasureTool::tr("What a click takes (Ctrl: the other one, for distances)"));
  QObject::connect(take, &QComboBox::activated, &tool,
                   [&tool](int index) { tool.setTakesWhole(index == 1); });
  auto* selection = new QPushButton(MeasureTool::tr("Measure &selection"), options);
  selection->setObjectName("measureSelection");
  selection->setToolTip(
      MeasureTool::tr("Measure the selected patches or edges (Enter over the view)"));
  QObject::connect(selection, &QPushButton::clicked, &tool, &MeasureTool::measureSelection);
  form->addRow(selection);
  auto* readout = new QLabel(options);
  readout->setObjectName("measureReadout");
  readout->setWordWrap(true);
  readout->setTextInteractionFlags(Qt::TextSelectableByMouse);
  // As high as the longest value, so that the panel does not jump under the pointer.
  readout->setMinimumHeight(4 * readout->fontMetrics().lineSpacing());
  readout->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  form->addRow(readout);
  const auto show = [&tool, kind, take, selection] {
    kind->setCurrentIndex(static_cast<int>(tool.kind()));
    take->setEnabled(tool.hasChoice());
    take->setCurrentIndex(tool.takesWhole() ? 1 : 0);
    selection->setEnabled(tool.canMeasureSelection());
  };
  QObject::connect(&tool, &Tool::changed, options, show);
  QObject::connect(&editor, &Editor::selectionChanged, options, show);
  const auto read = [&tool, readout] { readout->setText(tool.readout()); };
  QObject::connect(&tool, &MeasureTool::readoutChanged, options, read);
  show();
  read();
  return options;
}

}  // namespace palpa::gui
