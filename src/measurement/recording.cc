#include "measurement/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>

#include "case/refuse_path.h"
#include "case/user_error.h"
#include "measurement/hdf5_writing.h"
#include "measurement/open_recording.h"
#include "measurement/recording_content.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

namespace fs = std::filesystem;

// Which compression is missing, if that is the reason why data could not be read.
std::string missing_filter(hid_t dataset) {
  const Hdf5Handle properties(::H5Dget_create_plist(dataset));
  const int count = properties ? ::H5Pget_nfilters(properties.get()) : 0;
  for (int i = 0; i < count; ++i) {
    unsigned flags = 0;
    std::size_t values = 0;
    char name[64] = "";
    const auto number =
        ::H5Pget_filter2(properties.get(), unsigned(i), &flags, &values, nullptr, sizeof name, name, nullptr);
    if (number >= 0 && ::H5Zfilter_avail(number) <= 0)
      return fmt::format("it is compressed with the HDF5 filter {} ({}), which is not available here", number,
                         one_line(name, 60));
  }
  return "its data are damaged";
}

[[noreturn]] void refuse_data(const fs::path& file, const std::string& feature, hid_t dataset) {
  refuse_path(file, fmt::format("the feature {} cannot be read: {}.", one_line(feature, 60), missing_filter(dataset)));
}

std::size_t number_of_members(hid_t group) {
  H5G_info_t info{};
  return ::H5Gget_info(group, &info) < 0 ? 0 : info.nlinks;
}

// The length that most of them have; of equally frequent ones the greater.
std::size_t usual_length(const Datasets& features) {
  std::map<std::size_t, int> votes;
  for (const auto& [name, feature] : features)
    if (feature.shape.rows() > 0) ++votes[feature.shape.rows()];
  std::size_t best = 0;
  int most = 0;
  for (const auto& [length, count] : votes) {
    if (count < most) continue;
    most = count;
    best = length;
  }
  return best;
}

}  // namespace

Recording::~Recording() = default;
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;

Recording::Recording(const fs::path& file) {
  std::error_code error;
  Opening opening{.chain = {fs::weakly_canonical(file, error)}};
  *this = Recording(file, opening);
}

Recording::Recording(const fs::path& file, Opening& opening) : content_(std::make_unique<Content>()) {
  Content& c = *content_;
  c.path = file;
  OpenedRecording opened = open_recording(file);
  c.file = std::move(opened.file);
  c.others = std::move(opened.others);
  c.remarks = std::move(opened.remarks);
  std::error_code error;
  c.bytes = c.bytes_with_basins = fs::file_size(file, error);
  c.metadata = read_attributes(c.file.get());
  c.events_group = open_group(c.file.get(), "events");
  if (leads_to_another_file(c.file.get(), "events"))
    refuse_path(file, "keeps its events in another file, to which a link leads; such links are not followed.");
  if (!c.events_group) refuse_path(file, "has no group \"events\"; is it a recording of RT-DC?");
  const auto names = member_names(c.events_group.get());
  if (!names) refuse_path(file, "is damaged: the list of its features cannot be read.");
  for (const auto& name : *names)
    if (name != "contour") open_feature(name);
  c.contours = open_group(c.events_group.get(), "contour");
  c.events = usual_length(c.scalars);
  if (c.events == 0) c.events = usual_length(c.images);
  if (c.events == 0 && c.contours) c.events = number_of_members(c.contours.get());
  open_basins(opening);
  if (c.events == 0) refuse_path(file, "contains no events.");
  if (double(c.events) > reading_limits.events_per_byte * double(c.bytes_with_basins))
    refuse_path(file, fmt::format("is damaged: it claims {} events, more than its {} bytes can hold.", c.events,
                                  c.bytes_with_basins));
  const auto said = c.metadata.number("experiment:event count");
  if (said && *said != static_cast<double>(c.events))
    c.remarks.push_back(fmt::format("experiment:event count is {}, but the data have {} events.", *said, c.events));
  for (const auto* const datasets : {&c.scalars, &c.images})
    for (const auto& [name, feature] : *datasets)
      if (feature.shape.rows() != c.events)
        c.remarks.push_back(
            fmt::format("{} has {} rows for {} events.", one_line(name, 60), feature.shape.rows(), c.events));
}

void Recording::open_feature(const std::string& name) {
  Content& c = *content_;
  auto data = open_numbers(c.events_group.get(), name, c.bytes);
  if (!data) {
    if (leads_to_another_file(c.events_group.get(), name))
      c.remarks.push_back(
          fmt::format("{} is a link to another file, which is not followed, and was left out.", one_line(name, 60)));
    else if (!open_group(c.events_group.get(), name))
      c.remarks.push_back(fmt::format("{} contains no usable numbers and was left out.", one_line(name, 60)));
    return;
  }
  if (data->shape.extent.size() == 1)
    c.scalars.emplace(name, std::move(*data));
  else if (data->shape.is_pictures())
    c.images.emplace(name, std::move(*data));
}

void Recording::on_piece(const std::function<void()>& told) {
  content_->on_piece = told;
  for (const auto& basin : content_->basins)
    if (basin.recording) basin.recording->on_piece(told);
}

const fs::path& Recording::file() const { return content_->path; }
const Metadata& Recording::metadata() const { return content_->metadata; }

std::vector<fs::path> Recording::files_of_basins() const {
  std::vector<fs::path> files = content_->others;
  for (const auto& basin : content_->basins) {
    if (!basin.recording) continue;
    files.push_back(basin.recording->file());
    std::ranges::copy(basin.recording->files_of_basins(), std::back_inserter(files));
  }
  return files;
}

std::size_t Recording::events() const { return content_->events; }
const std::vector<std::string>& Recording::remarks() const { return content_->remarks; }
std::int64_t Recording::root() const { return content_->file.get(); }

bool Recording::has_scalar(const std::string& feature) const {
  return content_->scalars.contains(feature) || basin_with(feature, Kind::scalar) != nullptr;
}

bool Recording::is_single_precision(const std::string& feature) const {
  if (const auto found = content_->scalars.find(feature); found != content_->scalars.end())
    return found->second.shape.single_precision;
  const auto* basin = basin_with(feature, Kind::scalar);
  return basin && basin->recording && basin->recording->is_single_precision(feature);
}

std::optional<std::int64_t> Recording::compressed_scalar(const std::string& feature) const {
  const auto found = content_->scalars.find(feature);
  if (found == content_->scalars.end() || found->second.shape.rows() != events()) return {};
  const hid_t dataset = found->second.dataset.get();
  const Hdf5Handle type(::H5Dget_type(dataset));
  if (::H5Tget_class(type.get()) != H5T_FLOAT || !is_compressed(dataset)) return {};
  return dataset;
}

void Recording::read_scalar(const std::string& feature, std::size_t first, std::span<double> values) const {
  if (const auto found = content_->scalars.find(feature); found != content_->scalars.end()) {
    const OpenDataset& data = found->second;
    const std::size_t rows = data.shape.rows(), there = first < rows ? std::min(values.size(), rows - first) : 0;
    if (!read_rows(data, first, values.first(there), content_->on_piece))
      refuse_data(content_->path, feature, data.dataset.get());
    std::ranges::fill(values.subspan(there), no_value);
  } else if (const auto* basin = basin_with(feature, Kind::scalar)) {
    read_through(*basin, feature, first, values);
  } else {
    std::ranges::fill(values, no_value);
  }
}

std::optional<ImageSize> Recording::image_size(const std::string& feature) const {
  const auto size_of = [](const OpenDataset& images) {
    return ImageSize{images.shape.extent[2], images.shape.extent[1]};
  };
  if (const auto found = content_->images.find(feature); found != content_->images.end()) return size_of(found->second);
  const auto* basin = basin_with(feature, Kind::pictures);
  if (!basin) return std::nullopt;
  if (basin->recording) return basin->recording->image_size(feature);
  const auto cropped = basin->cropped.find(feature);
  return cropped == basin->cropped.end() ? size_of(basin->internal.at(feature)) : cropped->second.size();
}

std::size_t Recording::image_rows_per_chunk(const std::string& feature) const {
  constexpr std::size_t some = 32;  // for what is kept in pieces of many shapes
  if (const auto found = content_->images.find(feature); found != content_->images.end())
    return std::max<std::size_t>(found->second.shape.rows_per_chunk, 1);
  const auto* basin = basin_with(feature, Kind::pictures);
  if (!basin || basin->mapping) return 1;
  if (basin->recording) return basin->recording->image_rows_per_chunk(feature);
  return basin->cropped.empty() ? 1 : some;
}

void Recording::read_stored(const OpenDataset& images, const std::string& feature, std::size_t first,
                            std::span<std::uint8_t> pixels) const {
  const std::size_t rows = images.shape.rows(), one = images.shape.width();
  const std::size_t there = first < rows ? std::min(pixels.size() / one, rows - first) : 0;
  if (!read_rows(images, first, pixels.first(there * one), content_->on_piece))
    refuse_data(content_->path, feature, images.dataset.get());
  std::ranges::fill(pixels.subspan(there * one), 0);
}

void Recording::read_cropped(const CroppedImages& images, const std::string& feature, std::size_t first,
                             std::span<std::uint8_t> pixels) const {
  const std::size_t one = images.size().pixels(), count = pixels.size() / one;
  const std::size_t there = first < images.events() ? std::min(count, images.events() - first) : 0;
  for (std::size_t i = 0; i < there; ++i)
    if (!images.read(first + i, pixels.subspan(i * one, one), content_->on_piece))
      refuse_data(content_->path, feature, images.dataset());
  std::ranges::fill(pixels.subspan(there * one), 0);
  if (images.background().empty() || there == 0) return;
  std::vector<std::uint8_t> background(there * one);
  read_images(images.background(), first, there, background);
  std::ranges::transform(background, pixels, pixels.begin(),
                         [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a + b); });
}

void Recording::read_images(const std::string& feature, std::size_t first, std::size_t count,
                            std::span<std::uint8_t> pixels) const {
  const std::size_t one = image_size(feature).value_or(ImageSize{}).pixels();
  if (one == 0 || one * count != pixels.size()) {
    std::ranges::fill(pixels, 0);
    return;
  }
  if (const auto found = content_->images.find(feature); found != content_->images.end())
    return read_stored(found->second, feature, first, pixels);
  const Basin& basin = *basin_with(feature, Kind::pictures);
  const auto read = [&](std::size_t from, std::span<std::uint8_t> target) {
    if (basin.recording) return basin.recording->read_images(feature, from, target.size() / one, target);
    if (const auto cropped = basin.cropped.find(feature); cropped != basin.cropped.end())
      return read_cropped(cropped->second, feature, from, target);
    read_stored(basin.internal.at(feature), feature, from, target);
  };
  if (!basin.mapping) return read(first, pixels);
  std::ranges::fill(pixels, 0);
  for (std::size_t i = 0; i < count && first + i < basin.mapping->size(); ++i)
    read(static_cast<std::size_t>((*basin.mapping)[first + i]), pixels.subspan(i * one, one));
}

bool Recording::has_contours() const {
  return bool(content_->contours) || basin_with("contour", Kind::contours) != nullptr;
}

PixelContour Recording::read_contour(std::size_t event) const {
  if (!content_->contours) {
    const auto* basin = basin_with("contour", Kind::contours);
    if (!basin) return {};
    if (!basin->mapping) return basin->recording->read_contour(event);
    return event < basin->mapping->size()
               ? basin->recording->read_contour(static_cast<std::size_t>((*basin->mapping)[event]))
               : PixelContour{};
  }
  const auto data = open_numbers(content_->contours.get(), std::to_string(event), content_->bytes);
  if (!data || data->shape.extent.size() != 2 || data->shape.extent[1] != 2 ||
      data->shape.rows() > reading_limits.contour_points)
    return {};
  const std::size_t points = data->shape.rows();
  std::vector<std::int64_t> numbers(2 * points);
  if (!read_rows(*data, 0, std::span(numbers), content_->on_piece)) return {};
  const auto side = static_cast<std::int64_t>(reading_limits.image_side);
  PixelContour contour;
  for (std::size_t i = 0; i < points; ++i) {
    const std::int64_t x = numbers[2 * i], y = numbers[2 * i + 1];
    if (std::min(x, y) < -side || std::max(x, y) > side) return {};
    contour.push_back({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)});
  }
  return contour;
}

}  // namespace rheocyte
