#include "report/plot_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "case/refuse_path.h"
#include "case/stripped.h"
#include "case/user_error.h"
#include "events/event_pass.h"
#include "events/extract_settings.h"
#include "events/gates.h"
#include "extract/extraction.h"
#include "measurement/event_features.h"
#include "measurement/shape_source.h"
#include "report/recommended_columns.h"
#include "report/shape_features.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t events_at_a_time = 1 << 14;

/// The pairs of a block that are finite.
class Pairs {
 public:
  std::span<const float> of(const std::vector<double>& x, const std::vector<double>& y) {
    pairs_.clear();
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::isfinite(x[i]) && std::isfinite(y[i]))
        pairs_.insert(pairs_.end(), {static_cast<float>(x[i]), static_cast<float>(y[i])});
    return pairs_;
  }

 private:
  std::vector<float> pairs_;
};

/// The two axes of a block of events.
class Axes {
 public:
  Axes(const Recording& recording, ShapeSource& shapes, const PlotOptions& options)
      : shapes_(shapes),
        options_(options),
        features_(recording, shapes),
        gates_(options.measuring.gates),
        usual_(has_usual_axes(options)) {
    gates_.check(features_);
    if (ShapeFeatures::knows(options.x) || ShapeFeatures::knows(options.y))
      by_shapes_.emplace(recording, shapes, options);
  }

  // Events outside the gates get no numbers; returns how many they are.
  std::size_t read(std::size_t first, std::vector<double>& x, std::vector<double>& y) {
    if (usual_) {
      shapes_.read(first, x, y);
    } else {
      read(options_.x, first, x);
      read(options_.y, first, y);
    }
    if (gates_.empty()) return 0;
    inside_.resize(x.size());
    gates_.apply(features_, first, inside_);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!inside_[i]) x[i] = NAN;
    return static_cast<std::size_t>(std::ranges::count(inside_, char{0}));
  }

 private:
  void read(const std::string& feature, std::size_t first, std::vector<double>& values) {
    if (ShapeFeatures::knows(feature)) return by_shapes_->read(feature, first, values);
    features_.read(feature, first, values);
  }

  ShapeSource& shapes_;
  const PlotOptions& options_;
  EventFeatures features_;
  std::optional<ShapeFeatures> by_shapes_;
  Gates gates_;
  bool usual_;
  std::vector<char> inside_;
};

/// Which modulus of a recording is to be reported, as `rheocyte extract` with these options recommends it.
class Reporting {
 public:
  Reporting(const Recording& recording, const PlotOptions& options)
      : options_(extract_options_of(options)),
        tables_(options.table, options.section),
        extraction_(recording, options_, tables_) {}
  void take(std::size_t first, std::size_t count) { static_cast<void>(extraction_.compute(first, count)); }
  void tell(PlotPanel& panel) {
    const ExtractSummary summary = extraction_.summary();
    panel.recommended = recommended_in_short(summary);
    panel.warnings = remarks(summary);
  }

 private:
  static ExtractOptions extract_options_of(const PlotOptions& options) {
    ExtractOptions extract;
    extract.measuring = options.measuring;
    extract.table = options.table;
    extract.section = options.section;
    extract.no_pixelation = options.no_pixelation;
    return extract;
  }

  ExtractOptions options_;
  ModulusTables tables_;
  Extraction extraction_;
};

/// Null where there are no moduli.
std::unique_ptr<Reporting> reporting_of(const Recording& recording, const PlotOptions& options,
                                        const PlotPanel& panel) {
  if (!panel.has_conditions || !has_usual_axes(options)) return nullptr;
  try {
    return std::make_unique<Reporting>(recording, options);
  } catch (const UserError&) {
    return nullptr;
  }
}

void find_conditions(const Recording& recording, const PlotOptions& options, LinesWanted lines, PlotPanel& panel) {
  if (is_of_the_reservoir(recording)) {
    panel.measured = "reservoir";
    if (lines == LinesWanted::yes)
      panel.warnings.emplace_back("was recorded in the reservoir, where no isoelasticity lines exist.");
  } else if (lines == LinesWanted::yes) {
    take_conditions(recording, options, panel);
  } else if (lines == LinesWanted::if_possible) {
    try {
      take_conditions(recording, options, panel);
    } catch (const UserError& missing) {
      const std::string sentence = missing.what(), name = one_line(recording.file().string(), 300) + ": ";
      panel.warnings.push_back("drawn without isoelasticity lines: " +
                               (sentence.starts_with(name) ? sentence.substr(name.size()) : sentence));
    }
  }
}

}  // namespace

bool is_of_the_reservoir(const Recording& recording) {
  return in_small_letters(recording.metadata().text("setup:chip region").value_or("channel")) != "channel";
}

void take_conditions(const Recording& recording, const PlotOptions& options, PlotPanel& panel) {
  ExtractSettings settings =
      extract_settings(options.measuring, options.no_pixelation ? PixelUse::ignore : PixelUse::correct, recording);
  panel.has_conditions = true;
  panel.conditions = settings.conditions;
  ChannelFlow& flow = panel.conditions.flow;
  std::string temperature = fmt::format("{:.3g} °C", settings.temperature_C);
  if (settings.viscosity_varies()) {
    flow.viscosity_mPas = settings.buffer->viscosity(flow, settings.temperature_C);
    temperature = fmt::format("{:.1f} °C", settings.temperature_C);
  }
  panel.measured =
      fmt::format("{:g} µm · {:g} µl/s · {:.2f} mPa s", flow.width_um, flow.rate_ul_s, flow.viscosity_mPas);
  if (settings.buffer) panel.measured += fmt::format(" ({}, {})", settings.medium_text(), temperature);
  panel.warnings = settings.warnings;
}

PlotPanel plot_panel(const fs::path& file, const PlotOptions& options, LinesWanted lines, const TakePairs& take_pairs,
                     const TellProgress& on_progress) {
  Recording recording(file);
  EventPass pass(recording, on_progress);
  PlotPanel panel;
  panel.events = recording.events();
  panel.sample = one_line(recording.metadata().text("experiment:sample").value_or(""), 60);
  const auto& metadata = recording.metadata();
  panel.width_um = options.measuring.channel_width_um.value_or(metadata.number("setup:channel width").value_or(0));
  find_conditions(recording, options, lines, panel);
  panel.warnings.insert(panel.warnings.begin(), recording.remarks().begin(), recording.remarks().end());
  const double pixel_size_um =
      options.measuring.pixel_size_um.value_or(metadata.number("imaging:pixel size").value_or(0));
  ShapeSource shapes(recording, pixel_size_um);
  Axes axes(recording, shapes, options);
  const auto reporting = reporting_of(recording, options, panel);
  Pairs pairs;
  std::vector<double> x, y;
  pass.in_blocks(events_at_a_time, [&](std::size_t first, std::size_t count) {
    x.resize(count);
    y.resize(count);
    panel.gated += axes.read(first, x, y);
    const auto drawable = pairs.of(x, y);
    take_pairs(drawable);
    panel.drawable += drawable.size() / 2;
    if (reporting) reporting->take(first, count);
  });
  if (reporting) reporting->tell(panel);
  if (panel.drawable == 0)
    refuse_path(file, fmt::format("no event {}has {} and {}, so there is nothing to draw.",
                                  panel.gated > 0 ? "inside the gates " : "", options.x, options.y));
  return panel;
}

}  // namespace rheocyte
