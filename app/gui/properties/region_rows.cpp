#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>
#include <algorithm>

#include "app/gui/base/appearance.h"
#include "app/gui/base/overloaded.h"
#include "app/gui/base/translate.h"
#include "app/gui/document/editor.h"
#include "app/gui/properties/pages.h"

namespace palpa::gui {
namespace {

using modeling::HalfSpace;
using modeling::PatchSet;
using modeling::Region;

class RegionRows {
 public:
  RegionRows(PropertyPage& page, PropertyPage::Get<Region> get, PropertyPage::Set<Region> set)
      : page_(page), get_(std::move(get)), set_(std::move(set)) {}

  void add() const {
    const Region region = get_();
    page_.addSection(tr("Where"));
    int strokes = 0;
    for (std::size_t i = 0; i < region.parts.size(); ++i)
      std::visit(Overloaded{[&](const PatchSet& set) { addPatches(i, set); },
                            [&](const HalfSpace&) { addHalfSpace(i); },
                            [&](const modeling::Stroke& stroke) {
                              const QString radius = page_.shownLength(stroke.radius);
                              addRemovable(tr("Stroke %1, radius %2").arg(++strokes).arg(radius),
                                           QString("part%1").arg(i), withoutPart(i));
                            }},
                 region.parts[i]);
    addExceptions(region);
    addButtons(region);
  }

 private:
  using Edit = std::function<void(Region&)>;

  Edit withoutPart(std::size_t part) const {
    return [part](Region& region) {
      if (part < region.parts.size())
        region.parts.erase(region.parts.begin() + static_cast<std::ptrdiff_t>(part));
    };
  }

  /// Line of text with a button that removes the named part.
  void addRemovable(const QString& text, const QString& name, Edit remove) const {
    auto* row = new QWidget(&page_);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    auto* label = new QLabel(text, row);
    label->setWordWrap(true);
    auto* button = new QToolButton(row);
    button->setObjectName(name + "Remove");
    button->setIcon(icon("delete"));
    button->setToolTip(tr("Remove this part from the region"));
    button->setAccessibleName(tr("Remove %1").arg(text));
    button->setFocusPolicy(Qt::StrongFocus);
    auto* refusal = new QLabel(row);
    refusal->setObjectName("refusal");
    refusal->setWordWrap(true);
    refusal->hide();
    layout->addWidget(label, 1);
    layout->addWidget(refusal, 2);
    layout->addWidget(button);
    page_.addWidget(row);
    QObject::connect(button, &QToolButton::clicked, &page_,
                     [*this, button, remove] { change(button, remove); });
  }

  void addPatches(std::size_t part, const PatchSet& set) const {
    for (const std::string& name : set.patches)
      addRemovable(tr("Patch %1").arg(QString::fromStdString(name)),
                   QString("patch %1").arg(QString::fromStdString(name)),
                   [part, name, remove = withoutPart(part)](Region& region) {
                     if (part >= region.parts.size()) return;
                     auto* patches = std::get_if<PatchSet>(&region.parts[part]);
                     if (!patches) return;
                     std::erase(patches->patches, name);
                     if (patches->patches.empty()) remove(region);
                   });
  }

  void addHalfSpace(std::size_t part) const {
    addRemovable(tr("Everything on one side of a plane"), QString("part%1").arg(part),
                 withoutPart(part));
    const auto read = [get = get_, part] {
      const Region region = get();
      const auto* half =
          part < region.parts.size() ? std::get_if<HalfSpace>(&region.parts[part]) : nullptr;
      return half ? *half : HalfSpace();
    };
    const auto write = [get = get_, set = set_, part](const HalfSpace& half) {
      Region region = get();
      if (part >= region.parts.size()) return false;
      region.parts[part] = half;
      return set(region);
    };
    page_.addVector(
        tr("Normal, away from that side"), QString("normal%1").arg(part), Quantity::kNumber,
        [read] { return read().normal; },
        [read, write](const Eigen::Vector3d& normal) {
          HalfSpace half = read();
          half.normal = normal;
          return write(half);
        });
    page_.addQuantity(
        tr("Height along it"), QString("below%1").arg(part), Quantity::kLength,
        [read] { return read().below; },
        [read, write](double below) {
          HalfSpace half = read();
          half.below = below;
          return write(half);
        });
  }

  /// All exceptions in one line: the exceptions of one overlap belong together.
  void addExceptions(const Region& region) const {
    if (region.except.empty()) return;
    QStringList names;
    for (const modeling::RegionPart& part : region.except)
      if (const auto* set = std::get_if<PatchSet>(&part))
        for (const std::string& name : set->patches)
          names << tr("patch %1").arg(QString::fromStdString(name));
      else if (std::holds_alternative<HalfSpace>(part))
        names << tr("one side of a plane");
    const auto strokes = std::count_if(
        region.except.begin(), region.except.end(),
        [](const auto& part) { return std::holds_alternative<modeling::Stroke>(part); });
    if (strokes > 0) names << (strokes == 1 ? tr("a stroke") : tr("%1 strokes").arg(strokes));
    addRemovable(tr("Except %1").arg(names.join(", ")), "except",
                 [](Region& edited) { edited.except.clear(); });
  }

  void addButtons(const Region& region) const {
    auto* row = new QWidget(&page_);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 4, 0, 0);
    const auto button = [&](const QString& text, const QString& name, const QString& tip) {
      auto* made = new QToolButton(row);
      made->setText(text);
      made->setObjectName(name);
      made->setToolTip(tip);
      made->setFocusPolicy(Qt::StrongFocus);
      made->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
      made->setIcon(icon("add"));
      layout->addWidget(made);
      return made;
    };
    auto* patch = button(tr("Patch"), "addPatch", tr("Add a patch to the region"));
    patch->setPopupMode(QToolButton::InstantPopup);
    patch->setMenu(patchMenu(region, patch));
    patch->setEnabled(!patch->menu()->isEmpty());
    auto* half = button(tr("Half-space"), "addHalfSpace",
                        tr("Add everything on one side of a plane; begins with the lowest tenth"));
    layout->addStretch();
    page_.addWidget(row);
    QObject::connect(half, &QToolButton::clicked, &page_, [*this, half] {
      const auto box = modeling::boundingBox(page_.editor().project().body);
      const double below = box[0].z() + 0.1 * (box[1].z() - box[0].z());
      change(half, [below](Region& to) {
        to.parts.push_back(HalfSpace{Eigen::Vector3d::UnitZ(), below});
      });
    });
  }

  /// Menu of the patches that the region does not contain.
  QMenu* patchMenu(const Region& region, QToolButton* button) const {
    std::set<std::string> named;
    for (const modeling::RegionPart& part : region.parts)
      if (const auto* set = std::get_if<PatchSet>(&part))
        named.insert(set->patches.begin(), set->patches.end());
    auto* menu = new QMenu(button);
    menu->setStyleSheet(
        QStringLiteral("QMenu { menu-scrollable: 1; }"));  // for hundreds of patches
    for (const std::string& name : modeling::patchNames(page_.editor().project().body))
      if (!named.contains(name))
        QObject::connect(menu->addAction(QString::fromStdString(name)), &QAction::triggered, &page_,
                         [*this, button, name] { addPatch(button, name); });
    return menu;
  }

  void addPatch(QWidget* button, const std::string& name) const {
    change(button, [&name](Region& to) {
      for (modeling::RegionPart& part : to.parts)
        if (auto* set = std::get_if<PatchSet>(&part)) {
          set->patches.push_back(name);
          return;
        }
      to.parts.push_back(PatchSet{{name}});
    });
  }

  void change(QWidget* field, const Edit& edit) const {
    page_.attempt(field, [&] {
      Region region = get_();
      edit(region);
      if (region.parts.empty()) {
        Q_EMIT page_.editor().refused(
            tr("A region needs at least one part; add another one first, or delete the whole "
               "thing in the Model panel."));
        return false;
      }
      return set_(region);
    });
  }

  PropertyPage& page_;
  PropertyPage::Get<Region> get_;
  PropertyPage::Set<Region> set_;
};

}  // namespace

void addRegionRows(PropertyPage& page, PropertyPage::Get<Region> get,
                   PropertyPage::Set<Region> set) {
  RegionRows(page, std::move(get), std::move(set)).add();
}

QString regionKey(const Region& region) {
  QString key;
  for (const modeling::RegionPart& part : region.parts)
    std::visit(Overloaded{[&](const PatchSet& set) {
                            for (const std::string& name : set.patches)
                              key += "|" + QString::fromStdString(name);
                            key += ";";
                          },
                          [&](const HalfSpace&) { key += "half;"; },
                          [&](const auto&) { key += QString("other%1;").arg(part.index()); }},
               part);
  return key + QString("except%1").arg(region.except.size());
}

}  // namespace palpa::gui
