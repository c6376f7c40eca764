#include <lz4frame.h>
#include <zstd.h>

#include "common/record/mcap_decode.h"
#include "common/record/printable.h"
#include "common/record/record_index.h"

namespace kiln {
namespace {

/// The reason why `in` cannot be unpacked into `out`, or nullptr. `out` is cut to what came.
const char* unpackZstd(std::string_view in, std::string& out) {
  const std::size_t size = ZSTD_decompress(out.data(), out.size(), in.data(), in.size());
  if (ZSTD_isError(size) != 0) return ZSTD_getErrorName(size);
  out.resize(size);
  return nullptr;
}

const char* unpackLz4(std::string_view in, std::string& out) {
  LZ4F_dctx* created = nullptr;
  if (const auto code = LZ4F_createDecompressionContext(&created, LZ4F_VERSION);
      LZ4F_isError(code) != 0)
    return LZ4F_getErrorName(code);
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      created, &LZ4F_freeDecompressionContext);
  std::size_t done = 0;
  while (!in.empty()) {
    std::size_t room = out.size() - done, eaten = in.size();
    const auto code =
        LZ4F_decompress(context.get(), out.data() + done, &room, in.data(), &eaten, nullptr);
    if (LZ4F_isError(code) != 0) return LZ4F_getErrorName(code);
    done += room;
    in.remove_prefix(eaten);
    if (code == 0) break;
    if (room == 0 && eaten == 0) return "it unpacks to more than it says";
  }
  out.resize(done);
  return nullptr;
}

}  // namespace

Result<std::string> readChunk(const RandomFile& file, const ChunkEntry& chunk) {
  const auto damaged = [&](std::string_view why) {
    return makeError(ErrorCode::InvalidInput, "{}: the chunk at {} is damaged: {}", file.path(),
                     chunk.offset, why);
  };
  constexpr std::uint64_t kHeads = 1024;
  if (chunk.length > kMaxChunkBytes + kHeads) return damaged("it is larger than 32 MiB");
  auto bytes = file.read(chunk.offset, chunk.length);
  if (!bytes || chunk.loose) return bytes;
  mcap::ByteReader in(*bytes);
  const auto record = mcap::nextRecord(in);
  if (!record || record->opcode != mcap::Opcode::Chunk) return damaged("no chunk starts there");
  const auto content = mcap::decodeChunk(record->content);
  if (!content) return damaged("its lengths do not fit");
  if (content->uncompressed_size > kMaxChunkBytes) return damaged("it unpacks to over 32 MiB");
  std::string out;
  if (content->compression.empty()) {
    out = content->records;
  } else {
    const bool zstd = content->compression == "zstd";
    if (!zstd && content->compression != "lz4") {
      return makeError(ErrorCode::InvalidInput,
                       "{}: the chunk at {} is compressed with {}; Kiln reads zstd, lz4 and none",
                       file.path(), chunk.offset, printable(content->compression));
    }
    out.resize(static_cast<std::size_t>(content->uncompressed_size));
    const char* why = zstd ? unpackZstd(content->records, out) : unpackLz4(content->records, out);
    if (why != nullptr) return damaged(why);
  }
  if (out.size() != content->uncompressed_size) return damaged("it unpacks to another size");
  if (content->uncompressed_crc != 0 && content->uncompressed_crc != mcap::crc32(out))
    return damaged("its CRC does not match");
  return out;
}

}  // namespace kiln
