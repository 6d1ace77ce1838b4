/* Moduli of single cells of real-time deformability cytometry while they are measured: the interface of
 * librheocyte_cell for C99, and for every language that calls C (docs/instrument.md).
 *
 * A set-up holds medium, channel, flow, pixels, tables and the axial tension of the liquid. It never changes, and any
 * number of threads use it at once. A worker holds the memory of one thread and the cells that it has seen lately.
 *
 *   open a set-up        reads the tables; some tens of milliseconds
 *   open a worker        allocates all memory that its cells will need
 *   mask, contour, ...   per cell: no allocation, no lock, no system call
 *   refresh              in another thread: the axial tension of the cells seen lately, as a new set-up
 *   use                  in any thread: the worker takes the new set-up at its next cell
 *
 * Every function returns a rheocyte_cell_status. No function throws or ends the program. Numbers that do not exist are
 * NaN. Lengths are um, moduli kPa, tensions Pa, temperatures degrees Celsius; deformation and inertia ratio have no
 * unit. Texts are UTF-8 and end with a zero byte.
 */
#pragma once
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(RHEOCYTE_CELL_MAKES_LIBRARY)
#define RHEOCYTE_CELL_API __declspec(dllexport)
#elif defined(_WIN32) && !defined(RHEOCYTE_CELL_STATIC)
#define RHEOCYTE_CELL_API __declspec(dllimport)
#elif defined(__GNUC__)
#define RHEOCYTE_CELL_API __attribute__((visibility("default")))
#else
#define RHEOCYTE_CELL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** The binary interface that this header describes. It changes whenever a structure, a function or the meaning of a
 * number changes; rheocyte_cell_open refuses any other. */
#define RHEOCYTE_CELL_ABI 1

typedef enum rheocyte_cell_status {
  RHEOCYTE_CELL_OK = 0,
  RHEOCYTE_CELL_NULL_ARGUMENT = 1, /**< a pointer that must not be null is null */
  RHEOCYTE_CELL_WRONG_HANDLE = 2,  /**< a pointer is no handle of this kind, or its handle was closed */
  RHEOCYTE_CELL_WRONG_VERSION = 3, /**< the program was compiled with the header of another binary interface */
  RHEOCYTE_CELL_BAD_SETTINGS = 4,  /**< a setting is missing or impossible, or a table is unreadable: see the message */
  RHEOCYTE_CELL_BAD_PICTURE = 5,   /**< a size of 0, rows that are too short, or larger than the worker can take */
  RHEOCYTE_CELL_BAD_CONTOUR = 6,   /**< a point outside the picture, or more points than a contour can have */
  RHEOCYTE_CELL_IN_USE = 7,        /**< a worker still uses the set-up: close it later */
  RHEOCYTE_CELL_TOO_FEW_CELLS = 8, /**< fewer than 20 cells do not determine an axial tension */
  RHEOCYTE_CELL_NO_TENSION = 9,    /**< the cells lie outside the table of the effective modulus: see the message */
  RHEOCYTE_CELL_NO_MEMORY = 10,
  RHEOCYTE_CELL_NO_PROCESSOR = 11, /**< the processor has no AVX2 and FMA */
  RHEOCYTE_CELL_INTERNAL = 12      /**< an error of the library */
} rheocyte_cell_status;

/** What is known of a modulus. The numbers are those of the columns of states of `rheocyte extract`. */
typedef enum rheocyte_cell_state {
  RHEOCYTE_CELL_VALID = 0,
  RHEOCYTE_CELL_NO_DATA = 1,   /**< no cell, a number that is not finite, or (effective modulus) no axial tension yet */
  RHEOCYTE_CELL_TOO_SMALL = 2, /**< than any cell of the table */
  RHEOCYTE_CELL_TOO_LARGE = 3,
  RHEOCYTE_CELL_TOO_STIFF = 4,   /**< deformed less than the stiffest cell of the table of this area */
  RHEOCYTE_CELL_TOO_SOFT = 5,    /**< deformed more than the softest one */
  RHEOCYTE_CELL_UNSTABLE = 6,    /**< the surface of such a soft solid wrinkles */
  RHEOCYTE_CELL_UNRESOLVED = 7,  /**< the standard error exceeds the modulus, or the table has a gap */
  RHEOCYTE_CELL_REGULARISED = 8, /**< there is a modulus, of a solid whose surface is held smooth by bending */
  RHEOCYTE_CELL_INERTIAL = 10,   /**< there is a modulus, but the inertia of the liquid changes it */
  RHEOCYTE_CELL_CUT = 13         /**< the outline touches the edge of the picture */
} rheocyte_cell_state;
#define RHEOCYTE_CELL_STATES 14 /**< one more than the largest */

/** What the picture of a cell shows. */
typedef enum rheocyte_cell_outline {
  RHEOCYTE_CELL_OUTLINE_WHOLE = 0,
  RHEOCYTE_CELL_OUTLINE_NOT_GIVEN = 1, /**< the cell was given by its features */
  RHEOCYTE_CELL_OUTLINE_EMPTY = 2,     /**< nothing is set */
  RHEOCYTE_CELL_OUTLINE_TOO_SMALL = 3, /**< fewer than 12 points, or all on a line */
  RHEOCYTE_CELL_OUTLINE_AT_EDGE = 4,   /**< moduli have the state CUT */
  RHEOCYTE_CELL_OUTLINE_IN_PIECES = 5  /**< several groups of pixels: the one with the longest outline counts */
} rheocyte_cell_outline;

typedef struct rheocyte_cell_setup rheocyte_cell_setup;
typedef struct rheocyte_cell_worker rheocyte_cell_worker;

/** How cells are measured. Fill it with rheocyte_cell_default_settings, then set members. */
typedef struct rheocyte_cell_settings {
  uint32_t size;               /**< of this structure in bytes; set by rheocyte_cell_default_settings */
  uint32_t reserved;           /**< 0 */
  const char* medium;          /**< "CellCarrier", "0.59% MC-PBS", "water", ...; null if the viscosity is given */
  const char* viscosity_model; /**< null: "buyukurganci-2022"; or "herold-2017" */
  const char* table;           /**< of Young's modulus: name or path; null: the one that `rheocyte extract` uses */
  const char* tables_folder;   /**< with the tables of rheocyte; null: RHEOCYTE_TABLES, or share/rheocyte/tables of the
                                  installation */
  double temperature_C;        /**< of the medium; NaN if the viscosity is given */
  double viscosity_mPas;       /**< at the wall; NaN: that of the medium */
  double channel_width_um;     /**< of the square channel */
  double flow_rate_ul_s;       /**< sample and sheath together */
  double pixel_size_um;
  double axial_tension_Pa; /**< of the liquid, which elongates the cells; NaN: unknown until it is refreshed */
} rheocyte_cell_settings;

/** What is known of a cell. */
typedef struct rheocyte_cell_result {
  double area_um2;                                           /**< of the convex hull of the outline, as measured */
  double deformation;                                        /**< 1 - 2 sqrt(pi A) / P of the hull, as measured */
  double inertia_ratio;                                      /**< of the hull, along the channel over across */
  double x_um, y_um;                                         /**< centroid of the hull in the picture */
  double young_modulus_kPa, young_modulus_error_kPa;         /**< of a homogeneous solid, from area and deformation */
  double effective_modulus_kPa, effective_modulus_error_kPa; /**< of a cell with a cortex, under the axial tension */
  double stiffness_kPa, stiffness_error_kPa;                 /**< S = E + E2D / r0 of that cell */
  double axial_tension_Pa;                                   /**< of the liquid, in the set-up that was used */
  int32_t young_state;                                       /**< a rheocyte_cell_state */
  int32_t effective_state;                                   /**< of effective modulus and stiffness */
  int32_t outline;                                           /**< a rheocyte_cell_outline */
  uint32_t setup; /**< number of the set-up that was used (rheocyte_cell_tension.setup) */
} rheocyte_cell_result;

/** Masks in memory. */
typedef enum rheocyte_cell_format {
  RHEOCYTE_CELL_BYTES = 0, /**< one byte per pixel; anything but 0 belongs to the cell */
  RHEOCYTE_CELL_BITS = 1   /**< one bit per pixel, the first pixel in the highest bit; rows begin at whole bytes */
} rheocyte_cell_format;

typedef struct rheocyte_cell_masks {
  const uint8_t* pixels;  /**< row by row, x along the channel */
  uint32_t width, height; /**< columns, rows */
  uint32_t format;        /**< a rheocyte_cell_format */
  uint32_t reserved;      /**< 0 */
  size_t row_bytes;       /**< from one row to the next; 0: rows follow each other */
  size_t mask_bytes;      /**< from one mask to the next; 0: masks follow each other */
} rheocyte_cell_masks;

/** Where the axial tension of a set-up comes from. */
typedef enum rheocyte_cell_source {
  RHEOCYTE_CELL_TENSION_UNKNOWN = 0,
  RHEOCYTE_CELL_TENSION_GIVEN = 1,
  RHEOCYTE_CELL_TENSION_OF_CELLS = 2
} rheocyte_cell_source;

typedef struct rheocyte_cell_tension {
  double value_Pa;
  double error_Pa;                     /**< standard error by the scatter of the cells */
  double common_error_Pa;              /**< standard error that all cells share, by pixels, section, table and model */
  double median_effective_modulus_kPa; /**< of the cells of which the tension is */
  uint64_t cells;                      /**< their number */
  int32_t source;                      /**< a rheocyte_cell_source */
  uint32_t setup;                      /**< number of the set-up, counted from 1 in the order of their opening */
} rheocyte_cell_tension;

/** Numbers of cells since the worker was opened. */
typedef struct rheocyte_cell_counts {
  uint64_t cells;
  uint64_t young[RHEOCYTE_CELL_STATES], effective[RHEOCYTE_CELL_STATES]; /**< by rheocyte_cell_state */
} rheocyte_cell_counts;

/* ---- Versions and words ---- */

/** RHEOCYTE_CELL_ABI of the library. */
RHEOCYTE_CELL_API uint32_t rheocyte_cell_abi(void);
/** Version of rheocyte, such as "0.4.0". */
RHEOCYTE_CELL_API const char* rheocyte_cell_version(void);
/** One sentence, never null; lives as long as the library. */
RHEOCYTE_CELL_API const char* rheocyte_cell_status_text(int32_t status);
RHEOCYTE_CELL_API const char* rheocyte_cell_state_text(int32_t state);
RHEOCYTE_CELL_API const char* rheocyte_cell_outline_text(int32_t outline);

/* ---- Set-ups ---- */

/** Numbers NaN, texts null. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_default_settings(rheocyte_cell_settings* settings);

/** Reads the tables. `abi` is RHEOCYTE_CELL_ABI of the header. What is wrong stands in `message`, cut at
 * `message_bytes`; both may be 0. On errors `*setup` is null. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_open(uint32_t abi, const rheocyte_cell_settings* settings,
                                             rheocyte_cell_setup** setup, char* message, size_t message_bytes);
/** The same with one argument for each setting, for languages without pointers in structures. Empty texts are null. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_open_values(uint32_t abi, const char* medium, double temperature_C,
                                                    double viscosity_mPas, double channel_width_um,
                                                    double flow_rate_ul_s, double pixel_size_um,
                                                    double axial_tension_Pa, const char* tables_folder,
                                                    rheocyte_cell_setup** setup, char* message, size_t message_bytes);

/** IN_USE as long as a worker uses the set-up or is about to; then nothing is closed. No other thread may call a
 * function with the set-up at the same time or later. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_close(rheocyte_cell_setup* setup);

RHEOCYTE_CELL_API int32_t rheocyte_cell_get_tension(const rheocyte_cell_setup* setup, rheocyte_cell_tension* tension);

/** A set-up that is like `setup`, with the axial tension of the cells that these workers have seen lately under set-ups
 * with the settings of `setup` (rheocyte_cell_open_worker), by area, deformation and inertia ratio, as `rheocyte
 * extract` determines it for a recording of these cells. Takes tenths of a second; allocates; meant for a thread of its
 * own, while the workers continue. Errors leave `*refreshed` null. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_refresh(const rheocyte_cell_setup* setup, rheocyte_cell_worker* const* workers,
                                                size_t count, rheocyte_cell_setup** refreshed, char* message,
                                                size_t message_bytes);

/* ---- Workers: one per thread ---- */

/** For pictures of at most this size, of at most 2^22 pixels. It remembers the last `remembered` cells (20 to 2^20; 0:
 * 4096) for rheocyte_cell_refresh: the larger the number, the more slowly the tension follows. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_open_worker(rheocyte_cell_setup* setup, uint32_t most_width,
                                                    uint32_t most_height, uint32_t remembered,
                                                    rheocyte_cell_worker** worker);
/** Only when no thread uses it any more. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_close_worker(rheocyte_cell_worker* worker);

/** From its next cell on the worker uses this set-up. Any thread; never waits. With other settings the remembered cells
 * are forgotten. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_use(rheocyte_cell_worker* worker, rheocyte_cell_setup* setup);

/** Any thread. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_get_counts(const rheocyte_cell_worker* worker, rheocyte_cell_counts* counts);

/* ---- Cells: only the thread of the worker. Results are written only if the status is OK. ---- */

/** `count` masks, with one result for each. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_from_masks(rheocyte_cell_worker* worker, const rheocyte_cell_masks* masks,
                                                   size_t count, rheocyte_cell_result* results);
/** One mask of bytes. `row_bytes` as in rheocyte_cell_masks. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_from_mask(rheocyte_cell_worker* worker, const uint8_t* pixels, uint32_t width,
                                                  uint32_t height, size_t row_bytes, rheocyte_cell_result* result);
/** The chain of the outermost pixels of a cell, x and y in turn, counted from 0; either direction. Width and height of
 * the picture, or both 0 if unknown: then no outline counts as cut. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_from_contour(rheocyte_cell_worker* worker, const int32_t* xy, size_t points,
                                                     uint32_t width, uint32_t height, rheocyte_cell_result* result);
/** `count` cells by features as measured: area (um2), deformation and inertia ratio, which may be null. Without inertia
 * ratios the cells do not count for the axial tension. */
RHEOCYTE_CELL_API int32_t rheocyte_cell_from_features(rheocyte_cell_worker* worker, const double* area_um2,
                                                      const double* deformation, const double* inertia_ratio,
                                                      size_t count, rheocyte_cell_result* results);

#ifdef __cplusplus
}
#endif
