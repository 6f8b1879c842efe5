#include "modeling/project/profile_file.h"

#include <algorithm>
#include <initializer_list>

#include "modeling/error.h"
#include "modeling/project/json_guard.h"
#include "modeling/project/text_file.h"

namespace palpa::modeling {
namespace {

using nlohmann::json;

constexpr JsonLimits kLimits{kMaxProfileFile, 20'000, 8};

/// A value of a document together with its place, for messages.
class Place {
 public:
  Place(const json& value, std::string source, std::string path)
      : value_(value), source_(std::move(source)), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw ModelingError(source_ + ": " + (path_.empty() ? "" : path_ + ": ") + what);
  }

  /// The member with this key; `keys` lists all that the object may have.
  Place member(const char* key, std::initializer_list<const char*> keys) const {
    if (!value_.is_object()) fail(found() + ", expected an object");
    for (const auto& item : value_.items())
      if (std::find(keys.begin(), keys.end(), item.key()) == keys.end())
        Place(item.value(), source_, joinPath(path_, item.key())).fail("unknown key");
    if (!value_.contains(key)) fail(std::string("the key \"") + key + "\" is missing");
    return {value_[key], source_, joinPath(path_, key)};
  }

  std::vector<Place> elements() const {
    if (!value_.is_array()) fail(found() + ", expected a list");
    std::vector<Place> result;
    for (std::size_t i = 0; i < value_.size(); ++i)
      result.emplace_back(value_[i], source_, joinPath(path_, i));
    return result;
  }

  double number() const {
    if (!value_.is_number()) fail(found() + ", expected a number");
    return value_.get<double>();
  }

  int integer(int low, int high) const {
    const std::string expected =
        ", expected a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    if (!value_.is_number_integer()) fail(found() + expected);
    const double whole = value_.get<double>();
    if (whole < low || whole > high) fail(found() + expected);
    return value_.get<int>();
  }

 private:
  std::string found() const {
    if (value_.is_object()) return "found an object";
    if (value_.is_array()) return "found a list";
    return "found " + value_.dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 60);
  }

  const json& value_;
  std::string source_;
  std::string path_;
};

ProfileCurve curveFrom(const Place& place) {
  const auto member = [&](const char* key) {
    return place.member(key, {"degree", "knots", "points_mm"});
  };
  ProfileCurve curve;
  curve.degree = member("degree").integer(1, 5);
  for (const Place& knot : member("knots").elements()) curve.knots.push_back(knot.number());
  for (const Place& point : member("points_mm").elements()) {
    const std::vector<Place> coordinates = point.elements();
    if (coordinates.size() != 2)
      point.fail("found " + std::to_string(coordinates.size()) + " numbers, expected 2");
    curve.points.emplace_back(coordinates[0].number(), coordinates[1].number());
  }
  return curve;
}

json parseFile(const std::filesystem::path& path) {
  return parseGuarded(readTextFile(path, kMaxProfileFile), path.string(), kLimits);
}

}  // namespace

ProfileCurve readProfileCurve(const std::filesystem::path& path) {
  const json document = parseFile(path);
  return curveFrom(Place(document, path.string(), ""));
}

std::vector<LoftShape::Section> readSections(const std::filesystem::path& path) {
  const json document = parseFile(path);
  std::vector<LoftShape::Section> sections;
  for (const Place& place : Place(document, path.string(), "").elements()) {
    const auto member = [&](const char* key) { return place.member(key, {"z_mm", "profile"}); };
    const double z = member("z_mm").number();
    sections.push_back({z, curveFrom(member("profile"))});
  }
  return sections;
}

}  // namespace palpa::modeling
