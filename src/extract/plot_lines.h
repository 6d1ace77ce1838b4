// Lines of equal modulus and the region where a table has moduli, for the panels of one picture.
#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "extract/line_source.h"
#include "extract/modulus_tables.h"
#include "extract/plot_panel.h"

namespace rheocyte {

class PlotLines {
 public:
  /// Lines of the table or the file of the options; else of the tables that come with the program. UserError.
  explicit PlotLines(const PlotOptions& options);

  LinesWanted wanted() const { return wanted_; }

  /// What the drawing program needs, as a recording sees it: "lines" with areas (um^2), deformations and moduli (kPa),
  /// "table" with the identifier, "pixels" (um) and, of a table, "support".
  nlohmann::json for_panel(const PlotPanel& panel);

 private:
  /// Nothing if the lines come from a file.
  const LineSource* source_for(double flow_exponent);
  LevelLines lines_from(const LineSource& source, const PlotPanel& panel) const;

  const PlotOptions& options_;
  LinesWanted wanted_ = LinesWanted::no;
  std::optional<LevelLines> given_lines_;
  std::optional<LineSource> given_table_;
  std::optional<ModulusTables> own_tables_;
  std::map<std::filesystem::path, LineSource> own_sources_;  ///< of the own tables, once one is needed
};

}  // namespace rheocyte
