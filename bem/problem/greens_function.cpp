#include "bem/problem/greens_function.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace palpa::bem {

void GreensFunction::ensure(std::span<const int> dofs) {
  std::vector<int> missing;
  std::copy_if(dofs.begin(), dofs.end(), std::back_inserter(missing),
               [&](int dof) { return !columns_.contains(dof); });
  if (missing.empty()) return;
  const Eigen::MatrixXd computed = problem_->greensColumns(missing);
  for (std::size_t k = 0; k < missing.size(); ++k)
    columns_[missing[k]] = computed.col(static_cast<Eigen::Index>(k));
}

void GreensFunction::computeAll(const Job& job) {
  constexpr int kBlock = 192;
  const int count = problem_->dofs().nodalCount();
  LargeMatrix<float> all(problem_->dofs().count(), count);
  std::vector<int> block;
  for (int first = 0; first < count; first += kBlock) {
    job.throwIfCancelled();
    block.resize(std::min(kBlock, count - first));
    std::iota(block.begin(), block.end(), first);
    all.view().middleCols(first, static_cast<Eigen::Index>(block.size())) =
        problem_->greensColumns(block, ReferenceProblem::Effort::kFast).cast<float>();
    job.report("Green's function", static_cast<double>(first + block.size()) / count);
  }
  all_ = std::move(all);
}

Eigen::VectorXd GreensFunction::column(int dof) const {
  const auto place = columns_.find(dof);
  if (place != columns_.end()) return place->second;
  return all_.view().col(dof).cast<double>();
}

std::size_t GreensFunction::bytes() const {
  return all_.bytes() + columns_.size() * sizeof(double) * problem_->dofs().count();
}

}  // namespace palpa::bem
