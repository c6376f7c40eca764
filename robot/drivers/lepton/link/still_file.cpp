#include "robot/drivers/lepton/link/still_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <opencv2/imgcodecs.hpp>

#include "common/core/regular_file.h"
#include "robot/drivers/lepton/codec/picture_size.h"
#include "robot/drivers/lepton/codec/tjsn.h"

namespace kiln::lepton {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t kLargestFile = 64u << 20;
constexpr std::uint32_t kLongestSide_px = 4096;

std::string extensionOf(const fs::path& path) {
  std::string out = path.extension().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool isPicture(const fs::path& path) {
  const std::string e = extensionOf(path);
  return e == ".png" || e == ".tif" || e == ".tiff";
}

Result<LeptonFrame> readPicture(const std::string& bytes) {
  const auto size = pictureSize(bytes);  // before memory is taken for it
  if (!size) return makeError(ErrorCode::InvalidInput, "is not a readable picture (cut off?)");
  if (size->width > kLongestSide_px || size->height > kLongestSide_px)
    return makeError(ErrorCode::InvalidInput, "says {} x {} pixels; no thermal camera has them",
                     size->width, size->height);
  cv::Mat picture;
  try {
    picture = cv::imdecode(
        cv::Mat(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data())),
        cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& e) {
    return makeError(ErrorCode::InvalidInput, "cannot be decoded ({})", e.err);
  }
  if (picture.empty())
    return makeError(ErrorCode::InvalidInput, "is not a readable picture (cut off?)");
  if (picture.type() != CV_16UC1) {
    return makeError(ErrorCode::InvalidInput,
                     "is not 16-bit greyscale; export the camera's Y16 words");
  }
  std::vector<std::uint16_t> words(picture.begin<std::uint16_t>(), picture.end<std::uint16_t>());
  auto frame = splitFrame(picture.cols, picture.rows, std::move(words));
  if (frame) frame->pages = pictureCount(bytes);
  if (frame || frame.error().code != ErrorCode::VersionMismatch) return frame;
  return makeError(ErrorCode::VersionMismatch,
                   "the last two lines of its {} x {} pixels are no telemetry; record with "
                   "telemetry as footer, cut them off, or take it out of the folder",
                   picture.cols, picture.rows);
}

}  // namespace

Result<LeptonFrame> readStill(const std::string& path) {
  const auto bytes = readRegularFile(path, kLargestFile);
  if (!bytes) return tl::make_unexpected(bytes.error());
  auto frame = isPicture(path) ? readPicture(*bytes) : parseTjsn(*bytes);
  if (frame) return frame;
  const std::string& message = frame.error().message;
  const bool advised = message.find(';') != std::string::npos;
  return tl::make_unexpected(
      Error{frame.error().code,
            fmt::format("{}: {}{}", path, message, advised ? "" : "; take it out of the folder")});
}

Result<std::vector<std::string>> listStills(const std::string& folder) {
  std::error_code ec;
  if (!fs::is_directory(folder, ec)) {
    return makeError(ErrorCode::NotFound,
                     "{}: no such folder; give one with .tjsn, 16-bit .png or .tif stills", folder);
  }
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder, ec)) {
    const fs::path& path = entry.path();
    if (path.filename().string().starts_with('.')) continue;  // "._a.png" of other systems
    const bool tjsn = extensionOf(path) == ".tjsn";
    if (!tjsn && !isPicture(path)) continue;
    if (!tjsn && fs::exists(fs::path(path).replace_extension(".tjsn"), ec)) continue;
    out.push_back(path.string());
  }
  if (ec) return makeError(ErrorCode::NotFound, "{}: cannot be listed ({})", folder, ec.message());
  if (out.empty()) {
    return makeError(ErrorCode::NotFound,
                     "{}: holds no still; needs .tjsn, 16-bit .png or .tif files", folder);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace kiln::lepton
