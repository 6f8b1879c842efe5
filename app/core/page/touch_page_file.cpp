#include "app/core/page/touch_page_file.h"

#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace palpa::app {

// Made by CMake from resources/page.
extern const char* const kPageHtml;
extern const char* const kPageStyle;
extern const char* const kPageNumbers;
extern const char* const kPageAlgebra;
extern const char* const kPageModel;
extern const char* const kPageView;
extern const char* const kPageReadout;
extern const char* const kPageSelfTest;
extern const char* const kPageScript;

namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "pages store little-endian numbers");

/// Arrays of numbers, one after the other, and where each begins.
class Blocks {
 public:
  template <class Value>
  void add(const char* name, const char* type, const Value* values, std::size_t count) {
    constexpr std::size_t kAlignment = 4;
    bytes_.resize((bytes_.size() + kAlignment - 1) / kAlignment * kAlignment);
    const std::size_t size = count * sizeof(Value);
    index_[name] = {{"type", type}, {"at", bytes_.size()}, {"bytes", size}};
    bytes_.append(reinterpret_cast<const char*>(values), size);
  }
  const std::string& bytes() const { return bytes_; }
  const Json& index() const { return index_; }

 private:
  std::string bytes_;
  Json index_;
};

template <class Rows>
const auto* numbersOf(const Rows& rows) {
  return rows.data()->data();
}

Blocks blocksOf(const TouchPage& page) {
  Blocks blocks;
  const std::size_t vertices = page.positions.size();
  blocks.add("positions", "f32", numbersOf(page.positions), 3 * vertices);
  blocks.add("normals", "f32", numbersOf(page.normals), 3 * vertices);
  blocks.add("loaded", "f32", numbersOf(page.loaded), 3 * vertices);
  blocks.add("meanLoaded", "f32", numbersOf(page.meanLoaded), 3 * vertices);
  blocks.add("meanLoadedAtEdges", "f32", numbersOf(page.meanLoadedAtEdges),
             3 * page.meanLoadedAtEdges.size());
  blocks.add("meanLoadedAtMiddles", "f32", numbersOf(page.meanLoadedAtMiddles),
             3 * page.triangles.size());
  blocks.add("own", "f32", numbersOf(page.own), 6 * vertices);
  blocks.add("ownAtEdges", "f32", numbersOf(page.ownAtEdges), 6 * page.ownAtEdges.size());
  blocks.add("ownAtMiddles", "f32", numbersOf(page.ownAtMiddles), 6 * page.triangles.size());
  blocks.add("forceErrors", "f32", page.forceErrors.data(), page.forceErrors.size());
  blocks.add("triangles", "u16", numbersOf(page.triangles), 3 * page.triangles.size());
  blocks.add("edges", "u16", numbersOf(page.edges), 3 * page.edges.size());
  blocks.add("modelErrors", "f32", page.modelErrors.data(), page.modelErrors.size());
  blocks.add("touchable", "u8", page.isTouchable.data(), page.isTouchable.size());
  blocks.add("places", "u16", page.places.data(), page.places.size());
  std::vector<std::uint16_t> weightPlaces;
  std::vector<std::int16_t> weights;
  std::vector<float> weightScales;
  for (const PlaceWeights& each : page.weights) {
    weightPlaces.insert(weightPlaces.end(), each.places.begin(), each.places.end());
    weights.insert(weights.end(), each.numbers.begin(), each.numbers.end());
    weightScales.push_back(each.scale);
  }
  blocks.add("weightPlaces", "u16", weightPlaces.data(), weightPlaces.size());
  blocks.add("weights", "i16", weights.data(), weights.size());
  blocks.add("weightScales", "f32", weightScales.data(), weightScales.size());
  blocks.add("nodes", "u16", numbersOf(page.nodes), 3 * vertices);
  blocks.add("nodeWeights", "f32", numbersOf(page.nodeWeights), 3 * vertices);
  blocks.add("couplingScales", "f32", page.coupling.scales.data(), page.coupling.scales.size());
  blocks.add("couplings", "i16", page.coupling.numbers.data(), page.coupling.numbers.size());
  blocks.add("fieldScales", "f32", page.fields.scales.data(), page.fields.scales.size());
  blocks.add("fields", "i16", page.fields.numbers.data(), page.fields.numbers.size());
  return blocks;
}

void replace(std::string& text, std::string_view mark, std::string_view by) {
  const std::size_t at = text.find(mark);
  if (at != std::string::npos) text.replace(at, mark.size(), by);
}

/// No text of a project can end the element that holds it, or begin another.
std::string forHtml(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else if (c == '*')
      text += "\\u002a";  // "/*" begins a mark of the template
    else
      text += c;
  }
  return text;
}

}  // namespace

Json toJson(const TouchPage::Errors& errors) {
  return {{"model", errors.model},       {"typical_model", errors.typicalModel},
          {"force", errors.force},       {"typical_force", errors.typicalForce},
          {"coupling", errors.coupling}, {"coupling_radii", TouchPage::kCouplingDistances},
          {"field", errors.field},       {"typical_field", errors.typicalField},
          {"samples", errors.samples}};
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kAlphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (k + i < bytes.size() ? static_cast<unsigned char>(bytes[k + i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      text += k + i <= bytes.size() ? kAlphabet[group >> (18 - 6 * i) & 63U] : '=';
  }
  return text;
}

std::string touchPageText(const TouchPage& page) {
  const Blocks blocks = blocksOf(page);
  const Json data{{"format", 1},
                  {"name", page.name},
                  {"program", "Palpa " + page.version},
                  {"material",
                   {{"name", page.materialName},
                    {"youngs_modulus_MPa", page.material.youngsModulus},
                    {"poisson_ratio", page.material.poissonRatio}}},
                  {"radius_mm", page.radius},
                  {"model", {{"nodes", page.modelNodes}, {"triangles", page.modelTriangles}}},
                  {"errors", toJson(page.errors)},
                  {"node_count", page.nodeCount},
                  {"blocks", blocks.index()}};
  std::string text = kPageHtml;
  replace(text, "/*style*/", kPageStyle);
  replace(text, "/*numbers*/", kPageNumbers);
  replace(text, "/*algebra*/", kPageAlgebra);
  replace(text, "/*model*/", kPageModel);
  replace(text, "/*view*/", kPageView);
  replace(text, "/*readout*/", kPageReadout);
  replace(text, "/*selftest*/", kPageSelfTest);
  replace(text, "/*script*/", kPageScript);
  replace(text, "/*data*/", forHtml(data));
  replace(text, "/*bytes*/", base64(blocks.bytes()));
  return text;
}

}  // namespace palpa::app
