#include "tests/unit/common/record/sample_recording.h"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "common/core/check.h"

namespace kiln::test {

RecordFolder::RecordFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "kiln-record-XXXXXX").string();
  KILN_CHECK(::mkdtemp(name.data()) != nullptr, name);
  path_ = name;
}
RecordFolder::~RecordFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void writeSample(const std::string& path, double seconds, double start_s, bool close) {
  auto writer = RecordWriter::create(path);
  KILN_CHECK(writer.has_value());
  KILN_CHECK((*writer)->attach("notes.txt", "text/plain", "kiln", at(start_s)).has_value());
  const auto fast = (*writer)->addChannel("/fast", {"test.Fast", "protobuf", "fast schema"});
  const auto slow = (*writer)->addChannel("/slow", {"test.Slow", "protobuf", "slow schema"});
  KILN_CHECK(fast && slow);
  const int count = static_cast<int>(seconds * 100.0);
  for (int i = 0; i < count; ++i) {
    const Stamp t = at(start_s + 0.01 * i);
    KILN_CHECK((*writer)->write(*fast, t, t, fmt::format("/fast {}", i)).has_value());
    if (i % 100 == 0)
      KILN_CHECK((*writer)->write(*slow, t, t, fmt::format("/slow {}", i / 100)).has_value());
  }
  KILN_CHECK((close ? (*writer)->close() : (*writer)->flush()).has_value());
}

Collected collect(RecordCursor cursor) {
  Collected out;
  for (;;) {
    const auto message = cursor.next();
    if (!message) {
      ++out.damaged;
      continue;
    }
    if (!*message) return out;
    out.payloads.emplace_back((*message)->data);
    out.times.push_back((*message)->logged);
  }
}

std::string readAll(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void writeAll(const std::string& path, std::string_view bytes) {
  std::filesystem::remove(path);  // writing over a file makes some file systems flush it
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace kiln::test
