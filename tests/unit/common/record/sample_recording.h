#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/record/record_reader.h"
#include "common/record/record_writer.h"

namespace kiln::test {

/// A folder that is removed at the end.
class RecordFolder {
 public:
  RecordFolder();
  ~RecordFolder();
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

[[nodiscard]] inline Stamp at(double seconds) { return Stamp{} + fromSeconds(seconds); }

/// Two topics, "/fast" at 100 Hz and "/slow" at 1 Hz, from `start_s` for `seconds`, in chunks of
/// one second; payloads say topic and number: "/fast 17". Attaches "notes.txt" with "kiln".
void writeSample(const std::string& path, double seconds, double start_s = 10.0, bool close = true);

/// Topic and payload of everything a cursor still yields; damaged chunks are counted.
struct Collected {
  std::vector<std::string> payloads;
  std::vector<Stamp> times;
  int damaged = 0;
};
[[nodiscard]] Collected collect(RecordCursor cursor);

[[nodiscard]] std::string readAll(const std::string& path);
void writeAll(const std::string& path, std::string_view bytes);

}  // namespace kiln::test
