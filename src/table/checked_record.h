// Records as bytes: an outer CBOR object with the checksum of an inner one, which holds numbers as raw doubles.
#pragma once
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

/// What a record is, and in which version of its layout.
struct RecordKind {
  std::string_view kind, format;
};

/// Why bytes are no record; the end of a sentence.
struct DamagedRecord {
  std::string what;
};

/// Little-endian doubles.
nlohmann::json blob_of(std::span<const double> values);
/// Back; DamagedRecord if their number is another one.
std::vector<double> numbers_of(const nlohmann::json& record, const char* key, std::size_t size);

/// Equal records of one spec give equal bytes.
std::string sealed_record(const RecordKind& kind, const std::string& spec_hash, const nlohmann::json& record);

/// The inner object and the spec to which it belongs. DamagedRecord, or an exception of the CBOR reader.
struct OpenedRecord {
  std::string spec_hash;
  nlohmann::json record;
};
OpenedRecord opened_record(const RecordKind& kind, std::string_view bytes);

}  // namespace rheocyte
