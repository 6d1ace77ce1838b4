// The "section:key" values of a recording.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <variant>

namespace rheocyte {

/// Metadata of virtual recordings: the cells that were drawn, e.g. "linear solids in the tube".
inline constexpr const char* made_of_key = "user:rheocyte made of";

/// Values of the attributes at the root of a recording, whatever type the program that wrote them chose: numbers of
/// any size, truth values (as 0 and 1), texts of fixed or variable length, arrays of one element. Other arrays are
/// left out.
class Metadata {
 public:
  using Value = std::variant<double, std::string>;

  Metadata() = default;
  explicit Metadata(std::map<std::string, Value> values) : values_(std::move(values)) {}

  bool has(const std::string& key) const { return values_.contains(key); }
  /// A number, or a text that reads as one; nothing if the key is absent or holds another text.
  std::optional<double> number(const std::string& key) const;
  /// A text without blanks at its ends, or a number as text; nothing if absent or empty.
  std::optional<std::string> text(const std::string& key) const;

  const std::map<std::string, Value>& values() const { return values_; }

 private:
  std::map<std::string, Value> values_;
};

}  // namespace rheocyte
