// How cells are measured, and what their moduli follow from: immutable, and used by all threads at once.
#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "extract/effective_cell.h"
#include "infer/cells_under_tension.h"
#include "infer/grid_map.h"
#include "instrument/rheocyte_cell.h"

namespace rheocyte {

struct MeasuredSetUp;

/// Cells that do not determine an axial tension.
class NoTension : public std::runtime_error {
 public:
  NoTension(rheocyte_cell_status status, const std::string& sentence) : std::runtime_error(sentence), status_(status) {}
  rheocyte_cell_status status() const { return status_; }

 private:
  rheocyte_cell_status status_;
};

class SetUp {
 public:
  /// UserError naming what is missing or impossible.
  explicit SetUp(const rheocyte_cell_settings& settings);
  SetUp(const SetUp&) = delete;
  SetUp& operator=(const SetUp&) = delete;

  /// The same under the axial tension of these cells. NoTension; UserError.
  std::unique_ptr<SetUp> refreshed(const EventFigures& cells) const;

  /// At most `most_together` cells, whose area and deformation are in the results: their moduli and states. NaN is no
  /// data.
  static constexpr std::size_t most_together = 64;
  void add_moduli(std::span<rheocyte_cell_result> cells) const;

  double pixel_size_um() const;
  const rheocyte_cell_tension& tension() const { return tension_; }
  /// Whether the settings are the same, but for the tension.
  bool is_like(const SetUp& other) const { return measured_ == other.measured_; }

  /// Workers that use it, or are about to.
  std::atomic<int>& users() { return users_; }

 private:
  struct UnderTension {
    explicit UnderTension(GridsUnderTension grids)
        : effective_modulus(std::move(grids.effective_modulus)), stiffness(std::move(grids.stiffness)) {}
    GridMap effective_modulus, stiffness;
  };

  SetUp(std::shared_ptr<const MeasuredSetUp> measured, const rheocyte_cell_tension& tension);
  void take_tension(const ChannelFlow& flow);
  template <std::size_t most>
  void add_moduli(std::span<rheocyte_cell_result> cells) const;

  std::shared_ptr<const MeasuredSetUp> measured_;
  rheocyte_cell_tension tension_;
  std::unique_ptr<const UnderTension> under_tension_;  ///< null: the tension is unknown
  std::atomic<int> users_ = 0;
};

}  // namespace rheocyte
