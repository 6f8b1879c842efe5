#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <vector>

#include "modeling/error.h"
#include "modeling/exchange/cad_text_check.h"

// Structure of ISO 10303-21: "ISO-10303-21;", header statements, "DATA;", instances "#12=NAME(…);"
// with references to each other as #34, "ENDSEC;", "END-ISO-10303-21;". Strings are in single
// quotes, with inner quotes doubled; comments are /* … */.
namespace palpa::modeling {
namespace {

constexpr int kDeepestParentheses = 64;
constexpr std::size_t kMaxNumberLength = 18;  // digits of an instance's number

/// Scanner of the statements of a STEP file and of the references between instances.
class StepScanner {
 public:
  StepScanner(const std::string& text, const std::string& source) : text_(text), source_(source) {}

  void scan() {
    skipSpace();
    if (text_.compare(at_, 12, "ISO-10303-21") != 0)
      throw ModelingError(source_ +
                          ": is not a STEP file; it does not begin with ISO-10303-21: export it "
                          "again, or correct its ending");
    bool ended = false;
    for (skipSpace(); at_ < text_.size() && !ended; skipSpace()) ended = readStatement();
    if (!ended) fail("the file is cut off: END-ISO-10303-21 is missing at its end");
    checkReferences();
    if (faces_ > kMaxCadFaces)
      throw ModelingError(source_ + ": has " + std::to_string(faces_) + " faces; at most " +
                              std::to_string(kMaxCadFaces) + " are read: simplify the part",
                          ModelingError::Kind::kTooLarge);
  }

 private:
  struct Instance {
    std::uint64_t number;
    std::size_t line;
    std::size_t firstReference;  // into references_
    std::size_t lastReference = 0;
  };

  [[noreturn]] void fail(const std::string& what, std::size_t line = 0) const {
    throw ModelingError(source_ + ": line " + std::to_string(line ? line : line_) + ": " + what +
                        "; export the file again");
  }

  char get() {
    const char c = text_[at_++];
    if (c == '\n') ++line_;
    return c;
  }

  void skipSpace() {
    while (at_ < text_.size()) {
      if (std::isspace(static_cast<unsigned char>(text_[at_])) || text_[at_] == '\0') {
        get();
      } else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string::npos) fail("a comment has no end");
        while (at_ < end + 2) get();
      } else {
        return;
      }
    }
  }

  std::uint64_t readNumber() {
    std::uint64_t number = 0;
    std::size_t digits = 0;
    while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]))) {
      if (++digits > kMaxNumberLength) fail("the number of an instance is too long");
      number = 10 * number + static_cast<std::uint64_t>(get() - '0');
    }
    if (digits == 0) fail("expected a number after #");
    return number;
  }

  void skipString() {
    for (get(); at_ < text_.size();)
      if (get() == '\'') {
        if (at_ >= text_.size() || text_[at_] != '\'') return;
        get();
      }
    fail("the file is cut off in a text in quotes");
  }

  /// Reads up to the semicolon. Returns true for the statement that ends the file.
  bool readStatement() {
    const std::size_t start = at_;
    if (text_[at_] == '#') {
      get();
      const std::size_t line = line_;
      instances_.push_back({readNumber(), line, references_.size()});
      skipSpace();
      if (at_ >= text_.size() || get() != '=') fail("expected = after the number of an instance");
      skipSpace();
      const std::string_view rest = std::string_view(text_).substr(at_);
      if (rest.starts_with("ADVANCED_FACE") || rest.starts_with("FACE_SURFACE")) ++faces_;
    }
    const bool isInstance = text_[start] == '#';
    int depth = 0;
    for (skipSpace(); at_ < text_.size(); skipSpace()) {
      const char c = text_[at_];
      if (c == '\'') {
        skipString();
        continue;
      }
      get();
      if (c == '(' && ++depth > kDeepestParentheses) fail("the parentheses are nested too deeply");
      if (c == ')' && --depth < 0) fail("an opening parenthesis is missing");
      if (c == '#') {
        const std::uint64_t number = readNumber();
        if (isInstance) references_.push_back(number);
      }
      if (c == ';') {
        if (depth != 0) fail("a closing parenthesis is missing");
        if (isInstance) instances_.back().lastReference = references_.size();
        return text_.compare(start, 16, "END-ISO-10303-21") == 0;
      }
    }
    fail("the file is cut off: a statement has no semicolon at its end");
  }

  /// Throws ModelingError if a reference has no instance or a chain of references forms a cycle.
  void checkReferences() {
    std::sort(instances_.begin(), instances_.end(),
              [](const Instance& a, const Instance& b) { return a.number < b.number; });
    for (std::size_t i = 1; i < instances_.size(); ++i)
      if (instances_[i].number == instances_[i - 1].number)
        fail("#" + std::to_string(instances_[i].number) + " is defined twice", instances_[i].line);
    std::vector<std::size_t> targets(references_.size());
    for (const Instance& instance : instances_)
      for (std::size_t r = instance.firstReference; r < instance.lastReference; ++r) {
        const auto found = std::lower_bound(
            instances_.begin(), instances_.end(), references_[r],
            [](const Instance& one, std::uint64_t number) { return one.number < number; });
        if (found == instances_.end() || found->number != references_[r])
          fail("refers to #" + std::to_string(references_[r]) + ", which is not in the file",
               instance.line);
        targets[r] = static_cast<std::size_t>(found - instances_.begin());
      }
    checkCircles(targets);
  }

  void checkCircles(const std::vector<std::size_t>& targets) const {
    enum class State : char { kFresh, kOpen, kDone };
    std::vector<State> state(instances_.size(), State::kFresh);
    std::vector<std::pair<std::size_t, std::size_t>> path;  // instance, its next reference
    for (std::size_t root = 0; root < instances_.size(); ++root) {
      if (state[root] != State::kFresh) continue;
      path.assign(1, {root, instances_[root].firstReference});
      state[root] = State::kOpen;
      while (!path.empty()) {
        auto& [at, next] = path.back();
        if (next == instances_[at].lastReference) {
          state[at] = State::kDone;
          path.pop_back();
          continue;
        }
        const std::size_t target = targets[next++];
        if (state[target] == State::kOpen)
          fail("#" + std::to_string(instances_[target].number) + " refers to itself in a cycle",
               instances_[target].line);
        if (state[target] == State::kDone) continue;
        state[target] = State::kOpen;
        path.emplace_back(target, instances_[target].firstReference);
      }
    }
  }

  const std::string& text_;
  const std::string& source_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  int faces_ = 0;
  std::vector<Instance> instances_;
  std::vector<std::uint64_t> references_;
};

}  // namespace

void checkStepText(const std::string& text, const std::string& source) {
  StepScanner(text, source).scan();
}

}  // namespace palpa::modeling
