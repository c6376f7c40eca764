#include "common/wire/proto_message.h"

#include <vector>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

namespace kiln::wire {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

void cleanField(Message& message, const FieldDescriptor& field) {
  const auto& access = *message.GetReflection();
  const int n = field.is_repeated() ? access.FieldSize(message, &field) : 1;
  for (int i = 0; i < n; ++i) {
    if (field.type() == FieldDescriptor::TYPE_MESSAGE) {
      cleanText(field.is_repeated() ? *access.MutableRepeatedMessage(&message, &field, i)
                                    : *access.MutableMessage(&message, &field));
    } else if (field.is_repeated()) {
      access.SetRepeatedString(&message, &field, i,
                               printable(access.GetRepeatedString(message, &field, i)));
    } else {
      access.SetString(&message, &field, printable(access.GetString(message, &field)));
    }
  }
}

}  // namespace

void cleanText(Message& message) {
  std::vector<const FieldDescriptor*> present;
  message.GetReflection()->ListFields(message, &present);
  for (const FieldDescriptor* field : present) {
    if (field->type() == FieldDescriptor::TYPE_MESSAGE ||
        field->type() == FieldDescriptor::TYPE_STRING) {
      cleanField(message, *field);
    }
  }
}

}  // namespace kiln::wire
