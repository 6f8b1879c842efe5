#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "modeling/shapes/describe_shape.h"
#include "modeling/shapes/profile.h"
#include "modeling/shapes/profile_check.h"
#include "modeling/shapes/profile_error.h"
#include "modeling/shapes/round_patches.h"
#include "modeling/solid/surface_properties.h"

namespace palpa::modeling {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSameParameter = 1e-9;

/// Disc patch that covers an end of the profile on the axis, and its extent.
struct AxisCap {
  double parameter = 0.0;  ///< of the profile, at the rim of the cap
  double radius = 0.0;     ///< mm, at the rim
  bool apex = false;       ///< the profile leaves the axis obliquely
};

std::string axisPlace(double z) {
  return "z = " + numberText(std::round(z * 1e6) / 1e6) + " mm";
}

bool isOnAxis(const Profile& profile, double t) {
  return std::abs(profile.point(t).x()) <= 1e-9 * profile.size();
}

/// Point of the profile with the smallest radius (x) between two parameters with one minimum
/// between them.
Vector2d closestToAxis(const Profile& profile, double low, double high) {
  constexpr int kSteps = 80;  // each leaves two thirds of the interval
  for (int step = 0; step < kSteps; ++step) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (profile.point(a).x() < profile.point(b).x() ? high : low) =
        profile.point(a).x() < profile.point(b).x() ? b : a;
  }
  return profile.point(0.5 * (low + high));
}

void checkDistanceFromAxis(const Profile& profile) {
  const auto& t = profile.sampleParameters();
  const auto& samples = profile.samples();
  const std::size_t last = samples.size() - 1;
  const auto check = [&](const Vector2d& p, bool isEnd) {
    if (p.x() >= kMinLength) return;
    if (p.x() < -1e-9 * profile.size())
      throw ProfileError("revolve: profile: the curve crosses the axis near " + axisPlace(p.y()) +
                             "; the radius (x) must not be negative",
                         p);
    if (!isEnd)
      throw ProfileError("revolve: profile: the curve touches the axis near " + axisPlace(p.y()) +
                             " between its ends; only the ends of an open curve may lie on it",
                         p);
    if (p.x() > 1e-9 * profile.size())
      throw ProfileError("revolve: profile: the end at " + axisPlace(p.y()) + " is " +
                             numberText(p.x()) +
                             " mm away from the axis; put it on the axis (0) or " + "at least " +
                             numberText(kMinLength) + " mm away",
                         p);
  };
  for (std::size_t i : {std::size_t{0}, last}) check(samples[i], !profile.isClosed());
  for (std::size_t i = 1; i < last; ++i)
    if (samples[i].x() <= samples[i - 1].x() && samples[i].x() <= samples[i + 1].x()) {
      check(samples[i], false);
      check(closestToAxis(profile, t[i - 1], t[i + 1]), false);
    }
}

/// Volume of the body between profile and axis over π, ∫ r² dz; negative if the profile runs
/// downwards on the outside.
double signedVolume(const Profile& profile) {
  double sum = 0.0;
  const auto& samples = profile.samples();
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double a = samples[i - 1].x(), b = samples[i].x();
    sum += (a * a + a * b + b * b) / 3.0 * (samples[i].y() - samples[i - 1].y());
  }
  return sum;
}

/// Throws ModelingError if the flat caps that close the profile towards the axis cut through it.
void checkCaps(const Profile& profile) {
  if (profile.isClosed()) return;
  std::vector<Vector2d> line = profile.samples();
  if (!isOnAxis(profile, 0.0)) line.insert(line.begin(), {0.0, line.front().y()});
  if (!isOnAxis(profile, 1.0)) line.emplace_back(0.0, line.back().y());
  if (const auto crossing = selfCrossing(line, false))
    throw ProfileError("revolve: profile: the flat cap that closes an end meets the curve near " +
                           placeText(line[(*crossing)[1]]),
                       line[(*crossing)[1]]);
}

/// Largest cap at the profile's start: the radius must grow, and the curve may bend away from the
/// disc by at most about half of the remaining angle to the vertical.
AxisCap capAtStart(const Profile& profile) {
  constexpr double kRight = std::numbers::pi / 2;
  constexpr double kFlat = 2.0 * std::numbers::pi / 180.0;
  constexpr double kSteepest = 89.0 * std::numbers::pi / 180.0;
  constexpr double kBend = 0.55;
  constexpr int kSteps = 400;
  const auto slope = [&](double t, int side) {
    const Vector2d tangent = profile.tangent(t, side);
    return std::atan2(std::abs(tangent.y()), tangent.x());
  };
  const double start = slope(0.0, 1);
  if (start > kSteepest)
    throw ProfileError("revolve: profile: at " + axisPlace(profile.point(0.0).y()) +
                           " the curve runs along the axis; it must leave it at an angle",
                       profile.point(0.0));
  AxisCap cap;
  cap.apex = start > kFlat;
  const double end = profile.corners().empty() ? 1.0 : profile.corners().front();
  const double steepest = start + kBend * (kRight - start);
  for (int k = 1; k <= kSteps; ++k) {
    const double t = k == kSteps ? end : end * k / kSteps;
    if (slope(t, -1) > steepest) break;
    cap.parameter = t;
  }
  cap.radius = profile.point(cap.parameter).x();
  if (cap.radius < kMinLength || cap.radius < profile.size() / kMaxEdgeRatio)
    throw ProfileError("revolve: profile: at " + axisPlace(profile.point(0.0).y()) +
                           " the curve bends away from the axis too sharply",
                       profile.point(0.0));
  return cap;
}

/// Parameter up to cap.parameter at which the profile has the given radius.
double parameterAtRadius(const Profile& profile, const AxisCap& cap, double radius) {
  double low = 0.0, high = cap.parameter;
  if (radius >= cap.radius) return high;
  // Regula falsi with the Illinois rule: superlinear, and stays within the bracket.
  double below = -radius, above = cap.radius - radius;
  double t = low;
  for (int step = 0, last = 0; step < 60 && high - low > 1e-15; ++step) {
    t = (low * above - high * below) / (above - below);
    const double value = profile.point(t).x() - radius;
    if (std::abs(value) <= 1e-15 * cap.radius) break;
    if (value < 0.0) {
      low = t;
      below = value;
      if (last == -1) above *= 0.5;
      last = -1;
    } else {
      high = t;
      above = value;
      if (last == 1) below *= 0.5;
      last = 1;
    }
  }
  return t;
}

void addAxisCap(ExactShape& shape, const std::string& name, const RoundNet& net, bool facesUp,
                bool smoothRim, const Profile& profile, const AxisCap& cap) {
  addDisc(shape, name, net, facesUp, smoothRim, [profile, cap](const Vector3d& flat) {
    const Vector3d unit = std::numbers::sqrt2 * flat;
    const double t = parameterAtRadius(profile, cap, cap.radius * unit.norm());
    return Vector3d(cap.radius * unit + profile.point(t).y() * Vector3d::UnitZ());
  });
}

/// True if the surface has a tangent plane across this parameter of the profile. At an open end the
/// flat cap continues the profile towards the axis.
bool isSmoothAt(const Profile& profile, double t) {
  if (profile.isClosed() || (t > 0.0 && t < 1.0)) return isSmooth(profile, t);
  const double towardsAxis = t <= 0.0 ? profile.tangent(0.0, 1).x() : -profile.tangent(1.0, -1).x();
  return towardsAxis > std::cos(kSmoothAngle);
}

/// Parameters at which the bands between the caps are cut: corners, and enough others that no piece
/// of a closed profile is closed.
std::vector<double> bandCuts(const Profile& profile, double from, double to) {
  std::vector<double> cuts;
  if (!profile.isClosed()) {
    cuts.push_back(from);
    for (double corner : profile.corners())
      if (corner > from + kSameParameter && corner < to - kSameParameter) cuts.push_back(corner);
    cuts.push_back(to);
    return cuts;
  }
  constexpr std::size_t kMinPatches = 4;
  cuts = profile.corners();
  if (cuts.empty()) cuts.push_back(0.0);
  cuts.push_back(cuts.front() + 1.0);
  const auto length = [&](std::size_t i) {
    return profile.lengthUpTo(cuts[i + 1]) - profile.lengthUpTo(cuts[i]);
  };
  while (cuts.size() < kMinPatches + 1) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i + 1 < cuts.size(); ++i)
      if (length(i) > (1.0 + 1e-6) * length(longest)) longest = i;
    const double middle = profile.lengthUpTo(cuts[longest]) + 0.5 * length(longest);
    cuts.insert(cuts.begin() + static_cast<long>(longest) + 1, profile.parameterAt(middle));
  }
  return cuts;
}

void addBands(ExactShape& shape, const RoundNet& round, const NetSize& net, const Profile& profile,
              const std::vector<double>& cuts) {
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double from = cuts[i], to = cuts[i + 1];
    const std::string name = cuts.size() == 2 ? "side" : "side_" + std::to_string(i + 1);
    const auto point = [profile, from, to](const Vector3d& radial, double t) {
      const Vector2d p = profile.point(from + t * (to - from));
      return Vector3d(p.x() * radial + p.y() * Vector3d::UnitZ());
    };
    addBand(shape, name, round,
            net.fitted("revolve", profile.basis(from, to, net.degree), profile.degree()), point,
            isSmoothAt(profile, from), isSmoothAt(profile, to));
  }
}

/// Checked profile that runs upwards on the outside.
Profile revolvedProfile(const ProfileCurve& curve) {
  Profile profile(curve, "revolve: profile");
  checkDistanceFromAxis(profile);
  if (signedVolume(profile) < 0.0) profile = profile.reversed();
  checkCaps(profile);
  return profile;
}

}  // namespace

void checkRevolvedProfile(const ProfileCurve& curve) {
  const Profile profile = revolvedProfile(curve);
  if (profile.isClosed()) return;
  if (isOnAxis(profile, 0.0)) capAtStart(profile);
  if (isOnAxis(profile, 1.0)) capAtStart(profile.reversed());
}

ExactShape describe(const RevolveShape& revolve, const NetSize& net) {
  const Profile profile = revolvedProfile(revolve.profile);

  ExactShape shape;
  std::optional<AxisCap> start, end;
  const Profile backwards = profile.reversed();
  if (!profile.isClosed()) {
    if (isOnAxis(profile, 0.0)) start = capAtStart(profile);
    if (isOnAxis(profile, 1.0)) end = capAtStart(backwards);
  }
  const double from = start ? start->parameter : 0.0;
  const double to = end ? 1.0 - end->parameter : 1.0;
  const bool capsOnly = !profile.isClosed() && to - from < kSameParameter;
  const bool apex = (start && start->apex) || (end && end->apex);
  const RoundNet round{apex, apex ? net.fromApex() : uniformBasis(net.degree, net.aroundQuarter())};
  shape.smallestLength = profile.size();
  const bool smoothFrom = isSmoothAt(profile, from);
  const bool smoothTo = isSmoothAt(profile, to);
  if (start)
    addAxisCap(shape, "bottom", round, false, smoothFrom, profile, *start);
  else if (!profile.isClosed())
    addFlatDisc(shape, "bottom", round, false, smoothFrom, profile.point(0.0));
  if (!capsOnly) addBands(shape, round, net, profile, bandCuts(profile, from, to));
  if (end)
    addAxisCap(shape, "top", round, true, smoothTo, backwards, *end);
  else if (!profile.isClosed())
    addFlatDisc(shape, "top", round, true, smoothTo, profile.point(1.0));
  return shape;
}

}  // namespace palpa::modeling
