#pragma once

#include <QPlainTextEdit>

#include "gui/models/station_models.h"
#include "gui/widgets/theme.h"

namespace kiln::gui {

/// The event log: newest at the bottom, follows unless the operator has scrolled up. Warnings carry
/// a mark.
class LogView : public QPlainTextEdit {
  Q_OBJECT
 public:
  LogView(const Ui& ui, StationModels& models, QWidget* parent = nullptr);
  [[nodiscard]] static QString lineText(const LogLine& line, Stamp mission_zero);

 private:
  void append();
  void rebuild();
  void addLine(const LogLine& line);
  Ui ui_;
  StationModels& models_;
  std::uint64_t shown_ = 0;
};

}  // namespace kiln::gui
