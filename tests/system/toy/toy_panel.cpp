#include "tests/system/toy/toy_panel.h"

#include "gui/widgets/act_button.h"
#include "tests/system/toy/toy_view.h"

namespace kiln::toy {
namespace {

class ToyCard final : public gui::SceneCard {
 public:
  ToyCard(const gui::PanelParts& parts, QWidget* parent) : gui::SceneCard(parent) {
    auto* push = new gui::ActButton(parts.ui, QStringLiteral("Push"), this);
    push->resize(120, 40);
    resize(push->size());
    connect(push, &QAbstractButton::clicked, this, [&commands = parts.models.commands] {
      commands.send(MissionCommand{kPush, "", {{"by", 0.2}}}, QStringLiteral("push"));
    });
    hide();
  }
  [[nodiscard]] QString keyText() const override { return QStringLiteral("toy"); }
  [[nodiscard]] QString keyTip() const override { return QStringLiteral("the toy's card"); }
  void toggle() override {
    setVisible(isHidden());
    emit refreshed();
  }
  void cancel() override { hide(); }
  [[nodiscard]] std::vector<SceneItem> ghosts() const override { return items({2.0, 0.0, 0.0}); }
  [[nodiscard]] std::optional<Eigen::Vector2d> subject() const override { return std::nullopt; }
};

}  // namespace

gui::PanelKind panel() {
  gui::PanelKind kind{"toy.card"};
  kind.scene = [](const gui::PanelParts& parts, QWidget* parent) -> gui::SceneCard* {
    return new ToyCard(parts, parent);
  };
  return kind;
}

}  // namespace kiln::toy
