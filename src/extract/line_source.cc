#include "extract/line_source.h"

#include <utility>

#include "extract/any_table.h"

namespace rheocyte {

namespace {

std::variant<LineFinder, GridLineFinder> finder_for(AnyTable table) {
  if (auto* const grid = std::get_if<GridContent>(&table)) return GridLineFinder(std::move(*grid));
  return LineFinder(std::get<PublishedTable>(std::move(table)));
}

}  // namespace

LineSource::LineSource(const std::filesystem::path& table) : finder_(finder_for(read_any_table(table))) {}

std::vector<double> LineSource::even_levels(int count) const {
  return std::visit([&](const auto& finder) { return finder.even_levels(count); }, finder_);
}

LevelLines LineSource::lines(std::span<const double> levels_kPa) const {
  return std::visit([&](const auto& finder) { return finder.lines(levels_kPa); }, finder_);
}

std::vector<PlanePoint> LineSource::support() const {
  return std::visit([](const auto& finder) { return finder.support(); }, finder_);
}

PixelCorrection LineSource::pixel_correction() const {
  return std::holds_alternative<GridLineFinder>(finder_) ? PixelCorrection::own : PixelCorrection::field;
}

}  // namespace rheocyte
