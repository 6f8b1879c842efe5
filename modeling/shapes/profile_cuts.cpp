#include "modeling/shapes/profile_cuts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

/// Marks on a profile as lengths from the seam, ascending, in [0, 2 · length).
using Marks = std::vector<double>;

Marks cornerLengths(const Profile& profile) {
  Marks marks;
  for (double corner : profile.corners()) marks.push_back(profile.lengthUpTo(corner));
  return marks;
}

Eigen::Vector2d centreOf(const Profile& profile) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const auto& samples = profile.samples();
  for (std::size_t i = 1; i < samples.size(); ++i)
    sum += 0.5 * (samples[i] + samples[i - 1]) * (samples[i] - samples[i - 1]).norm();
  return sum / profile.length();
}

/// Marks on `profile` that correspond to the corners of the reference: its own corners, in the
/// order with the least twist of the loft, or, if it has none, marks in the same proportions of the
/// length, rotated for the least twist. The twist is the sum of the squared distances between
/// corresponding points, relative to the centres of their profiles.
Marks leastTwisted(const Profile& profile, const Profile& reference, const Marks& corners) {
  constexpr int kTurns = 128;
  const Marks own = cornerLengths(profile);
  const std::size_t count = corners.size();
  const double whole = profile.length();
  const auto turned = [&](int turn) {
    Marks marks;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = i + static_cast<std::size_t>(turn);
      if (own.empty())
        marks.push_back(whole * turn / kTurns +
                        whole / reference.length() * (corners[i] - corners.front()));
      else
        marks.push_back(own[k % count] + (k >= count ? whole : 0.0));
    }
    return marks;
  };
  const Eigen::Vector2d shift = centreOf(profile) - centreOf(reference);
  const auto twist = [&](const Marks& marks) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      sum += (profile.point(profile.parameterAt(marks[i])) -
              reference.point(reference.parameterAt(corners[i])) - shift)
                 .squaredNorm();
    return sum;
  };
  Marks best = turned(0);
  const int turns = own.empty() ? kTurns : static_cast<int>(count);
  for (int turn = 1; turn < turns; ++turn)
    if (twist(turned(turn)) < (1.0 - 1e-9) * twist(best)) best = turned(turn);
  return best;
}

/// Map from the marks of the reference to the marks of one profile.
class Correspondence {
 public:
  Correspondence(const Profile& profile, const Profile& reference)
      : profile_(profile), whole_(profile.length()), referenceWhole_(reference.length()) {
    anchors_ = cornerLengths(reference);
    if (anchors_.empty())
      anchors_ = own_ = {0.0};
    else
      own_ = leastTwisted(profile, reference, anchors_);
    anchors_.push_back(anchors_.front() + referenceWhole_);
    own_.push_back(own_.front() + whole_);
  }

  /// Parameter (0 … 4, growing with the mark) for a length along the reference: corners map to
  /// corners, lengths between them proportionally.
  double parameter(double mark) const {
    // One round more than needed, so that a mark before the first anchor does not become negative.
    double rounds = 1.0;
    while (mark < anchors_.front()) mark += referenceWhole_, rounds -= 1.0;
    while (mark >= anchors_.back()) mark -= referenceWhole_, rounds += 1.0;
    // By rounding, a round forth and back may end below the first anchor.
    mark = std::max(mark, anchors_.front());
    const auto above = std::upper_bound(anchors_.begin(), anchors_.end(), mark);
    const std::size_t i = std::min<std::size_t>(above - anchors_.begin(), anchors_.size() - 1);
    const double part = (mark - anchors_[i - 1]) / (anchors_[i] - anchors_[i - 1]);
    double length = own_[i - 1] + part * (own_[i] - own_[i - 1]);
    while (length >= whole_) length -= whole_, rounds += 1.0;
    // The exact parameter of a corner, not the parameter computed from its length.
    for (double corner : profile_.corners())
      if (std::abs(profile_.lengthUpTo(corner) - length) <= 1e-12 * whole_) return corner + rounds;
    return profile_.parameterAt(length) + rounds;
  }

 private:
  const Profile& profile_;
  double whole_, referenceWhole_;
  Marks anchors_, own_;
};

/// Fractions of a side's length at its marks, ends included.
std::vector<double> sharesOf(const Marks& side) {
  std::vector<double> shares;
  for (double mark : side) shares.push_back((mark - side.front()) / (side.back() - side.front()));
  return shares;
}

/// Gives two opposite sides equally many marks: each mark gets a partner on the other side, the
/// mark of the same index if there are equally many, otherwise a mark nearby or a new one.
void matchSides(Marks& near, Marks& far) {
  if (near.size() == far.size()) return;
  constexpr double kPartner = 0.05;  // fraction of the side's length
  const std::vector<double> a = sharesOf(near);
  std::vector<double> b = sharesOf(far);
  std::reverse(b.begin(), b.end());
  for (double& share : b) share = 1.0 - share;
  const auto at = [](const Marks& side, double share) {
    return side.front() + share * (side.back() - side.front());
  };
  Marks newNear, newFar;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    const bool lastA = i + 1 >= a.size(), lastB = j + 1 >= b.size();
    const bool pair = (lastA && lastB) || (!lastA && !lastB && std::abs(a[i] - b[j]) < kPartner);
    if (pair) {
      newNear.push_back(near[i++]);
      newFar.push_back(far[far.size() - 1 - j++]);
    } else if (!lastA && (lastB || a[i] < b[j])) {
      newFar.push_back(at(far, 1.0 - a[i]));
      newNear.push_back(near[i++]);
    } else {
      newNear.push_back(at(near, b[j]));
      newFar.push_back(far[far.size() - 1 - j++]);
    }
  }
  std::reverse(newFar.begin(), newFar.end());
  near = newNear;
  far = newFar;
}

/// Four sides as marks on the reference: from each corner of the square to the next.
std::array<Marks, 4> sidesBetween(const Marks& corners, const Marks& square, double length) {
  std::array<Marks, 4> sides;
  for (int k = 0; k < 4; ++k) {
    const double from = square[k];
    const double to = k == 3 ? square[0] + length : square[k + 1];
    sides[k].push_back(from);
    for (double round : {0.0, length})
      for (double corner : corners)
        if (corner + round > from + 1e-9 * length && corner + round < to - 1e-9 * length)
          sides[k].push_back(corner + round);
    sides[k].push_back(to);
  }
  matchSides(sides[0], sides[2]);
  matchSides(sides[1], sides[3]);
  return sides;
}

constexpr int kParts =
    16;  // of the length, for corners of the square that are not corners of the profile

/// Calls visit(marks) for squares with equal sides, beginning with the square at the seam.
template <class Visit>
void forEqualSides(double length, Visit visit) {
  for (int k = 0; 4 * k < kParts; ++k) {
    const double start = length * k / kParts;
    visit(Marks{start, start + 0.25 * length, start + 0.5 * length, start + 0.75 * length});
  }
}

/// Calls visit(marks) for all choices of the square's corners.
template <class Visit>
void forSquares(const Marks& corners, double length, Visit visit) {
  Marks others;
  if (corners.size() < 4) {
    for (int k = 0; k < kParts; ++k) {
      const double mark = length * k / kParts;
      const bool free = std::none_of(corners.begin(), corners.end(), [&](double corner) {
        const double apart = std::abs(mark - corner);
        return std::min(apart, length - apart) < 0.5 * length / kParts;
      });
      if (free) others.push_back(mark);
    }
  }
  const Marks fixed = corners.size() < 4 ? corners : Marks{};
  const Marks& pool = corners.size() < 4 ? others : corners;
  const auto choose = [&](auto& self, Marks chosen, std::size_t from) -> void {
    if (chosen.size() == 4) {
      std::sort(chosen.begin(), chosen.end());
      visit(chosen);
      return;
    }
    for (std::size_t i = from; i < pool.size(); ++i) {
      Marks next = chosen;
      next.push_back(pool[i]);
      self(self, next, i + 1);
    }
  };
  choose(choose, fixed, 0);
}

const Profile& referenceOf(const std::vector<Profile>& profiles, const std::string& shape) {
  const Profile* reference = &profiles.front();
  for (const Profile& profile : profiles)
    if (profile.corners().size() > reference->corners().size()) reference = &profile;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const std::size_t count = profiles[i].corners().size();
    if (count == 0 || count == reference->corners().size()) continue;
    throw ModelingError(shape + ": sections[" + std::to_string(i) + "].profile has " +
                        std::to_string(count) + " corners and another section " +
                        std::to_string(reference->corners().size()) +
                        "; all sections need equally many, or none");
  }
  return *reference;
}

}  // namespace

std::vector<ProfileCuts> cutProfiles(const std::vector<Profile>& profiles,
                                     const std::string& shape) {
  constexpr int kSearchCells = 8;
  constexpr int kFinalCells = 32;
  constexpr double kClearlyBetter = 1.05;
  const Profile& reference = referenceOf(profiles, shape);
  const Marks corners = cornerLengths(reference);
  std::vector<Correspondence> maps;
  for (const Profile& profile : profiles) maps.emplace_back(profile, reference);
  const auto cutsOf = [&](std::size_t section, const std::array<Marks, 4>& sides) {
    ProfileCuts cuts;
    for (int k = 0; k < 4; ++k)
      for (double mark : sides[k]) cuts.side[k].push_back(maps[section].parameter(mark));
    return cuts;
  };
  const auto quality = [&](const std::array<Marks, 4>& sides, int cells, double floor) {
    double worst = 1.0;
    for (std::size_t section : {std::size_t{0}, profiles.size() - 1}) {
      if (worst <= floor) break;
      worst =
          std::min(worst, FlatCap(profiles[section], cutsOf(section, sides)).quality(cells, floor));
    }
    return worst;
  };

  std::array<Marks, 4> best;
  double bestQuality = 0.0;
  const auto consider = [&](const Marks& square) {
    const std::array<Marks, 4> sides = sidesBetween(corners, square, reference.length());
    const double floor = kClearlyBetter * bestQuality;
    const double q = quality(sides, kSearchCells, floor);
    if (q <= floor) return;
    best = sides;
    bestQuality = q;
  };
  // A profile without corners is usually round, and then equal sides are as good as any others.
  if (corners.empty()) forEqualSides(reference.length(), consider);
  if (bestQuality <= 0.0) forSquares(corners, reference.length(), consider);
  if (bestQuality <= 0.0 || quality(best, kFinalCells, 0.0) <= 0.0)
    throw ModelingError(shape +
                        ": the flat cap over the profile would fold, because the profile is too "
                        "winding for a patch with four sides; simplify it or cut the body in two");
  std::vector<ProfileCuts> result;
  for (std::size_t i = 0; i < profiles.size(); ++i) result.push_back(cutsOf(i, best));
  return result;
}

}  // namespace palpa::modeling
