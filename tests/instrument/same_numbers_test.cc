// Cells that come one by one have the numbers that `rheocyte extract` gives them, to the last bit.
#include <algorithm>
#include <bit>
#include <filesystem>
#include <optional>

#include "case/user_error.h"
#include "extract/extraction.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"
#include "opened.h"
#include "shelf/virtual_cells.h"
#include "store/scratch.h"
#include "synth/virtual_recording.h"

namespace rheocyte::same_numbers_test {
namespace {

namespace fs = std::filesystem;
using test::Opened;

/// A power of two: the mean of the viscosities of all events, by which extract scales the tension, is then exact.
constexpr double viscosity_mPas = 8;

/// What stands in a file that has nothing but masks.
struct Masks {
  ImageSize size;
  std::size_t count = 0;
  std::vector<std::uint8_t> pixels;
};

std::optional<Masks> masks_of(const Recording& recording) {
  const auto size = recording.image_size("mask");
  if (!size) return {};
  Masks masks{*size, recording.events(), std::vector<std::uint8_t>(recording.events() * size->pixels())};
  recording.read_images("mask", 0, masks.count, masks.pixels);
  return masks;
}

void write(const Masks& masks, double width_um, double pixel_um, const fs::path& file) {
  test::RecordingWriter writer(file);
  writer.number("setup:channel width", width_um);
  writer.number("setup:flow rate", 0.04);
  writer.number("imaging:pixel size", pixel_um);
  writer.text("setup:chip region", "channel");
  writer.images("mask", masks.pixels, masks.size.height, masks.size.width);
}

bool is_same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_same(const EventBlock& events, const std::vector<rheocyte_cell_result>& cells) {
  ASSERT_EQ(events.area_um2.size(), cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    EXPECT_TRUE(is_same(events.area_um2[i], cells[i].area_um2)) << i;
    EXPECT_TRUE(is_same(events.deformation[i], cells[i].deformation)) << i;
    EXPECT_TRUE(is_same(events.young_modulus_kPa[i], cells[i].young_modulus_kPa)) << i;
    EXPECT_TRUE(is_same(events.standard_error_kPa[i], cells[i].young_modulus_error_kPa)) << i;
    EXPECT_EQ(int(events.state[i]), cells[i].young_state) << i;
    if (events.effective_modulus_kPa.empty()) continue;
    EXPECT_TRUE(is_same(events.effective_modulus_kPa[i], cells[i].effective_modulus_kPa)) << i;
    EXPECT_TRUE(is_same(events.effective_error_kPa[i], cells[i].effective_modulus_error_kPa)) << i;
    EXPECT_EQ(int(events.effective_state[i]), cells[i].effective_state) << i;
  }
}

rheocyte_cell_settings settings_of(const MeasuringConditions& conditions, double tension_Pa) {
  auto settings = test::usual_settings(tension_Pa);
  settings.channel_width_um = conditions.flow.width_um;
  settings.flow_rate_ul_s = conditions.flow.rate_ul_s;
  settings.pixel_size_um = conditions.pixel_size_um;
  return settings;
}

EffectiveCell cell_under(double tension_Pa) {
  EffectiveCell cell;
  cell.place = EffectivePlace::inside;
  cell.axial_tension_Pa.value = tension_Pa;
  cell.viscosity_mPas = viscosity_mPas;
  return cell;
}

class SameNumbers : public testing::Test {
 protected:
  static ExtractOptions options(const rheocyte_cell_settings& settings) {
    ExtractOptions options;
    if (settings.medium) {
      options.measuring.medium = settings.medium;
      options.measuring.temperature = std::to_string(settings.temperature_C);
    } else {
      options.measuring.viscosity_mPas = settings.viscosity_mPas;
    }
    return options;
  }

  /// Every mask by the library in one call, and by extract.
  void compare(const Masks& masks, double width_um, double pixel_um, const char* medium) {
    SCOPED_TRACE(medium ? medium : "a given viscosity");
    constexpr double tension_Pa = 170;
    const fs::path file = folder_ / "masks.rtdc";
    write(masks, width_um, pixel_um, file);
    auto settings = settings_of({{width_um, 0.04}, pixel_um}, medium ? NAN : tension_Pa);
    settings.medium = medium;
    if (medium) settings.viscosity_mPas = NAN, settings.temperature_C = 23;
    const Recording recording(file);
    const ModulusTables tables("");
    Extraction extraction(recording, options(settings), tables);
    ASSERT_TRUE(medium || extraction.take_tension(cell_under(tension_Pa)));
    const Opened opened(settings, std::uint32_t(masks.size.width), std::uint32_t(masks.size.height));
    std::vector<rheocyte_cell_result> cells(masks.count);
    const rheocyte_cell_masks all{
        masks.pixels.data(), std::uint32_t(masks.size.width), std::uint32_t(masks.size.height), 0, 0, 0, 0};
    ASSERT_EQ(rheocyte_cell_from_masks(opened.worker, &all, masks.count, cells.data()), 0);
    expect_same(extraction.compute(0, masks.count), cells);
    const auto has = [](const rheocyte_cell_result& cell) { return std::isfinite(cell.young_modulus_kPa); };
    with_modulus_ += std::size_t(std::ranges::count_if(cells, has));
  }

  /// All events by what is stored, under a given tension.
  static void compare_features(const Recording& recording, const ModulusTables& tables) {
    constexpr double tension_Pa = 120;
    ExtractOptions options;
    options.measuring.viscosity_mPas = viscosity_mPas;
    Extraction extraction(recording, options, tables);
    ASSERT_TRUE(extraction.take_tension(cell_under(tension_Pa)));
    const EventBlock events = extraction.compute(0, recording.events());
    const Opened opened(settings_of(extraction.conditions(), tension_Pa));
    std::vector<rheocyte_cell_result> together(recording.events()), single(recording.events());
    ASSERT_EQ(rheocyte_cell_from_features(opened.worker, events.area_um2.data(), events.deformation.data(), nullptr,
                                          together.size(), together.data()),
              0);
    for (std::size_t i = 0; i < single.size(); ++i) {
      single[i] = opened.from_features(events.area_um2[i], events.deformation[i]);
      if (int(events.state[i]) != RHEOCYTE_CELL_CUT) continue;
      for (auto* cell : {&together[i], &single[i]}) {  // features do not show it
        cell->young_modulus_kPa = cell->young_modulus_error_kPa = NAN;
        cell->effective_modulus_kPa = cell->effective_modulus_error_kPa = NAN;
        cell->young_state = cell->effective_state = RHEOCYTE_CELL_CUT;
      }
    }
    expect_same(events, together);
    expect_same(events, single);
  }

  test::ScratchFolder folder_;
  std::size_t with_modulus_ = 0;
};

TEST_F(SameNumbers, OfMasksOfRealCells) {
  RHEOCYTE_NEED_REFERENCE("rtdc");
  for (const char* name : {"mask_contour_reference.rtdc", "example_video.rtdc", "2020-10_image_bg.rtdc",
                           "mask_with_artefact.rtdc", "wide_channel_issue_212.rtdc"}) {
    RHEOCYTE_NEED_REFERENCE(fs::path("rtdc") / name);
    SCOPED_TRACE(name);
    const Recording recording(test::reference_folder() / "rtdc" / name);
    const auto masks = masks_of(recording);
    ASSERT_TRUE(masks);
    const double pixel_um = recording.metadata().number("imaging:pixel size").value_or(0.34),
                 width_um = recording.metadata().number("setup:channel width").value_or(20);
    for (const char* medium : {static_cast<const char*>(nullptr), "CellCarrier", "0.59% MC-PBS"})
      compare(*masks, width_um, pixel_um, medium);
  }
  EXPECT_GT(with_modulus_, 20U);
}

/// By what the recordings store, in single precision: each event alone and all in one call.
TEST_F(SameNumbers, OfStoredFeaturesOfAllReferenceRecordings) {
  RHEOCYTE_NEED_REFERENCE("rtdc");
  const ModulusTables tables("");
  std::size_t recordings = 0;
  for (const char* folder : {"rtdc", "hl60-doses"}) {
    if (!fs::exists(test::reference_folder() / folder)) continue;
    for (const auto& entry : fs::directory_iterator(test::reference_folder() / folder)) {
      SCOPED_TRACE(entry.path().filename());
      try {
        compare_features(Recording(entry.path()), tables);
        ++recordings;
      } catch (const UserError&) {  // of a recording that cannot be read, or has no area and deformation
      }
    }
  }
  EXPECT_GE(recordings, fs::exists(test::reference_folder() / "hl60-doses") ? 38U : 3U);
}

/// Cells with a cortex under a known axial tension, drawn by the camera of `rheocyte synth` from another table.
class OfVirtualCells : public SameNumbers {
 protected:
  static constexpr double tension_Pa = 180, stiffness_kPa = 0.2 + 2.4 / 6.2;

  OfVirtualCells() {
    auto spec = parse_synth_spec(
        "[recording]\ncells = 1100\nseed = 3\n[channel]\nwidth_um = 20\n[flow]\nrate_ul_per_s = 0.04\n"
        "viscosity_mPas = 8\naxial_tension_Pa = {mean = 180}\n[cell]\nkind = \"combined\"\n"
        "radius_um = {mean = 6.2, sd = 0.3}\n[cell.bulk]\n"
        "young_modulus_kPa = {mean = 0.2, sd = 0.02, distribution = \"lognormal\"}\n[cell.cortex]\n"
        "modulus_mN_per_m = {mean = 2.4, sd = 0.2, distribution = \"lognormal\"}\ntension_ratio = {mean = 0.6}\n",
        "spec.toml");
    const auto shapes = virtual_cells(spec, fs::path(folder_ / "").parent_path());
    write_virtual_recording(spec, *shapes, {"test", "line"}, folder_ / "virtual.rtdc", [](double) {});
    masks_ = masks_of(Recording(folder_ / "virtual.rtdc")).value();
    masks_.count = std::min<std::size_t>(masks_.count, 1000);
    masks_.pixels.resize(masks_.count * masks_.size.pixels());
  }
  Masks masks_;
};

TEST_F(OfVirtualCells, EachMaskHasTheNumbersOfItsEvent) {
  compare(masks_, 20, 0.34, nullptr);
  compare(masks_, 20, 0.34, "CellCarrier");
  EXPECT_GT(with_modulus_, masks_.count);
}

TEST_F(OfVirtualCells, TheTensionOfTheSetUpIsThatOfTheRecordingAndOfTheCells) {
  const Opened opened(test::usual_settings(), std::uint32_t(masks_.size.width), std::uint32_t(masks_.size.height));
  std::vector<rheocyte_cell_result> cells(masks_.count);
  const rheocyte_cell_masks all{
      masks_.pixels.data(), std::uint32_t(masks_.size.width), std::uint32_t(masks_.size.height), 0, 0, 0, 0};
  ASSERT_EQ(rheocyte_cell_from_masks(opened.worker, &all, masks_.count, cells.data()), 0);
  EXPECT_EQ(cells.front().effective_state, RHEOCYTE_CELL_NO_DATA) << "no tension is known yet";

  rheocyte_cell_setup* refreshed = nullptr;
  std::array<char, 500> message{};
  ASSERT_EQ(rheocyte_cell_refresh(opened.set_up, &opened.worker, 1, &refreshed, message.data(), message.size()), 0)
      << message.data();
  rheocyte_cell_tension tension{};
  ASSERT_EQ(rheocyte_cell_get_tension(refreshed, &tension), 0);
  EXPECT_EQ(tension.source, RHEOCYTE_CELL_TENSION_OF_CELLS);
  EXPECT_GT(tension.cells, masks_.count * 9 / 10);

  write(masks_, 20, 0.34, folder_ / "masks.rtdc");
  const Recording recording(folder_ / "masks.rtdc");
  const ModulusTables tables("");
  ExtractOptions options;
  options.measuring.viscosity_mPas = viscosity_mPas;
  Extraction extraction(recording, options, tables);
  extraction.compute(0, masks_.count);
  const ExtractSummary summary = extraction.summary();
  const EffectiveCell& found = summary.shapes.effective;
  ASSERT_TRUE(found.is_found()) << summary.shapes.text() << " " << tension.value_Pa << " +- " << tension.error_Pa
                                << " +- " << tension.common_error_Pa << " E_eff "
                                << tension.median_effective_modulus_kPa;
  EXPECT_TRUE(is_same(tension.value_Pa, found.axial_tension_Pa.value));
  EXPECT_TRUE(is_same(tension.error_Pa, found.axial_tension_Pa.error));
  EXPECT_TRUE(is_same(tension.common_error_Pa, found.axial_tension_Pa.common_error));

  // Cells and camera are not those of the table: the truth lies within two standard errors.
  EXPECT_NEAR(tension.value_Pa, tension_Pa, 2 * std::hypot(tension.error_Pa, tension.common_error_Pa));

  // And the moduli under it are those of the cells.
  ASSERT_EQ(rheocyte_cell_use(opened.worker, refreshed), 0);
  ASSERT_EQ(rheocyte_cell_from_masks(opened.worker, &all, masks_.count, cells.data()), 0);
  EXPECT_EQ(cells.front().setup, tension.setup);
  std::vector<double> stiffnesses;
  for (const auto& cell : cells)
    if (std::isfinite(cell.stiffness_kPa)) stiffnesses.push_back(cell.stiffness_kPa);
  ASSERT_GT(stiffnesses.size(), masks_.count / 2);
  std::ranges::nth_element(stiffnesses, stiffnesses.begin() + std::ptrdiff_t(stiffnesses.size() / 2));
  EXPECT_NEAR(stiffnesses[stiffnesses.size() / 2], stiffness_kPa, 0.3 * stiffness_kPa)
      << "30 %: stiffness_by_proportions (extract/common_errors.h)";
  ASSERT_EQ(rheocyte_cell_use(opened.worker, opened.set_up), 0);
  opened.from_features(100, 0.02);
  EXPECT_EQ(rheocyte_cell_close(refreshed), 0);
}

/// Bits, rows with gaps, masks with gaps, and contours are the same cells as plain masks.
TEST_F(OfVirtualCells, EveryFormIsTheSameCell) {
  constexpr std::size_t count = 40, gap = 7;
  const auto width = std::uint32_t(masks_.size.width), height = std::uint32_t(masks_.size.height);
  const Opened opened(test::usual_settings(600), width, height);
  const std::size_t row_bits = (width + 7) / 8, row_bytes = width + gap, mask_bytes = height * row_bytes + gap;
  std::vector<std::uint8_t> bits(count * height * row_bits), spaced(count * mask_bytes, 255);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x) {
        const std::uint8_t pixel = masks_.pixels[(i * height + y) * width + x];
        spaced[i * mask_bytes + y * row_bytes + x] = pixel;
        if (pixel) bits[(i * height + y) * row_bits + x / 8] |= std::uint8_t(128 >> x % 8);
      }
  std::vector<rheocyte_cell_result> plain(count), of_bits(count), of_spaced(count);
  const auto measure = [&](const std::uint8_t* pixels, std::uint32_t format, std::size_t row, std::size_t mask,
                           std::vector<rheocyte_cell_result>& results) {
    const rheocyte_cell_masks masks{pixels, width, height, format, 0, row, mask};
    ASSERT_EQ(rheocyte_cell_from_masks(opened.worker, &masks, count, results.data()), 0);
  };
  measure(masks_.pixels.data(), RHEOCYTE_CELL_BYTES, 0, 0, plain);
  measure(bits.data(), RHEOCYTE_CELL_BITS, 0, 0, of_bits);
  measure(spaced.data(), RHEOCYTE_CELL_BYTES, row_bytes, mask_bytes, of_spaced);
  ContourFinder finder;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& contour = finder.contour_of(
        {masks_.size, std::span(masks_.pixels).subspan(i * masks_.size.pixels(), masks_.size.pixels())});
    rheocyte_cell_result of_contour{};
    ASSERT_EQ(rheocyte_cell_from_contour(opened.worker, &contour.front().x, contour.size(), width, height, &of_contour),
              0);
    for (const auto& other : {of_bits[i], of_spaced[i], of_contour}) {
      EXPECT_TRUE(is_same(other.area_um2, plain[i].area_um2));
      EXPECT_TRUE(is_same(other.inertia_ratio, plain[i].inertia_ratio));
      EXPECT_TRUE(is_same(other.stiffness_kPa, plain[i].stiffness_kPa));
      EXPECT_TRUE(is_same(other.stiffness_error_kPa, plain[i].stiffness_error_kPa));
      EXPECT_EQ(other.outline, plain[i].outline);
    }
    const auto of_features = opened.from_features(plain[i].area_um2, plain[i].deformation, plain[i].inertia_ratio);
    EXPECT_TRUE(is_same(of_features.stiffness_kPa, plain[i].stiffness_kPa));
    EXPECT_TRUE(is_same(of_features.young_modulus_kPa, plain[i].young_modulus_kPa));
  }
}

}  // namespace
}  // namespace rheocyte::same_numbers_test
