// Any bytes are a checkpoint of a case, or refused. No fuzzer guesses a checksum: the bytes are tried as they stand,
// and as the content of a checkpoint that has been sealed properly.
#include "app/checkpoint.h"

#include "numeric/fingerprint.h"
#include "refused_or_read.h"

namespace {

void read_any(const std::string& content, const rheocyte::Case& c) {
  rheocyte::test::refused_or_read(
      reinterpret_cast<const std::uint8_t*>(content.data()), content.size(),
      [&](auto bytes) { rheocyte::decode_checkpoint(std::string(bytes), c, "checkpoint-1.bin"); });
}

/// What stands before the content of every checkpoint of a case.
std::string head_of(const rheocyte::Case& c) {
  const std::string checkpoint = rheocyte::encode_checkpoint({}, c), hash = rheocyte::time_case_hash(c);
  return checkpoint.substr(0, checkpoint.find(hash) + hash.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const rheocyte::Case a_case;
  static const std::string head = head_of(a_case);
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read_any(bytes, a_case);
  std::string content = head + bytes;
  const std::uint64_t sum = rheocyte::fnv1a(content);
  read_any(content.append(reinterpret_cast<const char*>(&sum), sizeof sum), a_case);
  return 0;
}
