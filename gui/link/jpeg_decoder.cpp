#include "gui/link/jpeg_decoder.h"

#include <QImage>
#include <algorithm>
#include <utility>

#include "common/wire/jpeg_size.h"

namespace kiln::gui {

namespace {
constexpr int kMaxSide_px = 8192;
constexpr std::size_t kMostCameras = 4;  // one that calls itself otherwise each time is no more
}  // namespace

JpegDecoder::JpegDecoder(std::function<void(RgbImagePtr)> done,
                         std::function<void(const std::string&)> failed)
    : done_(std::move(done)),
      failed_(std::move(failed)),
      thread_([this](std::stop_token stop) { run(stop); }) {}

JpegDecoder::~JpegDecoder() {
  thread_.request_stop();
  thread_.join();
}

void JpegDecoder::put(JpegImagePtr picture) {
  {
    const std::lock_guard lock(mutex_);
    const std::string camera = picture->frame;
    if (waiting_.size() >= kMostCameras && !waiting_.contains(camera))
      waiting_.erase(waiting_.begin());
    waiting_[camera] = std::move(picture);
  }
  wake_.notify_one();
}

RgbImagePtr JpegDecoder::decode(const JpegImage& picture) {
  if (picture.width <= 0 || picture.height <= 0 || picture.width > kMaxSide_px ||
      picture.height > kMaxSide_px)
    return {};
  // What the picture itself says, before memory is taken for it.
  const auto size =
      jpegSize({reinterpret_cast<const char*>(picture.jpeg.data()), picture.jpeg.size()});
  if (!size || size->width != picture.width || size->height != picture.height) return {};
  const QImage image =
      QImage::fromData(picture.jpeg.data(), static_cast<int>(picture.jpeg.size()), "JPEG")
          .convertToFormat(QImage::Format_RGB888);
  if (image.width() != picture.width || image.height() != picture.height) return {};
  auto out = std::make_shared<RgbImage>();
  out->stamp = picture.stamp;
  out->seq = picture.seq;
  out->frame = picture.frame;
  out->width = image.width();
  out->height = image.height();
  const auto row_bytes = static_cast<std::size_t>(3 * image.width());
  out->data.resize(row_bytes * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    std::copy_n(image.constScanLine(y), row_bytes,
                out->data.begin() + static_cast<std::ptrdiff_t>(row_bytes * y));
  }
  return out;
}

void JpegDecoder::reportFailure(const JpegImage& picture) {
  auto empty =
      std::make_shared<RgbImage>();  // tells the view that pictures come but cannot be read
  empty->stamp = picture.stamp;
  empty->seq = picture.seq;
  empty->frame = picture.frame;
  done_(std::move(empty));
  failed_("camera " + picture.frame + " sent a picture that is no JPEG of its size");
}

void JpegDecoder::run(std::stop_token stop) {
  while (!stop.stop_requested()) {
    std::map<std::string, JpegImagePtr> pictures;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return !waiting_.empty(); })) return;
      pictures = std::exchange(waiting_, {});
    }
    for (const auto& [camera, picture] : pictures) {
      if (auto image = decode(*picture))
        done_(std::move(image));
      else
        reportFailure(*picture);
    }
  }
}

}  // namespace kiln::gui
