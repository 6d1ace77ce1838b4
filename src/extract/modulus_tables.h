// The tables of one call of `rheocyte extract` or `rheocyte plot`, and which of them a recording gets.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "infer/grid_modulus.h"
#include "infer/modulus_parity.h"

namespace rheocyte {

/// A table of rheocyte, or a published one in parity mode.
class ModulusTable {
 public:
  /// A file in dclab's format, a grid, or the folder of a table of `rheocyte table`. UserError.
  explicit ModulusTable(const std::filesystem::path& file);

  const std::filesystem::path& file() const { return file_; }
  bool is_own() const { return std::holds_alternative<GridModulus>(table_); }
  const std::string& identifier() const;
  /// Identifier, model if known, and conditions in one line.
  std::string description() const;
  /// n of the liquid in a table of rheocyte; 1 for published ones.
  double flow_exponent() const;
  /// Published tables leave the standard errors NaN.
  void estimate(const MeasuringConditions& conditions, const MeasuredEvents& events,
                const EstimatedModuli& estimates) const;

 private:
  std::filesystem::path file_;
  std::variant<ParityModulus, GridModulus> table_;
};

/// A difference of flow exponents up to which a liquid and that of a table count as alike.
inline constexpr double flow_exponent_tolerance = 0.035;

class ModulusTables {
 public:
  /// The table that the user names (as in find_table); if the name is empty those that come with the program, of which
  /// there is at least one, else UserError.
  explicit ModulusTables(const std::string& name);

  struct Choice {
    const ModulusTable* used;
    const ModulusTable* other = nullptr;  ///< to compare with: the other way to take a shear-thinning liquid
  };
  /// For a medium with eta ~ (shear rate)^(n - 1) that thins the table whose liquid has its exponent n, if there is
  /// one; else the one of a Newtonian liquid, with the effective viscosity. A table that the user names is used always.
  Choice choose(double flow_exponent) const;

  /// True if rheocyte's own tables are used, of which areas are corrected and errors known.
  bool own() const { return tables_.front()->is_own(); }

 private:
  const ModulusTable* newtonian() const;
  const ModulusTable* matching(double flow_exponent) const;

  std::vector<std::unique_ptr<ModulusTable>> tables_;
  bool given_ = false;  ///< the first one is the user's choice
};

}  // namespace rheocyte
