#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "app/core/setup/boundary_setup.h"
#include "bem/problem/reference_problem.h"

namespace palpa::app {

/// Solved models on disk, so that a project that is opened again can be touched without being
/// assembled and factorised. A file holds the operators and factors of one ReferenceProblem bit by
/// bit and is found by a hash of everything they were computed from, this very program included.
///
/// The folder may be shared by several processes; all functions may be called from any thread. What
/// cannot be read or written never stops anything: there is just no stored model.
class ModelCache {
 public:
  /// 128-bit hash of mesh, kinds of conditions, material, precision, options and program.
  struct Key {
    std::uint64_t high = 0, low = 0;
    bool operator==(const Key&) const = default;
  };

  /// `limit`: bytes that all files together may take; the folder is made when it is first needed,
  /// readable by its owner only.
  ModelCache(std::filesystem::path folder, double limit);

  static Key keyOf(const BoundarySetup& setup, const bem::AssemblyOptions& assembly,
                   bem::Precision precision);

  /// The problem stored under the key; null when there is none. A file that is damaged, or not what
  /// its name says, is deleted, and `notice` gets a sentence. Throws Cancelled, std::bad_alloc.
  std::unique_ptr<bem::ReferenceProblem> read(const Key& key, const BoundarySetup& setup,
                                              bem::Precision precision, const Job& job,
                                              std::string& notice);

  /// Stores the problem and removes what was used longest ago until the limit is kept. Does nothing
  /// when it is stored already, too large for the limit, or would leave less than 1 GiB of the disk
  /// free. False with trouble() when it failed. Throws Cancelled; no part of the file is left.
  bool write(const Key& key, const bem::ReferenceProblem& problem, const Job& job);

  double limit() const { return limit_; }
  /// Applies at once.
  void setLimit(double bytes);
  /// Bytes of all files.
  double size() const;
  void clear();
  /// Why the last writing failed; empty when it did not.
  std::string trouble() const;

 private:
  std::filesystem::path fileOf(const Key& key) const;
  void trim(double most) const;
  void setTrouble(std::string trouble);

  const std::filesystem::path folder_;
  std::atomic<double> limit_;
  mutable std::mutex mutex_;  // guards trouble_
  std::string trouble_;
};

/// `palpa` in $XDG_CACHE_HOME, or in ~/.cache when that is not set to an absolute path; empty when
/// there is no home folder either.
std::filesystem::path defaultCacheFolder();

}  // namespace palpa::app
