#include "robot/drivers/velodyne/link/packet_file.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "robot/drivers/velodyne/codec/vlp16_packet.h"
#include "robot/drivers/velodyne/link/pcap_file.h"
#include "robot/drivers/velodyne/link/raw_packet_file.h"

namespace kiln::velodyne {
namespace {

using Magic = std::array<unsigned char, 4>;

bool isPcap(const Magic& m) {
  const std::uint32_t big = static_cast<std::uint32_t>(m[0]) << 24 | m[1] << 16 | m[2] << 8 | m[3];
  switch (big) {
    case 0xA1B2C3D4:  // microseconds, big endian
    case 0xD4C3B2A1:
    case 0xA1B23C4D:  // nanoseconds
    case 0x4D3CB2A1:
    case 0x0A0D0D0A:  // pcapng
      return true;
    default:
      return false;
  }
}

struct Packer {
  std::string_view magic, name, unpack;
};
constexpr std::array<Packer, 6> kPackers{{{"\x1F\x8B", "gzip", "gunzip"},
                                          {"\x28\xB5\x2F\xFD", "zstd", "unzstd"},
                                          {"\xFD\x37zX", "xz", "unxz"},
                                          {"BZh", "bzip2", "bunzip2"},
                                          {"\x04\x22\x4D\x18", "lz4", "unlz4"},
                                          {"PK\x03\x04", "zip", "unzip"}}};

const Packer* packerOf(const Magic& magic) {
  const std::string_view begin(reinterpret_cast<const char*>(magic.data()), magic.size());
  for (const Packer& packer : kPackers) {
    if (begin.starts_with(packer.magic)) return &packer;
  }
  return nullptr;
}

/// Raw packets, the first of which may be damaged.
bool isRaw(std::ifstream& in, const Magic& magic) {
  if (magic[0] == 0xFF && magic[1] == 0xEE) return true;
  std::array<unsigned char, 2> second{};
  in.clear();
  in.seekg(kDataPacketBytes);
  in.read(reinterpret_cast<char*>(second.data()), 2);
  return in.gcount() == 2 && second[0] == 0xFF && second[1] == 0xEE;
}

}  // namespace

Result<std::unique_ptr<PacketFile>> openPacketFile(const std::string& path) {
  std::error_code ec;
  if (!std::filesystem::exists(path, ec)) {
    return makeError(ErrorCode::NotFound,
                     "{}: no such file; give a pcap capture or a file of 1206-byte packets", path);
  }
  if (!std::filesystem::is_regular_file(path, ec)) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: not a file; give a pcap capture or a file of 1206-byte packets", path);
  }
  std::ifstream in(path, std::ios::binary);
  if (!in)
    return makeError(ErrorCode::NotFound, "{}: cannot be opened; check its permissions", path);
  Magic magic{};
  in.read(reinterpret_cast<char*>(magic.data()), 4);
  if (in.gcount() < 4) {
    return makeError(ErrorCode::Truncated,
                     "{}: has only {} bytes; give a pcap capture or a file of 1206-byte packets",
                     path, in.gcount());
  }
  if (isPcap(magic)) return openPcapFile(path);
  if (const Packer* packer = packerOf(magic)) {
    return makeError(ErrorCode::InvalidInput,
                     "{}: packed with {}; unzip it first ({} FILE) and give what comes out", path,
                     packer->name, packer->unpack);
  }
  if (isRaw(in, magic)) return openRawPacketFile(path);
  return makeError(ErrorCode::InvalidInput,
                   "{}: neither a pcap capture nor a file of 1206-byte LiDAR packets (it starts "
                   "with {:02X} {:02X} {:02X} "
                   "{:02X})",
                   path, magic[0], magic[1], magic[2], magic[3]);
}

}  // namespace kiln::velodyne
