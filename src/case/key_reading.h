// From the keys that the user gave to checked values: the one reader of case files and specs.
#pragma once
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "case/given_keys.h"
#include "case/key.h"

namespace rheocyte {

/// The values of one file. UserErrors are one sentence with file, line, key, value, range and the nearest known key.
class KeyReading {
 public:
  /// Refuses unknown keys, keys given twice and values that are wrong by themselves, even where they have no effect;
  /// makes all choices. Later keys, those of --set, replace earlier ones. `file` stands in messages, `topic` is that of
  /// `rheocyte help`.
  KeyReading(KeyList keys, std::vector<GivenKey> given, std::string file, std::string_view topic);

  /// Refuses keys without effect and alternatives that are both given (a key of the file that loses its effect through
  /// a setting is dropped), then sets what is not given. Keys that are left open are not asked for.
  void complete(std::span<const std::string_view> left_open = {});

  /// What stands for the key in the file or in a setting, or null; of a spread the last of its parts.
  const GivenKey* given(std::string_view key) const;
  bool has(std::string_view key) const { return given(key) != nullptr; }

  /// The value, or null: not given and without effect.
  const Value* value(std::string_view key) const;

  /// The option of a choice, for example "newtonian".
  std::string_view chosen(std::string_view key) const;

  template <class Owner>
  void fill(Owner& owner, std::span<const Key<Owner>> keys) const {
    for (const auto& key : keys)
      if (const Value* known = value(key.name)) key.set(owner, *known);
  }

  /// For example: `cell.radius_um = 0.001`. The key must have been given.
  std::string stated(std::string_view key) const;

  /// UserError that begins with the place of the key, or the file if it was not given.
  [[noreturn]] void refuse(std::string_view key, const std::string& reason) const;
  /// The same of a sentence without its end, about what is stated, or about the key if it was not given.
  [[noreturn]] void refuse_stated(std::string_view key, std::string_view predicate) const;

 private:
  using Parts = std::vector<GivenKey>;  ///< several for a spread, otherwise one

  void take(GivenKey given);
  void choose();
  bool applies(const KeyDescription&) const;
  bool is_met(const Condition&) const;
  bool was_set(std::string_view key) const;
  void drop(std::string_view key);
  void check_effect(const KeyDescription&);
  void check_alternative(const KeyDescription&);
  void set_fallback(const KeyDescription&);

  KeyList keys_;
  std::string file_;
  std::string_view topic_;
  std::map<std::string_view, Parts> given_;
  std::map<std::string_view, Value> values_;
};

/// Sentences about names of keys that are still understood but have been replaced.
std::vector<std::string> remarks_on_names(const KeyList&, std::span<const GivenKey>);

}  // namespace rheocyte
