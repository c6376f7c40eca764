#pragma once

#include <QFrame>
#include <vector>

#include "gui/models/station_models.h"
#include "gui/widgets/act_button.h"
#include "gui/widgets/text.h"

class QScrollArea;
class QVBoxLayout;

namespace kiln::gui {

/// One alarm: level, how long it stands, what and where, what to do, and a key to acknowledge it.
class AlarmRow : public QWidget {
  Q_OBJECT
 public:
  AlarmRow(const Ui& ui, StationModels& models, const AlarmModel::Entry& entry);
  [[nodiscard]] bool of(const AlarmModel::Entry& entry) const;
  void show(const AlarmModel::Entry& entry);
  /// "WARNING", "Arm in protective stop", "look at the arm", "for 12 s · acknowledged".
  [[nodiscard]] QStringList words() const;
  [[nodiscard]] ActButton* acknowledgeButton() const { return acknowledge_; }
  [[nodiscard]] int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] QString state() const;
  [[nodiscard]] int textRoom(int width) const;
  Ui ui_;
  StationModels& models_;
  AlarmModel::Entry entry_;
  ActButton* acknowledge_;
};

/// All alarms, by weight (AlarmModel::ranked), over the window. The keys of the list never take the
/// keyboard from what is driven, and no row moves while the pointer is over the list: what is new
/// comes at its end then.
class AlarmList : public QFrame {
  Q_OBJECT
 public:
  AlarmList(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  void toggle();
  [[nodiscard]] const std::vector<AlarmRow*>& rows() const { return rows_; }
  /// With all rows at this width; more than `most_px` scrolls.
  [[nodiscard]] int heightFor(int width, int most_px) const;

 signals:
  void resized();  ///< rows have come or gone

 protected:
  void leaveEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void refresh();
  void arrange();
  void fitRows();
  void restyle();
  Ui ui_;
  StationModels& models_;
  Label *title_, *none_;
  QScrollArea* scroll_;
  QVBoxLayout* column_;
  std::vector<AlarmRow*> rows_;
};

}  // namespace kiln::gui
