#include "table/checked_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "numeric/fingerprint.h"

namespace rheocyte {

namespace {

static_assert(std::endian::native == std::endian::little, "records hold little-endian numbers");

using nlohmann::json;

std::string as_text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

std::string envelope(const RecordKind& kind, std::string_view format, const std::vector<std::uint8_t>& record,
                     const std::string& spec_hash) {
  return as_text(json::to_cbor(json{{"kind", kind.kind},
                                    {"format", format},
                                    {"spec", spec_hash},
                                    {"checksum", fingerprint(as_text(record) + spec_hash)},
                                    {"record", json::binary(record)}}));
}

template <class Number>
json blob(std::span<const Number> values) {
  std::vector<std::uint8_t> bytes(values.size_bytes());
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return json::binary(std::move(bytes));
}

template <class Number>
std::vector<Number> values_in(const std::vector<std::uint8_t>& bytes) {
  std::vector<Number> values(bytes.size() / sizeof(Number));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

json json_of(std::string_view bytes) {
  if (!is_sound_json(bytes, json::input_format_t::cbor)) throw DamagedRecord{"it is cut or damaged"};
  return json::from_cbor(bytes.begin(), bytes.end());
}

}  // namespace

void check_record(bool good, const char* what) {
  if (!good) throw DamagedRecord{what};
}

json blob_of(std::span<const double> values) { return blob(values); }

json single_blob_of(std::span<const double> values) {
  std::vector<float> rounded(values.size());
  std::ranges::transform(values, rounded.begin(), [](double value) {
    constexpr double greatest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -greatest, greatest));
  });
  return blob(std::span<const float>(rounded));
}

std::vector<double> numbers_of(const json& record, const char* key, std::size_t size) {
  const auto& bytes = record.at(key).get_binary();
  if (bytes.size() == size * sizeof(double)) return values_in<double>(bytes);
  if (bytes.size() != size * sizeof(float)) throw DamagedRecord{fmt::format("{} has another length", key)};
  const auto values = values_in<float>(bytes);
  return {values.begin(), values.end()};
}

std::string sealed_record(const RecordKind& kind, const std::string& spec_hash, const json& record) {
  return envelope(kind, kind.format, json::to_cbor(record), spec_hash);
}

OpenedRecord opened_record(const RecordKind& kind, std::string_view bytes) {
  const json outer = json_of(bytes);
  if (outer.at("kind") != kind.kind) throw DamagedRecord{fmt::format("it is not a {}", kind.kind)};
  const std::string format = outer.at("format");
  if (format != kind.format && (kind.older_format.empty() || format != kind.older_format))
    throw DamagedRecord{
        fmt::format("it was written by another build, in format {} and not {}", json(format).dump(), kind.format)};
  const std::vector<std::uint8_t> record = outer.at("record").get_binary();
  const std::string spec = outer.at("spec");
  if (envelope(kind, format, record, spec) != bytes) throw DamagedRecord{"its checksum is wrong"};
  return {spec, json_of(as_text(record))};
}

void refuse_record(const RecordKind& kind, const std::string& name, const std::string& reason) {
  throw UserError(fmt::format("{}: this {} cannot be used: {}; {}.", name, kind.noun, reason, kind.way_out));
}

}  // namespace rheocyte
