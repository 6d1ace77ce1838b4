// The list of what the view has been given, and who reads it. For several threads at once.
#pragma once
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "store/thread.h"
#include "store/work_host.h"
#include "view/inspector_pool.h"
#include "view/item_places.h"

namespace rheocyte {

/// Items are numbers for the page; files of recordings are read in processes of their own only.
class ViewItems {
 public:
  /// To be made while the process has a single thread. Begins to read what the items are.
  explicit ViewItems(std::span<const std::filesystem::path> paths);
  ~ViewItems();
  ViewItems(const ViewItems&) = delete;
  ViewItems& operator=(const ViewItems&) = delete;

  enum class State { loading, ready, failed };
  struct Item {
    ItemPlace place;
    State state = State::loading;
    std::string error = {};
    nlohmann::ordered_json description = {};  ///< see describe_item
    std::string condition = {}, replicate = {};
    std::vector<std::filesystem::path> files = {};  ///< what is read of it: its own, and those of its basins
    std::string version = {};                       ///< of the files, when they were described
  };

  /// Items that have vanished, come back or changed are noticed here, and described again.
  nlohmann::ordered_json list();
  std::size_t count() const;
  /// What is wrong with places that cannot be read, one sentence each.
  std::vector<std::string> missing() const;
  /// A copy. Refused (404) if there is none of this number.
  Item at(std::size_t number) const;
  /// The same of a recording; Refused (409) if the item is something else.
  Item recording(std::size_t number) const;
  /// The path of a table. UserError if the item is none.
  std::filesystem::path table(std::size_t number) const;
  /// The folder of the first combined table that can be read; empty if there is none.
  std::filesystem::path combined() const;
  /// Condition and replicate, as far as they are given.
  void label(std::size_t number, const nlohmann::ordered_json& labels);

  /// For the session: paths and labels; places that are new are added.
  nlohmann::ordered_json kept() const;
  void restore(const nlohmann::ordered_json& kept);

  const WorkHost& host() const { return host_; }
  KeptInspectors& inspectors() { return inspectors_; }

 private:
  void describe_all(const std::stop_token& stop);
  bool describe_next(const std::stop_token& stop);
  void look_for_added();
  void describe(std::size_t number, const std::stop_token& stop);
  void look_after(std::size_t number);

  WorkHost host_;
  KeptInspectors inspectors_{host_};
  mutable std::mutex mutex_;
  std::condition_variable_any added_;
  std::vector<Item> items_;
  Thread reader_;
};

/// {"item", "kind", "name", "state", "error", "version", "events", "conditions", "condition", "replicate"}, what is not
/// known is left out.
nlohmann::ordered_json summary_of(std::size_t number, const ViewItems::Item&);

}  // namespace rheocyte
