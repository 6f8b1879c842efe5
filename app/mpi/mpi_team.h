#pragma once

#include <mpi.h>

#include "bem/base/team.h"

namespace palpa::mpi {

/// The ranks of a communicator as a team. Errors of MPI end the program.
class MpiTeam final : public bem::Team {
 public:
  explicit MpiTeam(MPI_Comm communicator);

  MPI_Comm communicator() const { return communicator_; }
  int index() const override { return index_; }
  int count() const override { return count_; }
  std::vector<Bytes> exchange(const std::vector<Bytes>& to) const override;
  std::vector<Bytes> gather(const Bytes& own) const override;

  /// Processor time of this process without what passed in Waiting objects, s: ranks that wait for
  /// others use their processors, too.
  double workSeconds() const;

  /// Lives while this rank communicates.
  class Waiting {
   public:
    explicit Waiting(const MpiTeam& team);
    ~Waiting();
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

   private:
    const MpiTeam& team_;
    const double begin_;
  };

 private:
  MPI_Comm communicator_;
  int index_ = 0, count_ = 1;
  mutable double waited_ = 0;
};

/// Largest number of bytes in one message; MPI counts with int.
inline constexpr std::size_t kMaxMessage = std::size_t{1} << 29;

}  // namespace palpa::mpi
