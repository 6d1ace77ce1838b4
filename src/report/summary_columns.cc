#include "report/summary_columns.h"

#include <algorithm>

#include "report/distribution_columns.h"
#include "report/effective_columns.h"
#include "report/methods_text.h"
#include "report/recommended_columns.h"
#include "report/verdict_columns.h"

namespace rheocyte {

namespace {

using S = ExtractSummary;

const DistributedQuantity young_modulus{"young_modulus", "kPa", "kPa", "E from deformation",
                                        "Young's modulus from area and deformation"};

std::string all_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const auto& sentence : sentences) text.append(text.empty() ? "" : " ").append(sentence);
  return text;
}

std::string beside_axis_text(const S& s) {
  const std::string turn = s.shapes.beside_axis.turn_text(), centring = s.shapes.beside_axis.centring_text();
  return turn + (turn.empty() || centring.empty() ? "" : " ") + centring;
}

void add_counts(ColumnList<S>& list) {
  list.add_count("events", &S::recorded);
  for (std::size_t k = 0; k < states_by_deformation().size(); ++k) {
    std::string name(states_by_deformation()[k]);
    std::ranges::replace(name, ' ', '_');
    list.add_count(name, [k](const S& s) { return s.counts[k]; });
  }
  list.add_count("cut_by_the_edge", [](const S& s) { return s.counts[std::size_t(ModulusState::cut)]; });
}

void add_modulus(ColumnList<S>& list) {
  list.add({"with_modulus_percent", "%", "Events with a modulus", "of all events, by area and deformation"},
           [](const S& s) { return 100 * double(s.with_modulus()) / double(std::max<std::size_t>(s.recorded, 1)); });
  add_quartiles(list, young_modulus, [](const S& s) { return s.modulus_kPa; });
  list.add(young_modulus.column("mean", "mean"), [](const S& s) { return s.modulus_kPa.mean; })
      .add(young_modulus.column("standard_deviation", "standard deviation"),
           [](const S& s) { return s.modulus_kPa.standard_deviation; })
      .add({"young_modulus_kPa_error_median", "kPa", "Standard error of E of an event, median",
            "of pixels, table and inertia"},
           &S::median_standard_error_kPa);
}

void add_words(ColumnList<S>& list) {
  list.add({"shapes_text", "", "Shapes in a sentence", "whether the shapes are those of the model"},
           [](const S& s) { return s.shapes.text(); })
      .add({"trend_text", "", "Changes in a sentence", "whether the shapes still change along the channel"},
           [](const S& s) { return s.shapes.trend_text(); })
      .add({"beside_axis_text", "", "Cells beside the axis in a sentence",
            "whether elongation is stored in cells beside the axis, and whether they approach it"},
           beside_axis_text)
      .add({"methods_text", "", "Paragraph for a methods section", "how the recommended modulus was obtained"},
           [](const S& s) { return methods_text(s); });
}

void add_settings(ColumnList<S>& list) {
  list.add({"table", "", "Table", "its identifier"}, &S::table)
      .add({"medium", "", "Medium", "the liquid; empty if a viscosity was given"}, &S::medium)
      .add({"viscosity_model", "", "Viscosity model", "\"given\" if the viscosity was given"}, &S::viscosity_model)
      .add({"viscosity_mean_mPas", "mPa s", "Viscosity, mean", "of the liquid, over the events"},
           &S::mean_viscosity_mPas)
      .add({"temperature", "", "Temperature", "and its source"}, &S::temperature)
      .add({"channel_width_um", "um", "Channel width", "of the square channel"},
           [](const S& s) { return s.conditions.flow.width_um; })
      .add({"flow_rate_ul_per_s", "ul/s", "Flow rate", "sample and sheath together"},
           [](const S& s) { return s.conditions.flow.rate_ul_s; })
      .add({"pixelation_pixel_size_um", "um", "Pixel size", "corrected for; 0: no correction"},
           [](const S& s) { return s.conditions.pixel_size_um; })
      .add({"corrected_for_pixels", "", "Corrected for pixels", "which features are"}, &S::corrected)
      .add({"gates", "", "Gates", "limits and polygons of the events that count"}, &S::gates)
      .add({"area_from", "", "Area from", "the stored feature, or contours or masks"}, &S::area_from)
      .add({"deformation_from", "", "Deformation from", "the stored feature, or contours or masks"},
           &S::deformation_from)
      .add({"settings_hash", "", "Hash of the settings", "the same for results that are comparable"}, &S::settings_hash)
      .add({"sample", "", "Sample", "from the metadata"}, [](const S& s) { return s.labels.sample; })
      .add({"date", "", "Date", "from the metadata"}, [](const S& s) { return s.labels.date; })
      .add({"time", "", "Time", "from the metadata"}, [](const S& s) { return s.labels.time; })
      .add({"run_index", "", "Run index", "from the metadata"}, [](const S& s) { return s.labels.run_index; })
      .add({"chip", "", "Chip", "from the metadata"}, [](const S& s) { return s.labels.chip; })
      .add({"remarks", "", "Remarks", "all in sentences"}, [](const S& s) { return all_of(s.warnings); });
}

}  // namespace

std::string summary_text(const Column<S>& column, const S& summary) {
  const CellValue value = column.value(summary);
  return has_value(value) ? cell_text(column, value) : "";
}

const Columns<S>& summary_columns() {
  static const Columns<S> columns = [] {
    ColumnList<S> list;
    list.add_of(
        recommended_columns(), [](const S& s) -> const S& { return s; }, start_of_recommended);
    add_counts(list);
    add_modulus(list);
    list.add_of(effective_columns(), [](const S& s) { return s.shapes.effective; });
    list.add_of(elongation_summary_columns(), &S::shapes).add_of(verdict_columns(), &S::shapes);
    list.add_of(beside_axis_columns(), [](const S& s) { return s.shapes.beside_axis; });
    add_words(list);
    add_settings(list);
    return std::move(list).columns();
  }();
  return columns;
}

}  // namespace rheocyte
