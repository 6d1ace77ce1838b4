// The outlines of all events in turn are those of single ones, however the file holds them.
#include "measurement/event_outlines.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "measurement/recording_writer.h"

namespace rheocyte::event_outlines_test {
namespace {

using test::RecordingWriter;
using test::ScratchFolder;
using test::Storage;

constexpr std::size_t events = 150, height = 20, width = 30;

/// Blocks of pixels, no two events alike.
std::vector<std::uint8_t> masks(std::size_t count) {
  std::vector<std::uint8_t> pixels(count * height * width);
  for (std::size_t event = 0; event < count; ++event)
    for (std::size_t y = 2; y < 4 + event % 15; ++y)
      for (std::size_t x = 3; x < 5 + event % 23; ++x) pixels[(event * height + y) * width + x] = 255;
  return pixels;
}

void expect_alike(const Recording& recording) {
  EventOutlines single(recording, 0.34), in_turn(recording, 0.34);
  for (const auto& [first, count] :
       {std::pair<std::size_t, std::size_t>{0, events}, {37, 1}, {31, 90}, {149, 1}, {8, 0}}) {
    std::size_t next = first;
    in_turn.each(first, count, [&](std::size_t event, const PixelContour& contour) {
      EXPECT_EQ(event, next++);
      EXPECT_EQ(contour, single.outline(event)) << event;
      EXPECT_FALSE(contour.empty());
    });
    EXPECT_EQ(next, first + count);
  }
}

TEST(EventOutlines, InTurnAreThoseOfSingleMasks) {
  for (const hsize_t rows_per_chunk : {0, 1, 7, 32, 150}) {
    const ScratchFolder folder;
    RecordingWriter(folder / "a.rtdc")
        .images("mask", masks(events), height, width, {Storage::Filter::none, false, rows_per_chunk});
    expect_alike(Recording(folder / "a.rtdc"));
  }
}

TEST(EventOutlines, InTurnAreThoseOfSingleContours) {
  const ScratchFolder folder;
  {
    RecordingWriter writer(folder / "a.rtdc");
    writer.scalar("deform", std::vector<double>(events, 0.1));
    for (int i = 0; i < int(events); ++i) writer.contour({i, 1, i + 1, 1, i + 1, 2, i, 2});
  }
  expect_alike(Recording(folder / "a.rtdc"));
}

TEST(EventOutlines, OfLargeBlocksAreReadOneByOne) {
  constexpr std::size_t many = 5000;
  const ScratchFolder folder;
  RecordingWriter(folder / "a.rtdc").images("mask", masks(many), height, width, {Storage::Filter::zstd, false, many});
  const Recording recording(folder / "a.rtdc");
  EventOutlines single(recording, 0.34), in_turn(recording, 0.34);
  std::size_t next = 20;
  in_turn.each(next, 60, [&](std::size_t event, const PixelContour& contour) {
    EXPECT_EQ(event, next++);
    EXPECT_EQ(contour, single.outline(event));
  });
  EXPECT_EQ(next, 80U);
}

TEST(EventOutlines, WhatFailsInTurnEndsTheWork) {
  const ScratchFolder folder;
  RecordingWriter(folder / "a.rtdc").images("mask", masks(events), height, width, {Storage::Filter::zstd, false, 10});
  const Recording recording(folder / "a.rtdc");
  EventOutlines outlines(recording, 0.34);
  const auto fail = [](std::size_t event, const PixelContour&) {
    if (event == 40) throw std::runtime_error("no more");
  };
  EXPECT_THROW(outlines.each(0, events, fail), std::runtime_error);
  std::size_t seen = 0;
  outlines.each(0, events, [&](std::size_t, const PixelContour&) { ++seen; });
  EXPECT_EQ(seen, events);
}

}  // namespace
}  // namespace rheocyte::event_outlines_test
