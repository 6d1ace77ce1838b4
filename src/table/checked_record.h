// Records as bytes: an outer CBOR object with the checksum of an inner one, which holds arrays of numbers as raw bytes.
#pragma once
#include <Eigen/Core>
#include <new>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

/// What a record is, in which version of its layout, what a user calls it, how it is made again, and which older
/// version is read as well, if any.
struct RecordKind {
  std::string_view kind, format, noun, way_out, older_format = {};
};

/// Why bytes are no record; the end of a sentence.
struct DamagedRecord {
  std::string what;
};

/// DamagedRecord with this reason if it is not good.
void check_record(bool good, const char* what);

/// Little-endian doubles.
nlohmann::json blob_of(std::span<const double> values);
/// Little-endian numbers of single precision (6e-8), for what is a thousandth off. Each must be of a size that they
/// have.
nlohmann::json single_blob_of(std::span<const double> values);
/// Back, from either of them; DamagedRecord if their number is another one.
std::vector<double> numbers_of(const nlohmann::json& record, const char* key, std::size_t size);

/// Equal records of one spec give equal bytes.
std::string sealed_record(const RecordKind& kind, const std::string& spec_hash, const nlohmann::json& record);

/// The inner object and the spec to which it belongs. DamagedRecord, or an exception of the CBOR reader.
struct OpenedRecord {
  std::string spec_hash;
  nlohmann::json record;
};
OpenedRecord opened_record(const RecordKind& kind, std::string_view bytes);

/// UserError: the record `name` cannot be used, why, and the way out.
[[noreturn]] void refuse_record(const RecordKind& kind, const std::string& name, const std::string& reason);

/// What `read` makes of a record; whatever it meets in damaged bytes becomes a UserError as that of refuse_record.
template <class Read>
auto read_or_refuse(const RecordKind& kind, const std::string& name, const Read& read) {
  std::string reason = "it is cut or damaged";
  try {
    return read();
  } catch (const DamagedRecord& damage) {
    reason = damage.what;
  } catch (const nlohmann::json::exception&) {
  } catch (const std::length_error&) {
  } catch (const std::bad_alloc&) {
  }
  refuse_record(kind, name, reason);
}

}  // namespace rheocyte
