#pragma once

#include <string>
#include <vector>

// Parts of the documents of this folder, and the frame around them. Internal to app/report.
namespace palpa::report {

/// A picture with a caption, in plain text. `source`: of the image.
std::string figure(const std::string& source, const std::string& caption);

/// Items in plain text.
std::string list(const std::vector<std::string>& items);

/// The bytes of a PNG file as the source of an image.
std::string dataSource(const std::string& png);

/// An HTML document with the style of reports; `title` in plain text, `content` in HTML. Its policy
/// forbids scripts and anything from elsewhere.
std::string documentOf(const std::string& title, const std::string& content);

}  // namespace palpa::report
