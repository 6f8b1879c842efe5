#include "modeling/project/json_print.h"

#include "base/text.h"

namespace palpa::modeling {
namespace {

class Printer {
 public:
  explicit Printer(const std::set<std::string>& open) : open_(open) {}

  void print(const Json& value, const std::string& path, bool mayBeOpen, int indent) {
    if (value.is_number_float()) {
      text_ += numberText(value.get<double>());
      return;
    }
    if (!value.is_structured()) {
      text_ += value.dump(-1, ' ', false, Json::error_handler_t::replace);
      return;
    }
    const bool isOpen = mayBeOpen && !value.empty() && open_.contains(path);
    bool isFirst = true;
    const auto separate = [&] {
      if (!isFirst) text_ += isOpen ? "," : ", ";
      isFirst = false;
      if (isOpen) breakLine(indent + 2);
    };
    text_ += value.is_object() ? '{' : '[';
    if (value.is_object()) {
      for (const auto& [key, entry] : value.get_ref<const Json::object_t&>()) {
        separate();
        print(key, "", false, 0);
        text_ += ": ";
        print(entry, path.empty() ? key : path + "." + key, isOpen, indent + 2);
      }
    } else {
      const std::string entryPath = isOpen ? path + "[]" : "";
      for (const Json& entry : value) {
        separate();
        print(entry, entryPath, isOpen, indent + 2);
      }
    }
    if (isOpen) breakLine(indent);
    text_ += value.is_object() ? '}' : ']';
  }

  std::string take() { return std::move(text_); }

 private:
  void breakLine(int indent) {
    text_ += '\n';
    text_.append(static_cast<std::size_t>(indent), ' ');
  }

  const std::set<std::string>& open_;
  std::string text_;
};

}  // namespace

std::string jsonText(const Json& value, const std::set<std::string>& open) {
  Printer printer(open);
  printer.print(value, "", true, 0);
  return printer.take();
}

}  // namespace palpa::modeling
