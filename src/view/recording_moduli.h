// The moduli of a recording for the view: computed by the same work as `rheocyte extract`, into the same files.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "extract/moduli_recording.h"
#include "report/companion_writer.h"
#include "report/extract_recording.h"
#include "report/moduli_columns.h"

namespace rheocyte {

/// {"summary": the columns of the summary table, "lines": what the command says on the terminal, "counts": events by
/// their states}.
nlohmann::ordered_json moduli_report(const std::filesystem::path& recording, const ExtractSummary& summary);

/// Keeps the features of moduli_features() in a companion that only this program reads.
class ModuliCompanion : public ModuliConsumer {
 public:
  explicit ModuliCompanion(std::filesystem::path file) : file_(std::move(file)) {}
  void begin(const Recording& recording, const std::vector<std::string>& remarks) override;
  void take(std::size_t first, const ModuliBlock& block) override;
  void end(const std::vector<std::string>& remarks) override;

 private:
  std::filesystem::path file_;
  BlockValues<ModuliBlock> values_{moduli_features()};
  std::optional<CompanionWriter> companion_;
};

/// Of a table of events the lines of some events, whose numbers count from 0, with all remarks. UserError if they
/// cannot be written.
void copy_events_of_gate(const std::filesystem::path& table, const std::filesystem::path& target,
                         std::span<const std::size_t> numbers);

}  // namespace rheocyte
