// The list of keys is consistent with itself, and the reference in docs is made from it.
#include "case/case_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "case/key_reference.h"

namespace rheocyte::case_keys_test {
namespace {

TEST(CaseKeys, HaveUniqueNamesAndASentence) {
  std::set<std::string_view> names;
  for (const auto& key : case_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_FALSE(key.sentence.empty()) << key.name;
    EXPECT_EQ(find_key(case_keys(), key.name), &key);
  }
  EXPECT_EQ(find_key(case_keys(), "cell.colour"), nullptr);
}

TEST(CaseKeys, HaveFiniteRangesThatHoldTheirDefault) {
  for (const auto& key : case_keys()) {
    const auto* number = std::get_if<Number>(&key.kind);
    if (!number) continue;
    EXPECT_TRUE(std::isfinite(number->range.least) && std::isfinite(number->range.greatest)) << key.name;
    EXPECT_FALSE(number->range.contains(std::nan("")));
    const auto* usual = fallback_of(key);
    EXPECT_TRUE(!usual || number->range.contains(std::get<double>(*usual))) << key.name;
  }
}

TEST(CaseKeys, ReferToOtherKeysThatExist) {
  for (const auto& key : case_keys()) {
    EXPECT_TRUE(key.alternative.empty() || case_key(key.alternative).alternative == key.name) << key.name;
    if (!key.only_for) continue;
    const auto* other = find_key(case_keys(), key.only_for->key);
    ASSERT_TRUE(other) << key.name;
    if (key.only_for->option.empty()) continue;  // it need only be given
    const auto& options = std::get<Choice>(other->kind).options;
    EXPECT_EQ(std::count(options.begin(), options.end(), key.only_for->option), 1) << key.name;
  }
}

TEST(CaseKeys, AreReadAndWrittenThroughTheSameMember) {
  const auto expect = [](const Key<Case>& key, const Value& value) {
    Case c;
    key.set(c, value);
    EXPECT_TRUE(std::visit(
        [&](const auto& wanted) {
          using T = std::decay_t<decltype(wanted)>;
          if constexpr (std::is_same_v<T, Spread>)
            return false;
          else
            return std::get<T>(key.get(c).value()) == wanted;
        },
        value))
        << key.name;
  };
  for (const auto& key : case_keys()) {
    if (std::holds_alternative<Number>(key.kind)) expect(key, 0.375);
    if (std::holds_alternative<List>(key.kind)) expect(key, std::vector<double>{1, 2.5});
    if (const auto* choice = std::get_if<Choice>(&key.kind))
      for (int option = 0; option < static_cast<int>(choice->options.size()); ++option) expect(key, option);
  }
}

TEST(CaseReference, InDocsIsUpToDate) {
  std::ostringstream text;
  text << std::ifstream(CASE_REFERENCE).rdbuf();
  EXPECT_EQ(text.str(), reference_markdown(case_reference()))
      << "run `build/rheocyte help case --markdown > docs/case-reference.md`";
}

}  // namespace
}  // namespace rheocyte::case_keys_test
