#include "app/gui/compare/variant_comparison.h"

#include <QFileInfo>
#include <QLocale>
#include <new>

#include "app/core/system/destroy_in_background.h"
#include "app/core/system/priority.h"
#include "app/gui/document/force_words.h"
#include "base/error.h"

namespace palpa::gui {
namespace {

constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
constexpr int kInterval = 40;      // ms between two requests
constexpr int kQuiet = 600;        // ms without a change until errors are estimated
constexpr int kFileSettles = 250;  // ms: programs write a file in several steps

app::BuildOptions buildOptions(const Settings& settings) {
  app::BuildOptions options;
  options.memoryLimit = settings.memoryLimitGiB() * kGiB;
  const std::filesystem::path folder = app::defaultCacheFolder();
  const double limit = settings.cacheLimitGiB() * kGiB;
  if (!folder.empty() && limit > 0)
    options.cache = std::make_shared<app::ModelCache>(folder, limit);
  return options;
}

}  // namespace

bool VariantComparison::Input::operator==(const Input& other) const {
  const auto isSame = [](const app::LiveContact& p, const app::LiveContact& q) {
    return p.name == q.name && p.tool.kind == q.tool.kind && p.tool.radius == q.tool.radius &&
           p.tool.friction == q.tool.friction && p.at == q.at && p.value == q.value;
  };
  return drawnA == other.drawnA && a == other.a && b == other.b && densityA == other.densityA &&
         densityB == other.densityB && touches == other.touches &&
         std::equal(contacts.begin(), contacts.end(), other.contacts.begin(), other.contacts.end(),
                    isSame);
}

VariantComparison::VariantComparison(Editor& editor, Simulation& simulation,
                                     const Settings& settings, QObject* parent)
    : QObject(parent),
      editor_(editor),
      simulation_(simulation),
      settings_(settings),
      worker_(app::lowerThreadPriority) {
  soon_.setSingleShot(true);
  soon_.setInterval(kInterval);
  quiet_.setSingleShot(true);
  quiet_.setInterval(kQuiet);
  fileTimer_.setSingleShot(true);
  fileTimer_.setInterval(kFileSettles);
  connect(&soon_, &QTimer::timeout, this, &VariantComparison::request);
  connect(&quiet_, &QTimer::timeout, this, &VariantComparison::estimate);
  connect(&fileTimer_, &QTimer::timeout, this, &VariantComparison::checkFile);
  for (auto signal : {&QFileSystemWatcher::fileChanged, &QFileSystemWatcher::directoryChanged})
    connect(&watcher_, signal, this, [this] { fileTimer_.start(); });
  const auto requestSoon = [this] {
    if (isActive() && !soon_.isActive()) soon_.start();
  };
  connect(&simulation, &Simulation::framed, this, requestSoon);
  connect(&simulation, &Simulation::activeChanged, this, requestSoon);
  connect(&editor, &Editor::rebuildChanged, this, requestSoon);
  connect(&editor, &Editor::projectChanged, this, requestSoon);
  connect(&editor, &Editor::aboutToReplace, this, &VariantComparison::leave);
}

VariantComparison::~VariantComparison() {
  pipeline_.reset();
  app::waitUntilDestroyed();  // pipelines of former comparisons tell this object of their builds
  worker_.cancel();
  worker_.waitUntilIdle();
}

QString VariantComparison::nameOfA() const {
  const QString file = editor_.fileName();
  return file.isEmpty() ? QString::fromStdString(editor_.project().name)
                        : QFileInfo(file).fileName();
}

void VariantComparison::start(const modeling::Project& other, const QString& name,
                              const QString& file) {
  end();
  name_ = name;
  file_ = file;
  auto project = std::make_shared<modeling::Project>(other);
  project->touches = editor_.project().touches;  // the elements of both follow the same touches
  other_ = std::move(project);
  pipeline_ =
      std::make_unique<app::RebuildPipeline>(buildOptions(settings_), settings_.threads(), [this] {
        // In the thread of the build.
        QMetaObject::invokeMethod(
            this,
            [this] {
              if (!isActive()) return;
              Q_EMIT changed();
              if (!soon_.isActive()) soon_.start();
            },
            Qt::QueuedConnection);
      });
  pipeline_->submit(*other_);
  watchFile();
  Q_EMIT changed();
}

void VariantComparison::end() {
  if (!isActive()) return;
  // Its worker may need a moment to stop; the window does not wait for it.
  app::destroyInBackground(std::shared_ptr<app::RebuildPipeline>(std::move(pipeline_)));
  ++generation_;
  isBusy_ = isEstimating_ = false;
  quiet_.stop();
  requested_ = {};
  other_.reset();
  began_.clear();
  result_.reset();
  notice_.clear();
  if (!watcher_.files().isEmpty()) watcher_.removePaths(watcher_.files());
  if (!watcher_.directories().isEmpty()) watcher_.removePaths(watcher_.directories());
  worker_.replace([this](const std::stop_token&) {
    playerA_.reset();
    playerB_.reset();
    surfaces_.reset();
  });
  Q_EMIT changed();
  Q_EMIT compared();
}

void VariantComparison::leave() {
  if (!isActive()) return;
  const QString name = name_;
  end();
  Q_EMIT editor_.said(
      tr("The comparison with %1 has ended, because another project opens").arg(name));
}

std::shared_ptr<const app::TouchModel> VariantComparison::modelA() const {
  if (simulation_.drawn() && simulation_.body()) return simulation_.body()->sharedModel();
  return editor_.model();
}

VariantComparison::Input VariantComparison::input() {
  Input input;
  input.a = modelA();
  if (simulation_.drawn() && &simulation_.drawn()->model() == input.a.get())
    input.drawnA = simulation_.sharedDrawn();
  input.b = pipeline_->model();
  input.densityA = editor_.project().material.densityKgPerM3;
  input.densityB = other_->material.densityKgPerM3;
  std::map<app::TouchId, Eigen::Vector3d> present;
  int number = 0;
  for (const auto& contact : simulation_.snapshot().touched()) {
    ++number;
    const auto known = began_.find(contact.id);
    present[contact.id] = known == began_.end() ? contact.point.position : known->second;
    using Status = app::TouchSnapshot::Status;
    if (simulation_.hasEnded(contact.id) || contact.status == Status::kFixed ||
        contact.status == Status::kWaiting)
      continue;
    input.contacts.push_back(
        {tr("%1 %2").arg(kindText(contact.tool.kind)).arg(number).toStdString(), contact.tool,
         present[contact.id], contact.value});
  }
  began_ = std::move(present);
  if (input.contacts.empty()) input.touches = editor_.project().touches;
  return input;
}

void VariantComparison::request() {
  if (!isActive() || isBusy_) return;
  Input next = input();
  if (!next.b || next == requested_) return;
  requested_ = next;
  isBusy_ = true;
  quiet_.stop();
  auto task = [this, input = std::move(next),
               generation = generation_](const std::stop_token& stop) {
    Job job;
    job.stop = stop;
    job.threads = 1;
    auto result = std::make_shared<Result>();
    try {
      compute(input, job, *result);
    } catch (const Cancelled&) {
      return;  // end() or a newer comparison
    } catch (const std::bad_alloc&) {
      result->problem = tr("There is not enough memory for the comparison. Close other programs.");
    } catch (const Error& error) {
      result->problem = QString::fromStdString(error.what());
    }
    QMetaObject::invokeMethod(
        this, [this, generation, result] { receive(generation, result); }, Qt::QueuedConnection);
  };
  if (isEstimating_)
    worker_.replace(std::move(task));
  else
    worker_.post(std::move(task));
  isEstimating_ = false;
}

void VariantComparison::compute(const Input& input, const Job& job, Result& result) {
  if (!playerB_ || playerB_->variant().model != input.b ||
      playerB_->variant().densityKgPerM3 != input.densityB) {
    surfaces_.reset();
    playerB_ = std::make_unique<app::VariantPlayer>(app::Variant{"B", input.b, input.densityB},
                                                    Simulation::displaySettings(*input.b), job);
  }
  result.drawnB = playerB_->drawn();
  if (!input.a) return;
  const bool isNewBody = input.drawnA && playerA_ && playerA_->drawn() != input.drawnA;
  if (!playerA_ || playerA_->variant().model != input.a || isNewBody ||
      playerA_->variant().densityKgPerM3 != input.densityA) {
    surfaces_.reset();
    const app::Variant variant{"A", input.a, input.densityA};
    playerA_ = input.drawnA ? std::make_unique<app::VariantPlayer>(variant, input.drawnA)
                            : std::make_unique<app::VariantPlayer>(
                                  variant, modeling::DisplaySettings{1, 1}, job);
  }
  result.drawnA = playerA_->drawn();
  if (!surfaces_)
    surfaces_ = std::make_shared<const app::SurfaceCorrespondence>(*playerA_->drawn(),
                                                                   *playerB_->drawn(), job);
  result.surfaces = surfaces_;
  result.isOfView = !input.contacts.empty();
  const std::vector<modeling::Touch> touches =
      result.isOfView ? playerA_->touchesOf(input.contacts, job) : input.touches;
  result.comparison = app::compareVariants(*playerA_, *playerB_, touches, job);
}

void VariantComparison::receive(std::uint64_t generation, std::shared_ptr<const Result> result) {
  if (generation != generation_) return;
  if (result_) app::destroyInBackground(std::move(result_));
  result_ = std::move(result);
  isBusy_ = false;
  if (result_->comparison) quiet_.start();
  Q_EMIT compared();
  if (!soon_.isActive()) soon_.start();  // the input may have changed meanwhile
}

void VariantComparison::estimate() {
  if (!isActive() || isBusy_ || isEstimating_ || !result_ || !result_->comparison) return;
  isEstimating_ = true;
  worker_.post([this, generation = generation_, known = result_](const std::stop_token& stop) {
    Job job;
    job.stop = stop;
    job.threads = 1;
    auto result = std::make_shared<Result>(*known);
    try {
      app::estimateErrors(*playerA_, *playerB_, *result->comparison, job);
    } catch (const Cancelled&) {
      return;  // a newer comparison
    } catch (const std::bad_alloc&) {
      return;  // without errors
    }
    QMetaObject::invokeMethod(
        this,
        [this, generation, known, result] {
          if (generation != generation_ || result_ != known) return;
          isEstimating_ = false;
          result_ = result;
          Q_EMIT compared();
        },
        Qt::QueuedConnection);
  });
}

void VariantComparison::watchFile() {
  if (file_.isEmpty()) return;
  const QFileInfo info(file_);
  fileTime_ = info.lastModified();
  fileSize_ = info.size();
  watcher_.addPath(file_);
  // Programs replace files, and a removed file may come back.
  watcher_.addPath(info.absolutePath());
}

void VariantComparison::checkFile() {
  if (!isActive() || file_.isEmpty()) return;
  const QFileInfo info(file_);
  QString notice;
  if (!info.exists())
    notice = tr("%1 is not there any more. The comparison uses the version that was read.")
                 .arg(info.fileName());
  else if (info.lastModified() != fileTime_ || info.size() != fileSize_)
    notice = tr("%1 has changed on the disk. The comparison uses the version that was read.")
                 .arg(info.fileName());
  if (info.exists() && !watcher_.files().contains(file_)) watcher_.addPath(file_);
  if (notice == notice_) return;
  notice_ = notice;
  Q_EMIT changed();
}

}  // namespace palpa::gui
