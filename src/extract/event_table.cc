#include "extract/event_table.h"

#include <charconv>
#include <cmath>

#include "case/user_error.h"
#include "store/read_file.h"

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

char* put_shape(char* at, const ShapeExcess& shape) {
  for (const double number : {shape.excess, shape.error}) {
    *at++ = '\t';
    at = put_number(at, number);
  }
  *at++ = '\t';
  *at++ = shape.is_elongated() ? '1' : '0';
  *at++ = '\t';
  return put_number(at, shape.odd_share);
}

}  // namespace

std::string_view mark_of_events(const std::filesystem::path& file) {
  constexpr std::string_view former = "# rheocyte ";
  return first_bytes(file, former.size()) == former ? former : first_columns_of_events;
}

std::string commented(const std::vector<std::string>& remarks) {
  std::string text;
  for (const auto& remark : remarks) text.append("# ").append(one_line(remark, 1000)).append("\n");
  return text;
}

EventTable::EventTable(const std::filesystem::path& file, const std::vector<std::string>& remarks,
                       const EventColumns& columns)
    : file_(file), columns_(columns) {
  text_ += first_columns_of_events;
  if (columns_.errors) text_ += "standard_error_kPa\t";
  text_ += "state";
  if (columns_.shapes) text_ += "\tshape_excess\tshape_excess_error\telongated\todd_share";
  if (columns_.asymmetry) text_ += "\tmode_3";
  for (const ElongationColumn& column : columns_.elongation) text_ += "\t" + column.name;
  if (columns_.asymmetry)
    for (const TiltFeature& feature : tilt_features()) text_.append("\t").append(feature.name);
  text_ += '\n';
  text_ += commented(remarks);
  write_out();
}

void EventTable::write_out() {
  file_.append(text_);
  text_.clear();
}

void EventTable::append(const EventBlock& block) {
  char line[512];
  for (std::size_t i = 0; i < block.state.size(); ++i) {
    char* at = put(line, ++events_);
    for (const double number :
         {block.area_um2[i], block.deformation[i], block.viscosity_mPas[i], block.young_modulus_kPa[i]}) {
      *at++ = '\t';
      at = put_number(at, number);
    }
    if (columns_.errors) {
      *at++ = '\t';
      at = put_number(at, block.standard_error_kPa[i]);
    }
    *at++ = '\t';
    for (const char c : name_of(block.state[i])) *at++ = c == ' ' ? '_' : c;
    if (columns_.shapes) at = put_shape(at, block.shape[i]);
    const auto add = [&](double number) {
      *at++ = '\t';
      at = put_number(at, number);
    };
    if (columns_.asymmetry) add(block.mode_3[i]);
    for (const ElongationColumn& column : columns_.elongation) add((block.elongation.*column.values)[i]);
    if (columns_.asymmetry)
      for (const TiltFeature& feature : tilt_features()) add(block.tilt[i].*feature.value);
    *at++ = '\n';
    text_.append(line, at);
  }
  write_out();
}

}  // namespace rheocyte
