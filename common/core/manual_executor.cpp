#include "common/core/manual_executor.h"

#include <utility>

namespace kiln {

bool ManualExecutor::post(Job job) {
  int& in_flight = in_flight_[job.kind];
  if (in_flight > 0) {
    ++dropped_jobs_;
    return false;
  }
  ++in_flight;
  Delivery deliver = job.run(stop_.get_token());
  at(clock_.now() + job.modelled_latency, kPriorityDelivery,
     [this, kind = std::move(job.kind), deliver = std::move(deliver)] {
       --in_flight_[kind];
       if (deliver) deliver();
     });
  return true;
}

void ManualExecutor::every(Duration period, std::string name, int priority,
                           std::function<void(Stamp)> tick) {
  TickStatistics statistics;
  statistics.name = std::move(name);
  periodics_.push_back(
      std::make_unique<Periodic>(Periodic{period, priority, std::move(tick), statistics}));
  schedulePeriodic(periodics_.size() - 1, clock_.now() + period);
}

void ManualExecutor::schedulePeriodic(std::size_t index, Stamp time) {
  at(time, periodics_[index]->priority, [this, index, time] {
    Periodic& periodic = *periodics_[index];
    ++periodic.statistics.ticks;
    schedulePeriodic(index, time + periodic.period);
    periodic.tick(time);
  });
}

void ManualExecutor::at(Stamp time, int priority, std::function<void()> event) {
  events_.emplace(Key{time, priority, sequence_++}, std::move(event));
}

void ManualExecutor::runUntil(Stamp until) {
  while (!events_.empty() && std::get<Stamp>(events_.begin()->first) <= until) {
    auto node = events_.extract(events_.begin());
    const Stamp time = std::get<Stamp>(node.key());
    if (time > clock_.now()) clock_.advanceTo(time);
    node.mapped()();
  }
  if (until > clock_.now()) clock_.advanceTo(until);
}

Stamp ManualExecutor::nextEvent() const {
  return events_.empty() ? Stamp::max() : std::get<Stamp>(events_.begin()->first);
}

std::vector<TickStatistics> ManualExecutor::statistics() const {
  std::vector<TickStatistics> out;
  for (const auto& periodic : periodics_) out.push_back(periodic->statistics);
  return out;
}

}  // namespace kiln
