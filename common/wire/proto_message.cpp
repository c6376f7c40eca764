#include "common/wire/proto_message.h"

#include <vector>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

namespace kiln::wire {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

Result<void> cleanField(Message& message, const FieldDescriptor& field, const char* what) {
  const auto& access = *message.GetReflection();
  const int n = field.is_repeated() ? access.FieldSize(message, &field) : 1;
  if (n > kLongestList) {
    return makeError(ErrorCode::InvalidInput, "{}: {} rows of {} are more than {}; dropped", what,
                     n, field.name(), kLongestList);
  }
  for (int i = 0; i < n; ++i) {
    if (field.type() == FieldDescriptor::TYPE_MESSAGE) {
      auto ok = cleanText(field.is_repeated() ? *access.MutableRepeatedMessage(&message, &field, i)
                                              : *access.MutableMessage(&message, &field),
                          what);
      if (!ok) return ok;
    } else if (field.is_repeated()) {
      access.SetRepeatedString(&message, &field, i,
                               printable(access.GetRepeatedString(message, &field, i)));
    } else {
      access.SetString(&message, &field, printable(access.GetString(message, &field)));
    }
  }
  return {};
}

}  // namespace

Result<void> cleanText(Message& message, const char* what) {
  std::vector<const FieldDescriptor*> present;
  message.GetReflection()->ListFields(message, &present);
  for (const FieldDescriptor* field : present) {
    if (field->type() != FieldDescriptor::TYPE_MESSAGE &&
        field->type() != FieldDescriptor::TYPE_STRING)
      continue;
    if (auto ok = cleanField(message, *field, what); !ok) return ok;
  }
  return {};
}

}  // namespace kiln::wire
