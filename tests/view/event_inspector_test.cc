// What is reported of one event: the numbers of `rheocyte extract`, and a model cell that lies over the picture.
#include "view/event_inspector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "../table/invented_combined.h"
#include "case/user_error.h"
#include "extract/moduli_recording.h"
#include "measurement/mask_from_outline.h"
#include "measurement/recording_writer.h"
#include "measurement/reference_files.h"
#include "report/event_columns.h"
#include "report/extract_recording.h"
#include "report/moduli_text.h"
#include "shape/outline_shape.h"
#include "view/model_outline.h"
#include "view/recording_columns.h"
#include "view/recording_moduli.h"
#include "virtual_cells.h"

namespace rheocyte::event_inspector_test {
namespace {

using Json = nlohmann::ordered_json;

/// What `rheocyte extract` writes for a recording.
std::filesystem::path extracted(const std::filesystem::path& file, const test::ScratchFolder& folder,
                                const ExtractOptions& options, const ModulusTables& tables) {
  ExtractFiles files({folder / "result.rtdc", folder / "result.tsv"}, false);
  extract_recording(file, files, options, tables, [](double) {});
  files.publish();
  return folder / "result.rtdc";
}

/// To the single precision of what extract writes.
void expect_equal(const Json& number, double wanted, const std::string& what) {
  if (std::isfinite(wanted))
    EXPECT_EQ(number.get<float>(), float(wanted)) << what;
  else
    EXPECT_TRUE(number.is_null()) << what << number;
}

void expect_the_numbers_of_extract(const std::filesystem::path& file, const test::ScratchFolder& folder,
                                   std::size_t most_events) {
  const ExtractOptions options;
  const ModulusTables tables("");
  const Recording recording(file), companion(extracted(file, folder, options, tables));
  RecordingColumns columns(recording, {.companion = &companion});
  EventInspector inspector({recording, &companion}, options, tables);
  for (std::size_t event = 0; event < std::min(most_events, recording.events()); ++event) {
    const Json told = inspector.inspect(event);
    const auto in_companion = [&](const std::string& name) {
      std::array<double, 1> value{};
      columns.read(name, event, value);
      return value[0];
    };
    for (const auto& [key, name] :
         {std::pair("young_modulus_kPa", "emodulus"), std::pair("young_modulus_kPa_error", "young_modulus_kPa_error"),
          std::pair("shape_excess", "shape_excess"),
          std::pair("young_modulus_asymmetry_kPa", "young_modulus_asymmetry_kPa"),
          std::pair("young_modulus_inertia_kPa", "young_modulus_inertia_kPa"),
          std::pair("axial_tension_Pa", "axial_tension_Pa")})
      if (columns.has(name)) {
        expect_equal(told[key], in_companion(name), key);
        expect_equal(told["features"][name], in_companion(name), name);
      }
    const auto state = static_cast<ModulusState>(in_companion("state"));
    EXPECT_EQ(told["state"], name_of(state));
    const bool is_drawn = told["young_modulus_asymmetry_kPa"].is_number() ||
                          (told.contains("young_modulus_inertia_kPa") && told["young_modulus_inertia_kPa"].is_number());
    const bool is_long = told["elongated"].get<bool>() && is_drawn;
    const auto sentence = told["sentence"].get<std::string>();
    EXPECT_EQ(sentence.empty(), state == ModulusState::valid && !is_long);
    EXPECT_EQ(sentence.find("has this shape") != std::string::npos, is_long) << sentence;
    EXPECT_EQ(told["case"].is_null(), !has_modulus(state));
  }
}

TEST(EventInspector, GivesTheNumbersOfExtractForVirtualCells) {
  const test::ScratchFolder folder;
  test::write_virtual_cells(folder / "cells.rtdc", 30);
  expect_the_numbers_of_extract(folder / "cells.rtdc", folder, 30);
}

TEST(EventInspector, GivesTheNumbersOfExtractForTheFieldsRecordings) {
  RHEOCYTE_NEED_REFERENCE("rtdc/wide_channel_issue_212.rtdc");
  const test::ScratchFolder folder;
  expect_the_numbers_of_extract(test::reference_folder() / "rtdc/wide_channel_issue_212.rtdc", folder, 8);
}

TEST(EventInspector, LaysTheModelOverTheOutline) {
  const test::ScratchFolder folder;
  test::write_virtual_cells(folder / "cells.rtdc", 20);
  const Recording recording(folder / "cells.rtdc");
  const ModulusTables tables("");
  int compared = 0;
  for (std::size_t event = 0; event < recording.events(); ++event) {
    const Json told = EventInspector({recording, nullptr}, ExtractOptions{}, tables).inspect(event);
    ASSERT_FALSE(told["outline"].is_null());
    if (told["model"].is_null()) continue;
    ++compared;
    EXPECT_LT(told["model"]["residual_rms_um"], 0.34) << "of the shape: within a pixel";
    const auto middle = [](const Json& curve) {
      double x = 0, y = 0;
      for (std::size_t i = 0; i < curve["x_um"].size(); ++i) {
        x += curve["x_um"][i].get<double>() / static_cast<double>(curve["x_um"].size());
        y += curve["y_um"][i].get<double>() / static_cast<double>(curve["y_um"].size());
      }
      return std::pair(x, y);
    };
    const auto [x, y] = middle(told["outline"]);
    const auto [model_x, model_y] = middle(told["model"]);
    EXPECT_NEAR(x, model_x, 0.5) << "means of points that lie unevenly";
    EXPECT_NEAR(y, model_y, 0.5);
  }
  EXPECT_GT(compared, 10);
}

TEST(EventInspector, TellsWhyThereIsNoModulus) {
  const test::ScratchFolder folder;
  {
    test::RecordingWriter writer(folder / "a.rtdc");
    test::write_usual_metadata(writer);
    writer.scalar("area_um", {80, 5, NAN});
    writer.scalar("deform", {0.03, 0.03, 0.03});
  }
  {
    test::RecordingWriter writer(folder / "bare.rtdc");
    writer.scalar("area_um", {80});
    writer.scalar("deform", {0.03});
  }
  const ModulusTables tables("");
  const Recording recording(folder / "a.rtdc"), bare(folder / "bare.rtdc");
  EXPECT_EQ(EventInspector({recording, nullptr}, ExtractOptions{}, tables).inspect(0)["state"], "valid");
  EXPECT_EQ(EventInspector({recording, nullptr}, ExtractOptions{}, tables).inspect(1)["state"], "too small");
  const Json without = EventInspector({recording, nullptr}, ExtractOptions{}, tables).inspect(2);
  EXPECT_EQ(without["state"], "no data");
  EXPECT_TRUE(without["features"]["area_um"].is_null());
  EXPECT_TRUE(without["outline"].is_null());
  const Json unknown = EventInspector({bare, nullptr}, ExtractOptions{}, tables).inspect(0);
  EXPECT_EQ(unknown["state"], "unknown");
  EXPECT_NE(unknown["sentence"].get<std::string>().find("setup:channel width"), std::string::npos) << unknown;
  EXPECT_THROW(static_cast<void>(EventInspector({recording, nullptr}, ExtractOptions{}, tables).inspect(3)), UserError);
  EXPECT_THROW(static_cast<void>(picture_of_event(recording, "image", 0)), UserError);
}

/// Cells of one kind at the places of pixels, with the usual metadata and a viscosity of 15 mPa s.
void write_combined_cells(const std::filesystem::path& file, const Eigen::MatrixX2d& outline_um, int cells) {
  constexpr double pixel_um = 0.34;
  const ImageSize size{120, 70};
  std::vector<std::uint8_t> all, mask(size.pixels());
  for (int i = 0; i < cells; ++i) {
    const Eigen::RowVector2d middle(60 + 0.1 * i, 35 - 0.07 * i);
    ASSERT_TRUE(fill_mask((outline_um / pixel_um).rowwise() + middle, size, mask));
    all.insert(all.end(), mask.begin(), mask.end());
  }
  test::RecordingWriter writer(file);
  test::write_usual_metadata(writer);
  writer.integer("experiment:event count", cells);
  writer.scalar("index", std::vector<double>(std::size_t(cells), 1));
  writer.images("mask", all, size.height, size.width);
}

/// The table of rheocyte moduli by columns, without its remarks.
std::vector<std::map<std::string, std::string>> rows_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream cells(line);
    std::vector<std::string> found;
    for (std::string cell; std::getline(cells, cell, '\t');) found.push_back(cell);
    if (names.empty()) {
      names = found;
      continue;
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (k == 0) rows.emplace_back();
      rows.back()[names.at(k)] = found[k];
    }
  }
  return rows;
}

TEST(EventInspector, SaysWhatModuliSaysByACombinedTable) {
  const test::ScratchFolder folder;
  const CombinedTable invented = test::whole_combined_table();
  std::filesystem::create_directory(folder / "table");
  std::ofstream(folder / "table/spec.toml") << to_toml(invented.spec);
  std::ofstream(folder / "table" / combined_table_name(invented.spec)) << combined_table_csv(invented);
  write_combined_cells(folder / "a.rtdc", test::invented_outline({7, 0.5, 0}, 1.2), 4);
  ModuliOptions moduli;
  moduli.table = folder / "table";
  moduli.section = Section::tube;  // as the invented cells
  moduli.measuring.viscosity_mPas = 15;
  const ModuliTables combined(moduli);
  ModuliText text(folder / "a.tsv");
  moduli_of_recording(folder / "a.rtdc", moduli, combined, 2, text, [](double) {});
  ModuliCompanion companion(folder / "a_moduli.rtdc");
  moduli_of_recording(folder / "a.rtdc", moduli, combined, 1, companion, [](double) {});
  const auto rows = rows_of(folder / "a.tsv");
  ExtractOptions options;
  options.measuring = moduli.measuring;
  const ModulusTables tables("");
  const Recording recording(folder / "a.rtdc");
  const Recording kept(folder / "a_moduli.rtdc");
  const ComputedFiles computed{.moduli = &kept};
  RecordingColumns columns(recording, computed);
  EventInspector inspector({recording, computed, &combined}, options, tables);
  for (std::size_t event = 0; event < 4; ++event) {
    const Json whole = inspector.inspect(event), told = whole.at("combined");
    ASSERT_TRUE(told.is_object()) << event;
    const auto& row = rows.at(event);
    EXPECT_EQ(told["status"], row.at("status"));
    for (const char* name : {"young_modulus_kPa", "cortex_modulus_mN_per_m", "stiffness_kPa", "chi_squared"}) {
      const double wanted = std::stod(row.at(name));
      EXPECT_NEAR(told[name].get<double>(), wanted, 5e-4 * wanted) << name << ", written with four to six digits";
    }
    std::array<double, 1> column{};
    columns.read("stiffness_kPa", event, column);
    expect_equal(told["stiffness_kPa"], column[0], "stiffness_kPa");
    expect_equal(whole.at("features").at("stiffness_kPa"), column[0], "stiffness_kPa");
    columns.read("cortex_modulus_mN_per_m", event, column);
    if (row.at("status") == "resolved")
      expect_equal(told["cortex_modulus_mN_per_m"], column[0], "cortex_modulus_mN_per_m");
    else
      EXPECT_TRUE(std::isnan(column[0])) << "moduli that are not told apart are none";
    // E = 0.6 kPa and E2D = 4.2 mN/m: the cell that was drawn, by the pixels within 0.1 um.
    EXPECT_NEAR(told["case"]["cell"]["radius_um"].get<double>(), 7, 0.1);
    Eigen::MatrixX2d drawn(Eigen::Index(told["contour"]["x_um"].size()), 2);
    for (Eigen::Index i = 0; i < drawn.rows(); ++i)
      drawn.row(i) << told["contour"]["x_um"][std::size_t(i)].get<double>(),
          told["contour"]["y_um"][std::size_t(i)].get<double>();
    const OutlineShape shape = outline_shape(drawn), wanted = outline_shape(test::invented_outline({7, 0.5, 0}, 1.2));
    EXPECT_NEAR(shape.area, wanted.area, 0.02 * wanted.area);
    EXPECT_NEAR(shape.deformation, wanted.deformation, 0.1 * wanted.deformation);
  }
}

TEST(ModelOutline, HasTheAreaTheCentroidAndTheVolumeOfItsSphere) {
  for (const Section section : {Section::tube, Section::square}) {
    const ModulusTables tables("", section);
    const ShapeMap& map = *tables.shapes(1);
    const MeasuringConditions conditions{map.origin().flow, 0, true};
    const auto round = model_outline(map, conditions, 80, 1e-4);
    ASSERT_TRUE(round);
    // To first order in the deformation a nearly round cell is a sphere.
    EXPECT_NEAR(round->radius_um, std::sqrt(80 / std::numbers::pi), 2e-3);
    const auto cell = model_outline(map, conditions, 80, 0.05);
    ASSERT_TRUE(cell);
    const OutlineShape shape = outline_shape(cell->outline);
    EXPECT_NEAR(shape.area, 80, 0.2) << "180 points, and modes beyond c7";
    EXPECT_NEAR(shape.x, 0, 1e-9);
    EXPECT_NEAR(shape.deformation, 0.05, 3e-3) << "4 to 6 % are in modes beyond c7";
    EXPECT_FALSE(model_outline(map, conditions, 80, -0.01));
    EXPECT_FALSE(model_outline(map, conditions, NAN, 0.05));
  }
}

TEST(ModelOutline, HasAVolumeOfRevolution) {
  constexpr int points = 2000;
  Eigen::MatrixX2d ellipse(points, 2);
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    ellipse.row(i) << 3 * std::cos(angle), 2 * std::sin(angle);
  }
  EXPECT_NEAR(volume_of_revolution(ellipse), 4. / 3 * std::numbers::pi * 3 * 2 * 2, 5e-4) << "second order in 1/2000";
}

}  // namespace
}  // namespace rheocyte::event_inspector_test
