// Buffers of measurements and their viscosity.
#include <pybind11/stl.h>

#include <string>

#include "case/user_error.h"
#include "events/recording_temperature.h"
#include "numeric/no_value.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/buffer.h"

namespace rheocyte {

namespace py = pybind11;

void viscosities_at(const Buffer& buffer, const ChannelFlow& flow, std::span<const double> celsius,
                    std::span<double> mPas) {
  buffer.viscosity(flow, celsius, mPas);
  for (std::size_t i = 0; i < celsius.size(); ++i)
    if (!is_possible_temperature(celsius[i])) mPas[i] = no_value;
}

namespace {

Buffer buffer_of(const std::string& medium_name, const std::string& model_name) {
  const auto medium = medium_of_name(medium_name);
  if (!medium)
    throw UserError("the medium \"" + one_line(medium_name, 60) + "\" has no known viscosity" +
                    near_medium(medium_name) +
                    "; give viscosity_mPas, or one of CellCarrier, CellCarrierB, 0.83% MC-PBS, "
                    "water.");
  const auto model = viscosity_model_of_name(model_name);
  if (!model)
    throw UserError("unknown viscosity model " + one_line(model_name, 60) +
                    "; there are buyukurganci-2022 and herold-2017.");
  return {*medium, *model};
}

py::array_t<double> viscosities(const Buffer& buffer, double width_um, double rate_ul_s, const Numbers& celsius) {
  py::array_t<double> result(celsius.size());
  viscosities_at(buffer, {.width_um = width_um, .rate_ul_s = rate_ul_s}, span_of(celsius), span_to_fill(result));
  return result;
}

}  // namespace

const Binding bind_media([](py::module_& module) {
  py::class_<Buffer>(module, "Buffer")
      .def(py::init(&buffer_of))
      .def("flow_exponent", &Buffer::flow_exponent)
      .def("viscosity", &viscosities);
  module.attr("possible_temperatures_C") = py::make_tuple(lowest_temperature_C, highest_temperature_C);
});

}  // namespace rheocyte
