#include "robot/drivers/lepton/device/lepton_file_camera.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "common/core/manual_executor.h"
#include "robot/drivers/lepton/codec/picture_size.h"
#include "robot/drivers/lepton/link/still_file.h"

namespace kiln {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class LeptonFileCameraTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("kiln_stills_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void addPng(const std::string& name, std::uint16_t value) const {
    cv::imwrite((folder_ / name).string(), cv::Mat(120, 160, CV_16UC1, cv::Scalar(value)));
  }
  fs::path folder_;
  ManualClock clock_;
  ManualExecutor executor_{clock_};
};

TEST_F(LeptonFileCameraTest, ShowsEachStillForAWhileAtTheCamerasRate) {
  addPng("a.png", 1);
  addPng("b.png", 2);
  auto camera =
      LeptonFileCamera::open(folder_.string(), executor_, {.rate_hz = 8.77, .frames_per_still = 3});
  ASSERT_TRUE(camera.has_value()) << camera.error();
  std::vector<ThermalImagePtr> shown;
  ASSERT_TRUE((*camera)->start([&](ThermalImagePtr image) { shown.push_back(std::move(image)); }));
  executor_.runUntil(Stamp{std::chrono::seconds(1)});
  ASSERT_EQ(shown.size(), 8u);  // floor(8.77)
  std::vector<int> values;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    values.push_back(shown[i]->counts[0]);
    EXPECT_EQ(shown[i]->frame_counter, i);  // a still shown again is not a frozen camera
    EXPECT_NEAR(toSeconds(shown[i]->stamp), static_cast<double>(i + 1) / 8.77, 1e-6);
  }
  EXPECT_EQ(values, (std::vector<int>{1, 1, 1, 2, 2, 2, 1, 1}));
}

TEST_F(LeptonFileCameraTest, RefusesAFolderWithoutStillsOrWithABrokenOne) {
  EXPECT_THAT(LeptonFileCamera::open("/nonexistent", executor_).error().message,
              HasSubstr("no such folder"));
  EXPECT_THAT(LeptonFileCamera::open(folder_.string(), executor_).error().message,
              HasSubstr("holds no still"));
  addPng("a.png", 1);
  std::ofstream(folder_ / "b.tjsn") << "{\"radiometric\":";
  EXPECT_THAT(LeptonFileCamera::open(folder_.string(), executor_).error().message,
              ::testing::AllOf(HasSubstr("b.tjsn"), HasSubstr("not valid JSON")));
}

TEST_F(LeptonFileCameraTest, APictureThatClaimsToBeHugeIsRefusedByItsHeader) {
  for (const char* name : {"huge.png", "huge.tiff"}) {
    const std::string path = (folder_ / name).string();
    cv::imwrite(path, cv::Mat(120, 160, CV_16UC1, cv::Scalar(30000)));
    std::ifstream in(path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    const auto size = lepton::pictureSize(bytes);
    ASSERT_TRUE(size.has_value()) << name;
    EXPECT_EQ(size->width, 160u);
    EXPECT_EQ(size->height, 120u);
    // 30,000 lines instead of 120, where the format keeps them.
    const bool png = std::string_view(name).ends_with("png");
    const std::string lines = png ? std::string("\0\0\0\x78", 4) : std::string("\x78\0", 2);
    const std::string entry = std::string("\x01\x01\x03\0\x01\0\0\0", 8) + lines;
    const std::size_t at = png ? 20 : bytes.find(entry) + 8;
    ASSERT_LT(at, bytes.size()) << name;
    bytes.replace(at, lines.size(), png ? std::string("\0\0\x75\x30", 4) : "\x30\x75");
    std::ofstream(path, std::ios::binary) << bytes;
    const auto still = lepton::readStill(path);
    ASSERT_FALSE(still.has_value()) << name;
    EXPECT_NE(still.error().message.find("160 x 30000"), std::string::npos) << still.error();
    for (std::size_t cut = 0; cut < std::min<std::size_t>(bytes.size(), 300); ++cut)
      (void)lepton::pictureSize(std::string_view(bytes).substr(0, cut));
  }
}

TEST_F(LeptonFileCameraTest, PassesHiddenFilesOver) {
  addPng("a.png", 1);
  std::ofstream(folder_ / "._a.png") << "Mac OS X        ";
  const auto camera = LeptonFileCamera::open(folder_.string(), executor_);
  ASSERT_TRUE(camera.has_value()) << camera.error();
  EXPECT_THAT((*camera)->stills(), ::testing::ElementsAre((folder_ / "a.png").string()));
}

TEST_F(LeptonFileCameraTest, EachRefusalNamesTheFileAndOneThingToDo) {
  const std::string path = (folder_ / "frame.png").string();
  cv::imwrite(path, cv::Mat(122, 160, CV_16UC1, cv::Scalar(0)));
  EXPECT_THAT(LeptonFileCamera::open(folder_.string(), executor_).error().message,
              ::testing::AllOf(HasSubstr(path + ": "), HasSubstr("160 x 122"),
                               HasSubstr("record with telemetry as footer")));
  std::ofstream(path, std::ios::trunc) << "no picture";
  EXPECT_THAT(LeptonFileCamera::open(folder_.string(), executor_).error().message,
              ::testing::AllOf(HasSubstr(path + ": "), HasSubstr("take it out of the folder")));
}

TEST_F(LeptonFileCameraTest, CountsThePagesOfATiff) {
  const std::string path = (folder_ / "three.tiff").string();
  const std::vector<cv::Mat> pages{cv::Mat(120, 160, CV_16UC1, cv::Scalar(1)),
                                   cv::Mat(120, 160, CV_16UC1, cv::Scalar(2)),
                                   cv::Mat(120, 160, CV_16UC1, cv::Scalar(3))};
  cv::imwrite(path, pages);
  const auto frame = lepton::readStill(path);
  ASSERT_TRUE(frame.has_value()) << frame.error();
  EXPECT_EQ(frame->pages, 3u);
  EXPECT_EQ(frame->counts[0], 1);

  // A chain of pages that leads back into itself.
  using namespace std::string_view_literals;
  EXPECT_EQ(lepton::pictureCount("II*\0\x08\0\0\0\0\0\x08\0\0\0"sv), 1000u);
  EXPECT_EQ(lepton::pictureCount("II*\0\xff\xff\xff\xff"sv), 1u);
}

TEST_F(LeptonFileCameraTest, RefusesEightBitPictures) {
  cv::imwrite((folder_ / "photo.png").string(), cv::Mat(120, 160, CV_8UC1, cv::Scalar(7)));
  EXPECT_THAT(LeptonFileCamera::open(folder_.string(), executor_).error().message,
              HasSubstr("16-bit greyscale"));
}

}  // namespace
}  // namespace kiln
