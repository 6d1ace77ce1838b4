// Specifications in TOML: names of any characters within quotes come through, and sentences call them what they are.
#include "case/toml_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/user_error.h"

namespace rheocyte::toml_json_test {
namespace {

constexpr TextKind kind = specification("population", true);

std::string refusal(std::string_view text, const TextKind& of = kind) {
  try {
    json_of_toml(text, "spec.toml", of);
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

/// Of two, three and four bytes.
TEST(TomlJson, NamesOfAnyCharactersComeThroughStringsOfAllKinds) {
  for (const std::string name : {"5 \u00B5M", "\u8584\u819C.rtdc", "\U0001F9EB \u00E4\u00F6\u00FC", "\u00DF"}) {
    const auto found =
        json_of_toml("a = \"" + name + "\"\nb = '" + name + "'\nc = \"\"\"\n" + name + "\"\"\"\nd = '''" + name +
                         "'''\n[s]\n\"" + name + "\" = [\"" + name + "\\\\\"]\n",
                     "spec.toml", kind);
    for (const char* const key : {"a", "b", "c", "d"}) EXPECT_EQ(found[key], name) << key;
    EXPECT_EQ(found["s"][name][0], name + "\\");
  }
}

/// Two bytes: from U+0080 on; three: but for surrogates; four: the first ones.
TEST(TomlJson, EachCharacterComesThrough) {
  const auto bytes_of = [](unsigned code) {
    std::string text;
    if (code < 0x800) {
      text += char(0xC0 | code >> 6);
    } else if (code < 0x10000) {
      text += char(0xE0 | code >> 12), text += char(0x80 | (code >> 6 & 0x3F));
    } else {
      text += char(0xF0 | code >> 18), text += char(0x80 | (code >> 12 & 0x3F)),
          text += char(0x80 | (code >> 6 & 0x3F));
    }
    return text + char(0x80 | (code & 0x3F));
  };
  constexpr unsigned first_surrogate = 0xD800, last_surrogate = 0xDFFF, step = 7;
  for (unsigned code = 0x80; code < 0x11000; code += step) {
    if (code >= first_surrogate && code <= last_surrogate) continue;
    const std::string name = bytes_of(code);
    EXPECT_EQ(json_of_toml("a = '" + name + "'", "spec.toml", kind)["a"], name) << code;
  }
}

TEST(TomlJson, OutsideOfQuotesTheyAreASentence) {
  EXPECT_EQ(refusal("\nk\u00E4se = 3\n"),
            "spec.toml:2: the character \u00E4 can only stand in a comment or within quotes.");
  EXPECT_EQ(refusal("a = 5 \u00B5m"),
            "spec.toml:1: the character \u00B5 can only stand in a comment or within quotes.");
  EXPECT_EQ(refusal("a = '\u00B5m'", TextKind{}), "spec.toml:1: the character \u00B5 can only stand in a comment.");
  for (const char* const open :
       {"a = \"\u00B5m\nb = 3", "a = \"\u00B5\\\u00B5\"", "a = \"\u00B5", "a = '''\u00B5", "a = \"\u00B5\" \u00B5"})
    EXPECT_NE(refusal(open).find("spec.toml:"), std::string::npos) << open;
  for (const char* const surrogate : {"a = '\xED\xA0\x80'", "a = '\xC0\xAF'", "a = '\xF5\x80\x80\x80'"})
    EXPECT_NE(refusal(surrogate), "accepted");
}

TEST(TomlJson, ASpecificationIsNoCase) {
  EXPECT_EQ(refusal(" \n"), "spec.toml: the specification is empty; `rheocyte help population` lists its keys.");
  EXPECT_EQ(refusal(std::string("a = \0", 5)),
            "spec.toml:1: a zero byte; a specification is a text file in TOML, saved as UTF-8.");
  EXPECT_EQ(refusal("a = '\xFF'"),
            "spec.toml:1: a byte that is not UTF-8; a specification is a text file in TOML, saved as UTF-8.");
  EXPECT_NE(refusal("a = " + std::string(99, '[')).find("a specification needs three."), std::string::npos);
}

}  // namespace
}  // namespace rheocyte::toml_json_test
