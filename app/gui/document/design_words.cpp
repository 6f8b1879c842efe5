#include "app/gui/document/design_words.h"

#include <QRegularExpression>
#include <QStringList>
#include <cmath>

#include "app/gui/base/overloaded.h"
#include "app/gui/base/translate.h"

namespace palpa::gui {
namespace {

using modeling::DesignTarget;
using modeling::PointSelection;

constexpr std::size_t kMaxPatchNames = 4;  // in a line

QString namesText(const std::vector<std::string>& names) {
  QStringList shown;
  for (std::size_t i = 0; i < names.size() && i < kMaxPatchNames; ++i)
    shown << QString::fromStdString(names[i]);
  if (names.size() > kMaxPatchNames)
    shown << tr("%n more", nullptr, static_cast<int>(names.size() - kMaxPatchNames));
  return shown.join(", ");
}

QString partsText(const PointSelection& selection);

QString partText(const PointSelection::Part& part) {
  return std::visit(Overloaded{[](const modeling::PointIndices& one) {
                                 return one.indices.size() == 1
                                            ? tr("a point by number")
                                            : tr("%1 points by number").arg(one.indices.size());
                               },
                               [](const modeling::PatchPoints& one) {
                                 return tr("patches %1").arg(namesText(one.patches));
                               },
                               [](const modeling::SidePoints& one) {
                                 return tr("a side of %1").arg(QString::fromStdString(one.patch));
                               },
                               [](const modeling::NetPoints& one) {
                                 return tr("a row of %1").arg(QString::fromStdString(one.patch));
                               },
                               [](const modeling::SlabPoints&) { return tr("a half space"); },
                               [](const modeling::BoxPoints&) { return tr("a box"); },
                               [](const modeling::BallPoints&) { return tr("a ball"); },
                               [](const modeling::AllOf& one) {
                                 QStringList texts;
                                 for (const PointSelection& inner : one.selections)
                                   texts << partsText(inner);
                                 return tr("the common points of %1").arg(texts.join(tr(" and ")));
                               },
                               [](const modeling::NoneOf& one) {
                                 QStringList texts;
                                 for (const PointSelection& inner : one.selections)
                                   texts << partsText(inner);
                                 return tr("all but %1").arg(texts.join(", "));
                               }},
                    part);
}

QString partsText(const PointSelection& selection) {
  QStringList texts;
  for (const PointSelection::Part& part : selection.parts) texts << partText(part);
  return texts.join("; ");
}

QString fieldText(const QString& key) {
  if (key == "touch") return tr("touch");
  if (key == "force_N") return tr("force");
  if (key == "stiffness_N_per_mm") return tr("stiffness");
  if (key == "depth_mm") return tr("depth");
  if (key == "weight") return tr("weight");
  if (key == "along") return tr("Direction");
  if (key == "largest_movement_mm") return tr("Largest movement");
  if (key.startsWith("mirrors")) return tr("Mirror planes");
  if (key.startsWith("points")) return tr("Points");
  if (key == "smallest_thickness_mm") return tr("Smallest thickness");
  return {};
}

}  // namespace

Unit targetUnit(DesignTarget::Kind kind, const ShownUnits& units) {
  return shownUnit(kind == DesignTarget::Kind::kForce ? "N" : "N/mm", units);
}

QString targetNumberText(DesignTarget::Kind kind, double value, const ShownUnits& units,
                         int digits) {
  return QString::number(value / targetUnit(kind, units).factor, 'g', digits);
}

QString targetValueText(DesignTarget::Kind kind, double value, const ShownUnits& units,
                        int digits) {
  return targetNumberText(kind, value, units, digits) + " " + targetUnit(kind, units).symbol;
}

QString wantedText(const DesignTarget& target, const ShownUnits& units) {
  const QString value = targetValueText(target.kind, target.value, units, 6);
  return target.depth ? tr("%1 at %2").arg(value, shown(*target.depth, Quantity::kLength, units, 4))
                      : value;
}

QString pointsText(const std::optional<PointSelection>& points) {
  if (!points) return tr("All outside patches that supports fix");
  QString text = partsText(*points);
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

QString limitsText(const std::vector<app::ShapeLimit>& limits) {
  QStringList texts;
  for (const app::ShapeLimit& limit : limits) texts << QString::fromStdString(limit.text);
  return texts.join("; ");
}

QString sentence(QString text) {
  if (text.isEmpty()) return text;
  text[0] = text[0].toUpper();
  if (!text.endsWith('.')) text += '.';
  return text;
}

QString designProblem(const QString& message, const modeling::Design& design) {
  static const QRegularExpression path(QStringLiteral(R"(^design\.([a-zA-Z_0-9.\[\]]+): )")),
      target(QStringLiteral(R"(^targets\[(\d+)\](?:\.(\w+))?$)"));
  const QRegularExpressionMatch found = path.match(message);
  if (!found.hasMatch()) return sentence(message);
  const QString rest = message.mid(found.capturedLength());
  const QString key = found.captured(1);
  QString place = fieldText(key);
  if (const auto of = target.match(key); of.hasMatch()) {
    const int index = of.captured(1).toInt();
    const bool isKnown = index < static_cast<int>(design.targets.size());
    place = tr("Target %1").arg(index + 1);
    if (isKnown)
      place += tr(" (%1)").arg(
          QString::fromStdString(design.targets[static_cast<std::size_t>(index)].touch));
    if (const QString field = fieldText(of.captured(2)); !field.isEmpty()) place += ", " + field;
  }
  return place.isEmpty() ? sentence(rest) : sentence(place + ": " + rest);
}

}  // namespace palpa::gui
