// For what a table was computed.
#pragma once
#include <string>
#include <string_view>

#include "case/channel_flow.h"

namespace rheocyte {

/// For what a table was computed, and by what; of published tables only identifier and flow are known.
struct TableOrigin {
  std::string identifier;  ///< e.g. "LE-2D-26"
  std::string model;       ///< e.g. "linear solid / newtonian fluid"
  std::string program;     ///< name and version
  std::string spec;        ///< the complete spec of the table
  ChannelFlow flow;
  bool is_shell = false;            ///< the stiffness is the modulus of a cortex (mN/m), not Young's modulus (kPa)
  Section section = Section::tube;  ///< of the channel

  /// In one line.
  std::string description() const;
  /// Its cells alone, as in cells_in_words.
  std::string cells() const;
};

/// The cells of a model, e.g. "linear solids in the tube", "neo-Hookean solids in the square channel"; empty if the
/// model is.
std::string cells_in_words(std::string_view model, Section section);

/// What determines which recordings a grid is for.
struct GridHead {
  double flow_exponent = 1;
  Section section = Section::tube;
  std::string model = {};  ///< of cell and liquid, as in TableOrigin
};

}  // namespace rheocyte
