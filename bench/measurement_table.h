#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

namespace palpa::bench {

/// Measurements as lines `bench;n;what;value;unit;goal`, which scripts/bench reads.
class MeasurementTable {
 public:
  /// Appends to a file; writes nothing for an empty path. Throws std::runtime_error if the file
  /// cannot be opened.
  void open(const std::string& path, const std::string& bench) {
    bench_ = bench;
    if (path.empty()) return;
    file_.open(path, std::ios::app);
    if (!file_) throw std::runtime_error(path + " cannot be written");
  }
  /// `text`: a number, or a number and its unit.
  void add(int n, const std::string& what, const std::string& text, const std::string& goal) {
    if (!file_.is_open()) return;
    const auto split = text.find(' ');
    file_ << bench_ << ';' << n << ';' << what.substr(what.find_first_not_of(' ')) << ';'
          << text.substr(0, split) << ';'
          << (split == std::string::npos ? std::string() : text.substr(split + 1)) << ';' << goal
          << std::endl;
  }

 private:
  std::string bench_;
  std::ofstream file_;
};

}  // namespace palpa::bench
