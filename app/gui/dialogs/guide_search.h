#pragma once

#include <QString>
#include <QUrl>
#include <optional>
#include <vector>

namespace palpa::gui {

/// Places of a text in the pages of the guide, in the order of the pages. Reads each page once, as
/// the reader shows it, so that positions are the same.
class GuideSearch {
 public:
  struct Match {
    int page = 0;      ///< index of the page
    int position = 0;  ///< of the first character in the document
    int length = 0;
  };

  void addPage(const QUrl& page);
  const QUrl& page(int index) const { return pages_[index].url; }
  /// Index of a page; nothing for pages that are not searched.
  std::optional<int> indexOf(const QUrl& page) const;

  /// Finds all places, without regard to case. An empty text has none.
  void find(const QString& text);
  const std::vector<Match>& matches() const { return matches_; }
  /// Number of matches in a page.
  int countIn(int page) const;

  /// Index of the first match at or after a position, continued on the next pages and then on the
  /// first one; nothing without matches.
  std::optional<int> nextFrom(int page, int position) const;
  /// Index of the last match that begins before a position, in the same way backwards.
  std::optional<int> previousFrom(int page, int position) const;

  /// The first place of a text with this case; the first page, an introduction, comes last.
  std::optional<Match> placeOf(const QString& text);

 private:
  struct Page {
    QUrl url;
    QString text;  // empty until read
  };
  const QString& textOf(int page);

  std::vector<Page> pages_;
  std::vector<Match> matches_;
};

}  // namespace palpa::gui
