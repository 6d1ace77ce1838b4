#include "table/table_keys.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace rheocyte {

namespace {

template <auto field>
TableNumber number(Range range) {
  using Value = std::remove_reference_t<decltype(std::declval<TableSpec&>().*field)>;
  return {range, std::is_integral_v<Value>, [](const TableSpec& spec) { return double(spec.*field); },
          [](TableSpec& spec, double value) { spec.*field = Value(value); }};
}

const std::array table{
    TableKey{"table.identifier", "", "name of the table: letters, digits and hyphens",
             TableWord{&TableSpec::identifier}},
    TableKey{"table.stiffness", "", "the swept parameter, the modulus of the bulk or of the cortex, or \"combined\"",
             TableWord{&TableSpec::stiffness_key}},
    TableKey{"table.least_area_um2", "um2", "area of the smallest cells, deformed",
             number<&TableSpec::least_area_um2>({1e-3, 1e8})},
    TableKey{"table.greatest_area_um2", "um2", "area of the largest cells, deformed",
             number<&TableSpec::greatest_area_um2>({1e-3, 1e8})},
    TableKey{"table.least_deformation", "", "deformation of the stiffest cells",
             number<&TableSpec::least_deformation>({1e-7, 0.9})},
    TableKey{"table.greatest_deformation", "", "deformation of the softest cells",
             number<&TableSpec::greatest_deformation>({1e-7, 0.9})},
    TableKey{"table.radii", "", "number of branches, equally spaced in the radius of the sphere",
             number<&TableSpec::radii>({2, 10000})},
    TableKey{"table.rows_per_radius", "", "rows of a full branch, at deformations of equal ratio",
             number<&TableSpec::rows_per_radius>({2, 10000})},
    TableKey{"table.accuracy", "", "wanted relative accuracy of the deformation",
             number<&TableSpec::accuracy>({1e-7, 1e-1})},
    TableKey{"table.bending_beyond_kBT", "kBT",
             "bending stiffness with which branches go on where the bare surface is unstable, 0 = they end there",
             number<&TableSpec::bending_beyond_kBT>({0, 1e12})},
    TableKey{"table.cortex_share", "", "shares of the cortex in the stiffness of combined cells, one sheet for each",
             TableList{{0, 1}, &TableSpec::cortex_shares}},
    TableKey{"table.tension_ratio", "", "tensions of combined cells as shares of the modulus of the cortex",
             TableList{{0, 1e3}, &TableSpec::tension_ratios}},
    TableKey{"table.bending_ratio", "", "bending stiffness of combined cells over S r0^3, 0 = cell.cortex.bending_kBT",
             number<&TableSpec::bending_ratio>({0, 1})},
    TableKey{"table.greatest_deformation_raw", "",
             "deformation of the contour itself, with the dent that the hull hides, at which combined branches end",
             number<&TableSpec::greatest_deformation_raw>({1e-7, 1})},
};

}  // namespace

std::span<const TableKey> table_keys() { return table; }

const TableKey* find_table_key(std::string_view key) {
  const auto found = std::ranges::find(table, key, &TableKey::key);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace rheocyte
