// The columns of cells that recordings saw along a channel.
#pragma once
#include <string>
#include <string_view>

#include "infer/time_course.h"
#include "report/column.h"

namespace rheocyte {

/// With these words the file begins: its first line holds the names of all columns.
inline constexpr std::string_view mark_of_courses = "recording\tcell\tevents\tfirst_place_um\t";

/// Of a cell that was seen again, in the channel of its recording.
struct CourseRow {
  std::string recording;
  double cell = 0, events = 0;  ///< its number, and how many events it is
  double first_place_um = 0, last_place_um = 0, radius_um = 0;
  Credible young_modulus_kPa{}, viscosity_Pas{};
  double chi_squared = 0;
  double section_factor = 1;  ///< of c_3, over that in the tube
  double section_error = 0;   ///< relative, of E, within its interval
  DrawnOut drawn_out{};
  std::string status = {}, event_numbers = {};
};

const Columns<CourseRow>& course_columns();

}  // namespace rheocyte
