#include "measurement/open_recording.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "measurement/text_recording.h"
#include "measurement/text_table.h"
#include "store/read_file.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// By the flags that HDF5 sets in the superblock of a file of its newest version and clears at the end.
bool is_being_written(const fs::path& file) {
  constexpr std::size_t version_at = 8, flags_at = 11;
  constexpr unsigned char writing = 1, single_writer = 4;
  std::array<char, flags_at + 1> head{};
  std::ifstream(file, std::ios::binary).read(head.data(), head.size());
  return head[version_at] == 3 && (static_cast<unsigned char>(head[flags_at]) & (writing | single_writer)) != 0;
}

/// In the words of a shell; the table as text has the same name.
std::string conversion_of_parquet(const fs::path& file) {
  const std::string from = one_line(file.string(), 200),
                    to = one_line(fs::path(file).replace_extension(".csv").string(), 200);
  return fmt::format("python -c \"import pandas; pandas.read_parquet('{}').to_csv('{}', index=False)\"", from, to);
}

// Files of the field's programs, and tables, that are not read.
void refuse_other_kinds(const fs::path& file) {
  const std::string kind = file.extension().string();
  const std::string head = first_bytes(file, 4).value_or("");
  if (kind == ".parquet" || head == "PAR1")
    refuse_path(file, fmt::format("is a table in Parquet, which only the Python functions read; convert it with {}.",
                                  conversion_of_parquet(file)));
  if (head == "PK\x03\x04" || head == "\xD0\xCF\x11\xE0")
    refuse_path(file,
                "is a workbook, as of Excel, or an archive; save its table of events as CSV (UTF-8) and give that.");
  if (kind == ".tdms")
    refuse_path(file, "is a recording in the older format .tdms; convert it with dclab-tdms2rtdc of dclab[tdms].");
  if (kind == ".so2")
    refuse_path(file,
                "is a session of DCscope, not a recording; give its recordings, or export there what passes its "
                "filters as .rtdc, or its polygon filters as .poly for --polygon.");
  if (kind == ".poly") refuse_path(file, "holds polygon filters; give it with --polygon, beside recordings (.rtdc).");
}

}  // namespace

OpenedRecording open_recording(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) refuse_missing(file);
  if (!fs::is_regular_file(status)) refuse_path(file, "is not a file; give an .rtdc recording.");
  prepare_hdf5();
  if (is_text_table(file)) {
    refuse_other_kinds(file);
    return open_text_recording(file);
  }
  const Hdf5Handle access(::H5Pcreate(H5P_FILE_ACCESS));
  // Recordings often lie on network drives that know no locks; nothing is written to them.
  ::H5Pset_file_locking(access.get(), false, true);
  const std::string name = file.string();  // UTF-8 on Windows, too
  Hdf5Handle opened(::H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.get()));
  if (opened) return {std::move(opened)};
  if (!first_bytes(file, 1)) refuse_path(file, "cannot be read; check its permissions.");
  if (::H5Fis_hdf5(name.c_str()) <= 0) refuse_other_kinds(file);
  if (::H5Fis_hdf5(name.c_str()) <= 0)
    refuse_path(file, "is not an HDF5 file, or its first bytes are damaged; .rtdc recordings are HDF5 files.");
  if (is_being_written(file))
    refuse_path(file,
                "is open for writing: its recording has not ended, or the program that made it broke down; wait for "
                "the end, or free it with h5clear -s (of the HDF5 tools).");
  refuse_path(file, "is damaged or incomplete and cannot be opened; copy it once more from where it was recorded.");
}

}  // namespace rheocyte
