#include "infer/moduli_estimate.h"

#include <fmt/format.h>

namespace rheocyte {

std::string_view name_of(ModuliStatus status) {
  switch (status) {
    case ModuliStatus::no_data: return "no-data";
    case ModuliStatus::resolved: return "resolved";
    case ModuliStatus::not_told_apart: return "not-told-apart";
    case ModuliStatus::outside_table: return "outside-table";
    case ModuliStatus::poor_fit: return "poor-fit";
    case ModuliStatus::gated: return "gated";
    case ModuliStatus::cut: return "cut-by-the-edge";
    case ModuliStatus::count: break;
  }
  return "";
}

double ModuliEstimate::error(Modulus m) const { return std::sqrt(covariance(int(m), int(m))); }

std::string sentence(const ModuliEstimate& e) {
  const auto stated = [&](Modulus m, std::string_view name, std::string_view unit) {
    return fmt::format("{} = {:.3g} +- {:.2g} {}", name, e.value(m), e.error(m), unit);
  };
  switch (e.status) {
    case ModuliStatus::no_data: return "There is no shape, or its error is unknown.";
    case ModuliStatus::outside_table: return "No cell of the table has such a shape.";
    case ModuliStatus::gated: return "The event lies outside the limits that were set.";
    case ModuliStatus::cut: return "The outline touches the edge of the picture: it is not that of the whole cell.";
    case ModuliStatus::poor_fit:
      return fmt::format(
          "The nearest cell of the table differs from the shape by more than its errors "
          "(chi2 = {:.3g} at {} degrees of freedom).",
          e.chi_squared, e.freedom);
    case ModuliStatus::resolved:
      return fmt::format("{}, {}.", stated(Modulus::young, "E", "kPa"), stated(Modulus::cortex, "E2D", "mN/m"));
    case ModuliStatus::not_told_apart:
    case ModuliStatus::count: break;
  }
  std::string known = fmt::format("E + E2D / r0 = {:.3g} +- {:.2g} kPa", e.stiffness_kPa, e.stiffness_error_kPa);
  if (e.is_known[std::size_t(Modulus::young)]) known += ", " + stated(Modulus::young, "E", "kPa");
  if (e.is_known[std::size_t(Modulus::cortex)]) known += ", " + stated(Modulus::cortex, "E2D", "mN/m");
  return fmt::format("The data do not determine the moduli separately; they determine {}.", known);
}

}  // namespace rheocyte
