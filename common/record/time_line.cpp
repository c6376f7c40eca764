#include "common/record/time_line.h"

#include <algorithm>
#include <limits>

#include "common/record/mcap_decode.h"

namespace kiln {
namespace {

constexpr std::uint64_t kFar_ns = 60'000'000'000;
constexpr std::uint64_t kLatestTime = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t kMaxGroups = 1000;  // of one chunk; more are no outliers

/// Messages that follow each other within 60 s.
struct Group {
  std::uint64_t start = 0, end = 0, messages = 0;
};

/// @param groups  sorted by start.
std::vector<Group> merged(const std::vector<Group>& groups) {
  std::vector<Group> out;
  for (const Group& group : groups) {
    if (out.empty() ||
        group.start > out.back().end + std::min(kFar_ns, kLatestTime - out.back().end)) {
      out.push_back(group);
    } else {
      out.back().end = std::max(out.back().end, group.end);
      out.back().messages += group.messages;
    }
  }
  return out;
}

std::vector<Group> groupsOf(const RandomFile& file, const ChunkEntry& chunk) {
  const std::vector<Group> whole{{chunk.start_time, chunk.end_time, chunk.messages}};
  const bool narrow = chunk.end_time - chunk.start_time <= kFar_ns;
  if (narrow && chunk.messages > 0) return whole;
  const auto records = readChunk(file, chunk);
  if (!records) return {};
  std::vector<Group> single;
  mcap::ByteReader in(*records);
  while (const auto record = mcap::nextRecord(in)) {
    if (record->opcode != mcap::Opcode::Message) continue;
    const auto m = mcap::decodeMessage(record->content);
    if (m && m->log_time <= kLatestTime) single.push_back({m->log_time, m->log_time, 1});
  }
  std::sort(single.begin(), single.end(),
            [](const Group& a, const Group& b) { return a.start < b.start; });
  auto groups = merged(single);
  if (groups.size() <= kMaxGroups) return groups;
  return {{groups.front().start, groups.back().end, single.size()}};
}

/// Takes groups away from the ends while they are few. @return messages taken.
std::uint64_t dropOutliers(std::vector<Group>& groups) {
  std::uint64_t all = 0, dropped = 0;
  for (const Group& group : groups) all += group.messages;
  const std::uint64_t allowed = all < 10 ? 0 : std::max<std::uint64_t>(1, all / 100);
  auto first = groups.begin(), last = groups.end();
  while (last - first > 1) {
    const bool front = first->messages <= (last - 1)->messages;
    const std::uint64_t messages = front ? first->messages : (last - 1)->messages;
    if (dropped + messages > allowed) break;
    dropped += messages;
    front ? ++first : --last;
  }
  groups = std::vector<Group>(first, last);
  return dropped;
}

}  // namespace

void findTimeLine(const RandomFile& file, RecordIndex& index) {
  std::vector<Group> spans;
  bool wide = false;
  for (const ChunkEntry& chunk : index.chunks) {
    spans.push_back({chunk.start_time, chunk.end_time, chunk.messages});
    wide = wide || chunk.end_time - chunk.start_time > kFar_ns;
  }
  std::vector<Group> runs = merged(spans);  // chunks are sorted by start
  if (wide || runs.size() > 1) {
    spans.clear();
    std::vector<std::vector<Group>> of_chunk;
    for (const ChunkEntry& chunk : index.chunks) {
      of_chunk.push_back(groupsOf(file, chunk));
      spans.insert(spans.end(), of_chunk.back().begin(), of_chunk.back().end());
    }
    std::stable_sort(spans.begin(), spans.end(),
                     [](const Group& a, const Group& b) { return a.start < b.start; });
    runs = merged(spans);
    index.outliers = dropOutliers(runs);
    for (std::size_t i = 0; i < of_chunk.size() && !runs.empty(); ++i) {
      ChunkEntry& chunk = index.chunks[i];
      chunk.start_time = std::clamp(chunk.start_time, runs.front().start, runs.back().end);
      chunk.end_time = std::clamp(chunk.end_time, runs.front().start, runs.back().end);
      std::erase_if(of_chunk[i], [&](const Group& g) {
        return g.end < runs.front().start || g.start > runs.back().end;
      });
      if (of_chunk[i].empty()) continue;
      chunk.start_time = of_chunk[i].front().start;
      chunk.end_time = of_chunk[i].back().end;
    }
  }
  if (runs.empty()) return;
  index.start_time = runs.front().start;
  index.end_time = runs.back().end;
}

}  // namespace kiln
