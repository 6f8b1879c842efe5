#include <algorithm>
#include <cmath>
#include <limits>

#include "app/gui/base/translate.h"
#include "app/gui/document/design_edit.h"
#include "app/gui/document/design_words.h"
#include "app/gui/document/named_items.h"
#include "app/gui/properties/design_rows.h"

namespace palpa::gui {
namespace {

using modeling::DesignTarget;

constexpr double kMinWish = 1e-9, kMaxWish = 1e9;  // N, N/mm, mm and weights

/// The target with this number; a default one while it is being removed.
DesignTarget targetOf(const Editor& editor, int target) {
  const auto& design = editor.project().design;
  if (!design || target >= static_cast<int>(design->targets.size())) return {};
  return design->targets[static_cast<std::size_t>(target)];
}

bool putTarget(Editor& editor, int target, const DesignTarget& value) {
  return editDesign(editor, [&](modeling::Design& design) {
    if (target < static_cast<int>(design.targets.size()))
      design.targets[static_cast<std::size_t>(target)] = value;
  });
}

/// The same touch with another kind of value: what it feels like at present.
DesignTarget withKind(DesignTarget target, DesignTarget::Kind kind, const TouchValues& values) {
  if (target.kind == kind) return target;
  target.kind = kind;
  target.depth.reset();
  if (const auto now = values.of(target)) target.value = withFourDigits(*now);
  return target;
}

void addValueRow(PropertyPage& page, int index, DesignTarget::Kind kind) {
  Editor& editor = page.editor();
  const bool isForce = kind == DesignTarget::Kind::kForce;
  const Unit unit = targetUnit(kind, page.workspace().settings.units());
  const double factor = isForce ? 1 : unit.factor;
  QuantityEdit* edit = page.addQuantity(
      isForce ? tr("Wanted &force") : tr("Wanted stiffness, %1").arg(unit.symbol), "targetValue",
      isForce ? Quantity::kForce : Quantity::kNumber,
      [&editor, index, factor] { return targetOf(editor, index).value / factor; },
      [&editor, index, factor](double value) {
        DesignTarget target = targetOf(editor, index);
        target.value = value * factor;
        return putTarget(editor, index, target);
      });
  edit->setRange(kMinWish, kMaxWish);
  page.explain(edit, isForce
                         ? tr("Norm of the force on the body under this touch")
                         : tr("Force over deflection under this touch, as in the Forces panel"));
}

void addDepthRow(PropertyPage& page, int index) {
  Editor& editor = page.editor();
  QuantityEdit* edit = page.addQuantity(
      tr("At a &depth of"), "targetDepth", Quantity::kLength,
      [&editor, index] {
        return targetOf(editor, index).depth.value_or(std::numeric_limits<double>::quiet_NaN());
      },
      [&editor, index](double depth) {
        DesignTarget target = targetOf(editor, index);
        target.depth = std::isnan(depth) ? std::nullopt : std::optional(depth);
        return putTarget(editor, index, target);
      });
  edit->setRange(kMinWish, kMaxWish);
  const modeling::Touch* touch = findNamed(editor.project().touches, targetOf(editor, index).touch);
  const QString own = touch ? page.shownLength(touch->vector.norm()) : QString();
  edit->setOptional(tr("its own: %1").arg(own));
  page.explain(edit, tr("Length of the displacement at which the force is wanted. Empty: the depth "
                        "that is stored in the touch"));
}

}  // namespace

QString targetKey(const Editor& editor, int index) {
  if (!editor.project().design || index < 0 ||
      index >= static_cast<int>(editor.project().design->targets.size()))
    return {};
  const DesignTarget target = targetOf(editor, index);
  const ShownUnits units = editor.settings().units();
  QStringList key{QString::number(index), QString::number(static_cast<int>(target.kind)),
                  targetUnit(target.kind, units).symbol, QString::fromStdString(target.touch)};
  for (const modeling::Touch& touch : editor.project().touches) {
    key << QString::fromStdString(touch.name);
    if (touch.name == target.touch)  // the depth is in the rows
      key << shown(touch.vector.norm(), Quantity::kLength, units, 6);
  }
  return key.join('\n');
}

void addTargetRows(PropertyPage& page, int index, const TouchValues& values) {
  Editor& editor = page.editor();
  page.addSection(tr("Target %1").arg(index + 1));
  QStringList names;
  for (const modeling::Touch& touch : editor.project().touches)
    names << QString::fromStdString(touch.name);
  QComboBox* touch = page.addChoice(
      tr("&Touch"), "targetTouch", names,
      [&editor, index, names] {
        return static_cast<int>(
            names.indexOf(QString::fromStdString(targetOf(editor, index).touch)));
      },
      [&editor, &values, index, names](int chosen) {
        DesignTarget target = targetOf(editor, index);
        target.touch = names[chosen].toStdString();
        target.depth.reset();
        if (const auto now = values.of(target)) target.value = withFourDigits(*now);
        return putTarget(editor, index, target);
      });
  page.explain(touch, tr("A touch of the project; Place touch (T) adds one"));
  QComboBox* kind = page.addChoice(
      tr("Should ha&ve"), "targetKind", {tr("a stiffness"), tr("a force at a depth")},
      [&editor, index] { return static_cast<int>(targetOf(editor, index).kind); },
      [&editor, &values, index](int chosen) {
        return putTarget(
            editor, index,
            withKind(targetOf(editor, index), static_cast<DesignTarget::Kind>(chosen), values));
      });
  page.explain(kind, tr("Stiffness of the touch, or the force that it needs at a depth"));
  page.addFact(tr("Now"), "targetNow", [&page, &values, index] {
    const DesignTarget target = targetOf(page.editor(), index);
    const auto now = values.of(target);
    return now ? targetValueText(target.kind, *now, page.workspace().settings.units())
               : QString("…");
  });
  const DesignTarget::Kind kindNow = targetOf(editor, index).kind;
  addValueRow(page, index, kindNow);
  if (kindNow == DesignTarget::Kind::kForce) addDepthRow(page, index);
  QuantityEdit* weight = page.addQuantity(
      tr("&Weight"), "targetWeight", Quantity::kNumber,
      [&editor, index] { return targetOf(editor, index).weight; },
      [&editor, index](double value) {
        DesignTarget target = targetOf(editor, index);
        target.weight = value;
        return putTarget(editor, index, target);
      });
  weight->setRange(kMinWish, kMaxWish);
  page.explain(weight, tr("Counts if not all targets can be reached: a target of weight 2 is met "
                          "better than a target of weight 1"));
}

}  // namespace palpa::gui
