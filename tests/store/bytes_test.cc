// Values come back from their bytes as they were, and from damaged bytes not at all.
#include "store/bytes.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace rheocyte::bytes_test {
namespace {

struct Inner {
  std::string name;
  Eigen::MatrixX2d points;
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.name, s.points);
  }
};

struct Outer {
  int number = 0;
  std::optional<double> fraction;
  std::array<std::size_t, 3> counts{};
  std::vector<Inner> inner;
  std::vector<std::string> words;
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.number, s.fraction, s.counts, s.inner, s.words);
  }
};

Outer some_value() {
  return {
      -7, 0.1, {1, 2, 3}, {{"a\0b", Eigen::MatrixX2d::Random(4, 2)}, {"", Eigen::MatrixX2d(0, 2)}}, {"x", "", "yz"}};
}

TEST(Bytes, AValueComesBackAsItWas) {
  const Outer value = some_value();
  const auto back = from_bytes<Outer>(to_bytes(value));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->number, value.number);
  EXPECT_EQ(back->fraction, value.fraction);
  EXPECT_EQ(back->counts, value.counts);
  ASSERT_EQ(back->inner.size(), 2U);
  EXPECT_EQ(back->inner[0].name, value.inner[0].name);
  EXPECT_EQ(back->inner[0].points, value.inner[0].points);
  EXPECT_EQ(back->words, value.words);
}

TEST(Bytes, TooFewOrTooManyAreRefused) {
  const std::string bytes = to_bytes(some_value());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(from_bytes<Outer>(std::string_view(bytes).substr(0, size))) << size;
  EXPECT_FALSE(from_bytes<Outer>(bytes + "x"));
}

// A count says how much to make: one beyond the bytes must not fill the memory.
TEST(Bytes, ACountBeyondTheBytesMakesNothing) {
  const std::string many = to_bytes(std::uint64_t{1} << 60U);
  EXPECT_FALSE(from_bytes<std::string>(many));
  EXPECT_FALSE(from_bytes<Eigen::VectorXd>(many));
  EXPECT_FALSE(from_bytes<std::vector<Outer>>(many));
}

}  // namespace
}  // namespace rheocyte::bytes_test
