/* After opening, cells cause no allocation, no lock and no system call: allocator and locks are replaced by counters, and
 * a process that the system kills at any call but exit computes them all the same. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <linux/seccomp.h>
#endif

#include "rheocyte_cell.h"

enum { WIDTH = 250, HEIGHT = 80, CELLS = 400 };

static unsigned long allocations, locks;

void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void __libc_free(void*);

void* malloc(size_t size) { return ++allocations, __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return ++allocations, __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return ++allocations, __libc_realloc(old, size); }
void* aligned_alloc(size_t alignment, size_t size) { return ++allocations, __libc_memalign(alignment, size); }
void free(void* memory) {
  if (memory != NULL) ++allocations;
  __libc_free(memory);
}

static int (*system_lock)(pthread_mutex_t*);
static int (*system_read_lock)(pthread_rwlock_t*);
int pthread_mutex_lock(pthread_mutex_t* mutex) { return ++locks, system_lock ? system_lock(mutex) : 0; }
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) { return ++locks, system_read_lock ? system_read_lock(lock) : 0; }

static unsigned char masks[CELLS][HEIGHT][WIDTH];
static rheocyte_cell_result results[CELLS];

/* Cells of many sizes at many places, one in ten empty, torn, or noise, which has the longest contours. */
static void draw(void) {
  unsigned random = 1;
  for (int i = 0; i < CELLS; ++i) {
    const double x = 60 + (i * 37) % 130, y = 30 + i % 20, a = 14 + i % 13, b = 11 + i % 11;
    for (int row = 0; row < HEIGHT; ++row)
      for (int column = 0; column < WIDTH; ++column) {
        random = random * 1664525U + 1013904223U;
        unsigned char set = pow((column - x) / a, 2) + pow((row - y) / b, 2) <= 1;
        if (i % 10 == 7) set = 0;
        if (i % 10 == 8) set |= column % 4 == 0 || row == 40; /* a comb */
        if (i % 10 == 9) set = random >> 30 != 0;
        masks[i][row][column] = set;
      }
  }
}

static int compute(rheocyte_cell_worker* worker) {
  int failed = 0;
  for (int i = 0; i < CELLS; ++i)
    failed |= rheocyte_cell_from_mask(worker, &masks[i][0][0], WIDTH, HEIGHT, 0, &results[i]);
  const rheocyte_cell_masks all = {&masks[0][0][0], WIDTH, HEIGHT, RHEOCYTE_CELL_BYTES, 0, 0, 0};
  failed |= rheocyte_cell_from_masks(worker, &all, CELLS, results);
  for (int i = 0; i < CELLS; ++i)
    failed |= rheocyte_cell_from_features(worker, &results[i].area_um2, &results[i].deformation,
                                          &results[i].inertia_ratio, 1, &results[i]);
  return failed;
}

static int check(int is_right, const char* words) {
  if (!is_right) fprintf(stderr, "failed: %s\n", words);
  return !is_right;
}

/* 0 if the child ends by itself where the system allows nothing but exit; 77 if the system cannot be asked for it. */
static int without_system_calls(rheocyte_cell_worker* worker) {
  const pid_t child = fork();
  if (child == 0) {
    if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_STRICT) != 0) _exit(77);
    const int failed = compute(worker);
    syscall(SYS_exit, failed);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  fprintf(stderr, "killed by signal %d\n", WTERMSIG(status));
  return 1;
}

int main(int argc, char** argv) {
  *(void**)&system_lock = dlsym(RTLD_NEXT, "pthread_mutex_lock");
  *(void**)&system_read_lock = dlsym(RTLD_NEXT, "pthread_rwlock_rdlock");
  char message[500];
  rheocyte_cell_setup *setup, *other;
  rheocyte_cell_worker* worker;
  rheocyte_cell_settings settings;
  rheocyte_cell_default_settings(&settings);
  settings.tables_folder = argc > 1 ? argv[1] : NULL;
  settings.medium = "CellCarrier";
  settings.temperature_C = 23;
  settings.channel_width_um = 20;
  settings.flow_rate_ul_s = 0.04;
  settings.pixel_size_um = 0.34;
  settings.axial_tension_Pa = 200;
  if (rheocyte_cell_open(RHEOCYTE_CELL_ABI, &settings, &setup, message, sizeof message) != RHEOCYTE_CELL_OK)
    return fprintf(stderr, "%s\n", message), 1;
  settings.axial_tension_Pa = 250;
  if (rheocyte_cell_open(RHEOCYTE_CELL_ABI, &settings, &other, message, sizeof message) != RHEOCYTE_CELL_OK)
    return fprintf(stderr, "%s\n", message), 1;
  int failed = check(allocations > 0, "opening is counted");
  if (rheocyte_cell_open_worker(setup, WIDTH, HEIGHT, 0, &worker) != RHEOCYTE_CELL_OK) return 1;
  draw();

  const unsigned long allocations_before = allocations, locks_before = locks;
  failed |= check(compute(worker) == 0, "all cells have a status");
  rheocyte_cell_use(worker, other);
  failed |= check(compute(worker) == 0, "after a swap, too");
  const unsigned long new_allocations = allocations - allocations_before, new_locks = locks - locks_before;
  printf("%d cells: %lu allocations, %lu locks\n", 6 * CELLS, new_allocations, new_locks);
  failed |= check(new_allocations == 0, "no allocation");
  failed |= check(new_locks == 0, "no lock");
  failed |= check(results[0].axial_tension_Pa == 250, "the set-up was swapped");
  failed |= check(isfinite(results[0].young_modulus_kPa), "cells have moduli");

  const int calls = without_system_calls(worker);
  printf(calls == 77 ? "system calls: cannot be forbidden here\n" : "system calls: none but exit\n");
  failed |= check(calls == 0 || calls == 77, "no system call");

  failed |= check(rheocyte_cell_close_worker(worker) == 0 && rheocyte_cell_close(setup) == 0 &&
                      rheocyte_cell_close(other) == 0,
                  "all is closed");
  return failed;
}
