#include "app/mpi/mpi_team.h"

#include <algorithm>
#include <cstdint>
#include <ctime>

namespace palpa::mpi {
namespace {

/// Calls use(begin, count) for parts of `bytes` bytes that fit into one message.
template <class Use>
void inMessages(std::size_t bytes, const Use& use) {
  for (std::size_t begin = 0; begin < bytes; begin += kMaxMessage)
    use(begin, static_cast<int>(std::min(kMaxMessage, bytes - begin)));
}

double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

MpiTeam::Waiting::Waiting(const MpiTeam& team) : team_(team), begin_(processorSeconds()) {}

MpiTeam::Waiting::~Waiting() {
  team_.waited_ += processorSeconds() - begin_;
}

double MpiTeam::workSeconds() const {
  return processorSeconds() - waited_;
}

MpiTeam::MpiTeam(MPI_Comm communicator) : communicator_(communicator) {
  MPI_Comm_rank(communicator, &index_);
  MPI_Comm_size(communicator, &count_);
}

std::vector<bem::Team::Bytes> MpiTeam::exchange(const std::vector<Bytes>& to) const {
  const Waiting waiting(*this);
  std::vector<std::uint64_t> sent, got(static_cast<std::size_t>(count_));
  for (const Bytes& bytes : to) sent.push_back(bytes.size());
  MPI_Alltoall(sent.data(), 1, MPI_UINT64_T, got.data(), 1, MPI_UINT64_T, communicator_);
  std::vector<Bytes> received(static_cast<std::size_t>(count_));
  std::vector<MPI_Request> requests;
  for (int m = 0; m < count_; ++m) {
    if (m == index_) continue;
    received[m].resize(got[m]);
    inMessages(got[m], [&](std::size_t begin, int count) {
      MPI_Irecv(received[m].data() + begin, count, MPI_BYTE, m, 0, communicator_,
                &requests.emplace_back());
    });
  }
  for (int m = 0; m < count_; ++m) {
    if (m == index_) continue;
    inMessages(sent[m], [&](std::size_t begin, int count) {
      MPI_Isend(to[m].data() + begin, count, MPI_BYTE, m, 0, communicator_,
                &requests.emplace_back());
    });
  }
  received[index_] = to[index_];
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return received;
}

std::vector<bem::Team::Bytes> MpiTeam::gather(const Bytes& own) const {
  const Waiting waiting(*this);
  std::vector<std::uint64_t> sizes(static_cast<std::size_t>(count_));
  const std::uint64_t size = own.size();
  MPI_Allgather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, communicator_);
  std::vector<Bytes> all(static_cast<std::size_t>(count_));
  all[index_] = own;
  for (int m = 0; m < count_; ++m) {
    all[m].resize(sizes[m]);
    inMessages(sizes[m], [&](std::size_t begin, int count) {
      MPI_Bcast(all[m].data() + begin, count, MPI_BYTE, m, communicator_);
    });
  }
  return all;
}

}  // namespace palpa::mpi
