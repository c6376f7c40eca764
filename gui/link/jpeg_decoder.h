#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "common/model/sensor.h"

namespace kiln::gui {

/// Decodes camera pictures on a thread of its own, newest first per camera; a picture that arrives
/// while another of its camera waits replaces it. put() is thread-safe; `done` and `failed` run on
/// the decoder's thread. A picture that cannot be decoded is handed on without pixels and reported
/// to `failed`.
class JpegDecoder {
 public:
  JpegDecoder(std::function<void(RgbImagePtr)> done,
              std::function<void(const std::string&)> failed);
  ~JpegDecoder();
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
  void put(JpegImagePtr picture);
  /// @return null if the bytes are no JPEG or its size is not what the message said.
  [[nodiscard]] static RgbImagePtr decode(const JpegImage& picture);

 private:
  void run(std::stop_token stop);
  void reportFailure(const JpegImage& picture);
  std::function<void(RgbImagePtr)> done_;
  std::function<void(const std::string&)> failed_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::map<std::string, JpegImagePtr> waiting_;  ///< by camera
  std::jthread thread_;
};

}  // namespace kiln::gui
