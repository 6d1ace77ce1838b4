// Pictures that are stored as parts around the cells are those that were recorded.
#include <filesystem>
#include <string>
#include <vector>

#include "case/user_error.h"
#include "measurement/recording.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"

namespace rheocyte::cropped_images_test {
namespace {

using test::RecordingWriter;
using test::ScratchFolder;
using Pixels = std::vector<std::uint8_t>;

constexpr const char* definition =
    R"({"type": "internal", "format": "h5datasetchop", "name": "chopped-image", "paths": ["basin_events"],)"
    R"("features": ["image"], "mapping": "same"})";

// Three events in pictures of 2 x 4 pixels; the last two lie in one frame, their parts in two datasets.
void write_cropped(const std::filesystem::path& file, const std::vector<int>& table,
                   const std::string& background = "image_bg") {
  RecordingWriter writer(file);
  writer.scalar("deform", {0.1, 0.2, 0.3});
  writer.integer("imaging:roi size x", 4);
  writer.integer("imaging:roi size y", 2);
  writer.images("image_bg", Pixels(24, 100), 2, 4);
  writer.images("0", {5, 250, 0, 7, 1, 2, 3, 4}, 2, 2, {}, "basin_events/image");
  writer.images("1", {50}, 1, 1, {}, "basin_events/image");
  writer.index_of_cropped("image", table, background);
  writer.lines("basins/x", {definition});
}

const std::vector<int> good_table{0, 0, 0, 0, 0, 0, 1, 0, 3, 2, 1, 0, 1, 0, 1};

Pixels pictures(const Recording& recording, const std::string& feature, std::size_t events) {
  const auto size = recording.image_size(feature).value_or(ImageSize{});
  Pixels pixels(events * size.pixels());
  recording.read_images(feature, 0, events, pixels);
  return pixels;
}

TEST(CroppedImages, PartsLieOnTheBackgroundWithThoseOfTheirFrame) {
  const ScratchFolder folder;
  write_cropped(folder / "a.rtdc", good_table);
  const Recording recording(folder / "a.rtdc");
  EXPECT_TRUE(recording.remarks().empty());
  EXPECT_EQ(recording.image_size("image"), (ImageSize{4, 2}));
  // 250 is -6 modulo 256; the second event's part is cut off at the right end; 0 is the background.
  EXPECT_EQ(pictures(recording, "image", 3), (Pixels{105, 94,  100, 100, 100, 107, 100, 100,  //
                                                     100, 100, 100, 101, 150, 100, 100, 103,  //
                                                     100, 100, 100, 101, 150, 100, 100, 103}));
  EXPECT_FALSE(recording.has_scalar("image"));
}

TEST(CroppedImages, WithoutABackgroundTheyLieOnZero) {
  const ScratchFolder folder;
  write_cropped(folder / "a.rtdc", good_table, "");
  EXPECT_EQ(pictures(Recording(folder / "a.rtdc"), "image", 1), (Pixels{5, 250, 0, 0, 0, 7, 0, 0}));
}

TEST(CroppedImages, AMissingBackgroundIsARemark) {
  const ScratchFolder folder;
  for (const std::string background : {"image_bg2", "image"}) {
    write_cropped(folder / "a.rtdc", good_table, background);
    const Recording recording(folder / "a.rtdc");
    EXPECT_FALSE(recording.image_size("image"));
    ASSERT_EQ(recording.remarks().size(), 1U);
    EXPECT_EQ(recording.remarks()[0], "the basin \"chopped-image\" is not used: its background " + background +
                                          " is missing or of another size.");
  }
}

TEST(CroppedImages, ADamagedTableIsRefusedAndNeverRunsInCircles) {
  const ScratchFolder folder;
  const std::vector<std::vector<int>> damaged{
      {9, 0, 0, 0, 0, 0, 1, 0, 3, 2, 1, 0, 1, 0, 1},   // no such part
      {0, 7, 0, 0, 0, 0, 1, 0, 3, 2, 1, 0, 1, 0, 1},   // no such row
      {0, 0, 2, 0, 0, 0, 1, 0, 3, 2, 1, 0, 1, 0, 1},   // below the picture
      {0, 0, 0, -1, 0, 0, 1, 0, 3, 2, 1, 0, 1, 0, 1},  // beside it
      {0, 0, 0, 0, 1, 0, 1, 0, 3, 2, 1, 0, 1, 0, 1},   // a frame whose circle does not come back
      {0, 0, 0, 0, -5, 0, 1, 0, 3, 2, 1, 0, 1, 0, 1},  // leads to no event
  };
  for (const auto& table : damaged) {
    write_cropped(folder / "a.rtdc", table);
    EXPECT_THROW(pictures(Recording(folder / "a.rtdc"), "image", 1), UserError);
  }
}

// Made by dclab 0.73.4 from whole.rtdc.
TEST(CroppedImages, ThoseOfDclabAreTheRecordedOnesPixelByPixel) {
  RHEOCYTE_NEED_REFERENCE("../cases/cropped-images/cropped.rtdc");
  const auto folder = test::reference_folder() / "../cases/cropped-images";
  const Recording cropped(folder / "cropped.rtdc"), whole(folder / "whole.rtdc");
  EXPECT_TRUE(cropped.remarks().empty());
  for (const std::string feature : {"image", "image_bg", "mask"})
    EXPECT_EQ(pictures(cropped, feature, cropped.events()), pictures(whole, feature, whole.events())) << feature;
}

}  // namespace
}  // namespace rheocyte::cropped_images_test
