// Checkpoints of a computation in time: two slots, written in turn, each with its case, its length and a checksum.
#pragma once
#include <filesystem>
#include <string>

#include "case/case.h"
#include "result/time_record.h"
#include "store/claim.h"

namespace rheocyte {

/// All that a later run needs to go on as if it had never stopped.
struct Checkpoint {
  TimeState state;
  TimeRecord record;

  /// For store/bytes.h.
  template <class Self>
  static auto fields(Self& c) {
    return std::tie(c.state, c.record);
  }
};

/// Equal for cases that may continue each other: the end of the time does not count.
std::string time_case_hash(const Case&);

/// "checkpoint-1.bin" or "checkpoint-2.bin".
std::string checkpoint_file(int slot);

/// The content of a slot, and back. UserError, which names the file: damaged, of another case, of another version.
std::string encode_checkpoint(const Checkpoint&, const Case&);
Checkpoint decode_checkpoint(const std::string& content, const Case&, const std::filesystem::path& file);

/// A checkpoint and the folder in which it lies, which no one else can remove meanwhile.
struct FoundCheckpoint {
  Checkpoint checkpoint;
  std::filesystem::path folder;
  Claim claim;
};

/// As read_checkpoint, for going on: also what killed computations for this folder have left.
FoundCheckpoint find_checkpoint(const std::filesystem::path& folder, const Case&);

/// The later one of the checkpoints of a result that can be read. UserError if there is none, or if the time or
/// the place that it has reached lies beyond the end of the case.
Checkpoint read_checkpoint(const std::filesystem::path& folder, const Case&);

/// The last state of a result in time, of implicit steps in a straight channel, as the start of a case on the same
/// mesh. UserError if the sizes, the degree or the scheme differ.
TimeStart read_start(const std::filesystem::path& folder, const Case&);

}  // namespace rheocyte
