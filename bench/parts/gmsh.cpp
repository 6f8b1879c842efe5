#include "bench/parts/gmsh.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

namespace palpa::bench {
namespace {

using Eigen::Vector3d;

constexpr const char* kSeconds = "400";  // for a run of Gmsh
constexpr double kPlane = 1e-4;          // of the size: largest distance from the support's plane
constexpr std::size_t kMaxSamples = 40;  // triangles of a surface that are compared
constexpr double kCurvature = 9;         // elements per turn
constexpr int kTriangle6 = 9, kTetrahedron10 = 11, kTriangle3 = 2;

struct GmshMesh {
  TetrahedralMesh mesh;
  std::vector<int> surfaces;  // of the faces
};

/// Reads the format MSH 2.2.
GmshMesh readMesh(const std::filesystem::path& path) {
  std::ifstream file(path);
  GmshMesh read;
  read.mesh.isQuadratic = true;
  std::map<long, int> number;
  for (std::string line; std::getline(file, line);) {
    long count = 0;
    if (line == "$Nodes") {
      file >> count;
      for (long i = 0; i < count; ++i) {
        long id = 0;
        Vector3d p;
        file >> id >> p[0] >> p[1] >> p[2];
        number[id] = read.mesh.nodeCount();
        read.mesh.nodes.push_back(p);
      }
    } else if (line == "$Elements") {
      file >> count >> std::ws;
      for (long i = 0; i < count && std::getline(file, line); ++i) {
        std::istringstream words(line);
        int type = 0, tags = 0, tag = 0, surface = 0;
        long id = 0, node = 0;
        words >> id >> type >> tags;
        for (int t = 0; t < tags; ++t) {
          words >> tag;
          if (t == 1) surface = tag;
        }
        std::vector<int> nodes;
        while (words >> node) nodes.push_back(number.at(node));
        if (type == kTriangle3) nodes.resize(6, 0);
        if (type == kTriangle6 || type == kTriangle3) {
          std::array<int, 6> face{};
          std::copy_n(nodes.begin(), 6, face.begin());
          read.mesh.faces.push_back(face);
          read.surfaces.push_back(surface);
        } else if (type == kTetrahedron10) {
          std::array<int, 10> t{};
          std::copy_n(nodes.begin(), 10, t.begin());
          std::swap(t[8], t[9]);  // Gmsh: middles of 23, then 13
          read.mesh.tetrahedra.push_back(t);
        }
      }
    }
  }
  return read;
}

void runGmsh(const std::string& script, const char* dimension,
             const std::filesystem::path& folder) {
  std::ofstream(folder / "part.geo") << script;
  const std::string timeout = findProgram("timeout"), gmsh = findProgram("gmsh");
  if (gmsh.empty()) throw std::runtime_error("gmsh is not installed");
  try {
    runProgram(
        {timeout, kSeconds, gmsh, dimension, "-format", "msh22", "-o", "part.msh", "part.geo"},
        folder, "gmsh.log");
  } catch (const std::runtime_error& error) {
    throw LeftOut(std::string("Gmsh cannot mesh it: ") + error.what());
  }
}

std::string header(const std::filesystem::path& file) {
  std::ostringstream text;
  text << "SetFactory(\"OpenCASCADE\");\nGeometry.OCCTargetUnit = \"MM\";\n"
       << "Mesh.SaveAll = 1;\nGeneral.Verbosity = 3;\nMerge \"" << file.string() << "\";\n";
  return text.str();
}

/// Distance of a point from a triangle, mm.
double distance(const Vector3d& x, const std::array<Vector3d, 3>& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  bool isInside = normal.squaredNorm() > 0;
  double edges = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d side = t[(k + 1) % 3] - t[k];
    if (side.cross(x - t[k]).dot(normal) < 0) isInside = false;
    const double along =
        std::clamp(side.dot(x - t[k]) / std::max(side.squaredNorm(), 1e-300), 0.0, 1.0);
    edges = std::min(edges, (x - t[k] - along * side).norm());
  }
  return isInside ? std::abs(normal.normalized().dot(x - t[0])) : edges;
}

/// True if the surface point belongs to the support: its nearest facet does.
bool isOnSupport(const Vector3d& x, const PartTouch& part) {
  double nearest = std::numeric_limits<double>::infinity();
  bool isSupported = false;
  for (const PartTouch::Facet& facet : part.facets) {
    const double d = distance(x, facet.corners);
    if (d >= nearest) continue;
    nearest = d;
    isSupported = facet.isSupported;
  }
  return isSupported;
}

}  // namespace

GmshPart::GmshPart(const std::filesystem::path& file, const PartTouch& part)
    : file_(file), part_(part) {
  const ExchangeFolder folder;
  std::ostringstream script;
  script << header(file) << "Mesh.MeshSizeMax = " << part.size / 30
         << ";\nMesh.MeshSizeFromCurvature = 12;\n";
  runGmsh(script.str(), "-2", folder.path());
  const GmshMesh read = readMesh(folder.path() / "part.msh");
  // The plane of the support.
  Vector3d normal = Vector3d::Zero(), point = Vector3d::Zero();
  for (const PartTouch::Facet& facet : part.facets)
    if (facet.isSupported) {
      const auto& t = facet.corners;
      normal += (t[1] - t[0]).cross(t[2] - t[0]);
      point = t[0];
    }
  normal.normalize();
  std::map<int, std::vector<Vector3d>> centres;
  std::map<int, bool> isInPlane;
  for (std::size_t f = 0; f < read.mesh.faces.size(); ++f) {
    const auto& nodes = read.mesh.faces[f];
    const int surface = read.surfaces[f];
    bool& inPlane = isInPlane.try_emplace(surface, true).first->second;
    Vector3d centre = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vector3d& x = read.mesh.nodes[nodes[k]];
      centre += x / 3;
      if (std::abs(normal.dot(x - point)) > kPlane * part.size) inPlane = false;
    }
    centres[surface].push_back(centre);
  }
  for (const auto& [surface, points] : centres) {
    if (!isInPlane[surface]) continue;
    std::size_t votes = 0, samples = 0;
    const std::size_t step = std::max<std::size_t>(1, points.size() / kMaxSamples);
    for (std::size_t i = 0; i < points.size(); i += step, ++samples)
      votes += isOnSupport(points[i], part);
    if (2 * votes > samples) support_.push_back(surface);
  }
  if (support_.empty()) throw LeftOut("Gmsh finds no surface in the plane of the support");
}

TetrahedralMesh GmshPart::mesh(const PartSizes& sizes) const {
  const ExchangeFolder folder;
  std::ostringstream script;
  script.precision(12);
  script << header(file_) << "c() = Boundary{ Surface{";
  for (std::size_t i = 0; i < support_.size(); ++i) script << (i ? "," : "") << support_[i];
  script
      << "}; };\nFor i In {0 : #c()-1}\n  c(i) = Abs(c(i));\nEndFor\n"
      // At the border of the support stresses are singular.
      << "Field[1] = Distance;\nField[1].CurvesList = {c()};\nField[1].NumPointsPerCurve = 100;\n"
      << "Field[2] = Threshold;\nField[2].InField = 1;\nField[2].DistMin = " << sizes.support
      << ";\nField[2].DistMax = " << 2 * sizes.largest << ";\nField[2].SizeMin = " << sizes.support
      << ";\nField[2].SizeMax = " << sizes.largest << ";\n"
      << "Field[3] = Ball;\nField[3].XCenter = " << part_.at.x()
      << ";\nField[3].YCenter = " << part_.at.y() << ";\nField[3].ZCenter = " << part_.at.z()
      << ";\nField[3].Radius = " << 1.1 * part_.radius
      << ";\nField[3].Thickness = " << 3 * part_.radius << ";\nField[3].VIn = " << sizes.touch
      << ";\nField[3].VOut = " << sizes.largest << ";\n"
      << "Field[4] = Min;\nField[4].FieldsList = {2, 3};\nBackground Field = 4;\n"
      << "Mesh.MeshSizeMax = " << sizes.largest << ";\nMesh.MeshSizeFromCurvature = " << kCurvature
      << ";\nMesh.MeshSizeExtendFromBoundary = 0;\nMesh.ElementOrder = 2;\n"
      << "Mesh.HighOrderOptimize = 2;\nMesh.Optimize = 1;\nMesh.Algorithm = 6;\n";
  runGmsh(script.str(), "-3", folder.path());
  GmshMesh read = readMesh(folder.path() / "part.msh");
  if (read.mesh.tetrahedra.empty()) throw LeftOut("Gmsh made no tetrahedra");
  for (const int surface : read.surfaces)
    read.mesh.tags.push_back(
        std::find(support_.begin(), support_.end(), surface) != support_.end() ? 1 : 0);
  return std::move(read.mesh);
}

}  // namespace palpa::bench
