#include "app/core/page/page_solutions.h"

#include <algorithm>
#include <numeric>

#include "app/core/results/mask_compliance.h"
#include "bem/contact/contact_surface.h"
#include "bem/problem/greens_columns.h"

namespace palpa::app {

using Eigen::Index;

namespace {

/// Masks that are solved together: enough for the solver to be efficient, few enough to stop soon.
constexpr std::size_t kBlock = 16;

}  // namespace

PageSolutions::PageSolutions(const TouchableModel& model, double radius, const Job& job)
    : model_(model), radius_(radius), one_(model.surface(), *model.columns(), model.base()) {
  std::vector<int> nodes(model.surface().places().size());
  std::iota(nodes.begin(), nodes.end(), 0);
  model.columns()->compute(nodes, job);
  one_.resize(1);
}

std::optional<PageSolutions::Own> PageSolutions::own(const bem::SurfacePoint& point) {
  if (!one_.place(0, point, radius_)) return std::nullopt;
  one_.update();
  return Own{one_.compliance(), one_.freeDisplacements()};
}

Eigen::MatrixXd PageSolutions::between(std::span<const bem::SurfacePoint> points) {
  bem::ContactCompliance all(model_.surface(), *model_.columns(), model_.base());
  all.resize(static_cast<int>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    all.place(static_cast<int>(k), points[k], radius_);
  all.update();
  return all.compliance();
}

bem::ContactMask PageSolutions::mask(const bem::SurfacePoint& point) const {
  const auto workspace = model_.surface().makeWorkspace();
  bem::ContactMask mask;
  model_.surface().makeMask(point, radius_, *workspace, mask);
  return mask;
}

void PageSolutions::forEach(std::span<const bem::ContactMask> masks,
                            const std::function<void(std::size_t k, const Eigen::MatrixXd& u)>& use,
                            const std::function<void(double fraction)>& report,
                            const Job& job) const {
  Job quiet = job;
  quiet.progress = nullptr;
  for (std::size_t first = 0; first < masks.size(); first += kBlock) {
    job.throwIfCancelled();
    const std::size_t count = std::min(kBlock, masks.size() - first);
    const Eigen::MatrixXd u = unitFields(model_, masks.subspan(first, count), quiet).u;
    for (std::size_t k = 0; k < count; ++k)
      use(first + k, u.middleCols<3>(3 * static_cast<Index>(k)));
    report(static_cast<double>(first + count) / static_cast<double>(masks.size()));
  }
}

}  // namespace palpa::app
