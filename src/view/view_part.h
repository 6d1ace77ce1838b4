// What the view answers, declared part by part: a file NAME_routes.cc has the constant NAME_routes. CMake makes the
// list of all parts from the names of these files.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "store/work_host.h"

namespace rheocyte {

class Exports;
class Router;
class SolverThreads;
class ViewItems;
class ViewSession;

/// What parts answer with; it outlives the router.
struct ViewContext {
  Router& router;
  Exports& exports;
  ViewSession& session;
  ViewItems& items;
  SolverThreads& threads;
};

/// What a process does that reads recordings for a part: isolated, for requests to the host of the items that have its
/// name in "do" and what it reads in "file". It gives JSON or bytes; UserError.
struct ItemWork {
  const char* name;
  void (*work)(const nlohmann::ordered_json& request, const WorkReply& reply, const TellProgress& tell);
  Isolation limits = {};
};

struct ViewPart {
  void (*add_routes)(const ViewContext& view);
  std::vector<ItemWork> item_work = {};
};

std::span<const ViewPart* const> view_parts();

}  // namespace rheocyte
