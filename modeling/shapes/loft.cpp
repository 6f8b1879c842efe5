// Lofts, and extrusions, which are lofts between two equal sections.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "modeling/error.h"
#include "modeling/shapes/describe_shape.h"
#include "modeling/shapes/profile_check.h"
#include "modeling/shapes/profile_cuts.h"
#include "modeling/shapes/profile_error.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kMaxSections = 32;

/// Closed counter-clockwise profile at a height.
struct Level {
  double z;
  Profile profile;
};

double signedArea(const Profile& profile) {
  double sum = 0.0;
  const auto& p = profile.samples();
  for (std::size_t i = 1; i < p.size(); ++i)
    sum += 0.5 * (p[i - 1].x() * p[i].y() - p[i - 1].y() * p[i].x());
  return sum;
}

Level levelFrom(double z, const ProfileCurve& curve, const std::string& path) {
  Profile profile(curve, path);
  if (!profile.isClosed())
    throw ProfileError(path + ": the curve is open, from " + placeText(profile.point(0.0)) +
                           " to " + placeText(profile.point(1.0)) +
                           "; its last point must equal its first",
                       profile.point(1.0));
  return {z, signedArea(profile) < 0.0 ? profile.reversed() : profile};
}

/// Sections as functions of the height: the weight of section k at the fraction t of the whole
/// height. The weights are the splines of the given degree that are 1 at their own section and 0 at
/// the others (interpolation at the sections with averaged knots).
class Blend {
 public:
  Blend(const std::vector<Level>& levels, int degree) {
    const int count = static_cast<int>(levels.size());
    const int used = std::min(degree, count - 1);
    std::vector<double> at;
    for (const Level& level : levels)
      at.push_back((level.z - levels.front().z) / (levels.back().z - levels.front().z));
    basis_ = {used, std::vector<double>(used + 1, 0.0)};
    for (int j = 1; j + used < count; ++j) {
      double mean = 0.0;
      for (int k = j; k < j + used; ++k) mean += at[k] / used;
      basis_.knots.push_back(mean);
    }
    basis_.knots.insert(basis_.knots.end(), used + 1, 1.0);
    Eigen::MatrixXd values(count, count);
    for (int i = 0; i < count; ++i) values.row(i) = basisValues(basis_, at[i]);
    inverse_ = values.inverse();
  }

  /// Weights of all sections at t.
  Eigen::RowVectorXd weights(double t) const { return basisValues(basis_, t) * inverse_; }

  /// Basis along the height in which patches of this degree represent the blend exactly.
  SplineBasis basis(int degree) const {
    SplineBasis result{degree, std::vector<double>(degree + 1, 0.0)};
    for (std::size_t i = basis_.degree + 1; i + basis_.degree + 1 < basis_.knots.size(); ++i)
      result.knots.insert(result.knots.end(), 1 + degree - basis_.degree, basis_.knots[i]);
    result.knots.insert(result.knots.end(), degree + 1, 1.0);
    return result;
  }

 private:
  SplineBasis basis_;
  Eigen::MatrixXd inverse_;
};

/// Body between sections whose profiles are cut at corresponding places.
struct LoftBody {
  std::string name;  ///< of the shape, for messages
  std::vector<Level> levels;
  std::vector<ProfileCuts> cuts;
  Blend blend;

  Vector3d sidePoint(int side, std::size_t piece, double s, double t) const {
    const Eigen::RowVectorXd weights = blend.weights(t);
    Vector2d p = Vector2d::Zero();
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const auto& ends = cuts[k].side[side];
      p += weights[static_cast<int>(k)] *
           levels[k].profile.point(ends[piece] + s * (ends[piece + 1] - ends[piece]));
    }
    const double z = levels.front().z + t * (levels.back().z - levels.front().z);
    return {p.x(), p.y(), z};
  }

  std::size_t pieces(int side) const { return cuts.front().side[side].size() - 1; }

  /// True if all sections are smooth at this cut.
  bool isSmoothAt(int side, std::size_t cut) const {
    for (std::size_t k = 0; k < levels.size(); ++k)
      if (!isSmooth(levels[k].profile, cuts[k].side[side][cut])) return false;
    return true;
  }
};

/// Basis along a piece of side 0 or 1 that also contains the opposite piece.
SplineBasis pieceBasis(const LoftBody& body, const NetSize& net, int side, std::size_t piece) {
  const std::size_t opposite = body.pieces(side) - 1 - piece;
  SplineBasis basis{net.degree, std::vector<double>(net.degree + 1, 0.0)};
  basis.knots.insert(basis.knots.end(), net.degree + 1, 1.0);
  for (std::size_t k = 0; k < body.levels.size(); ++k) {
    const auto own = [&](int which, std::size_t index) {
      const auto& ends = body.cuts[k].side[which];
      return body.levels[k].profile.basis(ends[index], ends[index + 1], net.degree);
    };
    basis = merged(basis, merged(own(side, piece), reversed(own(side + 2, opposite))));
  }
  int degree = 1;
  for (const Level& level : body.levels) degree = std::max(degree, level.profile.degree());
  return net.fitted(body.name, basis, degree);
}

void checkBetweenSections(const LoftBody& body) {
  constexpr int kBetween = 4;
  constexpr int kPerPiece = 24;
  const std::size_t levels = kBetween * (body.levels.size() - 1);
  for (std::size_t level = 1; level < levels; ++level) {
    const double t = static_cast<double>(level) / static_cast<double>(levels);
    std::vector<Vector2d> line;
    for (int side = 0; side < 4; ++side)
      for (std::size_t piece = 0; piece < body.pieces(side); ++piece)
        for (int i = 0; i < kPerPiece; ++i)
          line.push_back(
              body.sidePoint(side, piece, static_cast<double>(i) / kPerPiece, t).head<2>());
    line.push_back(line.front());
    if (const auto crossing = selfCrossing(line, true))
      throw ModelingError(body.name + ": the surface crosses itself between the sections, near " +
                          placeText(line[(*crossing)[0]]) +
                          ", z = " + numberText(body.sidePoint(0, 0, 0.0, t).z()) +
                          " mm; make neighbouring sections more alike or add one between them");
  }
}

void addSides(ExactShape& shape, const std::shared_ptr<const LoftBody>& body,
              const std::array<std::vector<SplineBasis>, 2>& around, const SplineBasis& upwards) {
  int number = 0;
  for (int side = 0; side < 4; ++side)
    for (std::size_t piece = 0; piece < body->pieces(side); ++piece) {
      const auto surface = [body, side, piece](double s, double t) {
        return body->sidePoint(side, piece, s, t);
      };
      const SplineBasis& basis =
          side < 2 ? around[side][piece] : around[side - 2][body->pieces(side) - 1 - piece];
      shape.patches.push_back(
          {"side_" + std::to_string(++number),
           {side < 2 ? basis : reversed(basis), upwards},
           surface,
           {false, body->isSmoothAt(side, piece + 1), false, body->isSmoothAt(side, piece)}});
    }
}

void addCap(ExactShape& shape, const LoftBody& body, bool isTop,
            const std::array<std::vector<SplineBasis>, 2>& around) {
  const std::size_t section = isTop ? body.levels.size() - 1 : 0;
  const FlatCap cap(body.levels[section].profile, body.cuts[section]);
  const double z = body.levels[section].z;
  const std::string name = isTop ? "top" : "bottom";
  const int columns = cap.pieces(0), rows = cap.pieces(1);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto surface = [=](double s, double t) {
        const Vector2d p = isTop ? cap.point(i, j, s, t) : cap.point(i, j, t, s);
        return Vector3d(p.x(), p.y(), z);
      };
      std::array<bool, 4> smooth{j > 0, i + 1 < columns, j + 1 < rows, i > 0};
      std::array<SplineBasis, 2> basis{around[0][i], around[1][j]};
      if (!isTop) {
        std::swap(basis[0], basis[1]);
        smooth = {smooth[3], smooth[2], smooth[1], smooth[0]};
      }
      const bool alone = columns * rows == 1;
      shape.patches.push_back({alone ? name : name + "_" + std::to_string(j * columns + i + 1),
                               basis, surface, smooth});
    }
}

ExactShape describeLevels(const std::string& name, std::vector<Level> levels, const NetSize& net) {
  const double height = levels.back().z - levels.front().z;
  std::vector<Profile> profiles;
  std::vector<NamedLength> lengths{{"the height", height}};
  for (const Level& level : levels) {
    profiles.push_back(level.profile);
    lengths.push_back({"the extent of a profile", level.profile.size()});
  }
  ExactShape shape;
  shape.smallestLength = checkLengths(name, lengths);
  std::vector<ProfileCuts> cuts = cutProfiles(profiles, name);
  const Blend blend(levels, net.degree);
  const auto body =
      std::make_shared<const LoftBody>(LoftBody{name, std::move(levels), std::move(cuts), blend});
  if (body->levels.size() > 2 || name == "loft") checkBetweenSections(*body);

  std::array<std::vector<SplineBasis>, 2> around;
  for (int side = 0; side < 2; ++side)
    for (std::size_t piece = 0; piece < body->pieces(side); ++piece)
      around[side].push_back(pieceBasis(*body, net, side, piece));
  addSides(shape, body, around, net.fitted(name, blend.basis(net.degree), net.degree));
  addCap(shape, *body, false, around);
  addCap(shape, *body, true, around);
  return shape;
}

}  // namespace

void checkClosedProfile(const ProfileCurve& curve, const std::string& path) {
  levelFrom(0.0, curve, path);
}

ExactShape describe(const ExtrudeShape& extrude, const NetSize& net) {
  checkLengths("extrude", {{"the height", extrude.height}});
  const Level bottom = levelFrom(0.0, extrude.profile, "extrude: profile");
  return describeLevels("extrude", {bottom, {extrude.height, bottom.profile}}, net);
}

ExactShape describe(const LoftShape& loft, const NetSize& net) {
  const std::size_t count = loft.sections.size();
  if (count < 2 || count > kMaxSections)
    throw ModelingError("loft: " + std::to_string(count) + " sections; expected 2 … " +
                        std::to_string(kMaxSections));
  std::vector<Level> levels;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string path = "loft: sections[" + std::to_string(i) + "]";
    const double z = loft.sections[i].z;
    if (!std::isfinite(z) || std::abs(z) > kMaxLength)
      throw ModelingError(path + ".z_mm: " + numberText(z) + " is not a finite number within ±" +
                          numberText(kMaxLength) + " mm");
    if (i > 0 && !(z >= levels.back().z + kMinLength))
      throw ModelingError(path + ".z_mm: " + numberText(z) + " must be at least " +
                          numberText(kMinLength) + " mm above the section before it (" +
                          numberText(levels.back().z) + ")");
    levels.push_back(levelFrom(z, loft.sections[i].profile, path + ".profile"));
  }
  return describeLevels("loft", std::move(levels), net);
}

}  // namespace palpa::modeling
