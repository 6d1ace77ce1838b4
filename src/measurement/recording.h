// A recording of RT-DC: an .rtdc file (HDF5) or a text, one row per event (docs/theory-extract.md, sec. "recordings").
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "measurement/metadata.h"
#include "measurement/pixel_contour.h"

namespace rheocyte {

struct BasinDefinition;
class CroppedImages;
struct OpenDataset;

/// An open recording. Data are read in pieces when they are asked for; what lies in a basin (another file, or another
/// place of the same file) is found there. HDF5 may break on files that somebody damaged on purpose, or by accident in
/// the wrong place: open files of unknown origin in a process of their own.
class Recording {
 public:
  /// UserError: no such file, no HDF5, damaged, no events.
  explicit Recording(const std::filesystem::path& file);
  ~Recording();
  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;

  const std::filesystem::path& file() const;
  const Metadata& metadata() const;
  /// The files in which basins lie, theirs among them, and those of metadata: they determine what is read here, too.
  std::vector<std::filesystem::path> files_of_basins() const;

  /// Number of events: the length that most features have. The metadata may say something else; then there is a remark.
  std::size_t events() const;

  /// Sentences about what is odd in the file and was left out, without its name.
  const std::vector<std::string>& remarks() const;

  /// Called from now on after each piece of at most a chunk, or about 1 MiB, that was read here or in a basin.
  void on_piece(const std::function<void()>& told);

  /// Whether there is one number per event of this name, e.g. "area_um".
  bool has_scalar(const std::string& feature) const;

  /// Of all of them, in the order of the alphabet; with those of basins.
  std::vector<std::string> scalar_names() const;

  /// Whether a scalar is stored with 32 bits; other programs then compute with 32 bits, too.
  bool is_single_precision(const std::string& feature) const;

  /// HDF5's identifier of a scalar of all events that lies in this file itself, compressed and checked as a companion
  /// wants it; nothing otherwise. Valid while the recording lives.
  std::optional<std::int64_t> compressed_scalar(const std::string& feature) const;

  /// Values of events [first, first + values.size()); NaN for those that the feature does not cover.
  /// UserError if the data are damaged.
  void read_scalar(const std::string& feature, std::size_t first, std::span<double> values) const;

  /// Rows and columns of the pictures of a feature: "image", "image_bg", "mask"; nothing if there are none.
  std::optional<ImageSize> image_size(const std::string& feature) const;
  /// Events that are best read together, so that no piece of the file is decompressed twice; at least 1.
  std::size_t image_rows_per_chunk(const std::string& feature) const;
  /// Pictures of events [first, first + count) behind each other, row by row; those that are missing are all 0.
  /// `pixels` holds count pictures. UserError if the data are damaged.
  void read_images(const std::string& feature, std::size_t first, std::size_t count,
                   std::span<std::uint8_t> pixels) const;

  /// Of the pictures that the events were cut from, stored or not: what the metadata say, else that of stored ones; 0 x
  /// 0 if unknown.
  ImageSize size_of_pictures() const;

  bool has_contours() const;
  /// The contour of one event; empty if the event has none or it is damaged.
  PixelContour read_contour(std::size_t event) const;

  /// HDF5's identifier of the root group; valid while the recording lives.
  std::int64_t root() const;

 private:
  struct Content;
  struct Basin;
  /// While files and the basins of basins are opened.
  struct Opening {
    std::set<std::filesystem::path> chain;  ///< from the recording to this basin
    int files = 0;                          ///< in all
  };
  explicit Recording(const std::filesystem::path& file, Opening& opening);
  void open_feature(const std::string& name);
  void open_basins(Opening& opening);
  void add_basin(const BasinDefinition& definition, Opening& opening);
  void add_internal_basin(Basin basin);
  void add_file_basin(const BasinDefinition& definition, Basin basin, Opening& opening);
  /// Last of all, for size and background of the pictures may come from other basins.
  void add_cropped_images(const BasinDefinition& definition);
  /// Why not; empty if the basin can be read from this file.
  std::string open_basin_file(const std::filesystem::path& file, Basin& basin, Opening& opening) const;
  enum class Kind { scalar, pictures, contours };
  const Basin* basin_with(const std::string& feature, Kind kind) const;
  static bool is_in(const Basin& basin, const std::string& feature, Kind kind);
  static void read_through(const Basin& basin, const std::string& feature, std::size_t first, std::span<double> values);
  void read_stored(const OpenDataset& images, const std::string& feature, std::size_t first,
                   std::span<std::uint8_t> pixels) const;
  void read_cropped(const CroppedImages& images, const std::string& feature, std::size_t first,
                    std::span<std::uint8_t> pixels) const;

  std::unique_ptr<Content> content_;
};

}  // namespace rheocyte
