#include "bem/gradient/mask_derivative.h"

#include <map>

namespace palpa::bem {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// One element: functions N at its points, bump b, weights W, and the projection β = (Nᵀ W N)⁻¹ Nᵀ
/// W b of the bump.
struct Projected {
  Eigen::MatrixXd basis;     ///< N: [point][function]
  VectorXd weights, bump;    ///< per point
  VectorXd mean;             ///< h·u per point
  std::vector<int> indices;  ///< into mask.nodes; -1: not in it
  Eigen::LDLT<Eigen::MatrixXd> mass;
  VectorXd projection;
};

double bumpHeight(const ContactMask& mask, const Vector3d& x) {
  return std::max(0.0, 1 - (x - mask.point.position).squaredNorm() / (mask.radius * mask.radius));
}

Projected project(const FieldSampler::Block& block, const ContactMask& mask,
                  const std::map<int, int>& indexOf, const Vector3d& ofMean, const VectorXd& u) {
  Projected result;
  const Index points = static_cast<Index>(block.points.size());
  result.basis.resize(points, block.displacement.cols());
  result.weights.resize(points);
  result.bump.resize(points);
  for (Index q = 0; q < points; ++q) {
    const SampledPoint& point = block.points[static_cast<std::size_t>(q)];
    const double height = bumpHeight(mask, point.position);
    result.basis.row(q) = block.displacement.row(3 * q);
    result.weights[q] = point.weight;
    result.bump[q] = height * height;
  }
  VectorXd ofFunctions(static_cast<Index>(block.coefficients.size()));
  for (std::size_t f = 0; f < block.coefficients.size(); ++f) {
    const auto found = indexOf.find(block.coefficients[f]);
    result.indices.push_back(found == indexOf.end() ? -1 : found->second);
    ofFunctions[static_cast<Index>(f)] =
        ofMean.dot(u.segment<3>(3 * static_cast<Index>(block.coefficients[f])));
  }
  result.mean = result.basis * ofFunctions;
  const Eigen::MatrixXd weighted = result.weights.asDiagonal() * result.basis;
  result.mass.compute(result.basis.transpose() * weighted);
  result.projection = result.mass.solve(weighted.transpose() * result.bump);
  return result;
}

/// Adds numbers of an element's functions to numbers of the mask's nodes.
void addTo(const Projected& element, const VectorXd& ofFunctions, VectorXd& ofNodes) {
  for (std::size_t f = 0; f < element.indices.size(); ++f)
    if (element.indices[f] >= 0) ofNodes[element.indices[f]] += ofFunctions[static_cast<Index>(f)];
}

VectorXd from(const Projected& element, const VectorXd& ofNodes) {
  VectorXd result = VectorXd::Zero(static_cast<Index>(element.indices.size()));
  for (std::size_t f = 0; f < element.indices.size(); ++f)
    if (element.indices[f] >= 0) result[static_cast<Index>(f)] = ofNodes[element.indices[f]];
  return result;
}

}  // namespace

// With the shares s_ea of element e in node a, A_a = Σ_e s_ea, the raw coefficients are
//   φ_a = Σ_e s_ea β_ea / A_a,   c = Σ_a φ_a ∫ N_a dΓ,   I = ∫ b dΓ,
//   J = K + 2 L,   K = (Σ g_a φ_a - ∫ Φ h·u dΓ) / c,   L = ∫ b h·u dΓ / I.
// The derivative of K by φ_a is G_a = (g_a - ∫ N_a h·u - K ∫ N_a) / c. A change of the bump and of
// the weights at the points changes β_e by (Nᵀ W N)⁻¹ Nᵀ [W δb + δW (b - N β)], so that with
//   γ_e = (Nᵀ W N)⁻¹ (s_ea G_a / A_a)
// K changes per δb_q by W_q (N γ)_q and per δW_q by (b - N β)_q (N γ)_q, by Σ_a σ_a(q) G_a (β_ea -
// φ_a) / A_a through the shares s_ea = Σ_q W_q σ_a(q), and by Φ_q (-h·u - K) / c; L changes per
// δb_q by W_q (h·u - L) / I and per δW_q by b_q (h·u - L) / I.
ShapeDensity maskDerivative(const std::vector<FieldSampler::Block>& blocks, const ContactMask& mask,
                            const MaskWork& work, MaskShares shares, const VectorXd& u,
                            Vector3d& ofCentre) {
  std::map<int, int> indexOf;
  for (const int node : mask.nodes) indexOf.try_emplace(node, static_cast<int>(indexOf.size()));
  const Index count = static_cast<Index>(indexOf.size());
  std::vector<Projected> elements;
  VectorXd integrals = VectorXd::Zero(count), means = VectorXd::Zero(count),
           totals = VectorXd::Zero(count), raw = VectorXd::Zero(count);
  const auto sharesOf = [&](const Projected& element) -> VectorXd {
    if (shares == MaskShares::kFunctions) return element.basis.transpose() * element.weights;
    return VectorXd::Constant(element.basis.cols(), element.weights.sum());
  };
  int points = 0;
  double ofBump = 0, meanOfBump = 0;
  for (const FieldSampler::Block& block : blocks) {
    const Projected& element = elements.emplace_back(project(block, mask, indexOf, work.ofMean, u));
    const VectorXd weighted = element.weights.cwiseProduct(element.mean);
    addTo(element, element.basis.transpose() * element.weights, integrals);
    addTo(element, element.basis.transpose() * weighted, means);
    const VectorXd share = sharesOf(element);
    addTo(element, share, totals);
    addTo(element, share.cwiseProduct(element.projection), raw);
    ofBump += element.weights.dot(element.bump);
    meanOfBump += weighted.dot(element.bump);
    points += static_cast<int>(block.points.size());
  }
  meanOfBump /= ofBump;
  raw = raw.cwiseQuotient(totals);
  const double carried = raw.dot(integrals);
  const double value = (raw.dot(work.ofTraction) - raw.dot(means)) / carried;
  const VectorXd byRaw = (work.ofTraction - means - value * integrals) / carried;

  ShapeDensity density(points);
  ofCentre.setZero();
  const double inverse = 1 / (mask.radius * mask.radius);
  Index next = 0;
  for (std::size_t e = 0; e < blocks.size(); ++e) {
    const Projected& element = elements[e];
    const VectorXd ofNodes = from(element, byRaw.cwiseQuotient(totals));
    const VectorXd adjoint =
        element.basis * element.mass.solve(sharesOf(element).cwiseProduct(ofNodes));
    const VectorXd rest = element.bump - element.basis * element.projection;
    const VectorXd byShare = ofNodes.cwiseProduct(element.projection - from(element, raw));
    const VectorXd atShares = shares == MaskShares::kFunctions
                                  ? VectorXd(element.basis * byShare)
                                  : VectorXd::Constant(rest.size(), byShare.sum());
    const VectorXd traction = element.basis * from(element, raw);
    for (Index q = 0; q < rest.size(); ++q, ++next) {
      const SampledPoint& point = blocks[e].points[static_cast<std::size_t>(q)];
      const double byBump = adjoint[q] + 2 * (element.mean[q] - meanOfBump) / ofBump;
      const Vector3d pull = -4 * bumpHeight(mask, point.position) * inverse * point.weight *
                            byBump * (point.position - mask.point.position);
      density.value.col(next) = pull;
      ofCentre -= pull;
      const double byWeight = rest[q] * adjoint[q] + atShares[q] -
                              traction[q] * (element.mean[q] + value) / carried +
                              2 * element.bump[q] * (element.mean[q] - meanOfBump) / ofBump;
      density.slope.middleCols<2>(2 * next) = byWeight * point.weight * point.frame.leftCols<2>();
    }
  }
  return density;
}

}  // namespace palpa::bem
