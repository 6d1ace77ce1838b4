// The tables of one call of `rheocyte extract` or `rheocyte plot`, and which of them a recording gets.
#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "infer/elongated_liquid.h"
#include "infer/modulus_map.h"
#include "infer/proportioned_cells.h"

namespace rheocyte {

/// A difference of flow exponents up to which a liquid and that of a table count as alike.
inline constexpr double flow_exponent_tolerance = 0.035;

/// A table of elongated cells that comes with the program.
struct ElongatedFile {
  std::filesystem::path file;
  double flow_exponent;
};
/// That of the nearest liquid; none where none comes with the program. `folder` as in shipped_tables.h.
std::optional<ElongatedFile> elongated_file(double flow_exponent, const std::filesystem::path& folder = {});

/// The table of elongated cells that the user names: a file elongated_*.cbor, a folder of `rheocyte table` with one, or
/// the identifier of one that comes with the program. UserError.
ElongatedContent given_elongated_table(const std::string& name);

/// Tables that come with the program are chosen by their metadata, and read when they are needed.
class ModulusTables {
 public:
  /// The table that the user names (as in find_table); if the name is empty those for a section that come with the
  /// program, of which there is at least one, else UserError. Without a section those of the square channel, or of the
  /// tube where there are no others. `folder`: of the tables that come with the program (shipped_tables.h).
  explicit ModulusTables(const std::string& name, std::optional<Section> section = {},
                         std::filesystem::path folder = {});

  /// For a medium with eta ~ (shear rate)^(n - 1) that thins the table whose liquid has its exponent n, if there is
  /// one; else the one of a Newtonian liquid, with the effective viscosity. A table that the user names is used always.
  /// UserError if the table cannot be read.
  const ModulusMap& used(double flow_exponent) const;
  /// Its file.
  const std::filesystem::path& file(double flow_exponent) const { return choose(flow_exponent).used->file; }
  /// To compare with: the other way to take a shear-thinning liquid; null if there is none.
  const ModulusMap* other(double flow_exponent) const;

  /// What cells look like: by the table that is used, or that of a Newtonian liquid that comes with the program; null
  /// if neither knows.
  const ShapeMap* shapes(double flow_exponent) const;

  /// Of cells that are elongated along the flow, in the square channel: the table that comes with the program for this
  /// liquid, or that of the nearest one changed to it; null in the tube, and where there is none.
  const ElongatedLiquid* elongated(double flow_exponent) const;

  /// Cells with a cortex, in the proportions of HL60 cells, for the effective modulus; none without the tables that
  /// come with the program. UserError if a table cannot be read.
  ProportionedTables proportioned(double flow_exponent) const;

  /// Of all that can be used.
  std::vector<std::filesystem::path> files() const;
  /// Tables that come with the program for cells of other laws or in the other section, one for each kind of cells:
  /// that of the medium with this exponent if there is one, else that of a Newtonian liquid. UserError as above.
  std::vector<const ModulusMap*> others(double flow_exponent) const;

  /// Whether they are the shipped ones of the square channel: those of the tube go on to greater deformations.
  bool are_square() const { return !given_ && section_ == Section::square; }
  Section section() const { return section_; }

  /// True if rheocyte's own tables are used, of which areas are corrected and errors known.
  bool own() const { return !given_ || tables_.front().map->is_rheocyte_table(); }

 private:
  struct Table {
    std::filesystem::path file;
    std::string identifier;
    double flow_exponent;
    std::string cells;                                        ///< as in cells_in_words
    mutable std::unique_ptr<const ModulusMap> map = nullptr;  ///< once it is needed

    const ModulusMap& ready() const;
  };
  void add_shipped();
  struct Choice {
    const Table *used, *other;
  };
  Choice choose(double flow_exponent) const;
  const Table* newtonian() const;
  const Table* matching(double flow_exponent) const;

  std::filesystem::path folder_;
  Section section_;
  std::vector<Table> tables_;
  mutable std::vector<Table> shipped_;                  ///< all of them, once others are requested
  mutable std::unique_ptr<const ModulusMap> standard_;  ///< once its shapes are needed
  /// Once it is needed: the table, and cells without elongation in its liquid and in that of the recording.
  struct Elongated {
    ElongatedSolids solids;
    std::unique_ptr<const ModulusMap> computed, measured;
    ElongatedLiquid liquid;
    Elongated(ElongatedContent content, std::unique_ptr<const ModulusMap> same,
              std::unique_ptr<const ModulusMap> other);
  };
  const ProportionedCells* proportioned_table(std::string_view identifier) const;
  mutable std::map<std::string, std::unique_ptr<const ProportionedCells>, std::less<>> proportioned_;  ///< once needed
  mutable std::map<double, std::unique_ptr<const Elongated>> elongated_;  ///< by the exponent of the recording's liquid
  bool given_ = false;                                                    ///< the first one is the user's choice
};

}  // namespace rheocyte
