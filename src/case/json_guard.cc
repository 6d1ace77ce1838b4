#include "case/json_guard.h"

#include <vector>

namespace rheocyte {

namespace {

using nlohmann::json;

class NestingGuard : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(json::number_integer_t) override { return true; }
  bool number_unsigned(json::number_unsigned_t) override { return true; }
  bool number_float(json::number_float_t, const json::string_t&) override { return true; }
  bool string(json::string_t&) override { return true; }
  bool binary(json::binary_t&) override { return true; }
  bool key(json::string_t&) override { return ++keys_.back() <= max_json_keys; }
  bool start_object(std::size_t) override {
    keys_.push_back(0);
    return ++depth_ <= max_json_nesting;
  }
  bool end_object() override {
    keys_.pop_back();
    return --depth_ >= 0;
  }
  bool start_array(std::size_t) override { return ++depth_ <= max_json_nesting; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

 private:
  int depth_ = 0;
  std::vector<int> keys_;  ///< of the objects that are open
};

}  // namespace

bool is_sound_json(std::string_view bytes, json::input_format_t format) {
  NestingGuard guard;
  return json::sax_parse(bytes.begin(), bytes.end(), &guard, format);
}

nlohmann::ordered_json parse_sound_json(std::string_view text) {
  return is_sound_json(text) ? nlohmann::ordered_json::parse(text) : nlohmann::ordered_json();
}

std::string json_text(const nlohmann::ordered_json& tree, JsonCharacters characters) {
  return tree.dump(2, ' ', characters == JsonCharacters::ascii, json::error_handler_t::replace);
}

std::string json_line(const nlohmann::ordered_json& tree) {
  return tree.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace rheocyte
