#include "test_mesh_files.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/text.h"

namespace palpa::modeling::test {
namespace {

std::string coordinates(const Eigen::Vector3d& p) {
  return numberText(p.x()) + " " + numberText(p.y()) + " " + numberText(p.z());
}

template <class T>
void append(std::string& bytes, T value, bool reversed = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (reversed) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

std::string stlText(const MeshBody& body) {
  std::string text = "solid test\n";
  for (const auto& triangle : body.triangles()) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (int n : triangle) text += "      vertex " + coordinates(body.positions()[n]) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid test\n";
}

std::string stlBinary(const MeshBody& body, const std::string& header) {
  std::string bytes = header;
  bytes.resize(80, '\0');
  append(bytes, static_cast<std::uint32_t>(body.triangles().size()));
  for (const auto& triangle : body.triangles()) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.0F);
    for (int n : triangle)
      for (int axis = 0; axis < 3; ++axis)
        append(bytes, static_cast<float>(body.positions()[n][axis]));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string objText(const MeshBody& body, const std::string& grouping) {
  std::string text = "# test\n";
  for (const Eigen::Vector3d& p : body.positions()) text += "v " + coordinates(p) + "\n";
  for (std::size_t face = 0; face < body.faceNames().size(); ++face) {
    if (!grouping.empty()) text += grouping + " " + body.faceNames()[face] + "\n";
    for (std::size_t t = 0; t < body.triangles().size(); ++t) {
      if (body.faceOfTriangle()[t] != static_cast<int>(face)) continue;
      text += "f";
      for (int n : body.triangles()[t]) text += " " + std::to_string(n + 1) + "/1/2";
      text += "\n";
    }
  }
  return text;
}

std::string plyText(const MeshBody& body, PlyKind kind) {
  const bool isText = kind == PlyKind::kText;
  const bool reversed = kind == PlyKind::kBigEndian;
  std::string bytes = "ply\nformat ";
  bytes += isText ? "ascii" : reversed ? "binary_big_endian" : "binary_little_endian";
  bytes += " 1.0\ncomment test\nelement vertex " + std::to_string(body.positions().size()) +
           "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\n"
           "element face " +
           std::to_string(body.triangles().size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& p : body.positions()) {
    if (isText) {
      bytes += coordinates(p) + " 255\n";
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) append(bytes, p[axis], reversed);
    append(bytes, std::uint8_t{255});
  }
  for (const auto& triangle : body.triangles()) {
    if (isText) {
      bytes += "3 " + std::to_string(triangle[0]) + " " + std::to_string(triangle[1]) + " " +
               std::to_string(triangle[2]) + "\n";
      continue;
    }
    append(bytes, std::uint8_t{3});
    for (int n : triangle) append(bytes, static_cast<std::int32_t>(n), reversed);
  }
  return bytes;
}

}  // namespace palpa::modeling::test
