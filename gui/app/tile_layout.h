#pragma once

#include <QBoxLayout>
#include <QObject>
#include <QPointer>
#include <QString>
#include <vector>

#include "gui/widgets/tile.h"

namespace kiln::gui {

class ActButton;

/// Where the tiles of the window stand at its size.
///
/// Wide: the graph, the scene over the pictures, the right column; timeline and log below. Low:
/// take-over and macros share one place behind two tabs. Small: one tile at a time has the middle,
/// behind tabs; the right column stays. A double click on the title of a tile of the middle gives
/// it all of the middle, one more puts everything back.
class TileLayout : public QObject {
  Q_OBJECT
 public:
  struct Tiles {
    Tile *mission, *scene;
    QWidget* pictures;  ///< a row of tiles, which may come and go
    Tile *timeline, *log;
    Tile *state, *teleop, *macros;
  };
  static constexpr QSize kLeast{944, 500};  ///< half of a screen of 1920 x 1080, less its frames
  TileLayout(const Ui& ui, const Tiles& tiles, QWidget& window);
  /// The middle with the right column, and the row below it; owned by the window's layout.
  [[nodiscard]] QBoxLayout* middle() const { return middle_; }
  [[nodiscard]] QBoxLayout* bottom() const { return bottom_; }
  void arrange(const QSize& window);
  void showLog(bool shown);
  [[nodiscard]] bool logShown() const { return log_shown_; }
  void showMacros(bool in_front);
  /// A tile of the middle that is needed now: in front, if it is not to be seen.
  void bringToFront(Tile& tile);
  /// Gives `tile` the middle; the one that has it, or nullptr: back to all.
  void enlarge(Tile* tile);
  [[nodiscard]] Tile* enlarged() const { return large_; }
  /// What the operator has chosen, in words to keep; unknown words are passed over.
  [[nodiscard]] QString choices() const;
  void choose(const QString& choices);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void watch(Tile& tile);
  [[nodiscard]] bool low() const;
  [[nodiscard]] bool small() const;
  [[nodiscard]] bool inFront(const QWidget* tile) const;
  [[nodiscard]] std::vector<Tile*> pictureTiles() const;
  QWidget* makeTabs(const std::vector<std::pair<QString, QWidget*>>& tabs);
  QWidget* makeRight();
  void arrangeMiddle();
  void arrangeRight();
  void markTabs();
  Ui ui_;
  Tiles tiles_;
  QSize size_;
  QBoxLayout *middle_, *centre_, *bottom_;
  std::vector<std::pair<ActButton*, QWidget*>> tabs_;
  QWidget *middle_tabs_, *right_tabs_ = nullptr, *right_;
  QWidget* front_;        ///< of a small window's middle
  QPointer<Tile> large_;  ///< has the middle
  bool macros_in_front_ = false, log_shown_ = false;
};

}  // namespace kiln::gui
