#include "modeling/body/body.h"

#include "base/count_text.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {

std::optional<int> findPatch(const Body& body, std::string_view name) {
  if (const auto* mesh = std::get_if<MeshBody>(&body)) return mesh->findFace(name);
  return std::get<Solid>(body).findPatch(name);
}

std::vector<std::string> patchNames(const Body& body) {
  if (const auto* mesh = std::get_if<MeshBody>(&body)) return mesh->faceNames();
  std::vector<std::string> names;
  for (const Patch& patch : std::get<Solid>(body).patches()) names.push_back(patch.name);
  return names;
}

std::string quotedPatchNames(const Body& body) {
  constexpr std::size_t kMaxShown = 40;  // CAD bodies may have thousands of faces
  const std::vector<std::string> names = patchNames(body);
  const std::size_t shown = names.size() > kMaxShown ? kMaxShown / 2 : names.size();
  std::string text;
  for (std::size_t k = 0; k < shown; ++k) text += (text.empty() ? "\"" : ", \"") + names[k] + "\"";
  if (shown < names.size())
    text += ", …, \"" + names.back() + "\" (" + countText(static_cast<double>(names.size())) +
            " in all)";
  return text;
}

std::array<Eigen::Vector3d, 2> boundingBox(const Body& body) {
  const auto* solid = std::get_if<Solid>(&body);
  if (solid) return boundingBox(*solid);
  const auto& positions = std::get<MeshBody>(body).positions();
  std::array<Eigen::Vector3d, 2> corners{positions.front(), positions.front()};
  for (const Eigen::Vector3d& p : positions)
    corners = {corners[0].cwiseMin(p), corners[1].cwiseMax(p)};
  return corners;
}

double volume(const Body& body) {
  if (const auto* solid = std::get_if<Solid>(&body)) return volume(SurfaceEvaluator(*solid));
  return volume(std::get<MeshBody>(body));
}

double area(const Body& body) {
  if (const auto* solid = std::get_if<Solid>(&body)) return area(SurfaceEvaluator(*solid));
  return area(std::get<MeshBody>(body));
}

}  // namespace palpa::modeling
