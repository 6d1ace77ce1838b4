#include "serve/json_member.h"

#include <nlohmann/json.hpp>

#include "serve/http.h"

namespace rheocyte {

std::string text_member(const nlohmann::ordered_json& tree, std::string_view name, std::string_view usual) {
  const auto found = tree.find(name);
  if (found == tree.end()) return std::string(usual);
  if (!found->is_string()) throw Refused(400, "input", "\"" + std::string(name) + "\" must be a text.");
  return found->get<std::string>();
}

const nlohmann::ordered_json& object_member(const nlohmann::ordered_json& tree, std::string_view name) {
  const auto found = tree.find(name);
  if (found == tree.end() || !found->is_object())
    throw Refused(400, "input", "\"" + std::string(name) + "\" must be an object.");
  return *found;
}

const nlohmann::ordered_json& list_member(const nlohmann::ordered_json& tree, std::string_view name) {
  static const nlohmann::ordered_json none = nlohmann::ordered_json::array();
  const auto found = tree.find(name);
  if (found == tree.end()) return none;
  if (!found->is_array()) throw Refused(400, "input", "\"" + std::string(name) + "\" must be a list.");
  return *found;
}

void add_member(std::string& object, std::string_view name, std::string_view json) {
  object.pop_back();
  object.append(",\"").append(name).append("\":").append(json).append("}");
}

}  // namespace rheocyte
