#pragma once

#include "common/record/record_index.h"

namespace kiln {

/// What readers and cursors of one recording share. Private to them.
struct RecordContent {
  std::shared_ptr<const RandomFile> file;
  RecordIndex index;

  [[nodiscard]] std::string_view topicOf(std::uint16_t channel) const {
    const auto found = index.channels.find(channel);
    return found == index.channels.end() ? std::string_view{}
                                         : std::string_view(found->second.topic);
  }
  [[nodiscard]] std::string_view schemaOf(std::uint16_t channel) const {
    const auto found = index.channels.find(channel);
    if (found == index.channels.end()) return {};
    const auto schema = index.schemas.find(found->second.schema_id);
    return schema == index.schemas.end() ? std::string_view{}
                                         : std::string_view(schema->second.name);
  }
};

}  // namespace kiln
