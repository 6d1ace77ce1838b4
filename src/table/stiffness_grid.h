// The stiffness of a cell from its area and deformation, millions of times a second: a table as a structured grid.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "table/curved_grid.h"
#include "table/out_of_table.h"
#include "table/shape_grid.h"
#include "table/table_origin.h"

namespace rheocyte {

/// Between two curves in the plane of ln(area) and ln(deformation), rows at equal distances in each column. Vectors
/// with one value per column, or columns x rows with the rows of a column behind each other.
struct GridPatch {
  bool regularised = false;  ///< of the branches that a bending stiffness holds smooth
  int first_column = 0, columns = 0, rows = 0;
  std::vector<double> lower, upper;   ///< ln(deformation) of the first and the last row
  std::vector<double> log_stiffness;  ///< at the nodes
  std::vector<double> error;          ///< relative, of the stiffness, at the nodes
  std::vector<double> beyond;         ///< why there is nothing above the last row: a OutOfTable as a number
};

/// All that a file of a grid holds.
struct GridContent {
  TableOrigin origin;
  double min_log_area = 0, column_step = 0;  ///< ln(um^2)
  int columns = 0;
  std::vector<GridPatch> patches;         ///< the bare surface's first; each lies on top of the one before
  std::optional<ShapeNodes> shapes = {};  ///< of the bare surface; grids of older versions have none
};

struct GridAnswer {
  double log_stiffness = 0;                        ///< ln(kPa) or ln(mN/m)
  double by_log_area = 0, by_log_deformation = 0;  ///< its derivatives
  double error = 0;                                ///< estimated, relative, as in StiffnessAnswer
  OutOfTable reason = OutOfTable::none;            ///< if there is one, the numbers mean nothing
  bool regularised = false;
};

/// Bicubic (Hermite) in the logarithms, with slopes from five nodes. The curved end of the smooth branches is a line of
/// the grid (docs/tables.md, sec. "grid").
class StiffnessGrid {
 public:
  explicit StiffnessGrid(GridContent content);

  const GridContent& content() const { return content_; }
  const TableOrigin& origin() const { return content_.origin; }

  /// Logarithms of area (um^2) and deformation; -infinity is a deformation of zero, NaN no number. Equally long
  /// (asserted).
  void answer(std::span<const double> log_area, std::span<const double> log_deformation,
              std::span<GridAnswer> answers) const;
  GridAnswer answer(double area_um2, double deformation) const;
  /// The logarithms of the stiffnesses alone; NaN where there is none.
  void values(std::span<const double> log_area, std::span<const double> log_deformation,
              std::span<double> log_stiffness) const;

  /// ln(deformation) of the first and the last smooth state of a bare surface at an area; nothing outside the areas.
  struct Range {
    double lower, upper;
  };
  std::optional<Range> smooth_range(double area_um2) const;

 private:
  struct Patch {
    explicit Patch(const GridPatch&);

    bool regularised;
    int first_column;
    CurvedGrid grid;
    CurvedGrid::Field log_stiffness;
    std::vector<double> cell_error;  ///< by the first of a cell's four nodes
    std::vector<OutOfTable> beyond;
  };
  struct Place;
  Place place_of(double log_area, double log_deformation) const;
  double value_at(const Place&) const;
  void answer_at(const Place&, GridAnswer& answer) const;
  /// take(number, place of the event) for all.
  template <class Take>
  void at_places(std::span<const double> log_area, std::span<const double> log_deformation, const Take& take) const;

  GridContent content_;
  std::vector<Patch> patches_;
};

/// The file of a grid: CBOR with a checksum.
std::string to_bytes(const GridContent&);
/// UserError naming `name` if the bytes are damaged or no grid.
GridContent grid_from_bytes(std::string_view bytes, const std::string& name);
/// Bytes of its file at most.
inline constexpr std::size_t largest_grid = std::size_t{64} << 20U;

/// Name of the file beside the other files of a table: grid_<identifier>.cbor.
std::string grid_file_name(const std::string& identifier);

}  // namespace rheocyte
