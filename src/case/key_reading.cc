#include "case/key_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "case/joined.h"
#include "case/key_value.h"
#include "case/nearest_name.h"
#include "case/user_error.h"

namespace rheocyte {

namespace {

struct Match {
  const KeyDescription* key = nullptr;
  std::string_view part = {};  ///< of a spread, for example ".mean"
  bool by_former_name = false;
};

// The part of the key that a name means, "" for the key itself.
std::optional<std::string_view> part_of(const KeyDescription& key, std::string_view known, std::string_view name) {
  if (known.empty() || !name.starts_with(known)) return {};
  const auto rest = name.substr(known.size());
  if (rest.empty()) return rest;
  if (!std::holds_alternative<Scatter>(key.kind)) return {};
  const auto found = std::ranges::find(spread_parts(), rest);
  return found == spread_parts().end() ? std::nullopt : std::optional(*found);
}

Match match(const KeyList& keys, std::string_view name) {
  for (const auto* key : keys) {
    if (const auto part = part_of(*key, key->name, name)) return {key, *part};
    if (const auto part = part_of(*key, key->former_name, name)) return {key, *part, true};
  }
  return {};
}

bool is_section(const KeyList& keys, std::string_view name) {
  const std::string prefix = std::string(name) + ".";
  return std::ranges::any_of(keys, [&](const auto* key) {
    return key->name.starts_with(prefix) || (std::holds_alternative<Scatter>(key->kind) && key->name == name);
  });
}

bool is_given_as_section(const GivenKey& given) {
  const auto* unusable = std::get_if<Unusable>(&given.value);
  return unusable && unusable->what == "a section";
}

std::string nearest_key(const KeyList& keys, std::string_view name) {
  std::vector<std::string> names;
  for (const auto* key : keys) {
    names.emplace_back(key->name);
    if (!std::holds_alternative<Scatter>(key->kind)) continue;
    for (const auto part : spread_parts()) names.push_back(std::string(key->name).append(part));
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  return did_you_mean(name, known);
}

[[noreturn]] void refuse_unknown(const KeyList& keys, const GivenKey& given, std::string_view topic) {
  if (is_section(keys, given.key))
    refuse(given, fmt::format("{} is a section, not a value; write [{}] and its keys below.", given.key, given.key));
  if (const auto* parent = find_key(keys, given.key.substr(0, given.key.rfind('.'))))
    refuse(given, fmt::format("{} stands below {}, which takes a value: {}.", stated(given), parent->name,
                              allowed_values(*parent)));
  const auto hint = nearest_key(keys, given.key);
  const auto what = is_given_as_section(given) ? fmt::format("section [{}]", one_line(given.key, 80))
                                               : fmt::format("key {}", stated(given));
  refuse(given, fmt::format("unknown {}{}", what,
                            hint.empty() ? fmt::format("; `rheocyte help {}` lists all keys.", topic) : hint));
}

// The options of a choice that fulfil a condition.
std::string fitting_options(const KeyDescription& choice, const Condition& condition) {
  std::vector<std::string_view> fitting;
  for (const auto option : std::get<Choice>(choice.kind).options)
    if ((option == condition.option) != condition.negated) fitting.push_back(option);
  return fmt::format("\"{}\"", joined(fitting, "\" or \""));
}

}  // namespace

KeyReading::KeyReading(KeyList keys, std::vector<GivenKey> given, std::string file, std::string_view topic)
    : keys_(std::move(keys)), file_(std::move(file)), topic_(topic) {
  for (auto& one : given) take(std::move(one));
  for (const auto& [name, parts] : given_) {
    const auto& key = *find_key(keys_, name);
    values_[name] = std::holds_alternative<Scatter>(key.kind) ? Value(checked_spread(key, parts))
                                                              : checked_value(key, parts.front());
  }
  choose();
}

void KeyReading::take(GivenKey given) {
  if (is_given_as_section(given) && is_section(keys_, given.key)) return;  // an empty section is no mistake
  const Match found = match(keys_, given.key);
  if (!found.key) refuse_unknown(keys_, given, topic_);
  if (found.by_former_name) given.key = std::string(found.key->name).append(found.part);
  Parts& parts = given_[found.key->name];
  const bool is_known = std::ranges::find(parts, given.key, &GivenKey::key) != parts.end();
  if (is_known && !given.from_set) rheocyte::refuse(given, fmt::format("{} is given twice.", rheocyte::stated(given)));
  std::erase_if(parts, [&](const GivenKey& earlier) { return found.part.empty() || earlier.key == given.key; });
  parts.push_back(std::move(given));
}

// They decide which of the other keys have an effect.
void KeyReading::choose() {
  for (const auto* key : keys_) {
    const auto* choice = std::get_if<Choice>(&key->kind);
    if (!choice || has(key->name) || has(key->alternative)) continue;
    if (const auto* usual = fallback_of(*key)) values_[key->name] = *usual;
    const auto& implied = choice->implied;
    if (!implied || has(implied->unless_given)) continue;
    const auto implies = [&](const auto& entry) {
      return entry.first == implied->by || (implied->by.ends_with('.') && entry.first.starts_with(implied->by));
    };
    if (std::ranges::any_of(given_, implies))
      values_[key->name] = int(std::ranges::find(choice->options, implied->option) - choice->options.begin());
  }
}

void KeyReading::complete(std::span<const std::string_view> left_open) {
  for (const auto* key : keys_) {
    check_effect(*key);
    check_alternative(*key);
  }
  for (const auto* key : keys_)
    if (std::ranges::find(left_open, key->name) == left_open.end()) set_fallback(*key);
}

const GivenKey* KeyReading::given(std::string_view key) const {
  const auto found = given_.find(key);
  return found == given_.end() ? nullptr : &found->second.back();
}

const Value* KeyReading::value(std::string_view key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? nullptr : &found->second;
}

std::string_view KeyReading::chosen(std::string_view key) const {
  return option_of(*find_key(keys_, key), *value(key));
}

std::string KeyReading::stated(std::string_view key) const { return rheocyte::stated(*given(key)); }

void KeyReading::refuse(std::string_view key, const std::string& reason) const {
  if (const auto* known = given(key)) rheocyte::refuse(*known, reason);
  throw KeyError(key, fmt::format("{}: {}", file_, reason));
}

void KeyReading::refuse_stated(std::string_view key, std::string_view predicate) const {
  refuse(key, fmt::format("{} {}.", has(key) ? stated(key) : std::string(key), predicate));
}

bool KeyReading::is_met(const Condition& condition) const {
  if (condition.option.empty()) return has(condition.key) != condition.negated;
  return (chosen(condition.key) == condition.option) != condition.negated;
}

bool KeyReading::applies(const KeyDescription& key) const { return !key.only_for || is_met(*key.only_for); }

bool KeyReading::was_set(std::string_view key) const {
  const auto* known = given(key);
  return known && known->from_set;
}

void KeyReading::drop(std::string_view key) {
  given_.erase(key);
  values_.erase(key);
}

void KeyReading::check_effect(const KeyDescription& key) {
  if (!has(key.name) || applies(key)) return;
  const auto& condition = *key.only_for;
  if (!was_set(key.name) && was_set(condition.key)) return drop(key.name);
  const auto what = stated(key.name);
  if (condition.option.empty())
    refuse(key.name,
           condition.negated
               ? fmt::format("{} has no effect, because {} is given; remove one of them.", what, condition.key)
               : fmt::format("{} has no effect without {}; remove it or give both.", what, condition.key));
  refuse(key.name, fmt::format("{} has no effect, because {} is \"{}\"; remove it or choose {}.", what, condition.key,
                               chosen(condition.key), fitting_options(*find_key(keys_, condition.key), condition)));
}

// Of two alternatives exactly one stays; a setting wins over the file.
void KeyReading::check_alternative(const KeyDescription& key) {
  if (key.alternative.empty() || !has(key.name) || !has(key.alternative)) return;
  if (was_set(key.name) != was_set(key.alternative)) return drop(was_set(key.name) ? key.alternative : key.name);
  refuse(key.alternative, fmt::format("{} and {} exclude each other; give exactly one of them.", stated(key.name),
                                      stated(key.alternative)));
}

void KeyReading::set_fallback(const KeyDescription& key) {
  if (values_.contains(key.name) || !applies(key) || has(key.alternative)) return;
  if (const auto* usual = fallback_of(key)) {
    values_[key.name] = *usual;
    return;
  }
  if (!is_required(key, keys_)) return;
  const auto instead = key.alternative.empty() ? "" : fmt::format(" (or {})", key.alternative);
  const auto reason = !key.only_for ? ""
                      : key.only_for->option.empty()
                          ? " " + condition_text(*key.only_for)
                          : fmt::format(" for {} = \"{}\"", key.only_for->key, chosen(key.only_for->key));
  throw KeyError(key.name, fmt::format("{}: the key {}{} is missing{}; it can be {} ({}).", file_, key.name, instead,
                                       reason, allowed_values(key), key.sentence));
}

std::vector<std::string> remarks_on_names(const KeyList& keys, std::span<const GivenKey> given) {
  std::vector<std::string> remarks;
  for (const auto& one : given)
    if (const auto [key, part, by_former_name] = match(keys, one.key); by_former_name)
      remarks.push_back(fmt::format("{}: {} is now called {}{}; this version still reads the old name.", one.where,
                                    one_line(one.key, 80), key->name, part));
  return remarks;
}

}  // namespace rheocyte
