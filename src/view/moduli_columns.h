// The columns of a table of `rheocyte moduli`, as features of a recording's events.
#pragma once
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace rheocyte {

class ModuliColumns {
 public:
  /// UserError if the file is no such table.
  explicit ModuliColumns(const std::filesystem::path& table);

  /// young_modulus_with_cortex_kPa, cortex_modulus_mN_per_m and tension_mN_per_m of the events whose moduli are
  /// resolved, stiffness_kPa of all that have one.
  static std::vector<std::string> names();
  bool has(const std::string& name) const { return columns_.contains(name); }
  /// Of events [first, first + values.size()); NaN where there is none. The name must be one of these.
  void read(const std::string& name, std::size_t first, std::span<double> values) const;

 private:
  std::map<std::string, std::vector<double>> columns_;
};

}  // namespace rheocyte
