#include "modeling/exchange/mesh_writer.h"

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "base/text.h"
#include "modeling/exchange/file_format.h"
#include "modeling/project/atomic_write.h"

namespace palpa::modeling {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as in memory");

template <class Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& bytes, const Eigen::Vector3f& vector) {
  for (const float value : vector) append(bytes, value);
}

std::string stlBytes(const MeshFile& mesh) {
  std::string bytes = "Palpa: a closed surface, lengths in mm";
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f p = mesh.positions[a].cast<float>();
    const Eigen::Vector3f q = mesh.positions[b].cast<float>();
    const Eigen::Vector3f r = mesh.positions[c].cast<float>();
    const Eigen::Vector3d normal =
        (q - p).cast<double>().cross((r - p).cast<double>()).normalized();
    append(bytes, Eigen::Vector3f(normal.cast<float>()));
    for (const Eigen::Vector3f& corner : {p, q, r}) append(bytes, corner);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string objText(const MeshFile& mesh) {
  std::string text = "# lengths in mm\n";
  for (const Eigen::Vector3d& p : mesh.positions)
    text += "v " + roundedText(p.x(), 9) + ' ' + roundedText(p.y(), 9) + ' ' +
            roundedText(p.z(), 9) + '\n';
  for (const auto& [a, b, c] : mesh.triangles)
    text += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' +
            std::to_string(c + 1) + '\n';
  return text;
}

std::string plyBytes(const MeshFile& mesh) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment lengths in mm\nelement vertex " +
      std::to_string(mesh.positions.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(mesh.triangles.size()) +
      "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& p : mesh.positions) append(bytes, Eigen::Vector3f(p.cast<float>()));
  for (const auto& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    append(bytes, triangle);
  }
  return bytes;
}

/// VTK's XML format with the numbers in one block behind the text. Each array is preceded by its
/// length in bytes.
class VtpText {
 public:
  explicit VtpText(const MeshFile& mesh) {
    std::vector<std::int64_t> corners, ends;
    for (const auto& triangle : mesh.triangles) {
      corners.insert(corners.end(), triangle.begin(), triangle.end());
      ends.push_back(static_cast<std::int64_t>(corners.size()));
    }
    text_ =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n"
        "<Piece NumberOfPoints=\"" +
        std::to_string(mesh.positions.size()) + "\" NumberOfPolys=\"" +
        std::to_string(mesh.triangles.size()) + "\">\n";
    addData("PointData", mesh.pointData);
    addData("CellData", mesh.triangleData);
    text_ += "<Points>\n";
    addArray("Float64", "Points", 3, mesh.positions);
    text_ += "</Points>\n<Polys>\n";
    addArray("Int64", "connectivity", 1, corners);
    addArray("Int64", "offsets", 1, ends);
    text_ += "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_" + numbers_ +
             "\n</AppendedData>\n</VTKFile>\n";
  }

  std::string take() { return std::move(text_); }

 private:
  void addData(const std::string& element, const std::vector<MeshData>& data) {
    text_ += "<" + element + ">\n";
    for (const MeshData& one : data) addArray("Float64", one.name, one.components, one.values);
    text_ += "</" + element + ">\n";
  }

  template <class Value>
  void addArray(const std::string& type, const std::string& name, int components,
                const std::vector<Value>& values) {
    text_ += "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
             std::to_string(components) + "\" format=\"appended\" offset=\"" +
             std::to_string(numbers_.size()) + "\"/>\n";
    const std::size_t size = values.size() * sizeof(Value);
    append(numbers_, static_cast<std::uint64_t>(size));
    numbers_.append(reinterpret_cast<const char*>(values.data()), size);
  }

  std::string text_;
  std::string numbers_;
};

std::string bytesOf(const MeshFile& mesh, FileFormat format) {
  switch (format) {
    case FileFormat::kStl:
      return stlBytes(mesh);
    case FileFormat::kObj:
      return objText(mesh);
    case FileFormat::kPly:
      return plyBytes(mesh);
    case FileFormat::kVtp:
      return VtpText(mesh).take();
    case FileFormat::kProject:
    case FileFormat::kStep:
    case FileFormat::kIges:
    case FileFormat::kBrep:
    case FileFormat::kPage:
      break;
  }
  throw std::invalid_argument("writeMesh: not a mesh format");
}

}  // namespace

void writeMesh(const MeshFile& mesh, const std::filesystem::path& path) {
  writeAtomically(bytesOf(mesh, requireFormat(path, isWritableMesh)), path);
}

}  // namespace palpa::modeling
