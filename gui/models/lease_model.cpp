#include "gui/models/lease_model.h"

#include <algorithm>

namespace kiln::gui {

LeaseModel::LeaseModel(Link& link, CommandModel& commands, QObject* parent)
    : Model(link, AgeLimits{}, parent), commands_(commands) {
  connect(&link, &Link::status, this, [this](const std::shared_ptr<const RobotStatus>& status) {
    lease_ = status->lease;
    arrived(status->stamp);
  });
  connect(&commands, &CommandModel::progressed, this, [this] { touch(); });
}

LeaseHolder LeaseModel::holder() const {
  if (!hasData() || ageLevel() != AgeLevel::Fresh) return LeaseHolder::Unknown;
  if (lease_.holder_client.empty()) return LeaseHolder::Free;
  return lease_.holder_client == link().clientId().toStdString() ? LeaseHolder::Mine
                                                                 : LeaseHolder::Other;
}

QString LeaseModel::holderName() const { return QString::fromStdString(lease_.holder_name); }

bool LeaseModel::requesting() const {
  const TrackedCommand* command = commands_.find(request_);
  return command && command->state == CommandState::Sent;
}

QString LeaseModel::askedBy() const {
  if (!mine() || lease_.requested_by_client.empty()) return {};
  return tr("%1 asks (%2 s)")
      .arg(QString::fromStdString(lease_.requested_by_name))
      .arg(std::max(0.0, lease_.request_expires_in_s), 0, 'f', 0);
}

QString LeaseModel::refusal() const {
  const TrackedCommand* command = commands_.find(request_);
  return command && command->bad() && !mine() ? command->reason : QString{};
}

void LeaseModel::request(bool take_over) {
  request_ = commands_.send(AcquireLease{take_over},
                            take_over ? tr("take over the lease") : tr("request the lease"));
}

void LeaseModel::release() { commands_.send(ReleaseLease{}, tr("release the lease")); }

}  // namespace kiln::gui
