#include "app/gui/dialogs/guide_search.h"

#include <QFile>
#include <QTextDocument>
#include <algorithm>

namespace palpa::gui {

void GuideSearch::addPage(const QUrl& page) {
  pages_.push_back({page, {}});
}

std::optional<int> GuideSearch::indexOf(const QUrl& page) const {
  const QUrl whole = page.adjusted(QUrl::RemoveFragment);
  for (std::size_t i = 0; i < pages_.size(); ++i)
    if (pages_[i].url == whole) return static_cast<int>(i);
  return std::nullopt;
}

const QString& GuideSearch::textOf(int page) {
  Page& read = pages_[page];
  if (!read.text.isEmpty()) return read.text;
  QFile file(read.url.toLocalFile());
  if (file.open(QIODevice::ReadOnly)) {
    QTextDocument document;
    document.setMarkdown(QString::fromUtf8(file.readAll()));
    read.text = document.toPlainText();
  }
  return read.text;
}

void GuideSearch::find(const QString& text) {
  matches_.clear();
  if (text.isEmpty()) return;
  for (int page = 0; page < static_cast<int>(pages_.size()); ++page) {
    const QString& in = textOf(page);
    for (auto at = in.indexOf(text, 0, Qt::CaseInsensitive); at >= 0;
         at = in.indexOf(text, at + text.size(), Qt::CaseInsensitive))
      matches_.push_back({page, static_cast<int>(at), static_cast<int>(text.size())});
  }
}

int GuideSearch::countIn(int page) const {
  return static_cast<int>(std::count_if(matches_.begin(), matches_.end(),
                                        [&](const Match& match) { return match.page == page; }));
}

std::optional<int> GuideSearch::nextFrom(int page, int position) const {
  if (matches_.empty()) return std::nullopt;
  const auto found = std::find_if(matches_.begin(), matches_.end(), [&](const Match& match) {
    return match.page > page || (match.page == page && match.position >= position);
  });
  return found == matches_.end() ? 0 : static_cast<int>(found - matches_.begin());
}

std::optional<int> GuideSearch::previousFrom(int page, int position) const {
  if (matches_.empty()) return std::nullopt;
  const auto found = std::find_if(matches_.rbegin(), matches_.rend(), [&](const Match& match) {
    return match.page < page || (match.page == page && match.position < position);
  });
  return static_cast<int>(found == matches_.rend() ? matches_.size() - 1
                                                   : matches_.rend() - found - 1);
}

std::optional<GuideSearch::Match> GuideSearch::placeOf(const QString& text) {
  const int count = static_cast<int>(pages_.size());
  for (int i = 1; i <= count; ++i) {
    const int page = i % count;
    if (const auto at = textOf(page).indexOf(text); at >= 0)
      return Match{page, static_cast<int>(at), static_cast<int>(text.size())};
  }
  return std::nullopt;
}

}  // namespace palpa::gui
