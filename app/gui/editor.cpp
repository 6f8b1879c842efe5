#include "app/gui/editor.h"

#include <QFileInfo>
#include <QMetaObject>

#include "modeling/error.h"
#include "modeling/exchange/import.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::gui {
namespace {

constexpr int kRebuildInterval = 33;      // ms between two announcements of the rebuild's progress
constexpr int kAutosaveInterval = 10000;  // ms between two looks whether a snapshot is due

/// What the program starts with: a ball on a fixed base.
modeling::Project firstProject() {
  modeling::Project project;
  project.name = "Untitled";
  project.primitive = modeling::Primitive{modeling::SphereShape{}};
  project.body = modeling::makePrimitive(*project.primitive);
  project.material = {"soft silicone", 0.2, 0.48};
  modeling::Support base;
  base.name = "base";
  base.where = modeling::Region::below(Eigen::Vector3d::UnitZ(), -20.0);
  project.supports = {base};
  project.mesh.edgeLength = 4.0;
  return project;
}

}  // namespace

Editor::Editor(QObject* parent) : QObject(parent) {
  rebuildTimer_.setSingleShot(true);
  rebuildTimer_.setInterval(kRebuildInterval);
  connect(&rebuildTimer_, &QTimer::timeout, this, &Editor::rebuildChanged);
  connect(&autosaveTimer_, &QTimer::timeout, this, [this] {
    attempt([this] { session_->autosaveIfDue(std::chrono::steady_clock::now()); });
  });
  autosaveTimer_.start(kAutosaveInterval);
  session_ = std::make_unique<app::Session>(firstProject(), sessionOptions());
}

Editor::~Editor() {
  session_->close();
}

app::Session::Options Editor::sessionOptions() {
  app::Session::Options options;
  // From the worker's thread: only starts the timer, in this object's thread.
  options.rebuildChanged = [this] {
    QMetaObject::invokeMethod(
        this,
        [this] {
          if (!rebuildTimer_.isActive()) rebuildTimer_.start();
        },
        Qt::QueuedConnection);
  };
  try {
    options.autosaveFolder = modeling::defaultAutosaveFolder();
  } catch (const modeling::ModelingError&) {
    // Without a home folder there are no snapshots; everything else works.
  }
  return options;
}

template <class Work>
bool Editor::attempt(const Work& work) {
  try {
    work();
    return true;
  } catch (const modeling::ModelingError& error) {
    Q_EMIT refused(QString::fromStdString(error.what()));
    return false;
  }
}

void Editor::adopt(std::unique_ptr<app::Session> session) {
  if (session_) session_->close();
  session_ = std::move(session);
  selection_.clear();
  Q_EMIT projectReplaced();
  Q_EMIT selectionChanged();
  Q_EMIT fileChanged();
  Q_EMIT rebuildChanged();
}

void Editor::start(modeling::Project project) {
  adopt(std::make_unique<app::Session>(std::move(project), sessionOptions()));
}

bool Editor::open(const QString& file) {
  return attempt([&] {
    adopt(std::make_unique<app::Session>(std::filesystem::path(file.toStdString()),
                                         sessionOptions()));
  });
}

bool Editor::importFile(const QString& file) {
  return attempt([&] {
    modeling::Project project = firstProject();
    modeling::ImportedBody imported = modeling::importBody(file.toStdString());
    project.name = QFileInfo(file).completeBaseName().toStdString();
    project.body = std::move(imported.body);
    project.primitive.reset();
    const auto [low, high] = modeling::boundingBox(project.body);
    project.supports[0].where =
        modeling::Region::below(Eigen::Vector3d::UnitZ(), low.z() + 0.1 * (high.z() - low.z()));
    project.mesh.edgeLength = std::sqrt(1.05 * modeling::area(project.body) / 600.0);
    start(std::move(project));
    for (const std::string& note : imported.notes) Q_EMIT refused(QString::fromStdString(note));
  });
}

bool Editor::save() {
  const bool saved = attempt([this] { session_->save(); });
  Q_EMIT fileChanged();
  return saved;
}

bool Editor::saveAs(const QString& file) {
  const bool saved = attempt([&] { session_->saveAs(file.toStdString()); });
  Q_EMIT fileChanged();
  return saved;
}

QString Editor::fileName() const {
  return session_->file() ? QString::fromStdString(session_->file()->string()) : QString();
}

bool Editor::perform(const modeling::Command& command, modeling::Merge merge) {
  return attempt([&] { changed(session_->perform(command, merge).change); });
}

void Editor::undo() {
  if (session_->document().canUndo()) changed(session_->undo());
}

void Editor::redo() {
  if (session_->document().canRedo()) changed(session_->redo());
}

void Editor::changed(const modeling::Change& change) {
  if (!change.any()) return;
  if (change.topology && !selection_.empty()) select({});
  Q_EMIT projectChanged(change);
  Q_EMIT fileChanged();
}

void Editor::select(std::set<int> points) {
  if (points == selection_) return;
  selection_ = std::move(points);
  Q_EMIT selectionChanged();
}

}  // namespace palpa::gui
