// Processes that stay with the recordings whose events are looked at, so that the next event is there at once.
#pragma once
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>

#include "store/work_host.h"

namespace rheocyte {

/// For several threads at once.
class KeptInspectors {
 public:
  /// The host must outlive it.
  explicit KeptInspectors(const WorkHost& host) : host_(host) {}

  /// The event as JSON. `recording` has what the process needs: "file" and its "version", "companion", "settings",
  /// "combined"; one that was begun with the same answers, if its tables have not changed since. UserError of the work.
  std::string inspect(const nlohmann::ordered_json& recording, std::size_t event);

 private:
  struct Kept {
    Kept(std::string f, std::string k, HostedWork w) : file(std::move(f)), key(std::move(k)), work(std::move(w)) {}

    std::string file, key;
    HostedWork work;
    std::mutex alone = {};
  };
  std::shared_ptr<Kept> take(const std::string& key) const;
  std::shared_ptr<Kept> begin(const nlohmann::ordered_json& recording, const std::string& key);
  void drop(const std::shared_ptr<Kept>&);

  const WorkHost& host_;
  mutable std::mutex mutex_;
  std::list<std::shared_ptr<Kept>> kept_;  ///< the latest first
};

}  // namespace rheocyte
