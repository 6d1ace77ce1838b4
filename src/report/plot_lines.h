// Isoelasticity lines and the region where a table has moduli, for the panels of one picture.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "infer/isoelasticity_lines.h"
#include "report/plot_panel.h"
#include "shelf/modulus_tables.h"

namespace rheocyte {

class PlotLines {
 public:
  /// Lines of the table or the file of the options; else of the tables that come with the program. UserError.
  explicit PlotLines(const PlotOptions& options);

  LinesWanted wanted() const { return wanted_; }

  /// Why none are drawn, where somebody could miss them: area or deformation against another feature; else empty.
  std::string why_none() const;

  /// What the drawing program needs, as a recording sees it: "lines" with areas (um^2), deformations and moduli (kPa),
  /// "table" with the identifier, "pixels" (um) and, of a table, "support".
  nlohmann::json for_panel(const PlotPanel& panel);

 private:
  IsoelasticityLines lines_of(const ModulusMap& map, const PlotPanel& panel) const;

  const PlotOptions& options_;
  LinesWanted wanted_ = LinesWanted::no;
  std::optional<IsoelasticityLines> given_lines_;
  std::optional<ModulusTables> tables_;  ///< nothing if lines come from a file
};

}  // namespace rheocyte
