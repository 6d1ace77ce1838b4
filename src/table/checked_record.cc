#include "table/checked_record.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>

#include "case/json_guard.h"
#include "case/user_error.h"
#include "numeric/fingerprint.h"

namespace rheocyte {

namespace {

static_assert(std::endian::native == std::endian::little, "records hold little-endian numbers");

using nlohmann::json;

std::string as_text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

std::string envelope(const RecordKind& kind, const std::vector<std::uint8_t>& record, const std::string& spec_hash) {
  return as_text(json::to_cbor(json{{"kind", kind.kind},
                                    {"format", kind.format},
                                    {"spec", spec_hash},
                                    {"checksum", fingerprint(as_text(record) + spec_hash)},
                                    {"record", json::binary(record)}}));
}

json json_of(std::string_view bytes) {
  if (!is_sound_json(bytes, json::input_format_t::cbor)) throw DamagedRecord{"it is cut or damaged"};
  return json::from_cbor(bytes.begin(), bytes.end());
}

}  // namespace

void check_record(bool good, const char* what) {
  if (!good) throw DamagedRecord{what};
}

json blob_of(std::span<const double> values) {
  std::vector<std::uint8_t> bytes(values.size_bytes());
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return json::binary(std::move(bytes));
}

std::vector<double> numbers_of(const json& record, const char* key, std::size_t size) {
  const auto& bytes = record.at(key).get_binary();
  if (bytes.size() != size * sizeof(double)) throw DamagedRecord{fmt::format("{} has another length", key)};
  std::vector<double> values(size);
  if (size > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::string sealed_record(const RecordKind& kind, const std::string& spec_hash, const json& record) {
  return envelope(kind, json::to_cbor(record), spec_hash);
}

OpenedRecord opened_record(const RecordKind& kind, std::string_view bytes) {
  const json outer = json_of(bytes);
  if (outer.at("kind") != kind.kind) throw DamagedRecord{fmt::format("it is not a {}", kind.kind)};
  if (outer.at("format") != kind.format)
    throw DamagedRecord{fmt::format("it was written by another build, in format {} and not {}",
                                    outer.at("format").dump(), kind.format)};
  const std::vector<std::uint8_t> record = outer.at("record").get_binary();
  const std::string spec = outer.at("spec");
  if (envelope(kind, record, spec) != bytes) throw DamagedRecord{"its checksum is wrong"};
  return {spec, json_of(as_text(record))};
}

void refuse_record(const RecordKind& kind, const std::string& name, const std::string& reason) {
  throw UserError(fmt::format("{}: this {} cannot be used: {}; {}.", name, kind.noun, reason, kind.way_out));
}

}  // namespace rheocyte
