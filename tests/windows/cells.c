/* Cells through the C interface, the same for every system: all their numbers with all digits.
 *
 *   cells        as the library is installed; masks, contours and features, with the axial tension of these cells
 */
#include <math.h>
#include <rheocyte_cell.h>
#include <stdio.h>

enum { WIDTH = 250, HEIGHT = 80, CELLS = 400 };

static unsigned char pixels[HEIGHT][WIDTH];

/* An egg with its blunt end in front. Whole numbers and their halves: the same pixels everywhere. */
static void draw(int number) {
  const double half_length = 20 + 0.125 * (number % 40), half_height = 17 + 0.25 * (number % 7), skew = 0.25,
               middle_x = 120 + 0.125 * number, middle_y = 38 + 0.5 * (number % 5);
  for (int row = 0; row < HEIGHT; ++row)
    for (int column = 0; column < WIDTH; ++column) {
      const double x = (column - middle_x) / half_length, y = (row - middle_y) / half_height;
      pixels[row][column] = x * x + y * y * (1 - skew * x) <= 1;
    }
}

static void print_cell(const char* how, int status, const rheocyte_cell_result* cell) {
  printf("%s %d %.17g %.17g %.17g %.17g %.17g ", how, status, cell->area_um2, cell->deformation, cell->inertia_ratio,
         cell->x_um, cell->y_um);
  printf("%.17g %.17g %.17g %.17g %.17g %.17g %d %d %d\n", cell->young_modulus_kPa, cell->young_modulus_error_kPa,
         cell->effective_modulus_kPa, cell->effective_modulus_error_kPa, cell->stiffness_kPa, cell->stiffness_error_kPa,
         cell->young_state, cell->effective_state, cell->outline);
}

static void print_cells(rheocyte_cell_worker* worker) {
  for (int i = 0; i < CELLS; ++i) {
    rheocyte_cell_result cell, again;
    draw(i);
    int status = rheocyte_cell_from_mask(worker, &pixels[0][0], WIDTH, HEIGHT, 0, &cell);
    print_cell("mask", status, &cell);
    const double area = 1.25 * cell.area_um2;
    status = rheocyte_cell_from_features(worker, &area, &cell.deformation, &cell.inertia_ratio, 1, &again);
    print_cell("features", status, &again);
  }
}

int main(void) {
  rheocyte_cell_settings settings;
  rheocyte_cell_setup *setup = NULL, *next = NULL;
  rheocyte_cell_worker* worker = NULL;
  rheocyte_cell_tension tension;
  char message[500] = "";
  rheocyte_cell_default_settings(&settings);
  printf("%d\n", rheocyte_cell_open(RHEOCYTE_CELL_ABI + 1, &settings, &setup, message, sizeof message));
  printf("%d %s\n", rheocyte_cell_open(RHEOCYTE_CELL_ABI, &settings, &setup, message, sizeof message), message);
  settings.medium = "CellCarrier";
  settings.temperature_C = 23;
  settings.channel_width_um = 20;
  settings.flow_rate_ul_s = 0.04;
  settings.pixel_size_um = 0.34;
  int status = rheocyte_cell_open(RHEOCYTE_CELL_ABI, &settings, &setup, message, sizeof message);
  if (status != RHEOCYTE_CELL_OK) {
    printf("%d %s\n", status, message);
    return 1;
  }
  if (rheocyte_cell_open_worker(setup, WIDTH, HEIGHT, 0, &worker) != RHEOCYTE_CELL_OK) return 1;
  print_cells(worker);
  status = rheocyte_cell_refresh(setup, &worker, 1, &next, message, sizeof message);
  printf("refreshed %d %s\n", status, status == RHEOCYTE_CELL_OK ? "" : message);
  if (status == RHEOCYTE_CELL_OK && rheocyte_cell_get_tension(next, &tension) == RHEOCYTE_CELL_OK) {
    printf("tension %.17g %.17g %.17g %.17g\n", tension.value_Pa, tension.error_Pa, tension.common_error_Pa,
           tension.median_effective_modulus_kPa);
    rheocyte_cell_use(worker, next);
    print_cells(worker);
  }
  rheocyte_cell_close_worker(worker);
  if (next && rheocyte_cell_close(next) != RHEOCYTE_CELL_OK) return 1;
  return rheocyte_cell_close(setup) != RHEOCYTE_CELL_OK;
}
