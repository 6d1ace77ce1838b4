/* Cells at a given rate: a camera thread puts masks into a ring buffer, another thread takes them out and decides, a
 * third one follows the axial tension of the set-up.
 *
 *   cc -std=c11 ring_buffer.c $(pkg-config --cflags --libs rheocyte_cell) -lpthread -lm -o ring_buffer
 *   ./ring_buffer [CELLS [CELLS_PER_S]]      0 cells per second: as fast as they are decided
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <rheocyte_cell.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WIDTH = 250, HEIGHT = 80, PLACES = 64 };

typedef struct {
  unsigned char pixels[HEIGHT][WIDTH];
  double seen_s; /* when the camera put it there */
} Mask;

static Mask ring[PLACES];
static atomic_long put, taken; /* numbers of masks so far */
static atomic_int has_ended;
static long cells = 2000;
static double cells_per_s = 5000;

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void wait_s(double duration) {
  const struct timespec time = {(time_t)duration, (long)(1e9 * fmod(duration, 1))};
  nanosleep(&time, NULL);
}

/* An ellipse in place of a cell. */
static void draw(Mask* mask, double x, double y, double length, double height) {
  for (int row = 0; row < HEIGHT; ++row)
    for (int column = 0; column < WIDTH; ++column)
      mask->pixels[row][column] = pow((column - x) / length, 2) + pow((row - y) / height, 2) <= 1;
}

/* The camera never waits: where the ring is full, a real one would lose the cell. */
static void* camera(void* unused) {
  const double start = seconds();
  for (long i = 0; i < cells; ++i) {
    if (cells_per_s > 0) {
      const double early = start + (double)i / cells_per_s - seconds();
      if (early > 0) wait_s(early);
    }
    while (i - atomic_load(&taken) >= PLACES) wait_s(1e-5);
    Mask* const mask = &ring[i % PLACES];
    draw(mask, 125, 40, 19 + 0.05 * (double)(i % 60), 17);
    mask->seen_s = seconds();
    atomic_store(&put, i + 1);
  }
  return unused;
}

typedef struct {
  rheocyte_cell_setup* setup;    /* the one in use, or about to be */
  rheocyte_cell_setup* previous; /* to be closed when it is no longer in use */
  rheocyte_cell_worker* worker;
  int refreshed;
} Follower;

/* A new set-up with the tension of the cells seen lately, until the cells end. */
static void* follow_tension(void* argument) {
  Follower* const follower = argument;
  while (!atomic_load(&has_ended)) {
    rheocyte_cell_setup* next;
    wait_s(1e-2);
    if (follower->previous && rheocyte_cell_close(follower->previous) == RHEOCYTE_CELL_OK) follower->previous = NULL;
    if (follower->previous) continue;
    if (rheocyte_cell_refresh(follower->setup, &follower->worker, 1, &next, NULL, 0) != RHEOCYTE_CELL_OK) continue;
    rheocyte_cell_use(follower->worker, next);
    follower->previous = follower->setup;
    follower->setup = next;
    ++follower->refreshed;
  }
  return NULL;
}

static int by_size(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static int decide(Follower* follower) {
  long sorted = 0, failed = 0;
  double* const latencies = calloc((size_t)cells, sizeof *latencies);
  if (!latencies) return 1;
  pthread_t camera_thread, follower_thread;
  pthread_create(&camera_thread, NULL, camera, NULL);
  pthread_create(&follower_thread, NULL, follow_tension, follower);
  rheocyte_cell_worker* const worker = follower->worker;
  for (long i = 0; i < cells; ++i) {
    while (atomic_load(&put) <= i) wait_s(1e-5);
    rheocyte_cell_result cell;
    const Mask* const mask = &ring[i % PLACES];
    if (rheocyte_cell_from_mask(worker, &mask->pixels[0][0], WIDTH, HEIGHT, 0, &cell) != RHEOCYTE_CELL_OK) ++failed;
    if (cell.effective_state == RHEOCYTE_CELL_VALID && cell.stiffness_kPa < 2) ++sorted; /* deflect the cell here */
    latencies[i] = seconds() - mask->seen_s;
    atomic_store(&taken, i + 1);
  }
  pthread_join(camera_thread, NULL);
  atomic_store(&has_ended, 1);
  pthread_join(follower_thread, NULL);
  qsort(latencies, (size_t)cells, sizeof *latencies, by_size);
  printf("%ld cells, %ld failed, %ld sorted, tension refreshed %d times\n", cells, failed, sorted, follower->refreshed);
  printf("from the camera to the decision: median %.3f ms, 99.9 %% %.3f ms\n", 1e3 * latencies[cells / 2],
         1e3 * latencies[cells * 999 / 1000]);
  free(latencies);
  return failed > 0;
}

/* The same cell as in the other examples. */
static void print_one_cell(rheocyte_cell_worker* worker) {
  Mask mask;
  rheocyte_cell_result cell;
  draw(&mask, 125, 40, 21, 18);
  if (rheocyte_cell_from_mask(worker, &mask.pixels[0][0], WIDTH, HEIGHT, 0, &cell) == RHEOCYTE_CELL_OK)
    printf("area %.17g deformation %.17g E %.17g S %.17g\n", cell.area_um2, cell.deformation, cell.young_modulus_kPa,
           cell.stiffness_kPa);
}

int main(int argc, char** argv) {
  if (argc > 1) cells = atol(argv[1]);
  if (argc > 2) cells_per_s = atof(argv[2]);
  if (cells < 1) return 1;
  rheocyte_cell_settings settings;
  rheocyte_cell_default_settings(&settings);
  settings.medium = "CellCarrier";
  settings.temperature_C = 23;
  settings.channel_width_um = 20;
  settings.flow_rate_ul_s = 0.04;
  settings.pixel_size_um = 0.34;
  settings.axial_tension_Pa = 200; /* until the cells say more */
  Follower follower = {NULL, NULL, NULL, 0};
  char message[500];
  if (rheocyte_cell_open(RHEOCYTE_CELL_ABI, &settings, &follower.setup, message, sizeof message) != RHEOCYTE_CELL_OK) {
    fprintf(stderr, "%s\n", message);
    return 1;
  }
  if (rheocyte_cell_open_worker(follower.setup, WIDTH, HEIGHT, 0, &follower.worker) != RHEOCYTE_CELL_OK) return 1;
  print_one_cell(follower.worker);
  const int failed = decide(&follower);
  rheocyte_cell_close_worker(follower.worker);
  if (follower.previous) rheocyte_cell_close(follower.previous);
  return rheocyte_cell_close(follower.setup) != RHEOCYTE_CELL_OK || failed;
}
