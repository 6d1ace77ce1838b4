// What the page shows names its own fields.
#include "view/page_words.h"

#include <gtest/gtest.h>

namespace rheocyte::page_words_test {
namespace {

TEST(PageWords, FieldsStandInPlaceOfOptions) {
  EXPECT_EQ(
      in_words_of_page("a.rtdc: holds no temperature; give --temperature in degrees Celsius, or --viscosity-mPas."),
      "a.rtdc: holds no temperature; give Temperature in degrees Celsius, or Viscosity.");
  EXPECT_EQ(in_words_of_page("--temperature-if-missing leaves (--medium too)"),
            "Temperature if missing leaves (Medium too)");
  EXPECT_EQ(in_words_of_page("give it with --pixel-size-um."), "give it with Pixel size.");
}

TEST(PageWords, NamesOfFilesAndUnknownOptionsStay) {
  for (const char* text : {"/data/run--temperature/a.rtdc: is damaged.", "--other and --", "a -- b", ""})
    EXPECT_EQ(in_words_of_page(text), text);
}

}  // namespace
}  // namespace rheocyte::page_words_test
