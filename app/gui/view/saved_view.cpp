#include "app/gui/view/saved_view.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <array>
#include <cmath>

namespace palpa::gui {
namespace {

struct Toggle {
  const char* key;
  bool SavedView::*on;
};

const std::array<Toggle, 8> kToggles{{{"net", &SavedView::showsNet},
                                      {"grid", &SavedView::showsGrid},
                                      {"axes", &SavedView::showsAxes},
                                      {"cube", &SavedView::showsCube},
                                      {"conditions", &SavedView::showsConditions},
                                      {"touches", &SavedView::showsTouches},
                                      {"dimensions", &SavedView::showsDimensions},
                                      {"warnings", &SavedView::showsWarnings}}};
const std::array<const char*, 3> kShadings{"shaded", "edges", "wire"};  // as view::Shading

QJsonArray toJson(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

bool readUnit(const QJsonValue& value, Eigen::Vector3d& vector) {
  const QJsonArray numbers = value.toArray();
  if (numbers.size() != 3) return false;
  for (int k = 0; k < 3; ++k) vector[k] = numbers[k].toDouble(std::nan(""));
  const double length = vector.norm();
  if (!(std::abs(length - 1) < 0.01)) return false;
  vector /= length;
  return true;
}

}  // namespace

std::string viewText(const SavedView& view, const std::string& present) {
  QJsonObject object = QJsonDocument::fromJson(QByteArray::fromStdString(present)).object();
  object["direction"] = toJson(view.camera.direction);
  object["up"] = toJson(view.camera.up);
  object["parallel"] = view.camera.parallel;
  object["zoom"] = view.camera.zoom;
  object["shading"] = kShadings[static_cast<std::size_t>(view.shading)];
  for (const Toggle& toggle : kToggles) object[toggle.key] = view.*toggle.on;
  return QJsonDocument(object).toJson(QJsonDocument::Compact).toStdString();
}

std::optional<SavedView> viewFromText(const std::string& text) {
  const QJsonDocument document = QJsonDocument::fromJson(QByteArray::fromStdString(text));
  if (!document.isObject()) return std::nullopt;
  const QJsonObject object = document.object();
  SavedView view;
  if (!readUnit(object["direction"], view.camera.direction)) return std::nullopt;
  if (!readUnit(object["up"], view.camera.up)) return std::nullopt;
  view.camera.parallel = object["parallel"].toBool(false);
  view.camera.zoom = object["zoom"].toDouble(1);
  if (!(view.camera.zoom >= 1e-3 && view.camera.zoom <= 1e3)) return std::nullopt;
  for (std::size_t k = 0; k < kShadings.size(); ++k)
    if (object["shading"].toString() == kShadings[k]) view.shading = static_cast<view::Shading>(k);
  for (const Toggle& toggle : kToggles) view.*toggle.on = object[toggle.key].toBool(true);
  return view;
}

}  // namespace palpa::gui
