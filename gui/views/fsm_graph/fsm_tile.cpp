#include "gui/views/fsm_graph/fsm_tile.h"

#include <QLineEdit>
#include <QPainter>
#include <QVBoxLayout>

#include "gui/views/fsm_graph/graph_view.h"
#include "gui/views/fsm_graph/jump_panel.h"

namespace kiln::gui {

namespace {
/// One line that explains fills and line styles, drawn with the very colours.
class Legend : public QWidget {
 public:
  explicit Legend(const Ui& ui) : ui_(ui) { setFixedHeight(18); }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Palette& p = ui_.theme.colors();
    QPainter painter(this);
    painter.setFont(ui_.theme.font(TextRole::Small));
    double x = 1;
    const auto text = [&](const QString& words) {
      painter.setPen(p.dim);
      painter.drawText(QRectF(x, 0, width(), height()), Qt::AlignVCenter | Qt::AlignLeft, words);
      x += painter.fontMetrics().horizontalAdvance(words) + 12;
    };
    const auto box = [&](const QColor& fill, const QColor& line) {
      painter.setPen(QPen(line, 1.4));
      painter.setBrush(fill);
      painter.drawRect(QRectF(x, height() / 2.0 - 5, 10, 10));
      x += 15;
    };
    const auto line = [&](const QColor& color, Qt::PenStyle style) {
      painter.setPen(QPen(color, 2, style));
      painter.drawLine(QPointF(x, height() / 2.0), QPointF(x + 20, height() / 2.0));
      x += 25;
    };
    box(p.active, p.active_line);
    text(tr("now"));
    box(mixed(p.panel, p.recent, 0.55), p.border);
    text(tr("recent"));
    line(p.dim, Qt::DotLine);
    text(tr("time-out"));
    line(p.forced, Qt::DashLine);
    text(tr("forced"));
  }

 private:
  Ui ui_;
};
}  // namespace

FsmTile::FsmTile(const Ui& ui, StationModels& models, ForcedJump& jump, QWidget* parent)
    : Tile(ui, tr("Mission"), parent),
      models_(models),
      graph_(new GraphView(ui, models, jump)),
      panel_(new JumpPanel(ui, models, jump, new Legend(ui))),
      search_(new QLineEdit) {
  auto* body = new QWidget;
  auto* column = new QVBoxLayout(body);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  column->addWidget(graph_, 1);
  column->addWidget(panel_);
  setContent(body);
  search_->setPlaceholderText(tr("find a state"));
  search_->setFixedSize(130, 22);
  search_->hide();
  addHeaderWidget(search_);
  connect(search_, &QLineEdit::textChanged, graph_, &GraphView::search);
  connect(search_, &QLineEdit::returnPressed, this, [this, &jump] {
    const QString name = graph_->search(search_->text());
    if (jump.phase() == ForcedJump::Phase::Armed && !name.isEmpty()) jump.pick(name);
    endSearch();
  });
  connect(graph_, &GraphView::nodeClicked, this, [&jump](const QString& name) {
    if (jump.phase() == ForcedJump::Phase::Armed || jump.phase() == ForcedJump::Phase::Picked)
      jump.pick(name);
  });
  connect(&models_.fsm, &Model::changed, this, &FsmTile::refresh);
  connect(&models_, &StationModels::aged, this, &FsmTile::refresh);
  refresh();
}

void FsmTile::refresh() {
  const FsmInfo* info = models_.fsm.info();
  setTitle(info ? tr("Mission · %1").arg(QString::fromStdString(info->mission)) : tr("Mission"));
  setInfo(search_->isVisible() ? QString{} : tr("/ find"));
  setAge(models_.fsm.ageS(), models_.fsm.ageLevel());
}

void FsmTile::beginSearch() {
  search_->show();
  search_->setFocus();
  search_->selectAll();
}

void FsmTile::endSearch() {
  search_->clear();
  search_->hide();
  graph_->setFocus();
}

}  // namespace kiln::gui
