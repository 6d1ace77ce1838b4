#include "extract/event_table.h"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cmath>

#include "case/user_error.h"

namespace rheocyte {

namespace {

template <class Number>
char* put(char* at, Number number) {
  return std::to_chars(at, at + 32, number).ptr;
}

char* put_number(char* at, double number) {
  if (std::isnan(number)) {
    for (const char c : {'n', 'a', 'n'}) *at++ = c;
    return at;
  }
  return put(at, static_cast<float>(number));
}

}  // namespace

EventTable::EventTable(const std::filesystem::path& file, const std::vector<std::string>& remarks, bool has_errors)
    : path_(file), file_(std::fopen(file.c_str(), "wbe")), has_errors_(has_errors) {
  if (!file_) refuse();
  for (const auto& remark : remarks) text_ += "# " + one_line(remark, 1000) + "\n";
  text_ += "event\tarea_um2\tdeformation\tviscosity_mPas\tyoung_modulus_kPa\t";
  text_ += has_errors_ ? "standard_error_kPa\tstate\n" : "state\n";
  write_out();
}

EventTable::~EventTable() {
  if (file_) std::fclose(file_);
}

void EventTable::refuse() const {
  throw UserError(fmt::format("{}: cannot be written; is the disk full, or is writing there not allowed?",
                              one_line(path_.string(), 300)));
}

void EventTable::write_out() {
  if (std::fwrite(text_.data(), 1, text_.size(), file_) != text_.size()) refuse();
  text_.clear();
}

void EventTable::append(const EventBlock& block) {
  char line[256];
  for (std::size_t i = 0; i < block.state.size(); ++i) {
    char* at = put(line, ++events_);
    for (const double number :
         {block.area_um2[i], block.deformation[i], block.viscosity_mPas[i], block.young_modulus_kPa[i]}) {
      *at++ = '\t';
      at = put_number(at, number);
    }
    if (has_errors_) {
      *at++ = '\t';
      at = put_number(at, block.standard_error_kPa[i]);
    }
    *at++ = '\t';
    text_.append(line, at);
    text_ += name_of(block.state[i]);
    text_ += '\n';
  }
  write_out();
}

void EventTable::close() {
  const bool good = std::fflush(file_) == 0 && ::fsync(::fileno(file_)) == 0;
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!good || !closed) refuse();
}

}  // namespace rheocyte
