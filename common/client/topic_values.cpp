#include "common/client/topic_values.h"

#include <array>

namespace kiln {
namespace {

template <class Row, class Function>
Result<void> hand(const Function& function, std::string_view payload, const Arrival& arrival) {
  if (!function) return {};
  auto value = Row::kDecode(payload);
  if (!value) return tl::make_unexpected(value.error());
  function(std::make_shared<const typename Row::Value>(std::move(*value)), arrival);
  return {};
}

}  // namespace

Result<void> TopicSubscribers::dispatch(Topic topic, std::string_view payload,
                                        const Arrival& arrival) const {
  Result<void> done;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((static_cast<std::size_t>(topic) == i &&
      (done = hand<std::tuple_element_t<i, TopicValues>>(std::get<i>(functions_), payload, arrival),
       true)) ||
     ...);
  }
  (std::make_index_sequence<kTopicCount>{});
  return done;
}

}  // namespace kiln
