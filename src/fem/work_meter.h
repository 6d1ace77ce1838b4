// Where the time of a computation goes.
#pragma once
#include <chrono>

namespace rheocyte {

/// Seconds and counts of the parts of the work; seconds are added over the threads.
struct WorkMeter {
  double assembly_s = 0;  ///< integrals over elements: residuals and tangents
  double factorisation_s = 0;
  double substitution_s = 0;  ///< solutions with the factors
  int factorisations = 0;

  WorkMeter& operator+=(const WorkMeter& other) {
    assembly_s += other.assembly_s;
    factorisation_s += other.factorisation_s;
    substitution_s += other.substitution_s;
    factorisations += other.factorisations;
    return *this;
  }
  WorkMeter operator-(const WorkMeter& other) const {
    return {assembly_s - other.assembly_s, factorisation_s - other.factorisation_s,
            substitution_s - other.substitution_s, factorisations - other.factorisations};
  }
};

/// Adds the seconds of its life.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace rheocyte
