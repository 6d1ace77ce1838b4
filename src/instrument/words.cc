// The words of the C interface.
#include <array>
#include <cstdint>

#include "infer/modulus_state.h"
#include "instrument/rheocyte_cell.h"
#include "store/build_info.h"

namespace rheocyte {

namespace {

constexpr std::array<const char*, 13> statuses{
    "Done.",
    "A pointer that must not be null is null.",
    "A pointer is no handle of this kind, or its handle was closed.",
    "The program was compiled for another binary interface of librheocyte_cell.",
    "A setting is missing or impossible, or a table cannot be read.",
    "The picture has no pixels, rows that are too short, an unknown format, or is larger than the worker can take.",
    "A point of the contour lies outside the picture, or it has too many points.",
    "A worker still uses the set-up.",
    "Fewer than 20 cells do not determine an axial tension.",
    "No axial tension follows from the cells.",
    "There is not enough memory.",
    "The processor has no AVX2 and FMA.",
    "An error of the library."};

constexpr std::array<const char*, 6> outlines{"",
                                              "The cell was given by its features.",
                                              "Nothing is set in the mask.",
                                              "The outline has too few points for the shape of a cell.",
                                              "The outline touches the edge of the picture.",
                                              "The mask is in pieces; the longest outline counts."};

template <std::size_t count>
const char* text_at(const std::array<const char*, count>& texts, std::int32_t number) {
  return number >= 0 && std::size_t(number) < count ? texts[std::size_t(number)] : "Unknown.";
}

}  // namespace

}  // namespace rheocyte

std::uint32_t rheocyte_cell_abi(void) { return RHEOCYTE_CELL_ABI; }

const char* rheocyte_cell_version(void) { return rheocyte::version; }

const char* rheocyte_cell_status_text(std::int32_t status) { return rheocyte::text_at(rheocyte::statuses, status); }

// The sentences are literals, so that they end with a zero byte.
const char* rheocyte_cell_state_text(std::int32_t state) {
  if (state < 0 || state >= RHEOCYTE_CELL_STATES) return "Unknown.";
  return rheocyte::sentence_of(rheocyte::ModulusState(state)).data();
}

const char* rheocyte_cell_outline_text(std::int32_t outline) { return rheocyte::text_at(rheocyte::outlines, outline); }
