#include "extract/extract_summary.h"

#include <fmt/format.h>

#include <cmath>

#include "case/user_error.h"

namespace rheocyte {

std::string in_one_line(const ExtractSummary& s) {
  std::string text = fmt::format("{} of {} events", s.with_modulus(), s.recorded), parts;
  for (std::size_t k = 0; k < s.counts.size(); ++k)
    if (const auto state = static_cast<ModulusState>(k); s.counts[k] > 0 && has_modulus(state))
      parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", s.counts[k], name_of(state));
  if (s.with_modulus() > s.counts.front()) text += fmt::format(" ({})", parts);
  if (s.with_modulus() > 0)
    text += fmt::format(", E median {} kPa (quartiles {:.4g} to {:.4g})", median_text(s.modulus_kPa),
                        s.modulus_kPa.first_quartile, s.modulus_kPa.third_quartile);
  if (std::isfinite(s.median_standard_error_kPa))
    text += fmt::format(", standard error of an event {:.2g} kPa", s.median_standard_error_kPa);
  std::string others;
  for (std::size_t k = 1; k < s.counts.size(); ++k)
    if (s.counts[k] > 0 && !has_modulus(static_cast<ModulusState>(k)))
      others += fmt::format("{}{} {}", others.empty() ? "" : ", ", s.counts[k], names_of_modulus_states[k]);
  return others.empty() ? text : text + "; " + others;
}

}  // namespace rheocyte
