// Random numbers that belong to a cell, not to a sequence: what is drawn for one cell does not depend on the others.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

namespace rheocyte {

/// What the numbers are for; each purpose has numbers of its own, so that noise does not change the population.
enum class Purpose : std::uint64_t { population, place, arrival, temperature, thermometer, contour, picture };

/// A stream of numbers, equal for equal seed, cell and purpose on every machine (SplitMix64, Steele et al. 2014, doi
/// 10.1145/2660193.2660195).
class CellRandom {
 public:
  CellRandom(std::uint64_t seed, std::uint64_t cell, Purpose purpose)
      : state_(mixed(mixed(mixed(seed) ^ cell) ^ static_cast<std::uint64_t>(purpose))) {}

  /// In (0, 1), never an end.
  double uniform() {
    state_ += 0x9e3779b97f4a7c15U;
    return (static_cast<double>(mixed(state_) >> 12U) + 0.5) * 0x1p-52;
  }

  /// Normal with mean 0 and standard deviation 1 (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_;
};

}  // namespace rheocyte
