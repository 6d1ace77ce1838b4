// The declaration of a key: what the user may give, and where its value goes. The reader, the writers, the references
// of `rheocyte help` and the options of the command line all work from lists of these; each list stands in one file
// (case/case_keys.cc, table/table_keys.cc, synth/synth_keys.cc).
#pragma once
#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "case/spread.h"
#include "case/to_path.h"

namespace rheocyte {

/// Both ends belong to the range.
struct Range {
  double least, greatest;
  bool contains(double value) const { return value >= least && value <= greatest; }  // false for NaN
};

struct Number {
  Range range;
  bool is_whole = false;
};

/// The option that a choice takes by itself when the key `by`, or another one of the section `by` ("time."), is given.
struct Implied {
  std::string_view option, by, unless_given = {};
};

/// One of a few words, numbered in the order of their enumeration (or false and true).
struct Choice {
  std::vector<std::string_view> options;
  std::optional<Implied> implied = {};
};

/// Any short text.
struct Word {};

struct List {
  Range range;  ///< of each number
  bool is_ascending = false;
};

/// A number for the whole population, or `.mean`, `.sd` and `.distribution` below the key.
struct Scatter {
  Range range;  ///< of the mean; the deviation goes from 0 to the greatest value
};

/// The value of a key; that of a choice is the number of its option.
using Value = std::variant<double, int, std::string, std::vector<double>, Spread>;

/// When a key has an effect: the choice `key` has the value `option` (negated: another one). Without an option: `key`
/// is given (negated: it is not).
struct Condition {
  std::string_view key, option;
  bool negated = false;
};

/// What happens when a key is not given: it is missed where it has an effect; nothing; or it has this value.
struct Required {};
struct Absent {};
using Fallback = std::variant<Required, Absent, Value>;
inline constexpr Required required;
inline constexpr Absent absent;

/// All about a key but its owner.
struct KeyDescription {
  std::string_view name = {};      ///< dotted, with the unit as its last part: "cell.radius_um"
  std::string_view unit = {};      ///< empty for pure numbers and words
  std::string_view sentence = {};  ///< what it is
  std::variant<Number, Choice, Word, List, Scatter> kind = {};
  Fallback fallback = required;
  std::optional<Condition> only_for = {};
  std::string_view alternative = {};    ///< the key that may stand instead; both together are refused
  std::string_view option = {};         ///< the spelling on command lines: "--channel-width-um"
  std::string_view former_option = {};  ///< still understood
  std::string_view former_name = {};    ///< as above
};

/// The key of a name that was another one in the version before.
inline KeyDescription renamed(KeyDescription key, std::string_view former_name) {
  key.former_name = former_name;
  return key;
}

/// A key of an `Owner`, for example a case.
template <class Owner>
struct Key : KeyDescription {
  std::optional<Value> (*get)(const Owner&) = nullptr;  ///< empty: not given and without effect
  void (*set)(Owner&, const Value&) = nullptr;
};

namespace key_access {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class Member>
std::optional<Value> value_of(const Member& member) {
  if constexpr (is_optional<Member>) {
    return member ? value_of(*member) : std::nullopt;
  } else if constexpr (std::is_same_v<Member, std::vector<double>>) {
    return member.empty() ? std::nullopt : std::optional<Value>(member);
  } else if constexpr (std::is_enum_v<Member> || std::is_same_v<Member, bool>) {
    return static_cast<int>(member);
  } else if constexpr (std::is_arithmetic_v<Member>) {
    return static_cast<double>(member);
  } else if constexpr (std::is_same_v<Member, Spread>) {
    return member;
  } else if constexpr (std::is_same_v<Member, std::filesystem::path>) {
    return member.string();
  } else {
    return std::string(member);
  }
}

template <class Member>
void store(Member& member, const Value& value) {
  if constexpr (is_optional<Member>) {
    store(member.emplace(), value);
  } else if constexpr (std::is_enum_v<Member> || std::is_same_v<Member, bool>) {
    member = static_cast<Member>(std::get<int>(value));
  } else if constexpr (std::is_arithmetic_v<Member>) {
    member = static_cast<Member>(std::get<double>(value));
  } else if constexpr (std::is_same_v<Member, std::vector<double>> || std::is_same_v<Member, Spread>) {
    member = std::get<Member>(value);
  } else if constexpr (std::is_same_v<Member, std::filesystem::path>) {
    member = to_path(std::get<std::string>(value));
  } else {
    member = std::get<std::string>(value);
  }
}

}  // namespace key_access

/// The key of a member: `field` is a pointer to it, or a function from an owner to it. The member's type decides how
/// the value is kept; std::optional is empty while the key has no effect.
template <class Owner, auto field>
Key<Owner> key_of(KeyDescription description) {
  return {std::move(description), [](const Owner& owner) { return key_access::value_of(std::invoke(field, owner)); },
          [](Owner& owner, const Value& value) { key_access::store(std::invoke(field, owner), value); }};
}

/// The key with this name, or null.
template <class Keys>
auto find_key(const Keys& keys, std::string_view name) -> decltype(&*keys.begin()) {
  for (const auto& key : keys)
    if (key.name == name) return &key;
  return nullptr;
}

/// Declarations of one or several owners, in the order in which they are documented.
using KeyList = std::vector<const KeyDescription*>;

template <class... Owners>
KeyList key_list(std::span<const Key<Owners>>... keys) {
  KeyList list;
  (std::ranges::for_each(keys, [&](const auto& key) { list.push_back(&key); }), ...);
  return list;
}

const KeyDescription* find_key(const KeyList&, std::string_view name);

/// The value when it is not given, or null.
inline const Value* fallback_of(const KeyDescription& key) { return std::get_if<Value>(&key.fallback); }

/// Whether it must be given where it has an effect, itself or its alternative: both are required.
bool is_required(const KeyDescription&, const KeyList&);

/// The word of a choice's value, for example "newtonian".
std::string_view option_of(const KeyDescription& choice, const Value&);

/// For example: for cell.bulk.law = "mooney-rivlin"; for cell.bulk.law other than "none"; without shapes.table.
std::string condition_text(const Condition&);

/// `0.1 .. 1000 um`.
std::string range_text(const Range&, std::string_view unit);

/// What may be given, for messages and help: `0.1 .. 1000 um`, or `"newtonian" or "power-law"`.
std::string allowed_values(const KeyDescription&);

/// A value as in the file, in a short form: `1e-4`, `"newtonian"`.
std::string value_text(const KeyDescription&, const Value&);

/// 1e-9 rather than 1e-09, and 1e7 rather than 1e+07.
std::string short_number(double value);

}  // namespace rheocyte
