// Any .rtdc file gives data or a sentence: the command that the user started neither crashes nor hangs, whatever is
// flipped, cut or claimed in its files, and data under a checksum are right or absent.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>

#include "lookup_table_file.h"
#include "measurement/hdf5_handle.h"
#include "measurement/recording_writer.h"
#include "robustness/run_program.h"

namespace rheocyte::damaged_recording_test {
namespace {

namespace fs = std::filesystem;
using test::RecordingWriter;
using test::ScratchFolder;
using test::Storage;

constexpr int events = 40;

/// Everything that a recording may hold, with checksums on all that is read for a modulus.
void write_rich_recording(const fs::path& file) {
  const Storage checked{Storage::Filter::zstd, true, 16}, packed{Storage::Filter::gzip, true, 16};
  std::vector<double> area, deformation, temperature, map;
  for (int i = 0; i < events; ++i) {
    area.push_back(60 + i);
    deformation.push_back(0.02 + 0.001 * i);
    temperature.push_back(23 + 0.01 * i);
    map.push_back(i / 2);
  }
  std::vector<std::uint8_t> mask(events * 20 * 30, 0);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = i % 30 > 8 && i % 30 < 20 && i / 30 % 20 > 5 ? 255 : 0;
  RecordingWriter writer(file);
  test::write_usual_metadata(writer);
  writer.truth("online_contour:no absdiff", true);
  writer.polygon("online_filter:area_um,deform polygon points", {0, 0, 1, 0, 1, 1});
  writer.scalar("area_um", area, H5T_IEEE_F32LE, checked);
  writer.scalar("deform", deformation, H5T_IEEE_F64LE, packed);
  writer.scalar("temp", temperature, H5T_IEEE_F32LE, checked);
  writer.scalar("basinmap0", map, H5T_STD_I64LE, checked);
  writer.scalar("time", {0, 1}, H5T_IEEE_F64LE, {}, "basin_events");
  writer.images("mask", mask, 20, 30, checked);
  for (int i = 0; i < 6; ++i) writer.contour({1, 1, 9, 1, 9, 9, 1, 9});
  writer.lines("logs/x", {"a line"});
  writer.lines("basins/x", {R"({"type": "internal", "format": "h5dataset", "name": "slow", "paths": ["basin_events"],)",
                            R"("features": ["time"], "mapping": "basinmap0"})"});
}

/// Kinds in turn: a few flipped bits, many flipped bits, a cut, a run of equal bytes, swapped blocks, flips at the
/// head.
std::string damaged(std::string bytes, int number) {
  std::mt19937 random(static_cast<unsigned>(number));
  const auto below = [&](std::size_t limit) { return random() % limit; };
  const auto flip = [&](std::size_t limit) { bytes[below(limit)] ^= static_cast<char>(1U << below(8)); };
  switch (number % 6) {
    case 0: {
      for (std::size_t k = 0, count = 1 + below(4); k < count; ++k) flip(bytes.size());
      break;
    }
    case 1: {
      for (std::size_t k = 0, count = 10 + below(300); k < count; ++k) flip(bytes.size());
      break;
    }
    case 2: bytes.resize(below(bytes.size())); break;
    case 3: {
      const std::size_t length = 1 + below(64), start = below(bytes.size() - length);
      const char value = below(2) ? '\xFF' : static_cast<char>(below(256));
      bytes.replace(start, length, length, value);
      break;
    }
    case 4: {
      const std::size_t length = 1 + below(256), a = below(bytes.size() - length), b = below(bytes.size() - length);
      bytes.replace(a, length, bytes.substr(b, length));
      break;
    }
    default: {
      for (std::size_t k = 0, count = 1 + below(6); k < count; ++k) flip(4096);
      break;
    }
  }
  return bytes;
}

/// Number of events whose area or deformation is neither missing nor that of the undamaged recording. Where the damage
/// has hidden a feature, it comes from outlines, and the table says so; these are not those of the features here.
int wrong_numbers(const fs::path& table) {
  std::istringstream text(test::content_of(table));
  bool area_is_stored = false, deformation_is_stored = false;
  int wrong = 0;
  for (std::string line; std::getline(text, line);) {
    area_is_stored = area_is_stored || line.find("# area from area_um,") != std::string::npos;
    deformation_is_stored = deformation_is_stored || line.ends_with(", deformation from deform");
    if (line.starts_with('#') || line.starts_with("event")) continue;
    std::istringstream cells(line);
    int event = 0;
    std::string area, deformation;
    cells >> event >> area >> deformation;
    const int i = event - 1;
    const bool good_area = area == "nan" || (i < events && std::stod(area) == 60 + i);
    const bool good_deformation =
        deformation == "nan" || (i < events && std::abs(std::stod(deformation) - (0.02 + 0.001 * i)) < 1e-8);
    wrong += (area_is_stored && !good_area) || (deformation_is_stored && !good_deformation);
  }
  return wrong;
}

TEST(DamagedRecording, OfAThousandEachGivesDataOrASentence) {
  const ScratchFolder folder;
  fs::create_directories(folder / "in");
  test::write_lookup_table(folder / "table.txt");
  write_rich_recording(folder / "good.rtdc");
  const std::string good = test::content_of(folder / "good.rtdc");
  constexpr int files = 1000;
  for (int i = 0; i < files; ++i)
    test::write_file(folder / ("in/" + std::to_string(10000 + i) + ".rtdc"), damaged(good, i));
  const auto ended = test::run({{RHEOCYTE, "extract", "-r", (folder / "in").string(), "-o", (folder / "out").string(),
                                 "--table", (folder / "table.txt").string(), "--patience", "5"}});
  EXPECT_EQ(ended.exit_code, 2) << ended.err.substr(0, 2000);
  EXPECT_EQ(ended.err.find("error of the program itself"), std::string::npos)
      << ended.err.substr(ended.err.find("error of the program itself"), 300);

  std::istringstream summary(test::content_of(folder / "out/rheocyte_summary.tsv"));
  std::string line;
  std::getline(summary, line);
  int lines = 0, with_data = 0, broke_down = 0, hung = 0, changed = 0;
  while (std::getline(summary, line)) {
    ++lines;
    broke_down += line.find("broke down") != std::string::npos;
    hung += line.find("nothing could be read for") != std::string::npos;
    const auto name = fs::path(line.substr(0, line.find('\t'))).stem().string();
    const auto table = folder / ("out/" + name + "_rheocyte.tsv");
    const bool has_data = fs::exists(table);
    with_data += has_data;
    EXPECT_TRUE(has_data || line.back() != '\t') << "neither data nor a sentence: " << line;
    if (has_data) changed += wrong_numbers(table) > 0;
  }
  EXPECT_EQ(lines, files);
  std::printf(
      "%d with data (%d of them with changed numbers), %d refused, HDF5 broke down in %d and hung in %d; %.1f s\n",
      with_data, changed, lines - with_data, broke_down, hung, ended.seconds);
  // A flip may hit the mask that says which checksums a piece of data has, or the place of a whole piece; HDF5 1.10
  // has no checksums there.
  EXPECT_LE(changed, files / 100);
  EXPECT_LE(hung, 3);
}

TEST(DamagedRecording, BombsAreRefusedBeforeTheyGoOff) {
  const ScratchFolder folder;
  test::write_lookup_table(folder / "table.txt");
  {
    RecordingWriter writer(folder / "a.rtdc");
    test::write_usual_metadata(writer);
    const auto empty = [&](const char* name, std::vector<hsize_t> extent, std::vector<hsize_t> chunk) {
      const int rank = static_cast<int>(extent.size());
      const Hdf5Handle space(::H5Screate_simple(rank, extent.data(), nullptr)), shape(::H5Pcreate(H5P_DATASET_CREATE));
      ::H5Pset_chunk(shape.get(), rank, chunk.data());
      const Hdf5Handle made(
          ::H5Dcreate2(writer.root(), name, H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, shape.get(), H5P_DEFAULT));
      ASSERT_TRUE(made);
    };
    empty("events/area_um", {1ULL << 40U}, {1U << 28U});
    empty("events/deform", {1ULL << 60U}, {10});
    empty("events/mask", {10, 1ULL << 31U, 1ULL << 31U}, {1, 1U << 14U, 1U << 14U});
  }
  const auto ended =
      test::run({{RHEOCYTE, "extract", (folder / "a.rtdc").string(), "--table", (folder / "table.txt").string()}});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_NE(ended.err.find("contains no events"), std::string::npos) << ended.err;
  EXPECT_LT(ended.seconds, 5);
}

}  // namespace
}  // namespace rheocyte::damaged_recording_test
