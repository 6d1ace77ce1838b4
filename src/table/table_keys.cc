#include "table/table_keys.h"

#include <array>

namespace rheocyte {

namespace {

template <auto field>
Key<TableSpec> key(KeyDescription description) {
  return key_of<TableSpec, field>(std::move(description));
}

using Spec = TableSpec;
/// What can be solved for in ducts (src/case/read_case.cc), for solids and shells.
constexpr double max_bending_ratio = 1e-3;
constexpr Condition combined{"table.cortex_fraction", ""}, square{"channel.section", "square"},
    elongated{"table.axial_ratio", ""};

const std::array table = {
    key<&Spec::identifier>({"table.identifier", "", "name of the table: letters, digits and hyphens", Word{}}),
    key<&Spec::stiffness_key>({"table.stiffness", "",
                               "the swept modulus, cell.bulk.young_modulus_kPa or cell.cortex.modulus_mN_per_m, or "
                               "\"combined\"; by itself that of the bulk if it has a law",
                               Word{}, absent}),
    key<&Spec::min_area_um2>(
        renamed({"table.min_area_um2", "um2", "area of the smallest cells, deformed", Number{{1e-3, 1e8}}, 30.0},
                "table.least_area_um2")),
    key<&Spec::max_area_um2>(
        renamed({"table.max_area_um2", "um2", "area of the largest cells, deformed", Number{{1e-3, 1e8}}, 290.0},
                "table.greatest_area_um2")),
    key<&Spec::min_deformation>(
        renamed({"table.min_deformation", "", "deformation of the stiffest cells", Number{{1e-7, 0.9}}, 5e-5},
                "table.least_deformation")),
    key<&Spec::max_deformation>(renamed({"table.max_deformation", "",
                                         "deformation of the softest cells; for elongated cells with bulk and cortex "
                                         "the part of the flow, in addition to that of the tension",
                                         Number{{1e-7, 0.9}}, 0.19},
                                        "table.greatest_deformation")),
    key<&Spec::radii>({"table.radii", "", "number of branches, equally spaced in the radius of the sphere",
                       Number{{2, 10000}, true}, 100.0}),
    key<&Spec::rows_per_radius>({"table.rows_per_radius", "",
                                 "number of rows of a full branch, at deformations of constant ratio",
                                 Number{{2, 10000}, true}, 120.0}),
    key<&Spec::accuracy>(
        {"table.accuracy", "", "requested relative accuracy of the deformation", Number{{1e-7, 1e-1}}, 2e-4}),
    key<&Spec::bending_beyond_kBT>(
        {"table.bending_beyond_kBT", "kBT",
         "bending stiffness with which branches continue where the bare surface is unstable, 0 = branches end there",
         Number{{0, 1e12}}, 0.0}),
    key<&Spec::bending_beyond_ratio>(
        {"table.bending_beyond_ratio", "",
         "the same in a square channel, over E r0^3 or E2D r0^2 of the cell; 3e-5 changes "
         "d by less than 0.7 % where both exist, up to 1 % for cells above 280 um2 of a 20 um channel",
         Number{{0, max_bending_ratio}}, 0.0, square}),
    key<&Spec::bending_from_margin>({"table.bending_from_margin", "",
                                     "stability margin of the bare surface, 1 at rest and 0 where it loses stability, "
                                     "below which bending_beyond_ratio stabilises it",
                                     Number{{0, 0.9}}, 0.0, square}),
    key<&Spec::cortex_fractions>(renamed(
        {"table.cortex_fraction", "", "fractions of the cortex in the stiffness of combined cells, one sheet for each",
         List{{0, 1}, true}, absent},
        "table.cortex_share")),
    key<&Spec::tension_ratios>({"table.tension_ratio", "",
                                "tensions of combined cells as fractions of the modulus of the cortex",
                                List{{0, 1e3}, true}, absent, combined}),
    key<&Spec::axial_ratios>({"table.axial_ratio", "",
                              "tensions of the liquid along the flow, flow.axial_tension_Pa, as fractions of the swept "
                              "stiffness: cells that are elongated; 0 must be among them",
                              List{{-0.5, 5}, true}, absent}),
    key<&Spec::elongation>({"table.elongated_by", "",
                            "cause of the elongation of the cells of table.axial_ratio: the tension, or the shape at "
                            "rest (cell.rest_aspect) that a sphere would take under that tension without flow",
                            Choice{{"tension", "rest-shape"}}, 0, elongated}),
    key<&Spec::bending_ratio>({"table.bending_ratio", "",
                               "bending stiffness of combined cells over S r0^3, 0 = cell.cortex.bending_kBT",
                               Number{{0, 1}}, 0.0, combined}),
    key<&Spec::max_deformation_raw>(renamed({"table.max_deformation_raw", "",
                                             "deformation of the contour itself, with the dent that the hull hides, at "
                                             "which combined branches end",
                                             Number{{1e-7, 1}}, 1.0, combined},
                                            "table.greatest_deformation_raw")),
    key<&Spec::computed_radii>({"table.computed_radii", "",
                                "number of branches that are computed; all others are interpolated",
                                Number{{4, 30}, true}, 8.0, square}),
    key<&Spec::computed_states>({"table.computed_states", "", "number of states that are computed on each of them",
                                 Number{{4, 20}, true}, 6.0, square}),
    key<&Spec::tube_table>({"table.tube_table", "",
                            "table of the tube, relative to which states are interpolated: identifier of a table of "
                            "the program, or a file grid_*.cbor",
                            Word{}, absent, square}),
};

}  // namespace

std::span<const Key<TableSpec>> table_keys() { return table; }

Reference table_reference() {
  return {.title = "Table reference",
          .topic = "table",
          .declaration = "src/table/table_keys.cc",
          .opening = "The spec of a look-up table is a text file in TOML. The shortest one:",
          .example = R"([channel]
width_um = 20.0
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
[table]
identifier = "my-first-table"
)",
          .rules =
              "It has all keys of a case (`rheocyte help case`) but cell.radius_um, the modulus that is swept,\n"
              "flow.drive, and numerics.accuracy; and those of the section [table]. `--set key=value` replaces a key\n"
              "of the file. The options of the command: `rheocyte table --help`.\n",
          .keys = key_list(table_keys())};
}

}  // namespace rheocyte
