#include "infer/published_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/user_error.h"
#include "table/scale.h"

namespace rheocyte {

PublishedTable read_published_table(const std::filesystem::path& file, const char* identifier_key) {
  const TableText text = read_table_text(file);
  const auto refuse = [&](const std::string& reason) {
    throw UserError(fmt::format("{}: {}", one_line(file.string(), 300), reason));
  };
  const auto identifier = text.metadata.find(identifier_key);
  if (identifier == text.metadata.end() || !identifier->is_string())
    refuse(fmt::format("the metadata need a text \"{}\".", identifier_key));
  const ChannelConditions made_at = conditions_of(text);
  PublishedTable table{one_line(identifier->get<std::string>(), 100),
                       made_at.channel_width_um,
                       made_at.flow_rate_ul_s,
                       made_at.viscosity_mPas,
                       text.abscissa,
                       {},
                       {},
                       {}};
  for (const auto& [size, deformation, modulus] : text.rows) {
    table.size.push_back(size);
    table.deformation.push_back(deformation);
    table.modulus_kPa.push_back(modulus);
  }
  if (text.rows.size() < 3) refuse("has fewer than three rows.");
  if (!(std::ranges::max(table.deformation) > 0)) refuse("no row has a positive deformation.");
  return table;
}

}  // namespace rheocyte
