#include "measurement/viscosity.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "case/user_error.h"
#include "numeric/no_value.h"
#include "numeric/whole_packets.h"

namespace rheocyte {

namespace {

// Events that are worked on together: their columns stay in the fastest memory.
constexpr std::size_t block_size = 512;
using Array = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, block_size, 1>;

constexpr double kelvin_at_0_celsius = 273.15;

constexpr double exponent_per_kelvin = 0.00223, activation_in_kelvin = 3379.7;  // of methyl cellulose, by Buyukurganci

/// eta = 1000 K g^(n - 1) with K = factor exp(activation_in_kelvin / Tk) and n = 0.00223 Tk + offset.
struct PowerLawOfTemperature {
  double factor, offset;
};

PowerLawOfTemperature buyukurganci(Medium medium) {
  switch (medium) {
    case Medium::methyl_cellulose_049: return {2.30e-6, -0.0056};
    case Medium::methyl_cellulose_059: return {5.70e-6, -0.0744};
    default: return {16.52e-6, -0.1455};
  }
}

void buyukurganci_viscosity(Medium medium, const ChannelFlow& flow, const Array& celsius, Array& viscosity) {
  const auto [factor, offset] = buyukurganci(medium);
  const double width_mm = 1e-3 * flow.width_um;
  const double shear_scale = 8 * flow.rate_ul_s / (width_mm * width_mm * width_mm);
  const Array kelvin = celsius + kelvin_at_0_celsius;
  const Array n = exponent_per_kelvin * kelvin + offset;
  // One exponential for the consistency and the power of the shear rate together.
  viscosity = 1000 * factor *
              (activation_in_kelvin / kelvin + (n - 1) * (std::log(shear_scale) + (0.6671 + 0.2121 / n).log())).exp();
}

/// The consistency (Pa s^n) at the reference temperature (degC) falls like its power -0.866.
struct PowerLawAtReference {
  double consistency, exponent, reference;
};
constexpr double herold_power_of_temperature = -0.866;

PowerLawAtReference herold(Medium medium) {
  if (medium == Medium::methyl_cellulose_049) return {0.179, 0.677, 23.2};
  return {0.360, 0.634, 23.6};
}

void herold_viscosity(Medium medium, const ChannelFlow& flow, const Array& celsius, Array& viscosity) {
  const auto [consistency, n, reference] = herold(medium);
  const double width_m = 1e-6 * flow.width_um;
  const double shear = 1.1856 * 6 * (1e-9 * flow.rate_ul_s) / (width_m * width_m * width_m) * 2 / 3;
  // 0.6771 as the field's programs have it, although the shear rate of the other model has 0.6671.
  const double profile = 0.6771 / 0.5928 + 0.2121 / (0.5928 * n);
  const double at_reference = 1000 * consistency * std::pow(shear * profile, n - 1);
  viscosity = at_reference * (herold_power_of_temperature * (celsius / reference).log()).exp();
}

void water_viscosity(const Array& celsius, Array& viscosity) {
  const Array below_20 = 20 - celsius;
  const Array series = 1.2364 - 1.37e-3 * below_20 + 5.7e-6 * below_20.square();
  viscosity = 1.002 * (std::log(10.0) * below_20 / (celsius + 96) * series).exp();
}

}  // namespace

std::optional<ViscosityModel> viscosity_model_of_name(std::string_view name) {
  for (const auto model : {ViscosityModel::buyukurganci_2022, ViscosityModel::herold_2017, ViscosityModel::kestin_1978})
    if (name == name_of(model)) return model;
  return std::nullopt;
}

std::string_view name_of(ViscosityModel model) {
  switch (model) {
    case ViscosityModel::buyukurganci_2022: return "buyukurganci-2022";
    case ViscosityModel::herold_2017: return "herold-2017";
    default: return "kestin-1978";
  }
}

Buffer::Buffer(Medium medium, ViscosityModel model)
    : medium_(medium), model_(medium == Medium::water ? ViscosityModel::kestin_1978 : model) {
  if (model_ == ViscosityModel::herold_2017 && medium_ == Medium::methyl_cellulose_083)
    throw UserError(
        "The viscosity model herold-2017 does not know 0.83% MC-PBS; take buyukurganci-2022, or give the "
        "viscosity itself.");
  if (model_ == ViscosityModel::kestin_1978 && medium_ != Medium::water)
    throw UserError(
        fmt::format("The viscosity model kestin-1978 is for water only, the medium is {}; take "
                    "buyukurganci-2022 or herold-2017.",
                    name_of(medium_)));
}

TemperatureRange Buffer::measured() const {
  switch (model_) {
    case ViscosityModel::buyukurganci_2022: return {22, 37};
    case ViscosityModel::herold_2017: return {18, 26};
    default: return {0, 40};
  }
}

void Buffer::viscosity(const ChannelFlow& flow, std::span<const double> celsius,
                       std::span<double> viscosity_mPas) const {
  assert(celsius.size() == viscosity_mPas.size());
  for (std::size_t first = 0; first < celsius.size(); first += block_size) {
    const std::size_t count = std::min(block_size, celsius.size() - first);
    viscosity_of_block(flow, celsius.subspan(first, count), viscosity_mPas.subspan(first, count));
  }
}

void Buffer::viscosity_of_block(const ChannelFlow& flow, std::span<const double> celsius,
                                std::span<double> viscosity_mPas) const {
  Array source = Array::Constant(whole_packets(celsius.size()), 20), target = source;
  std::ranges::copy(celsius, source.data());
  if (medium_ == Medium::water)
    water_viscosity(source, target);
  else if (!(flow.rate_ul_s > 0) || !(flow.width_um > 0))
    target.setConstant(no_value);
  else if (model_ == ViscosityModel::herold_2017)
    herold_viscosity(medium_, flow, source, target);
  else
    buyukurganci_viscosity(medium_, flow, source, target);
  for (std::size_t i = 0; i < celsius.size(); ++i)
    viscosity_mPas[i] = std::isfinite(celsius[i]) ? target[static_cast<Eigen::Index>(i)] : no_value;
}

double Buffer::viscosity(const ChannelFlow& flow, double celsius) const {
  double value = no_value;
  viscosity(flow, {&celsius, 1}, {&value, 1});
  return value;
}

double Buffer::flow_exponent(double celsius) const {
  if (medium_ == Medium::water) return 1;
  if (model_ == ViscosityModel::herold_2017) return herold(medium_).exponent;
  return exponent_per_kelvin * (celsius + kelvin_at_0_celsius) + buyukurganci(medium_).offset;
}

double Buffer::consistency_Pa_sn(double celsius) const {
  if (medium_ == Medium::water) return 1e-3 * viscosity({}, celsius);
  if (model_ == ViscosityModel::buyukurganci_2022)
    return buyukurganci(medium_).factor * std::exp(activation_in_kelvin / (celsius + kelvin_at_0_celsius));
  const auto [consistency, exponent, reference] = herold(medium_);
  return consistency * std::pow(celsius / reference, herold_power_of_temperature);
}

}  // namespace rheocyte
