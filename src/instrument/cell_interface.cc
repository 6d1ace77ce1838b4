// The functions of the C interface that every cell goes through: they neither allocate nor throw.
#include "instrument/handles.h"

using namespace rheocyte;

std::int32_t rheocyte_cell_use(rheocyte_cell_worker* worker, rheocyte_cell_setup* setup) {
  if (const std::int32_t status = checked(worker)) return status;
  if (const std::int32_t status = checked(setup)) return status;
  worker->content->use(*setup->content);
  return RHEOCYTE_CELL_OK;
}

std::int32_t rheocyte_cell_get_counts(const rheocyte_cell_worker* worker, rheocyte_cell_counts* counts) {
  if (const std::int32_t status = checked(worker)) return status;
  if (counts == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  *counts = worker->content->counts();
  return RHEOCYTE_CELL_OK;
}

std::int32_t rheocyte_cell_from_masks(rheocyte_cell_worker* worker, const rheocyte_cell_masks* masks, std::size_t count,
                                      rheocyte_cell_result* results) {
  if (const std::int32_t status = checked(worker)) return status;
  if (masks == nullptr || masks->pixels == nullptr || results == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  return worker->content->from_masks(*masks, {results, count});
}

std::int32_t rheocyte_cell_from_mask(rheocyte_cell_worker* worker, const std::uint8_t* pixels, std::uint32_t width,
                                     std::uint32_t height, std::size_t row_bytes, rheocyte_cell_result* result) {
  const rheocyte_cell_masks mask{pixels, width, height, RHEOCYTE_CELL_BYTES, 0, row_bytes, 0};
  return rheocyte_cell_from_masks(worker, &mask, 1, result);
}

std::int32_t rheocyte_cell_from_contour(rheocyte_cell_worker* worker, const std::int32_t* xy, std::size_t points,
                                        std::uint32_t width, std::uint32_t height, rheocyte_cell_result* result) {
  static_assert(sizeof(PixelPoint) == 2 * sizeof(std::int32_t));
  if (const std::int32_t status = checked(worker)) return status;
  if ((xy == nullptr && points > 0) || result == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  return worker->content->from_contour({reinterpret_cast<const PixelPoint*>(xy), points}, {width, height}, *result);
}

std::int32_t rheocyte_cell_from_features(rheocyte_cell_worker* worker, const double* area_um2,
                                         const double* deformation, const double* inertia_ratio, std::size_t count,
                                         rheocyte_cell_result* results) {
  if (const std::int32_t status = checked(worker)) return status;
  if (area_um2 == nullptr || deformation == nullptr || results == nullptr) return RHEOCYTE_CELL_NULL_ARGUMENT;
  worker->content->from_features({area_um2, count}, {deformation, count},
                                 {inertia_ratio, inertia_ratio == nullptr ? 0 : count}, {results, count});
  return RHEOCYTE_CELL_OK;
}
