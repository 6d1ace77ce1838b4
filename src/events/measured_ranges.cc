#include "events/measured_ranges.h"

#include <variant>

#include "case/case_keys.h"

namespace rheocyte {

namespace {

Range range_of_key(std::string_view key) { return std::get<Number>(case_key(key).kind).range; }

}  // namespace

MeasuredRanges measured_ranges() {
  return {range_of_key("channel.width_um"), range_of_key("flow.rate_ul_per_s"), {0.01, 10}};
}

}  // namespace rheocyte
