#include "common/core/error.h"

#include <ostream>

namespace kiln {

std::string_view toString(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidInput:
      return "invalid input";
    case ErrorCode::NotFound:
      return "not found";
    case ErrorCode::Unavailable:
      return "unavailable";
    case ErrorCode::Refused:
      return "refused";
    case ErrorCode::Degenerate:
      return "degenerate";
    case ErrorCode::Timeout:
      return "timeout";
    case ErrorCode::Truncated:
      return "truncated";
    case ErrorCode::VersionMismatch:
      return "version mismatch";
    case ErrorCode::Storage:
      return "storage";
    case ErrorCode::Fault:
      return "fault";
  }
  return "unknown";
}

std::ostream& operator<<(std::ostream& out, const Error& error) {
  return out << toString(error.code) << ": " << error.message;
}

}  // namespace kiln
