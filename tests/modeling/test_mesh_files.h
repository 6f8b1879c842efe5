#pragma once

#include <string>

#include "modeling/body/mesh_body.h"

// Mesh files as other programs write them.
namespace palpa::modeling::test {

std::string stlText(const MeshBody& body);
std::string stlBinary(const MeshBody& body, const std::string& header = "made by a test");
/// With a statement before the triangles of each face, e.g. "g".
std::string objText(const MeshBody& body, const std::string& grouping = "");
enum class PlyKind { kText, kLittleEndian, kBigEndian };
std::string plyText(const MeshBody& body, PlyKind kind);

}  // namespace palpa::modeling::test
