#include "common/wire/compress.h"

#include <zstd.h>

#include "common/core/check.h"

namespace kiln::wire {
namespace {
constexpr int kLevel = 1;
}

std::string compress(std::string_view raw) {
  std::string out(ZSTD_compressBound(raw.size()), '\0');
  const std::size_t size = ZSTD_compress(out.data(), out.size(), raw.data(), raw.size(), kLevel);
  KILN_CHECK(ZSTD_isError(size) == 0, ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

Result<std::string> decompress(std::string_view packed, std::size_t expected_size,
                               const char* what) {
  const auto declared = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (declared == ZSTD_CONTENTSIZE_ERROR || declared == ZSTD_CONTENTSIZE_UNKNOWN) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: {} bytes are not a zstd frame of known size; dropped", what,
                     packed.size());
  }
  if (declared != expected_size) {
    return makeError(ErrorCode::InvalidInput, "{}: frame declares {} bytes, {} are due; dropped",
                     what, declared, expected_size);
  }
  std::string out(expected_size, '\0');
  const std::size_t size = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) != 0) {
    return makeError(ErrorCode::InvalidInput, "{}: {}; dropped", what, ZSTD_getErrorName(size));
  }
  if (size != expected_size) {
    return makeError(ErrorCode::Truncated, "{}: {} of {} bytes; dropped", what, size,
                     expected_size);
  }
  return out;
}

}  // namespace kiln::wire
