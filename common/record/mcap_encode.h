#pragma once

#include "common/record/mcap_format.h"

/// Appends one whole record (opcode, length, content) to `out`.
namespace kiln::mcap {

void append(std::string& out, const Header& record);
/// The footer with its CRC, computed over `summary` (all bytes from summary_start on) and itself.
void appendFooter(std::string& out, Footer record, std::string_view summary);
void append(std::string& out, const Schema& record);
void append(std::string& out, const Channel& record);
void append(std::string& out, const Message& record);
void append(std::string& out, const Chunk& record);
void append(std::string& out, const MessageIndex& record);
void append(std::string& out, const ChunkIndex& record);
void append(std::string& out, const Attachment& record);
void append(std::string& out, const AttachmentIndex& record);
void append(std::string& out, const Statistics& record);
void append(std::string& out, const SummaryOffset& record);
void appendDataEnd(std::string& out, std::uint32_t data_section_crc);

}  // namespace kiln::mcap
