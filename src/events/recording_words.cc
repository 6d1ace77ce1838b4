// The sentences about a recording.
#include <fmt/format.h>

#include "events/plausibility.h"
#include "events/recording_facts.h"

namespace rheocyte {

namespace {

std::string temperature_text(const RecordingFacts& facts) {
  return fmt::format("{} {} outside {}, for which the viscosity model {} was measured.", facts.outside_temperature,
                     facts.outside_temperature == 1 ? "event has a temperature" : "events have temperatures",
                     facts.range_of_viscosity_model, facts.viscosity_model);
}

std::string inertia_text(const RecordingFacts& facts) {
  return fmt::format(
      "{} {} above {:g}, up to {:.2g}: the tables neglect the inertia of the liquid, which changes moduli by about "
      "{:.1f} % for each unit up to 8 and by an unknown amount beyond; are flow rate and viscosity right?",
      facts.inertial, facts.inertial == 1 ? "event has a Reynolds number" : "events have Reynolds numbers",
      max_reynolds_number, facts.greatest_reynolds_number, 100 * modulus_per_reynolds);
}

}  // namespace

std::string cut_text(std::size_t events) {
  if (events == 1)
    return "1 event is left out, because its outline touches the edge of the picture: the cell is cut off.";
  return fmt::format(
      "{} events are left out, because their outlines touch the edge of the picture: the cells are cut off.", events);
}

std::vector<std::string> remarks(const RecordingFacts& facts) {
  std::vector<std::string> sentences = facts.notes;
  if (facts.outside_temperature > 0) sentences.push_back(temperature_text(facts));
  if (facts.cut > 0) sentences.push_back(cut_text(facts.cut));
  if (facts.inertial > 0) sentences.push_back(inertia_text(facts));
  return sentences;
}

}  // namespace rheocyte
