// Wrong handles, versions, settings, pictures and numbers: a status or a state, never a crash.
#include <limits>
#include <thread>

#include "opened.h"

namespace rheocyte::handles_test {
namespace {

using test::ellipse;
using test::Opened;
using test::usual_settings;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Status and message of settings.
std::pair<std::int32_t, std::string> opened(const rheocyte_cell_settings* settings,
                                            std::uint32_t abi = RHEOCYTE_CELL_ABI) {
  rheocyte_cell_setup* set_up = nullptr;
  std::array<char, 500> message{};
  const auto status = rheocyte_cell_open(abi, settings, &set_up, message.data(), message.size());
  EXPECT_EQ(set_up == nullptr, status != 0);
  if (set_up) rheocyte_cell_close(set_up);
  return {status, message.data()};
}

TEST(InstrumentHandles, OtherVersionsAreRefused) {
  const auto settings = usual_settings();
  const auto [status, message] = opened(&settings, RHEOCYTE_CELL_ABI + 1);
  EXPECT_EQ(status, RHEOCYTE_CELL_WRONG_VERSION);
  EXPECT_NE(message.find("interface 2"), std::string::npos) << message;
  auto smaller = settings;
  smaller.size -= 8;
  EXPECT_EQ(opened(&smaller).first, RHEOCYTE_CELL_WRONG_VERSION);
  EXPECT_EQ(rheocyte_cell_abi(), std::uint32_t{RHEOCYTE_CELL_ABI});
}

TEST(InstrumentHandles, SettingsThatAreMissingOrImpossibleAreNamed) {
  EXPECT_EQ(opened(nullptr).first, RHEOCYTE_CELL_NULL_ARGUMENT);
  struct Case {
    void (*change)(rheocyte_cell_settings&);
    const char* word;
  };
  for (const auto& [change, word] :
       {Case{[](auto& s) { s.channel_width_um = NAN; }, "channel_width_um"},
        Case{[](auto& s) { s.channel_width_um = -20; }, "channel_width_um"},
        Case{[](auto& s) { s.flow_rate_ul_s = 0; }, "flow_rate_ul_s"},
        Case{[](auto& s) { s.pixel_size_um = infinite; }, "pixel_size_um"},
        Case{[](auto& s) { s.viscosity_mPas = -1; }, "viscosity_mPas"},
        Case{[](auto& s) { s.viscosity_mPas = NAN; }, "medium"},
        Case{[](auto& s) { s.viscosity_mPas = NAN, s.medium = "honey", s.temperature_C = 23; }, "honey"},
        Case{[](auto& s) { s.viscosity_mPas = NAN, s.medium = "CellCarrier"; }, "temperature_C"},
        Case{[](auto& s) { s.table = "no-such-table"; }, "no-such-table"},
        Case{[](auto& s) { s.tables_folder = "/nowhere"; }, "tables"},
        Case{[](auto& s) { s.axial_tension_Pa = 1e7; }, "axial_tension_Pa"},
        Case{[](auto& s) { s.axial_tension_Pa = infinite; }, "axial_tension_Pa"}}) {
    auto settings = usual_settings();
    change(settings);
    const auto [status, message] = opened(&settings);
    EXPECT_EQ(status, RHEOCYTE_CELL_BAD_SETTINGS) << word;
    EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

TEST(InstrumentHandles, MessagesAreCut) {
  const auto settings = usual_settings();
  rheocyte_cell_setup* set_up = nullptr;
  std::array<char, 4> message{'x', 'x', 'x', 'x'};
  EXPECT_EQ(rheocyte_cell_open(0, &settings, &set_up, message.data(), 3), RHEOCYTE_CELL_WRONG_VERSION);
  EXPECT_EQ(std::string(message.data()), "th");
  EXPECT_EQ(message[3], 'x');
  EXPECT_EQ(rheocyte_cell_open(0, &settings, &set_up, nullptr, 9), RHEOCYTE_CELL_WRONG_VERSION);
}

TEST(InstrumentHandles, HandlesOfTheOtherKindAndNullAreRefused) {
  const Opened opened(usual_settings());
  auto* const no_worker = reinterpret_cast<rheocyte_cell_worker*>(opened.set_up);
  auto* const no_set_up = reinterpret_cast<rheocyte_cell_setup*>(opened.worker);
  rheocyte_cell_result result{};
  rheocyte_cell_counts counts{};
  rheocyte_cell_tension tension{};
  rheocyte_cell_worker* worker = nullptr;
  const auto mask = ellipse();
  const double number = 1;
  EXPECT_EQ(rheocyte_cell_from_mask(no_worker, mask.data(), 250, 80, 0, &result), RHEOCYTE_CELL_WRONG_HANDLE);
  EXPECT_EQ(rheocyte_cell_from_features(no_worker, &number, &number, nullptr, 1, &result), RHEOCYTE_CELL_WRONG_HANDLE);
  EXPECT_EQ(rheocyte_cell_get_counts(no_worker, &counts), RHEOCYTE_CELL_WRONG_HANDLE);
  EXPECT_EQ(rheocyte_cell_close_worker(no_worker), RHEOCYTE_CELL_WRONG_HANDLE);
  EXPECT_EQ(rheocyte_cell_close(no_set_up), RHEOCYTE_CELL_WRONG_HANDLE);
  EXPECT_EQ(rheocyte_cell_use(opened.worker, no_set_up), RHEOCYTE_CELL_WRONG_HANDLE);
  EXPECT_EQ(rheocyte_cell_get_tension(no_set_up, &tension), RHEOCYTE_CELL_WRONG_HANDLE);
  EXPECT_EQ(rheocyte_cell_open_worker(no_set_up, 250, 80, 0, &worker), RHEOCYTE_CELL_WRONG_HANDLE);
  EXPECT_EQ(rheocyte_cell_close(nullptr), RHEOCYTE_CELL_NULL_ARGUMENT);
  EXPECT_EQ(rheocyte_cell_close_worker(nullptr), RHEOCYTE_CELL_NULL_ARGUMENT);
  EXPECT_EQ(rheocyte_cell_from_mask(opened.worker, nullptr, 250, 80, 0, &result), RHEOCYTE_CELL_NULL_ARGUMENT);
  EXPECT_EQ(rheocyte_cell_from_mask(opened.worker, mask.data(), 250, 80, 0, nullptr), RHEOCYTE_CELL_NULL_ARGUMENT);
  EXPECT_EQ(rheocyte_cell_from_contour(opened.worker, nullptr, 5, 250, 80, &result), RHEOCYTE_CELL_NULL_ARGUMENT);
  EXPECT_EQ(rheocyte_cell_from_features(opened.worker, nullptr, &number, nullptr, 1, &result),
            RHEOCYTE_CELL_NULL_ARGUMENT);
}

TEST(InstrumentHandles, EveryNumberHasWords) {
  for (std::int32_t number = -2; number < 20; ++number)
    for (const auto& text : {rheocyte_cell_status_text, rheocyte_cell_state_text, rheocyte_cell_outline_text})
      ASSERT_NE(text(number), nullptr) << number;
  EXPECT_NE(std::string(rheocyte_cell_status_text(RHEOCYTE_CELL_INTERNAL)), "Unknown.");
  EXPECT_EQ(std::string(rheocyte_cell_status_text(RHEOCYTE_CELL_INTERNAL + 1)), "Unknown.");
}

TEST(InstrumentHandles, PicturesThatDoNotFitAreRefused) {
  const Opened opened(usual_settings());
  const auto mask = ellipse();
  rheocyte_cell_result result{};
  result.area_um2 = 7;
  const auto status = [&](std::uint32_t width, std::uint32_t height, std::size_t row_bytes, std::uint32_t format = 0) {
    const rheocyte_cell_masks masks{mask.data(), width, height, format, 0, row_bytes, 0};
    return rheocyte_cell_from_masks(opened.worker, &masks, 1, &result);
  };
  for (const auto bad :
       {status(0, 80, 0), status(250, 0, 0), status(251, 80, 0), status(250, 81, 0), status(250, 80, 249),
        status(250, 80, 31, RHEOCYTE_CELL_BITS), status(250, 80, 0, 2), status(0xffffffff, 0xffffffff, 0)})
    EXPECT_EQ(bad, RHEOCYTE_CELL_BAD_PICTURE);
  EXPECT_EQ(result.area_um2, 7) << "nothing is written";
  rheocyte_cell_worker* worker = nullptr;
  for (const auto& [width, height] : {std::pair{0U, 80U}, {250U, 0U}, {1U << 12, (1U << 10) + 1}, {~0U, ~0U}})
    EXPECT_EQ(rheocyte_cell_open_worker(opened.set_up, width, height, 0, &worker), RHEOCYTE_CELL_BAD_PICTURE);
  EXPECT_EQ(rheocyte_cell_open_worker(opened.set_up, 250, 80, 19, &worker), RHEOCYTE_CELL_BAD_SETTINGS);
  EXPECT_EQ(worker, nullptr);
}

TEST(InstrumentHandles, WhatIsNoWholeCellHasAState) {
  const Opened opened(usual_settings(200));
  const auto result_of = [&](const std::vector<std::uint8_t>& mask) {
    rheocyte_cell_result result{};
    EXPECT_EQ(rheocyte_cell_from_mask(opened.worker, mask.data(), 250, 80, 0, &result), 0);
    return result;
  };
  const auto empty = result_of(std::vector<std::uint8_t>(std::size_t{250} * 80));
  EXPECT_EQ(empty.outline, RHEOCYTE_CELL_OUTLINE_EMPTY);
  EXPECT_EQ(empty.young_state, RHEOCYTE_CELL_NO_DATA);
  EXPECT_TRUE(std::isnan(empty.area_um2) && std::isnan(empty.stiffness_kPa));
  EXPECT_EQ(result_of(ellipse(125, 40, 1, 1)).outline, RHEOCYTE_CELL_OUTLINE_TOO_SMALL);
  EXPECT_EQ(result_of(ellipse(125, 40, 30, 0.1)).outline, RHEOCYTE_CELL_OUTLINE_TOO_SMALL) << "a line";
  const auto cut = result_of(ellipse(10, 40));
  EXPECT_EQ(cut.outline, RHEOCYTE_CELL_OUTLINE_AT_EDGE);
  EXPECT_EQ(cut.young_state, RHEOCYTE_CELL_CUT);
  EXPECT_EQ(cut.effective_state, RHEOCYTE_CELL_CUT);
  EXPECT_TRUE(std::isnan(cut.young_modulus_kPa) && std::isfinite(cut.area_um2));
  auto torn = ellipse();
  torn[3 * 250 + 3] = 1;
  const auto whole = result_of(ellipse()), in_pieces = result_of(torn);
  EXPECT_EQ(whole.outline, RHEOCYTE_CELL_OUTLINE_WHOLE);
  EXPECT_EQ(in_pieces.outline, RHEOCYTE_CELL_OUTLINE_IN_PIECES);
  EXPECT_EQ(in_pieces.young_modulus_kPa, whole.young_modulus_kPa);
  rheocyte_cell_counts counts{};
  rheocyte_cell_get_counts(opened.worker, &counts);
  EXPECT_EQ(counts.cells, 6U);
  EXPECT_EQ(counts.young[RHEOCYTE_CELL_CUT], 1U);
}

TEST(InstrumentHandles, ContoursOutsideThePictureAreRefused) {
  const Opened opened(usual_settings());
  rheocyte_cell_result result{};
  const auto status = [&](const std::vector<std::int32_t>& xy, std::uint32_t width = 250, std::uint32_t height = 80) {
    return rheocyte_cell_from_contour(opened.worker, xy.data(), xy.size() / 2, width, height, &result);
  };
  constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(status({5, 5, 6, 5, 250, 7, 5, 6}), RHEOCYTE_CELL_BAD_CONTOUR);
  EXPECT_EQ(status({5, 5, 6, -1, 7, 7, 5, 6}), RHEOCYTE_CELL_BAD_CONTOUR);
  EXPECT_EQ(status({0, 0, most, 0, most, most, 0, most}, 0, 0), RHEOCYTE_CELL_BAD_CONTOUR);
  EXPECT_EQ(status(std::vector<std::int32_t>(200000, 5)), RHEOCYTE_CELL_BAD_CONTOUR) << "too many points";
  EXPECT_EQ(status({5, 5, 6, 5, 6, 6, 5, 6}, 0, 80), RHEOCYTE_CELL_BAD_PICTURE);
  EXPECT_EQ(status({}), 0);
  EXPECT_EQ(result.outline, RHEOCYTE_CELL_OUTLINE_EMPTY);
}

TEST(InstrumentHandles, FeaturesThatAreNoNumbersAreNoData) {
  const Opened opened(usual_settings(200));
  for (const double bad : {double(NAN), infinite, -infinite})
    for (const auto& result : {opened.from_features(bad, 0.02), opened.from_features(80, bad)}) {
      EXPECT_EQ(result.young_state, RHEOCYTE_CELL_NO_DATA);
      EXPECT_EQ(result.effective_state, RHEOCYTE_CELL_NO_DATA);
      EXPECT_TRUE(std::isnan(result.young_modulus_kPa));
    }
  EXPECT_EQ(opened.from_features(80, -0.01).young_state, RHEOCYTE_CELL_TOO_STIFF);
  EXPECT_EQ(opened.from_features(1, 0.02).young_state, RHEOCYTE_CELL_TOO_SMALL);
  EXPECT_EQ(opened.from_features(1e9, 0.02).young_state, RHEOCYTE_CELL_TOO_LARGE);
  EXPECT_EQ(opened.from_features(80, 0.4).effective_state, RHEOCYTE_CELL_TOO_SOFT);
}

TEST(InstrumentHandles, ASetUpThatIsUsedStaysOpen) {
  const Opened opened(usual_settings());
  EXPECT_EQ(rheocyte_cell_close(opened.set_up), RHEOCYTE_CELL_IN_USE);
  const Opened other(usual_settings(150));
  EXPECT_EQ(rheocyte_cell_use(opened.worker, other.set_up), 0);
  EXPECT_EQ(rheocyte_cell_close(opened.set_up), RHEOCYTE_CELL_IN_USE) << "until the next cell";
  EXPECT_EQ(opened.from_features(120, 0.02).axial_tension_Pa, 150);
  EXPECT_EQ(rheocyte_cell_use(opened.worker, opened.set_up), 0);
  EXPECT_EQ(rheocyte_cell_use(opened.worker, opened.set_up), 0);
  EXPECT_TRUE(std::isnan(opened.from_features(120, 0.02).axial_tension_Pa));
}

/// Threads with a worker each, whose set-up another thread swaps and closes.
TEST(InstrumentHandles, SetUpsAreSwappedWhileThreadsWork) {
  constexpr int threads = 3, swaps = 20;
  const Opened first(usual_settings(100)), second(usual_settings(200));
  const double with_first = first.from_features(120, 0.02).stiffness_kPa,
               with_second = second.from_features(120, 0.02).stiffness_kPa;
  std::atomic<bool> goes_on = true;
  std::atomic<int> wrong = 0;
  std::vector<rheocyte_cell_worker*> workers(threads);
  for (auto& worker : workers) ASSERT_EQ(rheocyte_cell_open_worker(first.set_up, 250, 80, 0, &worker), 0);
  {
    std::vector<std::jthread> all;
    for (auto* const worker : workers)
      all.emplace_back([&, worker] {
        const double area = 120, deformation = 0.02;
        while (goes_on) {
          rheocyte_cell_result r{};
          wrong += rheocyte_cell_from_features(worker, &area, &deformation, nullptr, 1, &r);
          wrong += r.stiffness_kPa != (r.axial_tension_Pa == 100 ? with_first : with_second);
        }
      });
    for (int k = 0; k < swaps; ++k)
      for (auto* const worker : workers) rheocyte_cell_use(worker, (k % 2 ? first : second).set_up);
    goes_on = false;
  }
  EXPECT_EQ(wrong, 0);
  for (auto* const worker : workers) EXPECT_EQ(rheocyte_cell_close_worker(worker), 0);
}

}  // namespace
}  // namespace rheocyte::handles_test
