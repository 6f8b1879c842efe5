#include "bench/peers/peer_case.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bem/triangle/kelvin.h"
#include "bench/sphere.h"
#include "modeling/shapes/primitives.h"

namespace palpa::bench {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr double kSphere = 25, kCylinder = 20, kHeight = 60;  // mm
constexpr double kStep = 0.25;                                // mm, of the path
constexpr int kSteps = 24;

Vector3d vectorOf(const json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

json referenceCase(const std::string& path, const std::string& id) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  const json all = json::parse(file);
  for (const json& entry : all["cases"])
    if (entry["id"] == id) return entry;
  throw std::runtime_error(path + " has no case " + id);
}

/// The middle of an edge at the mean distance of its ends from an axis or a centre, given by which
/// components count.
Vector3d pushedOut(const Vector3d& a, const Vector3d& b, const Vector3d& counts) {
  const Vector3d middle = (a + b) / 2, across = middle.cwiseProduct(counts);
  const double wanted = (a.cwiseProduct(counts).norm() + b.cwiseProduct(counts).norm()) / 2;
  return middle + (wanted / across.norm() - 1) * across;
}

void takeReference(const json& entry, PeerCase& out) {
  out.material = {entry["material"]["E"], entry["material"]["nu"]};
  out.project.material = {"silicone-like", out.material.youngsModulus, out.material.poissonRatio};
  // The work of the load is twice the strain energy: f d = 2 W, d = D f.
  const double force = vectorOf(entry["reaction_force"]).norm();
  out.reference = {vectorOf(entry["load"]["center"]), vectorOf(entry["load"]["direction"]),
                   entry["load"]["a"], 2 * entry["energy_mJ"].get<double>() / (force * force)};
}

PeerCase sphereCase(const std::string& references) {
  PeerCase out;
  out.project = sphereProject(10);
  takeReference(referenceCase(references, "c_sph_pole"), out);
  out.source = {20, 15, 40};
  out.force = {0.03, -0.02, 0.06};
  out.places = pointsOnSphere(5);
  for (int k = 0; k < kSteps; ++k)
    out.path.push_back(kSphere *
                       Vector3d(std::sin(k * kStep / kSphere), 0, std::cos(k * kStep / kSphere)));
  out.middle = [](const Vector3d& a, const Vector3d& b, const Vector3d&) {
    return pushedOut(a, b, {1, 1, 1});
  };
  return out;
}

PeerCase cylinderCase(const std::string& references) {
  PeerCase out;
  out.project.name = "cylinder";
  out.project.body = modeling::makeCylinder(kCylinder, kHeight);
  out.project.supports.push_back({"base", modeling::Support::Kind::kFixed,
                                  modeling::Region::ofPatches({"bottom"}), Vector3d::Zero()});
  takeReference(referenceCase(references, "a_cyl_side"), out);
  out.source = {35, 10, 40};
  out.force = {0.03, 0.02, -0.05};
  const auto onSide = [](double angle, double z) {
    return Vector3d(kCylinder * std::cos(angle), kCylinder * std::sin(angle), z);
  };
  for (int k = 0; k < 5; ++k) out.places.push_back(onSide(0.3 + 1.2 * k, 20 + 7 * k));
  for (int k = 0; k < kSteps; ++k) out.path.push_back(onSide(k * kStep / kCylinder, 30));
  out.middle = [](const Vector3d& a, const Vector3d& b, const Vector3d& normal) -> Vector3d {
    if (std::abs(normal.z()) > 0.9) return (a + b) / 2;
    return pushedOut(a, b, {1, 1, 0});
  };
  return out;
}

}  // namespace

Vector3d PeerCase::exactDisplacement(const Vector3d& x) const {
  return bem::kelvinDisplacement(source, x, material).transpose() * force;
}

Vector3d PeerCase::exactTraction(const Vector3d& x, const Vector3d& normal) const {
  return bem::kelvinTraction(source, x, normal, material).transpose() * force;
}

PeerCase makePeerCase(const std::string& body, const std::string& references) {
  if (body == "sphere") return sphereCase(references);
  if (body == "cylinder") return cylinderCase(references);
  throw std::runtime_error("no body is called " + body);
}

}  // namespace palpa::bench
