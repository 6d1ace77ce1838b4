// The text table of the moduli of events.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "extract/moduli_recording.h"
#include "report/event_table.h"
#include "report/moduli_columns.h"

namespace rheocyte {

/// The text table.
class ModuliText : public ModuliConsumer {
 public:
  /// UserError, also of the calls that follow, if it cannot be written.
  explicit ModuliText(std::filesystem::path file) : file_(std::move(file)) {}
  void begin(const Recording&, const std::vector<std::string>& remarks) override {
    table_.emplace(file_, remarks, descriptions(values_.columns()));
  }
  void take(std::size_t, const ModuliBlock& block) override { table_->append(values_.of(block)); }
  void end(const std::vector<std::string>& remarks) override {
    table_->remark(remarks);
    table_->close();
  }

 private:
  std::filesystem::path file_;
  BlockValues<ModuliBlock> values_{moduli_columns()};
  std::optional<EventTable> table_;
};

}  // namespace rheocyte
