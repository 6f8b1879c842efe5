#pragma once

#include <barrier>
#include <functional>
#include <thread>
#include <vector>

#include "bem/base/team.h"

namespace palpa::bem::test {

/// A team of threads. Members must not fail, or the others wait for ever.
class ThreadTeam {
 public:
  explicit ThreadTeam(int count) : count_(count), barrier_(count), sent_(count) {}

  /// Runs the work of each member on a thread.
  void run(const std::function<void(const Team&)>& work) {
    std::vector<std::jthread> threads;
    for (int m = 0; m < count_; ++m) threads.emplace_back([&, m] { work(Member(*this, m)); });
  }

 private:
  class Member final : public Team {
   public:
    Member(ThreadTeam& all, int index) : all_(all), index_(index) {}
    int index() const override { return index_; }
    int count() const override { return all_.count_; }
    std::vector<Bytes> exchange(const std::vector<Bytes>& to) const override {
      all_.sent_[index_] = to;
      all_.barrier_.arrive_and_wait();
      std::vector<Bytes> received;
      for (const auto& from : all_.sent_) received.push_back(from[index_]);
      all_.barrier_.arrive_and_wait();
      return received;
    }
    std::vector<Bytes> gather(const Bytes& own) const override {
      return exchange(std::vector<Bytes>(static_cast<std::size_t>(count()), own));
    }

   private:
    ThreadTeam& all_;
    int index_;
  };

  int count_;
  std::barrier<> barrier_;
  std::vector<std::vector<Team::Bytes>> sent_;  ///< by each member, to each
};

}  // namespace palpa::bem::test
