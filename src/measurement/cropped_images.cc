#include "measurement/cropped_images.h"

#include <algorithm>

#include "measurement/hdf5_reading.h"

namespace rheocyte {

namespace {

constexpr std::size_t index_columns = 5;
constexpr int most_events_in_a_frame = 1000;
constexpr std::int64_t most_parts = 10'000;

}  // namespace

std::optional<CroppedImages> CroppedImages::open(Hdf5Handle group, ImageSize size, std::uintmax_t file_bytes) {
  auto index = group ? open_numbers(group.get(), "index", file_bytes) : std::nullopt;
  if (!index || index->shape.extent.size() != 2 || index->shape.extent[1] != index_columns) return std::nullopt;
  CroppedImages images;
  images.background_ = read_attributes(group.get()).text("inverse_background_feature").value_or("");
  images.size_ = size;
  images.file_bytes_ = file_bytes;
  images.group_ = std::move(group);
  images.index_ = std::move(*index);
  return images;
}

bool CroppedImages::read_index(const PieceRead& on_piece) const {
  if (!rows_.empty()) return true;
  std::vector<std::int64_t> numbers(index_columns * events());
  if (!read_rows(index_, 0, std::span(numbers), on_piece)) return false;
  rows_.reserve(events());
  for (auto n = numbers.begin(); n != numbers.end(); n += index_columns)
    rows_.push_back({n[0], n[1], n[2], n[3], n[4]});
  return true;
}

bool CroppedImages::read(std::size_t event, std::span<std::uint8_t> picture, const PieceRead& on_piece) const {
  std::ranges::fill(picture, 0);
  if (!read_index(on_piece)) return false;
  std::size_t at = event;
  for (int count = 0; count < most_events_in_a_frame && at < events(); ++count) {
    if (!place(rows_[at], picture, on_piece)) return false;
    at = static_cast<std::size_t>(rows_[at].next);
    if (at == event) return true;
  }
  return false;
}

bool CroppedImages::place(const Row& row, std::span<std::uint8_t> picture, const PieceRead& on_piece) const {
  Part* const found = part(row.part);
  if (!found || row.row < 0 || row.y < 0 || row.x < 0) return false;
  if (!read_rows(found->data, static_cast<std::size_t>(row.row), std::span(found->pixels), on_piece)) return false;
  const auto y = static_cast<std::size_t>(row.y), x = static_cast<std::size_t>(row.x);
  if (y >= size_.height || x >= size_.width) return false;
  const std::size_t width = found->data.shape.extent[2];
  const std::size_t lines = std::min(found->data.shape.extent[1], size_.height - y);
  const std::size_t seen = std::min(width, size_.width - x);
  for (std::size_t i = 0; i < lines; ++i)
    for (std::size_t k = 0; k < seen; ++k)
      if (const std::uint8_t pixel = found->pixels[i * width + k]) picture[(y + i) * size_.width + x + k] = pixel;
  return true;
}

CroppedImages::Part* CroppedImages::part(std::int64_t number) const {
  if (number < 0 || number >= most_parts) return nullptr;
  const auto place = static_cast<std::size_t>(number);
  if (place >= parts_.size()) parts_.resize(place + 1);
  if (!parts_[place]) {
    auto data = open_numbers(group_.get(), std::to_string(number), file_bytes_);
    if (!data || !data->shape.is_pictures()) return nullptr;
    std::vector<std::uint8_t> pixels(data->shape.width());
    parts_[place] = {std::move(*data), std::move(pixels)};
  }
  return &*parts_[place];
}

}  // namespace rheocyte
