#include "app/gui/document/own_materials.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>
#include <cmath>

namespace palpa::gui {
namespace {

using modeling::LibraryMaterial;

/// With the keys of resources/materials.json.
QJsonObject materialToJson(const LibraryMaterial& own) {
  const auto& [name, youngsModulus, poissonRatio, density] = own.material;
  QJsonObject object{{"name", QString::fromStdString(name)},
                     {"youngs_modulus_MPa", youngsModulus},
                     {"poisson_ratio", poissonRatio}};
  if (density) object["density_kg_per_m3"] = *density;
  if (!own.note.empty()) object["note"] = QString::fromStdString(own.note);
  return object;
}

bool isUsable(const modeling::Material& material) {
  const auto& [name, youngsModulus, poissonRatio, density] = material;
  const auto isPositive = [](double value) { return std::isfinite(value) && value > 0; };
  return !name.empty() && isPositive(youngsModulus) && poissonRatio > -1 && poissonRatio <= 0.5 &&
         (!density || isPositive(*density));
}

LibraryMaterial materialFromJson(const QJsonObject& object) {
  LibraryMaterial own;
  auto& [name, youngsModulus, poissonRatio, density] = own.material;
  name = object["name"].toString().trimmed().toStdString();
  youngsModulus = object["youngs_modulus_MPa"].toDouble();
  poissonRatio = object["poisson_ratio"].toDouble(-1);
  if (object.contains("density_kg_per_m3")) density = object["density_kg_per_m3"].toDouble();
  own.note = object["note"].toString().toStdString();
  return own;
}

/// By letters, as people read lists.
bool isBeforeByName(const LibraryMaterial& a, const LibraryMaterial& b) {
  const auto name = [](const LibraryMaterial& own) {
    return QString::fromStdString(own.material.name);
  };
  const int order = name(a).compare(name(b), Qt::CaseInsensitive);
  return order != 0 ? order < 0 : a.material.name < b.material.name;
}

}  // namespace

OwnMaterials::OwnMaterials(Settings& settings) : settings_(settings) {
  for (const QJsonValue& value : QJsonDocument::fromJson(settings.ownMaterials()).array()) {
    LibraryMaterial own = materialFromJson(value.toObject());
    if (isUsable(own.material) && !find(own.material.name)) list_.push_back(std::move(own));
  }
  std::sort(list_.begin(), list_.end(), isBeforeByName);
}

const LibraryMaterial* OwnMaterials::find(const std::string& name) const {
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const LibraryMaterial& own) {
    return own.material.name == name;
  });
  return found == list_.end() ? nullptr : &*found;
}

void OwnMaterials::put(LibraryMaterial material) {
  std::erase_if(list_, [&](const LibraryMaterial& own) {
    return own.material.name == material.material.name;
  });
  list_.push_back(std::move(material));
  store();
}

bool OwnMaterials::rename(const std::string& from, const std::string& to) {
  if (to.empty() || !find(from)) return false;
  if (to == from) return true;
  if (find(to) || isOfLibrary(to)) return false;
  for (LibraryMaterial& own : list_)
    if (own.material.name == from) own.material.name = to;
  store();
  return true;
}

void OwnMaterials::remove(const std::string& name) {
  if (std::erase_if(list_, [&](const LibraryMaterial& own) { return own.material.name == name; }))
    store();
}

void OwnMaterials::store() {
  std::sort(list_.begin(), list_.end(), isBeforeByName);
  QJsonArray array;
  for (const LibraryMaterial& own : list_) array.append(materialToJson(own));
  settings_.setOwnMaterials(QJsonDocument(array).toJson(QJsonDocument::Compact));
}

bool isOfLibrary(const std::string& name) {
  const auto& library = modeling::materialLibrary();
  return std::any_of(library.begin(), library.end(),
                     [&](const LibraryMaterial& each) { return each.material.name == name; });
}

const LibraryMaterial& similarWithDensity(const modeling::Material& material) {
  const LibraryMaterial* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const LibraryMaterial& each : modeling::materialLibrary()) {
    if (!each.material.densityKgPerM3) continue;
    if (each.material.name == material.name) return each;
    const double distance =
        std::abs(std::log(each.material.youngsModulus / material.youngsModulus));
    if (distance >= least) continue;
    least = distance;
    best = &each;
  }
  return *best;
}

}  // namespace palpa::gui
