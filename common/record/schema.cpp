#include "common/record/schema.h"

#include <set>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include "foxglove/CompressedImage.pb.h"
#include "foxglove/FrameTransforms.pb.h"
#include "foxglove/Log.pb.h"
#include "foxglove/PointCloud.pb.h"
#include "foxglove/PoseInFrame.pb.h"
#include "foxglove/RawImage.pb.h"
#include "kiln/fire/v1/fire.pb.h"
#include "kiln/v1/command.pb.h"
#include "kiln/v1/fsm.pb.h"
#include "kiln/v1/localization.pb.h"
#include "kiln/v1/mission.pb.h"
#include "kiln/v1/recording.pb.h"
#include "kiln/v1/sensor.pb.h"
#include "kiln/v1/telemetry.pb.h"
#include "kiln/v1/world.pb.h"

namespace kiln {
namespace {

namespace pb = google::protobuf;

/// Depth first, so that a file stands behind what it imports.
void addFile(const pb::FileDescriptor& file, std::set<std::string>& seen,
             pb::FileDescriptorSet& out) {
  if (!seen.insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) addFile(*file.dependency(i), seen, out);
  file.CopyTo(out.add_file());
}

/// One message of each file: naming it makes the linker keep the file's descriptors.
void linkDescriptors() {
  for (const pb::Descriptor* descriptor :
       {::foxglove::CompressedImage::descriptor(), ::foxglove::FrameTransforms::descriptor(),
        ::foxglove::Log::descriptor(), ::foxglove::PointCloud::descriptor(),
        ::foxglove::PoseInFrame::descriptor(), ::foxglove::RawImage::descriptor(),
        v1::Command::descriptor(), v1::FsmInfo::descriptor(), v1::DeviceSample::descriptor(),
        v1::Cloud::descriptor(), v1::MapLayer::descriptor(), v1::RobotStatus::descriptor(),
        v1::Scene::descriptor(), v1::MissionInfo::descriptor(),
        ::kiln::fire::v1::FireSite::descriptor()}) {
    (void)descriptor->full_name();
  }
}

}  // namespace

Result<RecordSchema> protobufSchema(std::string_view message) {
  linkDescriptors();
  const auto* descriptor =
      pb::DescriptorPool::generated_pool()->FindMessageTypeByName(std::string(message));
  if (descriptor == nullptr)
    return makeError(ErrorCode::NotFound, "there is no message '{}' in proto/", message);
  std::set<std::string> seen;
  pb::FileDescriptorSet files;
  addFile(*descriptor->file(), seen, files);
  return RecordSchema{std::string(message), "protobuf", files.SerializeAsString()};
}

}  // namespace kiln
