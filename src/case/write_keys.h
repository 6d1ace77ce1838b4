// Values of keys as text: for result.json, and for a copy that can be read again.
#pragma once
#include <algorithm>
#include <iterator>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "case/key.h"

namespace rheocyte {

using KeyValues = std::vector<std::pair<const KeyDescription*, Value>>;

/// Without those that have no effect.
KeyValues with_effect(KeyValues);

/// All values of an owner.
template <class Owner>
KeyValues all_values_of(const Owner& owner, std::span<const Key<Owner>> keys) {
  KeyValues values;
  for (const auto& key : keys)
    if (auto value = key.get(owner)) values.emplace_back(&key, std::move(*value));
  return values;
}

/// The values of an owner that have an effect.
template <class Owner>
KeyValues values_of(const Owner& owner, std::span<const Key<Owner>> keys) {
  return with_effect(all_values_of(owner, keys));
}

/// The same of a case and what has one as its base: whether a key has an effect may depend on a key of the other.
template <class Base, class Owner>
KeyValues values_of(const Base& base, std::span<const Key<Base>> keys_of_base, const Owner& owner,
                    std::span<const Key<Owner>> keys) {
  KeyValues values = all_values_of(base, keys_of_base);
  std::ranges::move(all_values_of(owner, keys), std::back_inserter(values));
  return with_effect(std::move(values));
}

/// Nested as in the file: {"channel": {"width_um": 20.0}, ...}.
nlohmann::ordered_json to_json(const KeyValues&);

/// A TOML file that gives back the same values to the last bit, without the keys that are to be left out.
std::string to_toml(const KeyValues&, std::span<const std::string_view> left_out = {});

}  // namespace rheocyte
