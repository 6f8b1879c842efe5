#include "modeling/project/json_guard.h"

#include <set>
#include <vector>

#include "modeling/error.h"

namespace palpa::modeling {
namespace {

/// Receiver of nlohmann's SAX events that checks and counts. It stores only the keys of the objects
/// that are open.
class Guard : public nlohmann::json_sax<nlohmann::json> {
 public:
  Guard(std::string_view text, const std::string& source, const JsonLimits& limits)
      : text_(text), source_(source), limits_(limits) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t& text) override {
    value();
    checkLength(text);
    return true;
  }
  bool binary(binary_t&) override { return value(); }

  bool start_object(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name.substr(0, 60);  // enough to identify a key that is too long
    checkLength(name);
    level.key = name;
    if (level.keys.size() >= limits_.keys)
      fail(path() + ": more than " + std::to_string(limits_.keys) + " keys in one object");
    if (!level.keys.insert(name).second) fail(path() + ": this key occurs twice");
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    // out_of_range.406: a number beyond the range of double.
    if (error.id == 406) {
      next();
      fail(path() + ": the number is too large");
    }
    std::size_t line = 1;
    std::size_t column = 1;
    for (std::size_t i = 0; i + 1 < position && i < text_.size(); ++i) {
      column = text_[i] == '\n' ? 1 : column + 1;
      line += text_[i] == '\n';
    }
    const bool ended = position > text_.size();
    const std::string where = "line " + std::to_string(line) + ", column " + std::to_string(column);
    if (ended) fail(where + ": the file ends too early; it is probably truncated");
    fail(where + ": not valid JSON (" + reason(error.what()) + ")");
  }

 private:
  struct Level {
    bool isObject;
    std::string key;             // of the current value
    std::size_t count = 0;       // values of the array so far
    std::set<std::string> keys;  // keys of the object so far
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw ModelingError(source_ + ": " + what);
  }

  /// Message of the library without its code and position.
  static std::string reason(const std::string& message) {
    const std::size_t colon = message.find(": ");
    const std::string rest = colon == std::string::npos ? message : message.substr(colon + 2);
    return rest.substr(0, 200);
  }

  std::string path() const {
    std::string text;
    for (const Level& level : levels_) {
      if (level.isObject)
        text = joinPath(text, level.key);
      else if (level.count > 0)
        text = joinPath(text, level.count - 1);
    }
    return text;
  }

  void checkLength(const std::string& text) const {
    if (text.size() > limits_.textBytes)
      fail(path() + ": a text of " + std::to_string(text.size()) + " bytes; at most " +
           std::to_string(limits_.textBytes) + " are accepted");
  }

  void next() {
    if (!levels_.empty() && !levels_.back().isObject) ++levels_.back().count;
  }

  bool value() {
    next();
    if (++values_ > limits_.values)
      fail(path() + ": more than " + std::to_string(limits_.values) + " values in the file");
    return true;
  }

  bool open(bool isObject) {
    value();
    if (static_cast<int>(levels_.size()) >= limits_.depth)
      fail(path() + ": nested deeper than " + std::to_string(limits_.depth) + " levels");
    levels_.push_back({isObject, {}, 0, {}});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::string& source_;
  const JsonLimits& limits_;
  std::vector<Level> levels_;
  std::size_t values_ = 0;
};

}  // namespace

std::string joinPath(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string joinPath(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

nlohmann::json parseGuarded(std::string_view text, const std::string& source,
                            const JsonLimits& limits) {
  if (text.size() > limits.bytes)
    throw ModelingError(source + ": the file has " + std::to_string(text.size()) +
                            " bytes; at most " + std::to_string(limits.bytes) + " are accepted",
                        ModelingError::Kind::kTooLarge);
  Guard guard(text, source, limits);
  nlohmann::json::sax_parse(text, &guard);
  return nlohmann::json::parse(text);
}

}  // namespace palpa::modeling
