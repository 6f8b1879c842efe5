#include "bem/gradient/boundary_form.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <set>

#include "base/parallel.h"

namespace palpa::bem {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// The sums of a pass are the same for every number of threads because they are added by task.
constexpr int kTasks = 8;
constexpr int kGeometry = 10;  // lanes per group: frame and weight

/// Hooke's law for derivatives along two tangents and the traction, in the frame of the surface
/// (surface_gradient.h).
struct SurfaceLaw {
  explicit SurfaceLaw(const Material& material)
      : shear(material.shear()),
        inverseShear(1 / shear),
        ratio(material.poissonRatio),
        coupling(ratio / (1 - ratio)),
        ofNormal((1 - 2 * ratio) / (2 * shear * (1 - ratio))) {}
  double shear, inverseShear, ratio, coupling, ofNormal;
};

/// Gradient, stress and traction of a field at some points, in their frames.
template <class Lanes>
struct LocalState {
  /// `frame`: by columns. `along`: the derivatives along both tangents, along the axes.
  LocalState(const Lanes* frame, const Lanes (&along)[2][3], const Lanes (&t)[3],
             const SurfaceLaw& law) {
    const auto component = [&](int axis, const Lanes(&of)[3]) -> Lanes {
      return frame[3 * axis] * of[0] + frame[3 * axis + 1] * of[1] + frame[3 * axis + 2] * of[2];
    };
    for (int i = 0; i < 3; ++i) {
      traction[i] = component(i, t);
      for (int j = 0; j < 2; ++j) gradient[i][j] = component(i, along[j]);
    }
    const Lanes trace = gradient[0][0] + gradient[1][1];
    shearSlope[0] = law.inverseShear * traction[0];
    shearSlope[1] = law.inverseShear * traction[1];
    for (int a = 0; a < 2; ++a) gradient[a][2] = shearSlope[a] - gradient[2][a];
    gradient[2][2] = law.ofNormal * traction[2] - law.coupling * trace;
    const Lanes common = law.coupling * (2 * law.shear * trace + traction[2]);
    stress[0] = 2 * law.shear * gradient[0][0] + common;
    stress[1] = 2 * law.shear * gradient[1][1] + common;
    shearStrain = gradient[0][1] + gradient[1][0];
  }
  /// σ(this):ε(other).
  Lanes energy(const LocalState& other, const SurfaceLaw& law) const {
    return stress[0] * other.gradient[0][0] + stress[1] * other.gradient[1][1] +
           law.shear * shearStrain * other.shearStrain + traction[0] * other.shearSlope[0] +
           traction[1] * other.shearSlope[1] + traction[2] * other.gradient[2][2];
  }
  /// Component j of (∇u)ᵀ t.
  Lanes pull(int j, const Lanes (&t)[3]) const {
    return gradient[0][j] * t[0] + gradient[1][j] * t[1] + gradient[2][j] * t[2];
  }

  Lanes gradient[3][3], traction[3];
  Lanes shearSlope[2];  ///< sums of the slopes between a tangent and the normal
  Lanes stress[2], shearStrain;
};

/// Coefficients of two fields by the list of an element, six numbers each.
using Pair = std::array<double, 6>;
void gather(const std::vector<int>& list, const double* a, const double* b,
            std::vector<Pair>& pairs) {
  pairs.resize(list.size());
  for (std::size_t k = 0; k < list.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      pairs[k][c] = a[3 * static_cast<Index>(list[k]) + c];
      pairs[k][3 + c] = b[3 * static_cast<Index>(list[k]) + c];
    }
}

}  // namespace

MaskTraction maskTraction(const ContactMask& mask, const std::vector<int>& firstSlot) {
  MaskTraction result;
  for (std::size_t k = 0; k < mask.nodes.size(); ++k)
    for (int slot = firstSlot[mask.nodes[k]]; slot < firstSlot[mask.nodes[k] + 1]; ++slot) {
      result.slots.push_back(slot);
      result.values.push_back(mask.traction[k]);
    }
  return result;
}

BoundaryForm::BoundaryForm(const FieldSampler& sampler, std::vector<Motion> motions,
                           int controlPoints, const Material& material)
    : sampler_(sampler),
      motions_(std::move(motions)),
      controlPoints_(controlPoints),
      material_(material) {
  assert(motions_.size() == sampler.blocks().size());
  int slotCount = 0;
  for (std::size_t b = 0; b < motions_.size(); ++b) {
    const FieldSampler::Functions& on = sampler.blocks()[b];
    const Motion& motion = motions_[b];
    Block block{data_.size(), (on.count + kLanes - 1) / kLanes};
    for (int group = 0; group < block.groups; ++group) {
      const int used = std::min(kLanes, on.count - kLanes * group);
      // The last point is repeated in the padding.
      const auto append = [&](const auto& numberOf) {
        Lanes& lanes = data_.emplace_back();
        for (int lane = 0; lane < kLanes; ++lane)
          lanes[lane] = numberOf(kLanes * group + std::min(lane, used - 1));
      };
      const auto pointOf = [&](int k) -> const SampledPoint& {
        return sampler.points()[static_cast<std::size_t>(on.first + k)];
      };
      for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
          append([&](int k) { return pointOf(k).frame(row, column); });
      append([&](int k) { return pointOf(k).weight; });
      for (int lane = used; lane < kLanes; ++lane) data_.back()[lane] = 0;
      for (Index f = 0; f < on.displacement.cols(); ++f)
        for (int tangent = 1; tangent <= 2; ++tangent)
          append([&](int k) { return on.displacement(3 * k + tangent, f); });
      for (Index s = 0; s < on.traction.cols(); ++s)
        append([&](int k) { return on.traction(k, s); });
      for (Index j = 0; j < motion.functions.cols(); ++j)
        append([&](int k) { return motion.functions(3 * k, j); });
    }
    blocks_.push_back(block);
    for (const int slot : on.slots) slotCount = std::max(slotCount, slot + 1);
  }
  std::vector<std::vector<int>> blocksOf(static_cast<std::size_t>(slotCount));
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (const int slot : sampler.blocks()[b].slots) blocksOf[slot].push_back(static_cast<int>(b));
  firstOfSlot_.push_back(0);
  for (const std::vector<int>& list : blocksOf) {
    blocksOfSlot_.insert(blocksOfSlot_.end(), list.begin(), list.end());
    firstOfSlot_.push_back(static_cast<int>(blocksOfSlot_.size()));
  }
}

/// One task of ofEnergy(): visits blocks and adds up what they give.
class BoundaryForm::Pass {
 public:
  Pass(const BoundaryForm& form, const BoundaryField& a, const BoundaryField& b)
      : form_(form),
        a_(a),
        b_(b),
        law_(form.material_),
        result_(Matrix3Xd::Zero(3, form.controlPoints_)) {}

  void add(std::size_t block) {
    const FieldSampler::Functions& on = form_.sampler_.blocks()[block];
    const std::vector<int>& controlPoints = form_.motions_[block].controlPoints;
    gather(on.coefficients, a_.u.data(), b_.u.data(), u_);
    gather(on.slots, a_.p.data(), b_.p.data(), p_);
    byControlPoints_.resize(controlPoints.size());
    for (auto& each : byControlPoints_)
      for (Lanes& lanes : each) lanes.setZero();
    const Lanes* data = &form_.data_[form_.blocks_[block].first];
    for (int group = 0; group < form_.blocks_[block].groups; ++group) data = addGroup(data);
    for (std::size_t j = 0; j < controlPoints.size(); ++j)
      for (int c = 0; c < 3; ++c) result_(c, controlPoints[j]) += byControlPoints_[j][c].sum();
  }

  const Matrix3Xd& result() const { return result_; }

 private:
  /// Returns the end of the group's data.
  const Lanes* addGroup(const Lanes* data) {
    const Lanes* frame = data;
    const Lanes weight = data[9];
    data += kGeometry;
    Lanes along[2][2][3], traction[2][3];
    for (int field = 0; field < 2; ++field)
      for (int c = 0; c < 3; ++c) {
        along[field][0][c].setZero();
        along[field][1][c].setZero();
        traction[field][c].setZero();
      }
    for (const Pair& u : u_) {
      for (int field = 0; field < 2; ++field)
        for (int c = 0; c < 3; ++c) {
          along[field][0][c] += data[0] * u[3 * field + c];
          along[field][1][c] += data[1] * u[3 * field + c];
        }
      data += 2;
    }
    for (const Pair& p : p_) {
      for (int field = 0; field < 2; ++field)
        for (int c = 0; c < 3; ++c) traction[field][c] += data[0] * p[3 * field + c];
      ++data;
    }
    const LocalState<Lanes> a(frame, along[0], traction[0], law_),
        b(frame, along[1], traction[1], law_);
    Lanes local[3], density[3];
    for (int j = 0; j < 3; ++j) local[j] = -a.pull(j, b.traction) - b.pull(j, a.traction);
    local[2] += a.energy(b, law_);
    for (int c = 0; c < 3; ++c)
      density[c] =
          weight * (frame[c] * local[0] + frame[3 + c] * local[1] + frame[6 + c] * local[2]);
    for (auto& each : byControlPoints_) {
      for (int c = 0; c < 3; ++c) each[c] += data[0] * density[c];
      ++data;
    }
    return data;
  }

  const BoundaryForm& form_;
  const BoundaryField &a_, &b_;
  SurfaceLaw law_;
  Matrix3Xd result_;
  std::vector<Pair> u_, p_;
  std::vector<std::array<Lanes, 3>> byControlPoints_;
};

Matrix3Xd BoundaryForm::ofEnergy(const BoundaryField& a, const BoundaryField& b,
                                 const Job& job) const {
  std::array<Matrix3Xd, kTasks> sums;
  const std::size_t perTask = (blocks_.size() + kTasks - 1) / kTasks;
  parallelFor(kTasks, job, [&](std::ptrdiff_t task) {
    Pass pass(*this, a, b);
    const std::size_t first = static_cast<std::size_t>(task) * perTask;
    for (std::size_t k = first; k < std::min(first + perTask, blocks_.size()); ++k) pass.add(k);
    sums[static_cast<std::size_t>(task)] = pass.result();
  });
  for (std::size_t task = 1; task < kTasks; ++task) sums.front() += sums[task];
  return sums.front();
}

// With s = |x - c|²/r² the mask is Φ = b / B, b = (1 - s)², B = ∫ b dΓ. The measure Φ dΓ changes by
// [ḃ + b div V - b Ḃ / B] / B with ḃ = -4 (1 - s) (x - c)·(V(x) - V(c)) / r², and the work of h =
// force·u by ∫ (h - H) (ḃ + b div V) dΓ / B, H = ∫ b h dΓ / B.
Vector3d BoundaryForm::addMask(const ContactMask& mask, const MaskTraction& traction,
                               const Vector3d& force, const VectorXd& u, double factor,
                               Matrix3Xd& byControlPoints) const {
  struct Point {
    std::size_t block;
    int k;                       ///< in the block
    const SampledPoint* sample;  ///< of the sampler
    double height, work;
  };
  const double inverse = 1 / (mask.radius * mask.radius);
  const Vector3d& centre = mask.point.position;
  VectorXd ofSlots = VectorXd::Zero(static_cast<Index>(firstOfSlot_.size()) - 1);
  std::set<int> blocks;
  for (std::size_t i = 0; i < traction.slots.size(); ++i) {
    const int slot = traction.slots[i];
    if (slot >= ofSlots.size()) continue;  // on no element
    ofSlots[slot] = traction.values[i];
    blocks.insert(blocksOfSlot_.begin() + firstOfSlot_[slot],
                  blocksOfSlot_.begin() + firstOfSlot_[slot + 1]);
  }
  std::vector<Point> points;
  double total = 0, mean = 0;
  for (const int b : blocks) {
    const FieldSampler::Functions& on = sampler_.blocks()[static_cast<std::size_t>(b)];
    const VectorXd support = on.traction * ofSlots(on.slots);
    VectorXd work(static_cast<Index>(on.coefficients.size()));
    for (std::size_t f = 0; f < on.coefficients.size(); ++f)
      work[static_cast<Index>(f)] =
          force.dot(u.segment<3>(3 * static_cast<Index>(on.coefficients[f])));
    for (int k = 0; k < on.count; ++k) {
      if (support[k] == 0) continue;
      const SampledPoint& sample = sampler_.points()[static_cast<std::size_t>(on.first + k)];
      const double height = 1 - (sample.position - centre).squaredNorm() * inverse;
      if (height <= 0) continue;
      points.push_back(
          {static_cast<std::size_t>(b), k, &sample, height, on.displacement.row(3 * k).dot(work)});
      total += sample.weight * height * height;
      mean += sample.weight * height * height * points.back().work;
    }
  }
  mean /= total;
  Vector3d ofCentre = Vector3d::Zero();
  for (const Point& point : points) {
    const double work = factor * point.sample->weight / total * (point.work - mean);
    const Vector3d pull = -4 * point.height * inverse * work * (point.sample->position - centre);
    ofCentre -= pull;
    const Eigen::Matrix<double, 3, 2> slope =
        work * point.height * point.height * point.sample->frame.leftCols<2>();
    const Motion& motion = motions_[point.block];
    for (std::size_t j = 0; j < motion.controlPoints.size(); ++j)
      byControlPoints.col(motion.controlPoints[j]) +=
          motion.functions(3 * point.k, static_cast<Index>(j)) * pull +
          slope * motion.functions.col(static_cast<Index>(j)).segment<2>(3 * point.k + 1);
  }
  return ofCentre;
}

}  // namespace palpa::bem
