// The declaration of the keys of a spec for `rheocyte synth`.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/parameters.h"
#include "synth/synth_spec.h"

namespace rheocyte {

struct SynthNumber {
  Range range;
  std::optional<double> fallback;  ///< empty: only if given
  void (*set)(SynthSpec&, double);
  bool is_whole = false, is_required = false;
};

/// One of a few words, or any short text if there are no options.
struct SynthWord {
  std::vector<std::string_view> options;
  std::string_view fallback;
  void (*set)(SynthSpec&, const std::string&);
};

/// A number for all cells alike, or `.mean`, `.sd` and `.distribution` below the key.
struct SynthSpread {
  Range range;  ///< of the mean; the deviation goes from 0 to the greatest value
  std::optional<double> fallback;
  void (*set)(SynthSpec&, const Spread&);
};

struct SynthKey {
  std::string_view key, unit, sentence;
  std::variant<SynthNumber, SynthWord, SynthSpread> value;
};

/// All keys in the order in which they are documented.
std::span<const SynthKey> synth_keys();

/// What may be given, for messages.
std::string allowed_values(const SynthKey& key);

}  // namespace rheocyte
