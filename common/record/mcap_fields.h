#pragma once

#include <concepts>
#include <tuple>
#include <type_traits>

#include "common/record/mcap_format.h"

/// The fields of each record in the order of the file, once for writer and reader: a number stands
/// as many bytes long as its type, a string, map or list behind its length in bytes (uint32). What
/// follows the fields (raw data, a CRC) is the business of mcap_encode and mcap_decode.
namespace kiln::mcap {

template <class R, class Record>
concept Of = std::same_as<std::remove_const_t<R>, Record>;

template <Of<Header> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.profile, r.library);
}
template <Of<Footer> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.summary_start, r.summary_offset_start, r.summary_crc);
}
template <Of<Schema> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.id, r.name, r.encoding, r.data);
}
template <Of<Channel> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.id, r.schema_id, r.topic, r.message_encoding, r.metadata);
}
template <Of<Message> R>
[[nodiscard]] auto fields(R& r) {  // then the data, to the end of the record
  return std::tie(r.channel_id, r.sequence, r.log_time, r.publish_time);
}
template <Of<Chunk> R>
[[nodiscard]] auto fields(R& r) {  // then the records behind their length (uint64)
  return std::tie(r.start_time, r.end_time, r.uncompressed_size, r.uncompressed_crc, r.compression);
}
template <Of<MessageIndex> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.channel_id, r.entries);
}
template <Of<ChunkIndex> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.start_time, r.end_time, r.offset, r.length, r.message_index_offsets,
                  r.message_index_length, r.compression, r.compressed_size, r.uncompressed_size);
}
template <Of<Attachment> R>
[[nodiscard]] auto fields(R& r) {  // then the data behind its length (uint64), then the CRC
  return std::tie(r.log_time, r.create_time, r.name, r.media_type);
}
template <Of<AttachmentIndex> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.offset, r.length, r.log_time, r.create_time, r.data_size, r.name, r.media_type);
}
template <Of<Statistics> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.message_count, r.schema_count, r.channel_count, r.attachment_count,
                  r.metadata_count, r.chunk_count, r.start_time, r.end_time,
                  r.channel_message_counts);
}
template <Of<SummaryOffset> R>
[[nodiscard]] auto fields(R& r) {
  return std::tie(r.group, r.start, r.length);
}

}  // namespace kiln::mcap
