// Look-up tables of moduli as the field publishes them: text files with area, deformation and Young's modulus.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "table/table_text.h"

namespace rheocyte {

/// A table for one channel, flow rate and viscosity; other conditions follow from it by scaling.
struct PublishedTable {
  std::string identifier;  ///< e.g. "LE-2D-FEM-19"
  double channel_width_um = 0, flow_rate_ul_s = 0, viscosity_mPas = 0;
  Abscissa abscissa = Abscissa::area;
  /// Equally long: area (um^2) or volume (um^3) of a cell, its deformation, its Young's modulus (kPa).
  std::vector<double> size, deformation, modulus_kPa;
};

/// Reads a table in the format of dclab, or lines with their key. UserError with file and line as read_table_text; also
/// for a missing name, fewer than three rows, no positive deformation.
PublishedTable read_published_table(const std::filesystem::path& file,
                                    const char* identifier_key = table_identifier_key);

}  // namespace rheocyte
