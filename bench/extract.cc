// Throughput of the extraction of moduli, one core: from memory, and outlines from masks.
//
//     bench_extract TABLE GRID ELONGATED [options of Google Benchmark]
//
// TABLE: a published table, e.g. lut_LE-2D-FEM-19.txt; GRID: one of rheocyte, e.g. data/grid_LE-2D-26.cbor;
// ELONGATED: data/elongated_HE-3D-el-26.cbor
#include <benchmark/benchmark.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <vector>

#include "case/user_error.h"
#include "infer/elongated_solids.h"
#include "infer/grid_map.h"
#include "infer/published_map.h"
#include "measurement/contour_features.h"
#include "measurement/contour_from_mask.h"
#include "measurement/viscosity.h"
#include "program.h"
#include "store/read_file.h"

namespace rheocyte {
namespace {

constexpr std::size_t events = 1'000'000;
PublishedTable published;
std::unique_ptr<PublishedMap> table;
std::unique_ptr<GridMap> grid;
std::unique_ptr<ElongatedSolids> elongated;

struct Events {
  std::vector<double> area, deformation, temperature;
};

// Everywhere in the table with equal probability: the worst case for the processor's caches.
Events uniform_in_hull() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1), degrees(22, 25);
  Events all;
  const MeasuringConditions conditions{{20, 0.06}, 0};
  while (all.area.size() < events) {
    const double area = 340 * unit(random), deformation = 0.2 * unit(random), viscosity = 5;
    double modulus = NAN;
    table->moduli(conditions, {{&area, 1}, {&deformation, 1}, {&viscosity, 1}}, {&modulus, 1});
    if (std::isnan(modulus)) continue;
    all.area.push_back(area);
    all.deformation.push_back(deformation);
    all.temperature.push_back(degrees(random));
  }
  return all;
}

// A population as it is measured: areas 80 +- 12 um^2, deformations about 0.035.
Events population() {
  std::mt19937 random(2);
  std::normal_distribution<double> area(80, 12), degrees(23, 0.2);
  std::lognormal_distribution<double> deformation(std::log(0.035), 0.4);
  Events all;
  for (std::size_t i = 0; i < events; ++i) {
    all.area.push_back(area(random));
    all.deformation.push_back(deformation(random));
    all.temperature.push_back(degrees(random));
  }
  return all;
}

// Viscosity of each event's temperature, pixelation, modulus.
void moduli(benchmark::State& state, const Events& all) {
  const Buffer buffer(Medium::methyl_cellulose_049, ViscosityModel::buyukurganci_2022);
  const std::size_t block = 1 << 16;  // as the program reads them
  std::vector<double> viscosity(block), modulus(block);
  for (auto _ : state)
    for (std::size_t first = 0; first < events; first += block) {
      const std::size_t count = std::min(block, events - first);
      const auto part = [&](const std::vector<double>& column) { return std::span(column).subspan(first, count); };
      const std::span<double> eta(viscosity.data(), count), result(modulus.data(), count);
      buffer.viscosity({20, 0.06}, part(all.temperature), eta);
      table->moduli({{20, 0.06}, 0.34}, {part(all.area), part(all.deformation), eta}, result);
      benchmark::DoNotOptimize(modulus.data());
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * events));
}

void moduli_uniform_in_hull(benchmark::State& state) {
  static const Events all = uniform_in_hull();
  moduli(state, all);
}

void moduli_of_a_population(benchmark::State& state) {
  static const Events all = population();
  moduli(state, all);
}

// Viscosity of each event's temperature, pixels, modulus, standard error and state.
void own_moduli(benchmark::State& state, const Events& all) {
  const Buffer buffer(Medium::methyl_cellulose_049, ViscosityModel::buyukurganci_2022);
  const std::size_t block = 1 << 16;
  std::vector<double> viscosity(block), modulus(block), error(block);
  std::vector<ModulusState> states(block);
  for (auto _ : state)
    for (std::size_t first = 0; first < events; first += block) {
      const std::size_t count = std::min(block, events - first);
      const auto part = [&](const std::vector<double>& column) { return std::span(column).subspan(first, count); };
      const std::span<double> eta(viscosity.data(), count);
      buffer.viscosity({20, 0.06}, part(all.temperature), eta);
      grid->estimate({{20, 0.06}, 0.34}, {part(all.area), part(all.deformation), eta},
                     {{modulus.data(), count}, {error.data(), count}, {states.data(), count}});
      benchmark::DoNotOptimize(modulus.data());
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * events));
}

void own_moduli_uniform(benchmark::State& state) {
  static const Events all = uniform_in_hull();
  own_moduli(state, all);
}

void own_moduli_of_a_population(benchmark::State& state) {
  static const Events all = population();
  own_moduli(state, all);
}

// As of elongated cells, half of them drawn out.
void own_moduli_of_elongated_cells(benchmark::State& state) {
  static const Events all = population();
  std::vector<double> mode_2, mode_3, mode_4, mode_5;
  const ShapeGrid& shapes = grid->shapes()->shapes();
  for (std::size_t i = 0; i < events; ++i) {
    const double log_area = std::log(all.area[i]);
    mode_2.push_back(shapes.mode(2, log_area, all.deformation[i]) + (i % 2 ? 0.1 : 0));
    mode_3.push_back(0.7 * shapes.mode(3, log_area, all.deformation[i]));
    mode_4.push_back(shapes.mode(4, log_area, all.deformation[i]));
    mode_5.push_back(shapes.mode(5, log_area, all.deformation[i]));
  }
  const std::vector<double> viscosity(events, 5.0);
  std::vector<double> modulus(events), error(events), other(events);
  std::vector<ModulusState> states(events);
  std::vector<ElongatedCell> cells(events);
  for (auto _ : state) {
    elongated->estimate({{20, 0.06}, 0.34}, {all.area, all.deformation, viscosity},
                        {ElongatedBy::modes, mode_2, mode_3, mode_4, mode_5},
                        {{modulus, error, states}, other, other, other, other, cells});
    benchmark::DoNotOptimize(modulus.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * events));
}

void viscosities(benchmark::State& state) {
  static const Events all = population();
  const Buffer buffer(Medium::methyl_cellulose_049, ViscosityModel::buyukurganci_2022);
  std::vector<double> viscosity(events);
  for (auto _ : state) buffer.viscosity({20, 0.06}, all.temperature, viscosity);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * events));
}

void table_and_triangulation(benchmark::State& state) {
  for (auto _ : state) {
    const PublishedMap again(published);
    benchmark::DoNotOptimize(&again);
  }
}

// Masks of 250 x 80 pixels with one elliptic cell each, as an RT-DC camera gives them.
std::vector<std::uint8_t> masks(const ImageSize& size, std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<std::uint8_t> pixels;
  for (std::size_t k = 0; k < count; ++k) {
    const double a = 14 + 10 * unit(random), b = 12 + 4 * unit(random), x0 = 40 + 170 * unit(random);
    const double y0 = 40 + 3 * unit(random);
    for (std::size_t y = 0; y < size.height; ++y)
      for (std::size_t x = 0; x < size.width; ++x)
        pixels.push_back(std::pow((double(x) - x0) / a, 2) + std::pow((double(y) - y0) / b, 2) < 1 ? 255 : 0);
  }
  return pixels;
}

void features_from_masks(benchmark::State& state) {
  const ImageSize size{250, 80};
  const std::size_t count = 1000;
  const auto pixels = masks(size, count);
  ContourFinder finder;
  ContourMeasurer measurer;
  for (auto _ : state)
    for (std::size_t i = 0; i < count; ++i) {
      const Mask mask{size, std::span(pixels).subspan(i * size.pixels(), size.pixels())};
      const auto features = measurer.measure(finder.contour_of(mask), 0.34);
      benchmark::DoNotOptimize(&features);
    }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * count));
}

BENCHMARK(moduli_uniform_in_hull)->Unit(benchmark::kMillisecond);
BENCHMARK(moduli_of_a_population)->Unit(benchmark::kMillisecond);
BENCHMARK(own_moduli_uniform)->Unit(benchmark::kMillisecond);
BENCHMARK(own_moduli_of_a_population)->Unit(benchmark::kMillisecond);
BENCHMARK(own_moduli_of_elongated_cells)->Unit(benchmark::kMillisecond);
BENCHMARK(viscosities)->Unit(benchmark::kMillisecond);
BENCHMARK(table_and_triangulation)->Unit(benchmark::kMillisecond);
BENCHMARK(features_from_masks)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rheocyte

int rheocyte::measure(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 4) throw UserError("usage: bench_extract TABLE GRID ELONGATED [options of Google Benchmark]");
  published = read_published_table(argv[1]);
  table = std::make_unique<PublishedMap>(published);
  std::ifstream file(argv[2], std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  grid = std::make_unique<GridMap>(grid_from_bytes(bytes, argv[2]));
  elongated =
      std::make_unique<ElongatedSolids>(elongated_from_bytes(content_of_file(argv[3], largest_elongated), argv[3]));
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
