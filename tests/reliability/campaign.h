#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// Common part of the reliability campaigns (docs/reliability.md). Each campaign is a program with
// the options --seconds, --rounds and --seed that prints one line of figures and exits with 0 if
// nothing failed.
namespace palpa::reliability {

using Clock = std::chrono::steady_clock;
using Random = std::mt19937_64;

constexpr double kMiB = 1024.0 * 1024.0;  // bytes

/// A whole number from `least` to `most`, the same on every machine for the same seed.
int pick(Random& random, int least, int most);
/// A number from `least` to `most`.
double pickReal(Random& random, double least, double most);
/// True with probability 1 / `times`.
inline bool oneIn(Random& random, int times) {
  return pick(random, 1, times) == 1;
}

/// Resources of the process.
struct Usage {
  double resident = 0;                 ///< bytes
  double heap = 0;                     ///< bytes handed out by the allocator; 0 if unknown
  int handles = 0;                     ///< open file descriptors
  std::multiset<std::string> threads;  ///< their names
};
/// Resources of this process, after the allocator has returned unused memory.
Usage usageNow();

/// Bytes by which the resident size may vary at constant use: freed blocks between others in the
/// allocator's only arena. 2 MiB were measured.
constexpr double kFragments = 16.0 * 1024 * 1024;

/// Options, limits, failures and figures of a campaign.
class Campaign {
 public:
  /// Reads --seconds, --rounds and --seed; the arguments are the defaults (0 seconds or rounds: no
  /// limit). Prints the usage and exits with 2 if they are wrong. `others` are further options
  /// "--name VALUE".
  Campaign(const char* name, int argc, char** argv, double seconds, long rounds,
           std::vector<std::string> others = {});

  std::uint64_t seed() const { return seed_; }
  double seconds() const { return seconds_; }
  /// Value of one of the further options; none if absent.
  std::optional<std::string> option(std::string_view name) const;

  /// Counts a round; false if there were enough or the time is up.
  bool next();
  long rounds() const { return rounds_; }
  double elapsed() const;
  /// Elapsed part of the campaign, 0 … 1.
  double fraction() const;

  /// Reports a failure, with round and seed, on stderr. May be called from any thread.
  void fail(const std::string& what);
  /// fail() unless `truth`; returns `truth`.
  bool require(bool truth, const std::string& what);
  /// Reports an omission on stderr and in the figures.
  void skip(const std::string& what);
  int failures() const { return failures_; }

  /// Adds to the line of figures, in this order.
  void figure(const std::string& name, double value, const std::string& unit = {});
  /// Memory, handles and threads at two moments.
  void figures(const Usage& before, const Usage& after);
  /// Fails unless the use of resources is constant: the heap may grow by at most `maxGrowth` bytes,
  /// the resident size by kFragments more, and the numbers of handles and threads not at all. With
  /// the address sanitizer, which keeps freed blocks, its leak check replaces the check of memory.
  void requireFlat(const Usage& before, const Usage& after, double maxGrowth);

  /// Prints the line of figures; returns the exit code of the program.
  int end();

 private:
  const std::string name_;
  double seconds_;
  long requestedRounds_;
  std::uint64_t seed_ = 1;
  std::vector<std::pair<std::string, std::string>> others_;
  Clock::time_point began_ = Clock::now();
  long rounds_ = 0;
  int failures_ = 0;
  std::string line_;
};

}  // namespace palpa::reliability
