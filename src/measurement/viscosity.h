// Viscosity of the measurement buffers of RT-DC in the channel (docs/theory-extract.md, sec. "viscosity").
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "case/channel_flow.h"
#include "measurement/medium.h"

namespace rheocyte {

/// Metadata of virtual recordings whose liquid has no name: its viscosity (mPa s).
inline constexpr const char* viscosity_key = "user:rheocyte viscosity_mPas";

enum class ViscosityModel {
  buyukurganci_2022,  ///< Buyukurganci et al. 2022, doi 10.1039/D2SM01515C
  herold_2017,        ///< Herold 2017, arXiv:1704.00572; knows no 0.83 %
  kestin_1978         ///< water: Kestin, Sokolov, Wakeham 1978, doi 10.1063/1.555581
};

/// "buyukurganci-2022", "herold-2017", "kestin-1978" or nothing.
std::optional<ViscosityModel> viscosity_model_of_name(std::string_view name);
std::string_view name_of(ViscosityModel model);

/// Temperatures (degC) for which a model was measured; outside it extrapolates.
struct TemperatureRange {
  double lowest, highest;
  bool contains(double celsius) const { return celsius >= lowest && celsius <= highest; }
};

/// A medium with the model of its viscosity.
class Buffer {
 public:
  /// UserError if the model does not know the medium. Water has a model of its own, whichever is asked for.
  Buffer(Medium medium, ViscosityModel model);

  Medium medium() const { return medium_; }
  ViscosityModel model() const { return model_; }
  TemperatureRange measured() const;

  /// Effective viscosity at the wall (mPa s) of a channel of this width and rate, one value per temperature (degC). A
  /// flow rate of zero gives NaN for shear-thinning media, a temperature that is not finite gives NaN. The spans are
  /// equally long (asserted).
  void viscosity(const ChannelFlow& flow, std::span<const double> celsius, std::span<double> viscosity_mPas) const;

  /// The same at one temperature.
  double viscosity(const ChannelFlow& flow, double celsius) const;

  /// n of eta ~ (shear rate)^(n - 1) at a temperature (degC); 1 for water.
  double flow_exponent(double celsius) const;
  /// K of eta = K (shear rate)^(n - 1) in Pa s^n, at a temperature (degC); the viscosity of water.
  double consistency_Pa_sn(double celsius) const;

 private:
  void viscosity_of_block(const ChannelFlow& flow, std::span<const double> celsius,
                          std::span<double> viscosity_mPas) const;

  Medium medium_;
  ViscosityModel model_;
};

}  // namespace rheocyte
