// A disk that is full, wherever that is met, is a sentence; the process goes on and ends as it would.
#include "measurement/written_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "case/user_error.h"
#include "measurement/companion_file.h"
#include "measurement/recording.h"
#include "measurement/recording_file.h"
#include "measurement/recording_writer.h"

namespace rheocyte::written_file_test {
namespace {

namespace fs = std::filesystem;

constexpr int code_of_sentence = 2, code_of_success = 3;

/// Files may not grow beyond this, as on a full disk; what the process says is kept in a file, too.
void limit_files(rlim_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{bytes, bytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
}

/// Ends the process as a program does, by a code for what happened.
template <class Write>
[[noreturn]] void end_after(rlim_t bytes, const Write& write) {
  limit_files(bytes);
  try {
    write();
  } catch (const UserError& error) {
    std::fputs(error.what(), stderr);
    std::exit(code_of_sentence);
  }
  std::exit(code_of_success);
}

/// Numbers, pictures that do not compress, and a log: about 2 MB.
void write_recording(const fs::path& path) {
  constexpr std::size_t events = 200;
  const ImageSize size{100, 100};
  std::minstd_rand random(1);
  std::vector<std::uint8_t> pixels(events * size.pixels());
  for (auto& pixel : pixels) pixel = std::uint8_t(random());
  std::vector<double> values(events);
  for (auto& value : values) value = double(random());
  RecordingFile file(path);
  file.add_metadata("experiment:sample", std::string("cells"));
  for (const char* feature : {"area_um", "deform", "time"}) file.append(feature, values);
  file.append_images("image", size, pixels);
  file.add_log("a log", std::vector<std::string>(100, std::string(100, 'x')));
  file.close();
}

void write_companion(const fs::path& path, const fs::path& original) {
  const Recording recording(original);
  CompanionFile file(path, recording, "a program");
  file.add_feature("userdef0");
  file.add_feature_of(recording, "area_um");
  std::vector<double> values(recording.events());
  recording.read_scalar("area_um", 0, values);
  for (const char* feature : {"userdef0", "area_um"}) file.write(feature, 0, values);
  file.add_log("a log", std::vector<std::string>(100, "a line"));
  file.close();
}

TEST(WrittenFileDeathTest, ARecordingOnAFullDiskIsRefusedWhereverTheDiskEnds) {
  const test::ScratchFolder folder;
  write_recording(folder / "whole.rtdc");
  const auto whole = fs::file_size(folder / "whole.rtdc");
  ASSERT_GT(whole, 1'500'000);
  const auto write = [&] { write_recording(folder / "a.rtdc"); };
  for (const std::uintmax_t bytes : {300UL, 800UL, 2'048UL, 4'000UL, 8'000UL, 30'000UL, whole / 2, whole - 1})
    EXPECT_EXIT(end_after(bytes, write), testing::ExitedWithCode(code_of_sentence), "cannot be written") << bytes;
  EXPECT_EXIT(end_after(whole, write), testing::ExitedWithCode(code_of_success), "");
}

TEST(WrittenFileDeathTest, SoIsACompanion) {
  const test::ScratchFolder folder;
  write_recording(folder / "a.rtdc");
  write_companion(folder / "whole.rtdc", folder / "a.rtdc");
  const auto whole = fs::file_size(folder / "whole.rtdc");
  const auto write = [&] { write_companion(folder / "b.rtdc", folder / "a.rtdc"); };
  for (const std::uintmax_t bytes : {300UL, 800UL, 2'048UL, 4'000UL, whole / 2, whole - 1})
    EXPECT_EXIT(end_after(bytes, write), testing::ExitedWithCode(code_of_sentence), "cannot be written") << bytes;
  EXPECT_EXIT(end_after(whole, write), testing::ExitedWithCode(code_of_success), "");
}

TEST(WrittenFileDeathTest, AFileThatIsGivenUpUnfinishedEndsNoProcess) {
  const test::ScratchFolder folder;
  const auto write = [&] {
    RecordingFile file(folder / "a.rtdc");
    file.append("deform", std::vector<double>(1000, 0.25));
    throw UserError("none of the cells can be recorded");
  };
  EXPECT_EXIT(end_after(500, write), testing::ExitedWithCode(code_of_sentence), "none of the cells");
}

}  // namespace
}  // namespace rheocyte::written_file_test
