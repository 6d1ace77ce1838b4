#include "view/case_from_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "case/case_keys.h"
#include "case/keys_in_json.h"
#include "case/read_case.h"
#include "numeric/number_from_chars.h"

namespace rheocyte {

namespace {

/// How much stiffer than the last state that was found: there its surface need not be stable on every mesh.
constexpr double safety = 1.01;

/// Up to three digits.
double rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::ceil(value / unit) * unit;
}

double number_in(const std::string& text) {
  double number = std::nan("");
  number_from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

Case case_from_json(const nlohmann::ordered_json& tree, const std::string& accuracy) {
  const std::string name = "case";
  std::vector<GivenKey> given = keys_in_json(tree, name);
  if (!accuracy.empty()) given.push_back({"numerics.accuracy", "accuracy", number_in(accuracy), true});
  KeyReading keys(key_list(case_keys()), std::move(given), name, "case");
  return complete_case(keys);
}

Case nearest_existing(Case c, double reached) {
  const double wanted = c.cell.bulk.young_modulus_kPa.value_or(c.cell.cortex.modulus_mN_per_m.value_or(1));
  const double factor = rounded_up(wanted * safety / reached) / wanted;
  for (auto* stiffness :
       {&c.cell.bulk.young_modulus_kPa, &c.cell.cortex.modulus_mN_per_m, &c.cell.cortex.tension_mN_per_m})
    if (*stiffness) **stiffness *= factor;
  c.cell.cortex.bending_kBT *= factor;
  return c;
}

}  // namespace rheocyte
