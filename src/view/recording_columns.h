// All features of a recording's events by their names: stored ones, those that it implies, and those that were computed
// from it.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/event_features.h"
#include "measurement/recording.h"
#include "measurement/shape_source.h"
#include "report/event_column.h"

namespace rheocyte {

/// A column that `rheocyte extract` has computed: its name here, and its feature in the companion.
struct ComputedColumn {
  std::string name, feature;
};

/// What a recording's own emodulus is called here: that of another program, or of a companion that is opened as a
/// recording. "emodulus" is the computed one alone.
inline constexpr std::string_view stored_modulus_name = "emodulus_stored";

/// Of a companion: emodulus, and what its metadata state about userdef0 to userdef9 (report/event_columns.h).
std::vector<ComputedColumn> computed_columns(const Recording& companion);

/// All that can be computed here, by the names of features.
std::vector<ColumnDescription> computed_features();

/// What has been computed from a recording; null: nothing.
struct ComputedFiles {
  const Recording* companion = nullptr;  ///< of `rheocyte extract`
  const Recording* moduli = nullptr;     ///< of `rheocyte moduli`, see ModuliCompanion
};

class RecordingColumns {
 public:
  /// All must outlive it.
  explicit RecordingColumns(const Recording& recording, const ComputedFiles& files = {});

  std::size_t events() const { return recording_.events(); }
  /// In the order of the alphabet, the computed ones at the end; without the numbers of events in basins.
  std::vector<std::string> names() const;
  bool has(const std::string& name) const;
  /// Values of events [first, first + values.size()), NaN where there is none. UserError naming what the recording does
  /// not have, or if its data are damaged.
  void read(const std::string& name, std::size_t first, std::span<double> values);

 private:
  const std::string* computed(const std::string& name) const;
  bool has_modulus(const std::string& name) const;

  const Recording& recording_;
  ComputedFiles files_;
  std::vector<ComputedColumn> computed_;
  std::optional<ShapeSource> shapes_;  ///< of recordings that have areas and deformations
  std::optional<EventFeatures> features_;
};

/// How numbers are handed on: little endian.
enum class NumberType { float32, float64 };

/// Appends them to the bytes.
void append_numbers(std::span<const double> values, NumberType type, std::string& bytes);

}  // namespace rheocyte
