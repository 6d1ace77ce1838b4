// Moduli that are being computed, or have been, for recordings of the view. For several threads at once.
#pragma once
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <semaphore>
#include <stop_token>
#include <string>

#include "view/view_items.h"

namespace rheocyte {

class Client;
struct ExtractOptions;

class ModuliRuns {
 public:
  /// The items must outlive it.
  explicit ModuliRuns(const ViewItems& items);
  ~ModuliRuns();
  ModuliRuns(const ModuliRuns&) = delete;
  ModuliRuns& operator=(const ModuliRuns&) = delete;

  /// Starts over with these settings (see extract_options). Where there are no threads they are computed here, as long
  /// as the client waits. UserError about the settings, Refused about the item.
  void start(std::size_t item, const nlohmann::ordered_json& settings, const Client* client);
  /// For the session: of each run its recording and its settings; restored they start over.
  nlohmann::ordered_json kept() const;
  void restore(const nlohmann::ordered_json& kept);
  /// Nothing is left of a run.
  void stop(std::size_t item);
  /// {"state": "none|running|ready|failed", "done": 0..1, "settings", "command"}, then "summary", "lines", "features",
  /// or "error". Moduli of files that have changed since they were read have failed, here and in all that follows.
  nlohmann::ordered_json state(std::size_t item) const;

  /// What the moduli of an item were computed with, or would be; see all_settings.
  nlohmann::ordered_json settings(std::size_t item) const;
  /// The companion with what has been computed; empty: nothing.
  std::filesystem::path companion(std::size_t item) const;
  /// The companion of `rheocyte moduli`; empty also without a combined table.
  std::filesystem::path several(std::size_t item) const;
  /// Events by their states, {"valid": 12, "too small": 3, ...}; empty without moduli.
  nlohmann::ordered_json counts(std::size_t item) const;
  /// Names of the computed columns.
  nlohmann::ordered_json features(std::size_t item) const;

 private:
  struct Run;
  void begin(std::size_t item, const ExtractOptions& options, const Client* client);
  std::shared_ptr<Run> run_of(std::size_t item) const;
  std::shared_ptr<Run> take_out(std::size_t item);
  void compute(Run& run, const nlohmann::ordered_json& request, const std::stop_token& stop, const Client* client);

  const ViewItems& items_;
  std::counting_semaphore<> free_processors_;
  mutable std::mutex mutex_;
  std::map<std::size_t, std::shared_ptr<Run>> runs_;
  std::atomic<std::size_t> started_ = 0;
};

}  // namespace rheocyte
