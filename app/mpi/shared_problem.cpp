#include "app/mpi/shared_problem.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/mpi/column_solver.h"
#include "base/byte_reader.h"
#include "bem/base/error.h"

namespace palpa::mpi {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// Sends bytes to rank 0 in messages of equal size, the last one shorter.
class Sender {
 public:
  explicit Sender(MPI_Comm communicator) : communicator_(communicator) { buffer_.reserve(kSize); }
  void add(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const std::size_t some = std::min(bytes.size(), kSize - buffer_.size());
      buffer_.insert(buffer_.end(), bytes.begin(),
                     bytes.begin() + static_cast<std::ptrdiff_t>(some));
      bytes = bytes.subspan(some);
      if (buffer_.size() == kSize) flush();
    }
  }
  void flush() {
    MPI_Send(buffer_.data(), static_cast<int>(buffer_.size()), MPI_BYTE, 0, 1, communicator_);
    buffer_.clear();
  }

  static constexpr std::size_t kSize = std::size_t{16} << 20;

 private:
  MPI_Comm communicator_;
  std::vector<std::byte> buffer_;
};

/// The other end of a Sender.
class Receiver {
 public:
  Receiver(MPI_Comm communicator, int from) : communicator_(communicator), from_(from) {}
  void take(std::span<std::byte> to) {
    while (!to.empty()) {
      if (at_ == buffer_.size()) receive();
      const std::size_t some = std::min(to.size(), buffer_.size() - at_);
      std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(at_), some, to.begin());
      at_ += some;
      to = to.subspan(some);
    }
  }
  /// Takes the last message if it is not complete, which may be empty.
  void finish() {
    if (buffer_.empty() || buffer_.size() == Sender::kSize) receive();
  }

 private:
  void receive() {
    buffer_.resize(Sender::kSize);
    MPI_Status status;
    MPI_Recv(buffer_.data(), static_cast<int>(Sender::kSize), MPI_BYTE, from_, 1, communicator_,
             &status);
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    buffer_.resize(static_cast<std::size_t>(count));
    at_ = 0;
  }

  MPI_Comm communicator_;
  int from_;
  std::vector<std::byte> buffer_;
  std::size_t at_ = 0;
};

}  // namespace

SharedProblem::SharedProblem(std::unique_ptr<bem::CompressedReferenceProblem> share,
                             const MpiTeam& team)
    : ReferenceProblem(share->dofs(), bem::CompressedReferenceProblem::kRefinement),
      share_(std::move(share)),
      team_(team) {}

void SharedProblem::write(const ByteSink& /*sink*/) const {
  throw std::logic_error("a share of a problem cannot be stored");
}

MatrixXd SharedProblem::residual(const bem::BoundaryField& field, const Job& job) const {
  MatrixXd r = share_->residual(field, job);
  const MpiTeam::Waiting waiting(team_);
  // A sum for all in one call may differ between the ranks in the last bit.
  const auto size = static_cast<int>(r.size());
  MPI_Reduce(team_.index() == 0 ? MPI_IN_PLACE : r.data(), r.data(), size, MPI_DOUBLE, MPI_SUM, 0,
             team_.communicator());
  MPI_Bcast(r.data(), size, MPI_DOUBLE, 0, team_.communicator());
  return r;
}

SharedProblem::Columns SharedProblem::columnsOf(int rank, Index all) const {
  const Index begin = all * rank / team_.count(), end = all * (rank + 1) / team_.count();
  return {begin, end - begin};
}

MatrixXd SharedProblem::allColumns(const MatrixXd& own, Index all) const {
  MatrixXd columns(dofs().count(), all);
  std::vector<int> counts, begins;
  for (int rank = 0; rank < team_.count(); ++rank) {
    counts.push_back(static_cast<int>(dofs().count() * columnsOf(rank, all).count));
    begins.push_back(static_cast<int>(dofs().count() * columnsOf(rank, all).begin));
  }
  const MpiTeam::Waiting waiting(team_);
  MPI_Allgatherv(own.data(), static_cast<int>(own.size()), MPI_DOUBLE, columns.data(),
                 counts.data(), begins.data(), MPI_DOUBLE, team_.communicator());
  return columns;
}

MatrixXd SharedProblem::apply(const MatrixXd& own, Index all, const Job& job) const {
  const MatrixXd summand = -share_->residual(dofs().expand(allColumns(own, all), MatrixXd()), job);
  MatrixXd sum(dofs().count(), own.cols());
  std::vector<int> counts;
  for (int rank = 0; rank < team_.count(); ++rank)
    counts.push_back(static_cast<int>(dofs().count() * columnsOf(rank, all).count));
  const MpiTeam::Waiting waiting(team_);
  MPI_Reduce_scatter(summand.data(), sum.data(), counts.data(), MPI_DOUBLE, MPI_SUM,
                     team_.communicator());
  return sum;
}

MatrixXd SharedProblem::correction(const MatrixXd& r, const Job& job) const {
  constexpr int kMaxSteps = 60;
  constexpr double kTolerance = bem::CompressedReferenceProblem::kTolerance;
  const Index all = r.cols();
  // Columns of length 1, so that their common residual bounds each one.
  const Eigen::RowVectorXd scale = r.colwise().norm().cwiseMax(1e-300);
  const Columns mine = columnsOf(team_.index(), all);
  const MatrixXd b = r.middleCols(mine.begin, mine.count) *
                     scale.segment(mine.begin, mine.count).cwiseInverse().asDiagonal();
  const ColumnSystem system{
      [&](const MatrixXd& own) { return apply(own, all, job); },
      [&](const MatrixXd& own) { return own.cols() > 0 ? share_->precondition(own, job) : own; }};
  const ColumnSolution solution = solveColumns(
      team_.communicator(), system, b, kTolerance / std::sqrt(static_cast<double>(all)), kMaxSteps);
  if (!(solution.residual <= 100 * kTolerance))  // also if it is not a number
    throw bem::SolverError(bem::SolverError::Kind::kBadCondition,
                           "the equations of the compressed operators were solved only to " +
                               std::to_string(solution.residual) +
                               "; check the mesh for degenerate places");
  return allColumns(solution.x, all) * scale.asDiagonal();
}

std::unique_ptr<bem::CompressedReferenceProblem> SharedProblem::whole() {
  if (team_.index() > 0) {
    Sender sender(team_.communicator());
    share_->operators().write([&](std::span<const std::byte> bytes) { sender.add(bytes); });
    sender.flush();
    share_.reset();
    return nullptr;
  }
  for (int rank = 1; rank < team_.count(); ++rank) {
    Receiver receiver(team_.communicator(), rank);
    share_->add(
        bem::CompressedOperators([&](std::span<std::byte> bytes) { receiver.take(bytes); }));
    receiver.finish();
  }
  return std::move(share_);
}

}  // namespace palpa::mpi
