#include "extract/event_table.h"

#include <charconv>
#include <cmath>
#include <fstream>

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

std::string_view mark_of_events(const std::filesystem::path& file) {
  constexpr std::string_view former = "# rheocyte ";
  std::string start(former.size(), '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == former ? former : first_columns_of_events;
}

std::string commented(const std::vector<std::string>& remarks) {
  std::string text;
  for (const auto& remark : remarks) text.append("# ").append(one_line(remark, 1000)).append("\n");
  return text;
}

EventTable::EventTable(const std::filesystem::path& file, const std::vector<std::string>& remarks, bool has_errors)
    : file_(file), has_errors_(has_errors) {
  text_ += first_columns_of_events;
  text_ += has_errors_ ? "standard_error_kPa\tstate\n" : "state\n";
  text_ += commented(remarks);
  write_out();
}

void EventTable::write_out() {
  file_.append(text_);
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
    for (const char c : name_of(block.state[i])) text_ += c == ' ' ? '_' : c;
    text_ += '\n';
  }
  write_out();
}

}  // namespace rheocyte
