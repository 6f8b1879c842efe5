#include "app/gui/dialogs/shape_preview.h"

#include <QThreadPool>
#include <QVBoxLayout>
#include <atomic>
#include <exception>

#include "app/gui/base/appearance.h"
#include "modeling/shapes/make_primitive.h"
#include "modeling/solid/tessellation.h"

namespace palpa::gui {
namespace {

constexpr int kPreviewInterval = 30;  // ms between two checks for the answer

}  // namespace

struct ShapePreview::Answer {
  std::optional<modeling::Solid> solid;
  QString problem;
  std::atomic<bool> isThere = false;
};

ShapePreview::ShapePreview(const QString& whyStale, QWidget* parent)
    : ViewportWidget(parent), veil_(new QLabel(whyStale, this)) {
  setObjectName("preview");
  setAccessibleName(tr("Preview"));
  viewport().setTheme(viewportTheme(currentTheme()));
  veil_->setObjectName("stale");
  veil_->setAlignment(Qt::AlignCenter);
  veil_->setWordWrap(true);
  QColor veil = palette().color(QPalette::Window);
  veil.setAlphaF(0.75F);
  veil_->setStyleSheet(QString("background: %1;").arg(veil.name(QColor::HexArgb)));
  veil_->hide();
  auto* cover = new QVBoxLayout(this);
  cover->setContentsMargins(0, 0, 0, 0);
  cover->addWidget(veil_);
  timer_.setInterval(kPreviewInterval);
  connect(&timer_, &QTimer::timeout, this, &ShapePreview::look);
}

void ShapePreview::showSolid(const modeling::Solid& solid) {
  const modeling::Tessellation tessellation(solid);
  const auto shape = tessellation.evaluate(solid.controlPoints());
  viewport().setBody({shape.positions, shape.normals, tessellation.triangles(),
                      tessellation.patchOfTriangle(), tessellation.borders(),
                      tessellation.knotLines()});
  if (showsNet_)
    viewport().setControlNet({solid.controlPoints(), modeling::controlNetLines(solid)});
  if (isFresh_) viewport().lookFrom(view::StandardView::kIsometric);
  isFresh_ = false;
  viewport().fit();
  update();
}

void ShapePreview::setStale(bool isStale) {
  veil_->setVisible(isStale);
}

void ShapePreview::ask(const modeling::Primitive& primitive) {
  waiting_ = primitive;
  isWanted_ = false;
  timer_.start();
  if (!answer_) look();
}

void ShapePreview::forget() {
  waiting_.reset();
  isWanted_ = false;
}

void ShapePreview::look() {
  if (answer_) {
    if (!answer_->isThere) return;
    const std::shared_ptr<Answer> answer = std::move(answer_);
    // While a drag makes new requests, an older solid is better than none.
    if (answer->solid) showSolid(*answer->solid);
    if (isWanted_) Q_EMIT answered(answer->problem);
  }
  if (!waiting_) {
    if (!answer_) timer_.stop();
    return;
  }
  answer_ = std::make_shared<Answer>();
  QThreadPool::globalInstance()->start([answer = answer_, primitive = *waiting_] {
    try {
      answer->solid = modeling::makePrimitive(primitive);
    } catch (const std::exception& error) {
      answer->problem = QString::fromStdString(error.what());
    }
    answer->isThere = true;
  });
  waiting_.reset();
  isWanted_ = true;
}

}  // namespace palpa::gui
