#include "app/gui/document/editor.h"

#include <QFileInfo>
#include <QMetaObject>

#include "app/core/session/import_project.h"
#include "app/core/session/new_project.h"
#include "app/core/system/destroy_in_background.h"
#include "app/gui/document/measurements.h"
#include "app/gui/document/named_items.h"
#include "app/gui/document/touch_gradient.h"
#include "modeling/error.h"
#include "modeling/exchange/file_format.h"
#include "modeling/project/project_file.h"
#include "modeling/project/proposed_support.h"
#include "modeling/shapes/make_primitive.h"

namespace palpa::gui {
namespace {

constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
constexpr int kRebuildInterval = 33;     // ms between two reports of the rebuild's progress
constexpr int kAutosaveInterval = 1000;  // ms between two checks whether a snapshot is due

/// The initial project: a sphere on a fixed base.
modeling::Project firstProject() {
  const modeling::Primitive sphere{modeling::SphereShape{}};
  modeling::Project project = app::makeProject(modeling::makePrimitive(sphere), "Untitled");
  project.primitive = sphere;
  return project;
}

}  // namespace

Editor::Editor(Settings& settings, QObject* parent)
    : QObject(parent),
      settings_(settings),
      measurements_(new Measurements(*this)),
      gradient_(new TouchGradient(*this)) {
  rebuildTimer_.setSingleShot(true);
  rebuildTimer_.setInterval(kRebuildInterval);
  connect(&rebuildTimer_, &QTimer::timeout, this, &Editor::rebuildChanged);
  connect(&autosaveTimer_, &QTimer::timeout, this, [this] {
    attempt([this] { session_->autosaveIfDue(std::chrono::steady_clock::now()); });
  });
  autosaveTimer_.start(kAutosaveInterval);
  runner_ = [](const QString&, const std::function<void(const Job&)>& work) {
    work({});
    return true;
  };
  session_ = std::make_unique<app::Session>(firstProject(), sessionOptions());
  connect(&settings, &Settings::changed, this, [this] {
    const double limit = settings_.cacheLimitGiB() * kGiB;
    app::ModelCache* cache = session_->cache();
    if (cache && cache->limit() != limit) cache->setLimit(limit);
  });
}

Editor::~Editor() {
  session_->close();
  app::waitUntilDestroyed();  // sessions that were replaced tell this object of their rebuild
}

app::Session::Options Editor::sessionOptions() {
  app::Session::Options options;
  options.threads = settings_.threads();
  options.build.memoryLimit = settings_.memoryLimitGiB() * kGiB;
  options.cacheFolder = app::defaultCacheFolder();
  options.cacheLimit = settings_.cacheLimitGiB() * kGiB;
  options.autosaveEvery = std::chrono::seconds(settings_.autosaveSeconds());
  options.autosavePoll = std::chrono::milliseconds(kAutosaveInterval);
  // Called in the worker's thread: only starts the timer, in this object's thread.
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
    // Without a home folder the session writes no snapshots.
  }
  return options;
}

template <class Work>
bool Editor::attempt(const Work& work) {
  try {
    work();
    return true;
  } catch (const std::exception& error) {  // must not reach Qt's event loop
    Q_EMIT refused(QString::fromStdString(error.what()));
    return false;
  }
}

void Editor::adopt(std::unique_ptr<app::Session> session) {
  Q_EMIT aboutToReplace();
  session_->close();
  // Its worker may need a moment to stop; the window does not wait for it.
  app::destroyInBackground(std::shared_ptr<app::Session>(std::move(session_)));
  session_ = std::move(session);
  selection_ = {};
  Q_EMIT projectReplaced();
  Q_EMIT selectionChanged();
  Q_EMIT fileChanged();
  Q_EMIT rebuildChanged();
}

void Editor::start(modeling::Project project) {
  adopt(std::make_unique<app::Session>(std::move(project), sessionOptions()));
}

bool Editor::openInBackground(
    const QString& title,
    const std::function<std::unique_ptr<app::Session>(const Job&, const app::Session::Options&)>&
        make) {
  bool isOpen = false;
  attempt([&] {
    const app::Session::Options options = sessionOptions();
    std::unique_ptr<app::Session> session;
    if (!runner_(title, [&](const Job& job) { session = make(job, options); })) return;
    if (!session) return;
    adopt(std::move(session));
    isOpen = true;
  });
  return isOpen;
}

bool Editor::open(const QString& file) {
  const std::filesystem::path path = file.toStdString();
  return openInBackground(tr("Opening %1").arg(QFileInfo(file).fileName()),
                          [&](const Job&, const app::Session::Options& options) {
                            // A backup copy opens as a project without a file: saving asks for a
                            // name.
                            if (path.extension() == ".bak")
                              return std::make_unique<app::Session>(modeling::readProject(path),
                                                                    options);
                            return std::make_unique<app::Session>(path, options);
                          });
}

bool Editor::importFile(const QString& file, const modeling::ImportOptions& options,
                        bool* needsChoice) {
  const QFileInfo info(file);
  std::vector<std::string> notes;
  const bool isOpen = openInBackground(
      tr("Importing %1").arg(info.fileName()),
      [&](const Job& job, const app::Session::Options& session) -> std::unique_ptr<app::Session> {
        try {
          app::ImportedProject imported = app::importProject(file.toStdString(), options, job);
          notes = std::move(imported.notes);
          return std::make_unique<app::Session>(std::move(imported.project), session);
        } catch (const modeling::SeveralBodies&) {
          if (!needsChoice) throw;
          *needsChoice = true;
          return nullptr;
        }
      });
  if (!isOpen) return false;
  QStringList told;
  for (const std::string& note : notes) told << QString::fromStdString(note);
  // For a CAD file the notes contain the same with the reason.
  const auto format = modeling::fileFormatOf(file.toStdString());
  if (!solid() && format && infoOf(*format).kind == modeling::FileKind::kMesh)
    told << tr(
        "The mesh became a mesh body, which can be supported and touched but has no control "
        "points and cannot be exported as CAD.");
  told << tr("It is held on %1; Paint support (P) changes that.")
              .arg(QString::fromStdString(modeling::proposeSupport(project().body).description()));
  Q_EMIT said(tr("%1 was imported. %2").arg(info.fileName(), told.join(' ')));
  return true;
}

bool Editor::exportFile(const QString& file, ExportedSurface surface,
                        const app::TouchPageSettings& page) {
  bool isWritten = false;
  attempt([&] {
    const modeling::Project copy = project();
    isWritten = runner_(tr("Exporting %1").arg(QFileInfo(file).fileName()), [&](const Job& job) {
      exportBody(copy, file.toStdString(), surface, job, page);
    });
  });
  if (isWritten) Q_EMIT said(tr("Exported to %1").arg(file));
  return isWritten;
}

bool Editor::recover(const modeling::Snapshot& snapshot) {
  const bool isOpen =
      openInBackground(tr("Recovering %1").arg(QString::fromStdString(snapshot.projectName)),
                       [&](const Job&, const app::Session::Options& options) {
                         return std::make_unique<app::Session>(snapshot, options);
                       });
  if (!isOpen) return false;
  return attempt([&] {
    // The edits must always have a snapshot: write the new one before discarding the old.
    const auto now = std::chrono::steady_clock::now();
    bool isKept = session_->autosaveIfDue(now);
    if (!isKept) isKept = session_->autosaveIfDue(now + sessionOptions().autosaveEvery);
    if (isKept) modeling::discard(snapshot);
  });
}

bool Editor::save() {
  return !fileName().isEmpty() && saveAs(fileName());
}

bool Editor::saveAs(const QString& file) {
  Q_EMIT aboutToSave();
  bool isSaved = false;
  attempt([&] {
    const std::filesystem::path path = file.toStdString();
    const modeling::Project copy = project();
    // Writing cannot be interrupted: the file is complete even after Cancel.
    runner_(tr("Saving %1").arg(QFileInfo(file).fileName()), [&](const Job&) {
      modeling::writeProject(copy, path);
      isSaved = true;
    });
    if (isSaved) session_->markSavedAs(path);
  });
  Q_EMIT fileChanged();
  if (isSaved) Q_EMIT saved(file);
  return isSaved;
}

QString Editor::fileName() const {
  return session_->file() ? QString::fromStdString(session_->file()->string()) : QString();
}

bool Editor::perform(const modeling::Command& command, modeling::Merge merge) {
  return attempt([&] { changed(session_->perform(command, merge).change); });
}

bool Editor::performAll(const QString& label, const std::vector<modeling::Command>& commands) {
  return attempt([&] {
    session_->beginGroup(label.toStdString());
    try {
      for (const modeling::Command& command : commands) changed(session_->perform(command).change);
    } catch (...) {
      cancelGroup();
      throw;
    }
    endGroup();
  });
}

void Editor::editView(const std::string& view) {
  session_->editView(view);
  Q_EMIT fileChanged();
}

void Editor::undo() {
  if (session_->document().canUndo()) changed(session_->undo());
}

void Editor::redo() {
  if (session_->document().canRedo()) changed(session_->redo());
}

void Editor::goToState(std::size_t position) {
  const modeling::Document& document = session_->document();
  if (document.isInGroup() || position >= document.history().labels.size()) return;
  changed(session_->goToState(position));
}

void Editor::changed(const modeling::Change& change) {
  if (!change.any()) return;
  // Receivers of projectChanged must not see removed items in the selection, and receivers of
  // selectionChanged must already know the change.
  const Selection before = selection_;
  deselectRemoved(change);
  Q_EMIT projectChanged(change);
  if (selection_ != before) Q_EMIT selectionChanged();
  Q_EMIT fileChanged();
}

void Editor::beginGroup(const QString& label) {
  session_->beginGroup(label.toStdString());
}

void Editor::endGroup() {
  if (!session_->document().isInGroup()) return;
  session_->endGroup();
  Q_EMIT fileChanged();
}

void Editor::cancelGroup() {
  if (!session_->document().isInGroup()) return;
  changed(session_->cancelGroup());
}

void Editor::deselectRemoved(const modeling::Change& change) {
  Selection kept = selection_;
  if (change.topology) kept = {{}, {}, {}, kept.named};
  if (kept.named && !hasNamed(project(), *kept.named)) kept.named.reset();
  selection_ = std::move(kept);
}

void Editor::select(Selection selection) {
  if (selection == selection_) return;
  selection_ = std::move(selection);
  Q_EMIT selectionChanged();
}

}  // namespace palpa::gui
