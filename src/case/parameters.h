// The declaration of a parameter. Reader, writers, help and docs/case-reference.md all work from this one table.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/case.h"

namespace rheocyte {

/// Both ends belong to the range.
struct Range {
  double least, greatest;
  bool contains(double value) const { return value >= least && value <= greatest; }  // false for NaN
};

/// A parameter that is a number.
struct Number {
  Range range;
  std::optional<double> fallback;             ///< value when the key is not given; empty: the key is required
  std::optional<double> (*get)(const Case&);  ///< empty: no effect in this case
  void (*set)(Case&, double);
};

/// A parameter that is one of a few words, numbered in the order of its enumeration.
struct Choice {
  std::vector<std::string_view> options;
  std::optional<int> fallback;
  int (*get)(const Case&);
  void (*set)(Case&, int);
};

/// A parameter that is a list of numbers, not given by default.
struct List {
  Range range;  ///< of each number
  std::vector<double>& (*at)(Case&);
};

/// The parameter has an effect only if the choice `key` has the value `option`, or only if it has another one.
struct Condition {
  std::string_view key, option;
  bool negated = false;
};

struct Parameter {
  std::string_view key;       ///< dotted, with the unit as its last part: "cell.radius_um"
  std::string_view unit;      ///< empty for pure numbers and choices
  std::string_view sentence;  ///< what it is
  std::variant<Number, Choice, List> value;
  std::optional<Condition> only_for = {};
  std::string_view alternative = {};  ///< the key that may stand instead; without a fallback exactly one is given
};

/// All parameters in the order in which they are documented and written.
std::span<const Parameter> parameters();

/// The parameter with this key, or null.
const Parameter* find_parameter(std::string_view key);

/// The option of a choice that a case has, e.g. "newtonian" for "flow.law". The key must be that of a choice.
std::string_view chosen_option(const Case&, std::string_view key);

/// Whether it must be given where it has an effect, itself or its alternative.
bool is_required(const Parameter&);

/// Whether the parameter has an effect in this case (its law is the chosen one).
bool applies(const Parameter&, const Case&);

/// For example: cell.bulk.law = "mooney-rivlin", or: cell.bulk.law other than "none".
std::string condition_text(const Condition&);

/// What may be given, for messages and help: `0.1 .. 1000 um`, or `"newtonian" or "power-law"`.
std::string allowed_values(const Parameter&);

/// The value when the key is not given: `1000`, `"newtonian"`, or `required`.
std::string fallback_text(const Parameter&);

}  // namespace rheocyte
