// The functions of the C interface that open, refresh and close: they may allocate and throw inside.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <string_view>

#include "case/user_error.h"
#include "instrument/handles.h"
#include "numeric/no_value.h"

namespace rheocyte {

namespace {

/// Where the caller reads what is wrong.
struct Message {
  char* text;
  std::size_t bytes;

  void write(std::string_view sentence) const {
    if (text == nullptr || bytes == 0) return;
    const std::size_t count = std::min(sentence.size(), bytes - 1);
    std::copy_n(sentence.data(), count, text);
    text[count] = 0;
  }
};

/// What the work returns, or the status of what it throws.
template <class Work>
std::int32_t guarded(const Message& message, const Work& work) noexcept {
  const auto say = [&](rheocyte_cell_status status, std::string_view sentence) {
    message.write(sentence);
    return std::int32_t(status);
  };
  try {
    message.write("");
    return work();
  } catch (const NoTension& error) {
    return say(error.status(), error.what());
  } catch (const UserError& error) {
    return say(RHEOCYTE_CELL_BAD_SETTINGS, error.what());
  } catch (const std::bad_alloc&) {
    return say(RHEOCYTE_CELL_NO_MEMORY, rheocyte_cell_status_text(RHEOCYTE_CELL_NO_MEMORY));
  } catch (const std::exception& error) {
    return say(RHEOCYTE_CELL_INTERNAL, error.what());
  } catch (...) {
    return say(RHEOCYTE_CELL_INTERNAL, rheocyte_cell_status_text(RHEOCYTE_CELL_INTERNAL));
  }
}

bool has_processor() {
#ifdef __AVX2__
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return true;
#endif
}

rheocyte_cell_settings default_settings() {
  return {sizeof(rheocyte_cell_settings),
          0,
          nullptr,
          nullptr,
          nullptr,
          nullptr,
          no_value,
          no_value,
          no_value,
          no_value,
          no_value,
          no_value};
}

const char* filled(const char* text) { return text != nullptr && *text != 0 ? text : nullptr; }

}  // namespace

}  // namespace rheocyte

using namespace rheocyte;

std::int32_t rheocyte_cell_default_settings(rheocyte_cell_settings* settings) {
  if (settings == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  *settings = default_settings();
  return RHEOCYTE_CELL_OK;
}

std::int32_t rheocyte_cell_open(std::uint32_t abi, const rheocyte_cell_settings* settings, rheocyte_cell_setup** setup,
                                char* message, std::size_t message_bytes) {
  if (setup == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  *setup = nullptr;
  return guarded({message, message_bytes}, [&]() -> std::int32_t {
    if (settings == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
    if (abi != RHEOCYTE_CELL_ABI || settings->size != sizeof *settings) {
      Message{message, message_bytes}.write(
          fmt::format("the program was compiled for interface {}, the library (rheocyte {}) has {}.", abi,
                      rheocyte_cell_version(), RHEOCYTE_CELL_ABI));
      return RHEOCYTE_CELL_WRONG_VERSION;
    }
    if (!has_processor()) return RHEOCYTE_CELL_NO_PROCESSOR;
    *setup = new rheocyte_cell_setup{.content = std::make_unique<SetUp>(*settings)};
    return RHEOCYTE_CELL_OK;
  });
}

std::int32_t rheocyte_cell_open_values(std::uint32_t abi, const char* medium, double temperature_C,
                                       double viscosity_mPas, double channel_width_um, double flow_rate_ul_s,
                                       double pixel_size_um, double axial_tension_Pa, const char* tables_folder,
                                       rheocyte_cell_setup** setup, char* message, std::size_t message_bytes) {
  rheocyte_cell_settings settings = default_settings();
  settings.medium = filled(medium);
  settings.tables_folder = filled(tables_folder);
  settings.temperature_C = temperature_C;
  settings.viscosity_mPas = viscosity_mPas;
  settings.channel_width_um = channel_width_um;
  settings.flow_rate_ul_s = flow_rate_ul_s;
  settings.pixel_size_um = pixel_size_um;
  settings.axial_tension_Pa = axial_tension_Pa;
  return rheocyte_cell_open(abi, &settings, setup, message, message_bytes);
}

std::int32_t rheocyte_cell_close(rheocyte_cell_setup* setup) {
  if (const std::int32_t status = checked(setup)) return status;
  if (setup->content->users().load() > 0) return RHEOCYTE_CELL_IN_USE;
  setup->is = 0;
  delete setup;
  return RHEOCYTE_CELL_OK;
}

std::int32_t rheocyte_cell_get_tension(const rheocyte_cell_setup* setup, rheocyte_cell_tension* tension) {
  if (const std::int32_t status = checked(setup)) return status;
  if (tension == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  *tension = setup->content->tension();
  return RHEOCYTE_CELL_OK;
}

std::int32_t rheocyte_cell_refresh(const rheocyte_cell_setup* setup, rheocyte_cell_worker* const* workers,
                                   std::size_t count, rheocyte_cell_setup** refreshed, char* message,
                                   std::size_t message_bytes) {
  if (refreshed == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  *refreshed = nullptr;
  return guarded({message, message_bytes}, [&]() -> std::int32_t {
    if (const std::int32_t status = checked(setup)) return status;
    if (workers == nullptr && count > 0) return RHEOCYTE_CELL_NULL_ARGUMENT;
    EventFigures cells;
    for (std::size_t i = 0; i < count; ++i) {
      if (const std::int32_t status = checked(workers[i])) return status;
      workers[i]->content->recent().collect(cells);
    }
    *refreshed = new rheocyte_cell_setup{.content = setup->content->refreshed(cells)};
    return RHEOCYTE_CELL_OK;
  });
}

std::int32_t rheocyte_cell_open_worker(rheocyte_cell_setup* setup, std::uint32_t most_width, std::uint32_t most_height,
                                       std::uint32_t remembered, rheocyte_cell_worker** worker) {
  if (worker == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  *worker = nullptr;
  return guarded({nullptr, 0}, [&]() -> std::int32_t {
    if (const std::int32_t status = checked(setup)) return status;
    const ImageSize largest{most_width, most_height};
    if (largest.pixels() == 0 || largest.pixels() > Worker::most_pixels) return RHEOCYTE_CELL_BAD_PICTURE;
    const std::uint32_t cells = remembered == 0 ? Worker::usually_remembered : remembered;
    if (cells < Worker::fewest_remembered || cells > Worker::most_remembered) return RHEOCYTE_CELL_BAD_SETTINGS;
    *worker = new rheocyte_cell_worker{.content = std::make_unique<Worker>(*setup->content, largest, cells)};
    return RHEOCYTE_CELL_OK;
  });
}

std::int32_t rheocyte_cell_close_worker(rheocyte_cell_worker* worker) {
  if (const std::int32_t status = checked(worker)) return status;
  worker->is = 0;
  delete worker;
  return RHEOCYTE_CELL_OK;
}
