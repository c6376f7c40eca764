#pragma once

#include <QFrame>
#include <QVBoxLayout>

#include "gui/widgets/age_badge.h"
#include "gui/widgets/text.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// The frame of every view: title at the left, what it shows and its age at the right, content
/// below. When the age is red the content is hatched over, with one sentence; it stays visible
/// underneath but cannot be mistaken for live.
class Tile : public QFrame {
  Q_OBJECT
 public:
  Tile(const Ui& ui, const QString& title, QWidget* parent = nullptr);
  /// Takes ownership of `content`. With `flush` there is no margin around it (images, 3D).
  void setContent(QWidget* content, bool flush = false);
  void setTitle(const QString& title);
  /// Grey text at the right of the header, before the age: "map · 28 k points".
  void setInfo(const QString& text);
  void setAge(double age_s, AgeLevel level);
  /// A widget at the far right of the header (search field, small buttons). Takes ownership.
  void addHeaderWidget(QWidget* widget);
  /// Text over the hatch; default "last heard 4.2 s ago".
  void setStaleText(const QString& headline, const QString& detail = {});
  [[nodiscard]] AgeLevel ageLevel() const { return level_; }
  [[nodiscard]] bool hatched() const;

 signals:
  void titleDoubleClicked();

 protected:
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  class Overlay;
  void restyle();
  void fitInfo();
  Ui ui_;
  QVBoxLayout* layout_;
  QHBoxLayout* header_;
  Label* title_;
  Label* info_;
  AgeBadge* badge_;
  QWidget* content_ = nullptr;
  Overlay* overlay_;
  AgeLevel level_ = AgeLevel::Fresh;
  QString info_text_, stale_headline_, stale_detail_;
};

}  // namespace kiln::gui
