#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "app/core/model/model_file.h"
#include "bem/problem/discretisation.h"

namespace palpa::app {

/// Solved models on disk: a project that is opened again can be touched without assembly and
/// factorisation. A file holds the operators and factors of one ReferenceProblem bit by bit. Its
/// name is a hash of everything they were computed from, the program included.
///
/// Several processes may share the folder; all functions may be called from any thread. Failures to
/// read or write are not errors: the model counts as not stored.
class ModelCache {
 public:
  /// 128-bit hash of mesh, kinds of conditions, material, precision, options and program.
  using Key = ModelKey;

  /// `limit`: bytes that all files together may take. The first write makes the folder, readable by
  /// its owner only.
  ModelCache(std::filesystem::path folder, double limit);

  static Key keyOf(const bem::Discretisation& discretisation, const bem::ProblemInputs& inputs);

  /// The problem stored under the key; null if there is none. A file that is damaged, or does not
  /// match its name, is deleted, and `notice` gets a sentence. Throws Cancelled, std::bad_alloc.
  std::unique_ptr<bem::ReferenceProblem> read(const Key& key,
                                              const bem::Discretisation& discretisation,
                                              const bem::ProblemInputs& inputs, const Job& job,
                                              std::string& notice);

  /// Stores the problem and removes the files used longest ago until the limit is met. Does nothing
  /// if the problem is stored already, too large for the limit, or would leave less than 1 GiB of
  /// the disk free. False, with trouble(), if it failed. Throws Cancelled; no part of the file
  /// remains.
  bool write(const Key& key, const bem::ReferenceProblem& problem, const Job& job);

  double limit() const { return limit_; }
  /// Takes effect immediately.
  void setLimit(double bytes);
  /// Bytes of all files.
  double size() const;
  void clear();
  /// Reason why the last write failed; empty if it succeeded.
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

/// `palpa` in $XDG_CACHE_HOME, or in ~/.cache if $XDG_CACHE_HOME is not an absolute path; empty
/// without a home folder.
std::filesystem::path defaultCacheFolder();

}  // namespace palpa::app
