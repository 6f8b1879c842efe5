#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

#include "modeling/error.h"
#include "modeling/exchange/mesh_reader.h"
#include "modeling/exchange/polygon_soup.h"
#include "modeling/exchange/text_cursor.h"

namespace palpa::modeling {
namespace {

/// Names of one kind of grouping, and the current one.
struct Grouping {
  std::vector<std::string> names{""};
  std::map<std::string, int, std::less<>> numbers{{"", 0}};
  int current = 0;
  std::vector<int> ofPolygon;

  void enter(std::string_view name) {
    const auto [place, isNew] =
        numbers.try_emplace(std::string(name), static_cast<int>(names.size()));
    if (isNew) names.emplace_back(name);
    current = place->second;
  }
  bool dividesPolygons() const {
    return std::adjacent_find(ofPolygon.begin(), ofPolygon.end(), std::not_equal_to<>()) !=
           ofPolygon.end();
  }
};

class ObjText {
 public:
  ObjText(std::string_view text, const Job& job) : cursor_(text), job_(job) {}

  PolygonSoup parse() {
    while (cursor_.nextLine()) {
      if (cursor_.line() % 65536 == 0) job_.throwIfCancelled();
      statement(cursor_.word());
    }
    for (Grouping& grouping : groupings_)
      if (grouping.dividesPolygons()) {
        soup_.groups = std::move(grouping.ofPolygon);
        soup_.groupNames = std::move(grouping.names);
        break;
      }
    return std::move(soup_);
  }

 private:
  void statement(std::string_view keyword) {
    if (keyword.empty() || keyword.front() == '#') return;
    if (keyword == "v") {
      Eigen::Vector3d point;  // a weight or a colour may follow
      for (int axis = 0; axis < 3; ++axis) point[axis] = cursor_.number();
      soup_.points.push_back(point);
    } else if (keyword == "f") {
      polygon();
    } else if (keyword == "g") {
      groupings_[0].enter(cursor_.restOfLine());
    } else if (keyword == "o") {
      groupings_[1].enter(cursor_.restOfLine());
    } else if (keyword == "usemtl") {
      groupings_[2].enter(cursor_.restOfLine());
    } else if (isFreeForm(keyword)) {
      cursor_.fail("curves and free-form surfaces (" + excerpt(keyword) + ") are not supported",
                   "export the surface as polygons");
    } else if (!isIgnored(keyword)) {
      cursor_.fail(excerpt(keyword) + " is not a statement of an OBJ file");
    }
  }

  static bool isFreeForm(std::string_view keyword) {
    return keyword == "cstype" || keyword == "curv" || keyword == "surf";
  }

  static bool isIgnored(std::string_view keyword) {
    static const std::set<std::string_view> kKnown{
        "vt",     "vn",   "vp",    "s",        "p",        "l",    "mtllib",     "usemap",
        "maplib", "mg",   "bevel", "c_interp", "d_interp", "lod",  "shadow_obj", "trace_obj",
        "deg",    "bmat", "step",  "parm",     "trim",     "hole", "scrv",       "sp",
        "end",    "con",  "curv2", "ctech",    "stech"};
    return kKnown.contains(keyword);
  }

  void polygon() {
    int count = 0;
    for (std::string_view word = nextCorner(); !word.empty(); word = nextCorner()) {
      soup_.corners.push_back(corner(word));
      if (++count > kMaxPolygonCorners)
        cursor_.fail("a polygon has more than " + std::to_string(kMaxPolygonCorners) + " corners");
    }
    if (count < 3) cursor_.fail("a polygon has fewer than three corners");
    soup_.closePolygon();
    for (Grouping& grouping : groupings_) grouping.ofPolygon.push_back(grouping.current);
  }

  /// A backslash continues the polygon on the next line.
  std::string_view nextCorner() {
    std::string_view word = cursor_.word();
    while (word == "\\" && cursor_.nextLine()) word = cursor_.word();
    return word == "\\" || (!word.empty() && word.front() == '#') ? std::string_view() : word;
  }

  /// "7", "7/1", "7//3", "7/1/3"; negative numbers count back from the last point read.
  int corner(std::string_view word) const {
    const std::string_view first = word.substr(0, word.find('/'));
    long long index = 0;
    const auto [end, error] = std::from_chars(first.data(), first.data() + first.size(), index);
    if (error != std::errc() || end != first.data() + first.size())
      cursor_.fail("expected the number of a point, found " + excerpt(word));
    const auto count = static_cast<long long>(soup_.points.size());
    const long long place = index < 0 ? count + index : index - 1;
    if (index == 0 || place < 0 || place >= count)
      cursor_.fail("there is no point " + std::to_string(index) + "; the number of points up to " +
                   "this line is " + std::to_string(count));
    return static_cast<int>(place);
  }

  TextCursor cursor_;
  const Job& job_;
  PolygonSoup soup_;
  std::array<Grouping, 3> groupings_;  // g, o, usemtl
};

}  // namespace

PolygonSoup parseObj(std::string_view bytes, const Job& job) {
  return ObjText(bytes, job).parse();
}

}  // namespace palpa::modeling
