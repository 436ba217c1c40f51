/* Scarp for C, and for languages that call C: converts height fields to triangle meshes with a proven error bound.
 *
 *   scarp_field field;
 *   scarp_field_init(&field, sizeof field);
 *   field.samples = heights; field.cols = 512; field.rows = 512;
 *   scarp_options options;
 *   scarp_options_init(&options, sizeof options);
 *   options.max_error = 1.5;
 *   scarp_mesh* mesh = NULL;
 *   if (scarp_simplify(&field, &options, &mesh) != SCARP_OK) fprintf(stderr, "%s\n", scarp_last_error());
 *   scarp_options_clear(&options);
 *   scarp_mesh_free(mesh);
 *
 * General rules:
 *   - A function that can fail returns a scarp_status; after a failure its output is NULL or unchanged.
 *     scarp_last_error() then returns one sentence with the cause and the remedy. The library throws no exception and
 *     prints nothing.
 *   - Structs begin with their own size, which scarp_..._init() sets. Structs only grow at their end. A later library
 *     reads the members that an earlier caller knows, and uses defaults for the others. Handles are opaque.
 *   - Data behind a pointer in a struct is borrowed during the call; a Refiner borrows its samples until it is freed.
 *   - A pointer returned by a handle is valid until the handle is freed. Freeing NULL does nothing. Functions that
 *     return a number or a pointer do not accept NULL as a handle.
 *   - Several threads may call at once. Several threads may read a handle, or one thread may change it. Text is UTF-8.
 *   - The same input and options give the same bytes on every machine, for any number of threads. */
#ifndef SCARP_C_H
#define SCARP_C_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

/* Incremented when an old caller would break; the shared library's SOVERSION. */
#define SCARP_ABI_VERSION 1

/* The result of a call, with the values of the program's exit codes. */
typedef int32_t scarp_status;
#define SCARP_OK 0
#define SCARP_USAGE 1     /* options that conflict or are out of range; a null pointer */
#define SCARP_INPUT 2     /* a raster or mesh without usable data, or a file that cannot be read */
#define SCARP_PROMISE 3   /* the requested error bound cannot be met, or is exceeded */
#define SCARP_OUTPUT 4    /* a file that cannot be written, or a format that cannot hold the mesh */
#define SCARP_CANCELLED 5 /* cancelled by the progress function */
#define SCARP_INTERNAL 70 /* a bug in Scarp */

typedef struct scarp_mesh scarp_mesh;         /* a mesh, its options, and its measured error */
typedef struct scarp_refiner scarp_refiner;   /* a mesh that grows by one vertex at a time */
typedef struct scarp_live scarp_live;         /* a field that changes, and its mesh */
typedef struct scarp_changes scarp_changes;   /* cells of a live field that changed */
typedef struct scarp_raster scarp_raster;     /* a raster read from a file */
typedef struct scarp_tiles scarp_tiles;       /* terrain tiles for globes, made on request */
typedef struct scarp_bytes scarp_bytes;       /* the bytes of a file */
typedef struct scarp_settings scarp_settings; /* options by name */

/* A snapshot of a running pass. */
typedef struct scarp_progress {
  uint32_t struct_size;
  int32_t reserved;
  const char* pass;    /* "read", "refine", "fit", "search", "measure", "tiles" ...; valid during the call only */
  double fraction;     /* 0 to 1 of this pass */
  uint64_t vertices;   /* so far; 0: unknown */
  double max_error;    /* so far, in z units; 0: unknown */
  double seconds_left; /* estimated time left for this pass; NaN: no estimate yet */
  uint64_t tiles;      /* written so far, in the pass "tiles" */
  uint64_t bytes;      /* bytes of these tiles */
} scarp_progress;
/* Called on the thread that made the call, at the start of a pass and a few times a second. Return 0 to continue, else
 * to cancel. Must not throw or jump. */
typedef int32_t (*scarp_progress_fn)(const scarp_progress* progress, void* user);

/* The positions of samples. */
#define SCARP_FRAME_GRID 0    /* x = column, y = rows - 1 - row; the geotransform is ignored */
#define SCARP_FRAME_SOURCE 1  /* by the geotransform and the CRS; degrees become metres if the CRS is in degrees */
#define SCARP_FRAME_DEGREES 2 /* geotransform in degrees (of WGS 84 without a CRS); x, y in metres from the centre */

/* Heights on a grid, row-major, the first row in the north. NaN and infinities are nodata. */
typedef struct scarp_field {
  uint32_t struct_size;
  int32_t cols, rows; /* at least 2 */
  int32_t frame;      /* DEFAULT: SCARP_FRAME_GRID. The option "crs" selects another. */
  const float* samples;
  double nodata;          /* nodata value; if any sample has it, all samples are copied. DEFAULT: NaN, none. */
  double geotransform[6]; /* GDAL's, of pixel corners: x = g[0] + g[1] col + g[2] row, y = g[3] + g[4] col + g[5] row */
  double sample_rounding; /* largest |value - float32 sample| by rounding; bounds are reduced by it */
  const char* crs;        /* "EPSG:32611", WKT. DEFAULT: NULL. A library without GDAL uses it only as a name. */
  const char* name;       /* for messages and the mesh's metadata. DEFAULT: NULL, "heights". */
  const char* unit; /* unit of the heights: "m", "ft"; for errors such as "1m" and "3ft". DEFAULT: NULL, unknown. */
} scarp_field;

/* Scattered points: heights z at x, y. */
typedef struct scarp_points {
  uint32_t struct_size;
  int32_t frame; /* SCARP_FRAME_DEGREES: x and y are degrees, of WGS 84 without a CRS. DEFAULT: 0, by the CRS. */
  const double *x, *y, *z;
  uint64_t count;
  uint64_t stride;  /* doubles from one x to the next, at least 1; 3 for interleaved x, y, z. DEFAULT: 1. */
  const char* crs;  /* like a field's; degrees become metres from the middle of the points. DEFAULT: NULL */
  const char* name; /* DEFAULT: NULL, "points" */
} scarp_points;

/* The most common options; others are set by name. */
typedef struct scarp_options {
  uint32_t struct_size;
  int32_t threads;        /* 0: all cores, or one for few samples. Never changes the result. */
  double max_error;       /* in z units. DEFAULT: NaN, none. */
  uint64_t max_triangles; /* 0: none */
  uint64_t max_points;    /* vertices; 0: none */
  const float* mask;      /* NULL, or a weight for each sample: weight * |error| is bounded; 0 and NaN: no bound */
  const float* tolerance; /* NULL, or a bound for each sample (NaN: none) or each point (infinity: none) */
  scarp_progress_fn progress;
  void* user;
  scarp_settings* named; /* options set by scarp_options_set() */
} scarp_options;

/* The measured error of a mesh. Errors are vertical, mesh minus sample, in z units. */
typedef struct scarp_report {
  uint32_t struct_size;
  int32_t stop;          /* goal that ended the run: 0 max_error, 1 max_triangles, 2 max_points, 3 every sample is exact
                          */
  int32_t effort;        /* 0 fast, 1 normal, 2 high, 3 max; -1 for a mesh that was only measured */
  int32_t is_cut_short;  /* 1: a time limit ended the run early */
  int32_t max_error_col; /* the sample with the largest error; -1: none */
  int32_t max_error_row;
  uint64_t vertices, triangles;
  uint64_t samples;   /* number of samples judged */
  uint64_t uncovered; /* valid samples without a triangle */
  uint64_t stray;     /* valid samples outside every valid cell */
  uint64_t over;      /* samples above their tolerance, or above "fail_above" */
  double max_error, rmse, mean_error, mean_abs_error, p50, p95, p99;
  double seconds;
} scarp_report;

/* Settings of a live field. */
typedef struct scarp_live_options {
  uint32_t struct_size;
  int32_t threads;  /* for an update that touches several cells; never changes the result. DEFAULT: 1. */
  double max_error; /* in z units, at least 0. DEFAULT: 0. */
  int32_t effort;   /* 0 fast, 1 normal, 2 high. DEFAULT: 0. */
  int32_t cell;     /* steps between samples on a cell's side, 8 to 254. DEFAULT: 0, which is 32 with fast, else 64. */
  int32_t col, row; /* position of the field's first sample on the lattice of cells. DEFAULT: 0. */
  const float* tolerance; /* NULL, or a bound for each sample of the field */
  uint64_t max_triangles; /* a budget after every change; bounds exceed max_error if necessary. DEFAULT: 0, none. */
  const int64_t* level;   /* with a budget: NULL, or scarp_live_level() of another field of the same size */
} scarp_live_options;

/* The mesh of a cell; the pointers are valid as long as the scarp_changes. */
typedef struct scarp_live_cell {
  uint32_t struct_size;
  uint32_t slot;                /* its place in a renderer's buffer; no other cell has this place */
  uint64_t version;             /* the change that made it */
  int32_t col, row;             /* its first sample, on the lattice of cells */
  uint32_t vertices, triangles; /* 0 triangles: the cell has no surface */
  const float* positions;       /* 3 a vertex: columns east and rows north of the first sample (y <= 0), height */
  const uint16_t* indices;      /* 3 a triangle, counter-clockwise from above where rows run south */
  double max_error;             /* measured */
} scarp_live_cell;

/* The library. */
uint32_t scarp_abi_version(void);
const char* scarp_version(void);
int32_t scarp_has_gdal(void); /* 1: reads all formats of GDAL, and knows CRSs; 0: PGM and STM, and points as text */
/* A line for each struct: its name, its size, and its members with their offsets, "scarp_field 104 struct_size:0 cols:4
 * ...". Bindings that redeclare the structs compare their layout with it. */
const char* scarp_abi_layout(void);
/* The message of this thread's last failed call; valid until its next call. */
const char* scarp_last_error(void);
/* Renames an option for a binding ("crs", "frame"): callers may set it by the new name, and messages use that name.
 * Applies to the whole process; call it before any other function. SCARP_USAGE if there is no such option. */
scarp_status scarp_name_option(const char* name, const char* shown);

/* Rounds heights to float32 samples, for a field. Returns the largest |value - sample|, for the field's
 * sample_rounding. NaN remains NaN; values beyond float32 become infinite. */
double scarp_round_samples(const double* values, uint64_t count, float* samples);

void scarp_field_init(scarp_field* field, uint32_t struct_size);
void scarp_points_init(scarp_points* points, uint32_t struct_size);
void scarp_options_init(scarp_options* options, uint32_t struct_size);
/* Sets an option of the program to a value that the program accepts. `name`: its long name with _ instead of -. Options
 * for the program's terminal and files are refused. Examples: ("max_error", "0.5%"), ("effort", "high"), ("breaklines",
 * "dikes.gpkg"), ("normals", "true"). For a repeatable option each call adds a value; else the last value is used. NULL
 * removes the option. An option set by name overrides the same member of the struct. `scarp help --json` lists all
 * options. "of" is the format of the mesh: like the program's OUTPUT it determines the frame, and whether positions are
 * float32. SCARP_USAGE for an unknown name; the message suggests a similar one. */
scarp_status scarp_options_set(scarp_options* options, const char* name, const char* value);
/* Frees the options of scarp_options_set(); the struct may be used again. */
void scarp_options_clear(scarp_options* options);

/* Simplifies a field in memory, like `scarp simplify` for a raster with these samples. Float32 samples are not copied,
 * unless scarp_field::nodata requires it. */
scarp_status scarp_simplify(const scarp_field* field, const scarp_options* options, scarp_mesh** out);
/* Simplifies a file of a raster or points, with all its metadata, exactly like the program. */
scarp_status scarp_simplify_file(const char* path, const scarp_options* options, scarp_mesh** out);
scarp_status scarp_simplify_points(const scarp_points* points, const scarp_options* options, scarp_mesh** out);

/* Judges a mesh by brute force, as `scarp measure` does, with the options of that command: "fail_above", "mask",
 * "tolerance", "cutline" ... `out` is set for SCARP_OK, and for SCARP_PROMISE, which means that the mesh exceeds a
 * bound. */
scarp_status scarp_measure(const scarp_field* field, const scarp_mesh* mesh, const scarp_options* options,
                           scarp_report* out);
scarp_status scarp_measure_file(const char* path, const scarp_mesh* mesh, const scarp_options* options,
                                scarp_report* out);
scarp_status scarp_measure_points(const scarp_points* points, const scarp_mesh* mesh, const scarp_options* options,
                                  scarp_report* out);

/* The volumes between two surfaces, like `scarp measure --volume`: over the area that both cover, in the units of x, y
 * and z of the first surface. */
typedef struct scarp_volumes {
  uint32_t struct_size;
  int32_t reserved;
  double cut;          /* volume with the second surface below the first */
  double fill;         /* volume with the second surface above the first */
  double net;          /* cut - fill */
  double uncertainty;  /* error bound of these three, from the max errors of the meshes; NaN if a mesh has none */
  double common_area;  /* area that both cover */
  double from_outside; /* area of the first that the second does not cover */
  double to_outside;   /* area of the second that the first does not cover; 0 for a level */
} scarp_volumes;

/* Measures from one mesh to another, in the frames that their metadata name, or to a level. Uses only the options
 * threads and progress. SCARP_INPUT for meshes without a common area, for solids, for triangles that are vertical or
 * face down, and for triangles that overlap. */
scarp_status scarp_measure_volume(const scarp_mesh* from, const scarp_mesh* to, const scarp_options* options,
                                  scarp_volumes* out);
scarp_status scarp_measure_volume_to_level(const scarp_mesh* from, double level, const scarp_options* options,
                                           scarp_volumes* out);

/* Meshes. Vertex v lies at origin + positions[3v .. 3v + 2], x east, y north, z up. At most 2^32 - 2 vertices and
 * triangles. */
scarp_status scarp_mesh_from_arrays(const double* positions, uint64_t vertices, const uint32_t* triangles,
                                    uint64_t triangle_count, scarp_mesh** out);
scarp_status scarp_mesh_read(const char* path, scarp_mesh** out);
uint64_t scarp_mesh_vertex_count(const scarp_mesh* mesh);
uint64_t scarp_mesh_triangle_count(const scarp_mesh* mesh);
const double* scarp_mesh_origin(const scarp_mesh* mesh);       /* 3 */
const double* scarp_mesh_positions(const scarp_mesh* mesh);    /* 3 a vertex, offsets from the origin */
const uint32_t* scarp_mesh_triangles(const scarp_mesh* mesh);  /* 3 a triangle, counter-clockwise from above */
const float* scarp_mesh_normals(const scarp_mesh* mesh);       /* 3 a vertex; NULL without the option "normals" */
const float* scarp_mesh_uvs(const scarp_mesh* mesh);           /* 2 a vertex; NULL without the option "uvs" */
const float* scarp_mesh_positions_f32(const scarp_mesh* mesh); /* rounded positions; computed at the first call */
/* `key`: "crs", "frame", "command", "error" ...; NULL if the mesh does not have it. */
const char* scarp_mesh_metadata(const scarp_mesh* mesh, const char* key);
const char* scarp_mesh_warnings(const scarp_mesh* mesh); /* one sentence a line; "" if none */
/* The report of a mesh that Scarp made; SCARP_USAGE for other meshes, which scarp_measure() can measure. */
scarp_status scarp_mesh_report(const scarp_mesh* mesh, scarp_report* out);
/* Makes another mesh: a solid, closed by walls and a flat base at z, which must be below all vertices. */
scarp_status scarp_mesh_add_base(const scarp_mesh* mesh, double z, scarp_mesh** out);
/* `format`: "glb", "obj", "2dm" ... (`scarp help --json`), "svg" or "eps". NULL: the format for which the mesh was
 * made. */
scarp_status scarp_mesh_encode(const scarp_mesh* mesh, const char* format, scarp_bytes** out);
/* Writes a file in the format of its ending, first to a temporary name. */
scarp_status scarp_mesh_write(const scarp_mesh* mesh, const char* path, int32_t overwrite);
/* Converts a whole mesh to bytes, and back, for another process with the same version of the library. */
scarp_status scarp_mesh_pack(const scarp_mesh* mesh, scarp_bytes** out);
scarp_status scarp_mesh_unpack(const uint8_t* bytes, uint64_t size, scarp_mesh** out);
void scarp_mesh_free(scarp_mesh* mesh);

const uint8_t* scarp_bytes_data(const scarp_bytes* bytes);
uint64_t scarp_bytes_size(const scarp_bytes* bytes);
void scarp_bytes_free(scarp_bytes* bytes);

/* Inserts one vertex at a time, the worst sample first. Borrows the field's samples until it is freed. */
scarp_status scarp_refiner_create(const scarp_field* field, scarp_refiner** out);
/* 1: inserted; 0: every sample is exact; -1: failed, see scarp_last_error(). */
int32_t scarp_refiner_insert_worst(scarp_refiner* refiner);
/* Inserts vertices until the max error is at most max_error, or there are max_vertices (0: any number). Returns the
 * number of vertices inserted; -1: failed. */
int64_t scarp_refiner_run(scarp_refiner* refiner, double max_error, uint64_t max_vertices);
/* The same with options: uses max_error (DEFAULT: 0), max_points and progress. `inserted`, if not NULL, is always set:
 * the refiner keeps vertices inserted before a cancellation. */
scarp_status scarp_refiner_go_on(scarp_refiner* refiner, const scarp_options* options, uint64_t* inserted);
double scarp_refiner_max_error(const scarp_refiner* refiner);
uint64_t scarp_refiner_vertex_count(const scarp_refiner* refiner);
uint64_t scarp_refiner_triangle_count(const scarp_refiner* refiner);
scarp_status scarp_refiner_mesh(const scarp_refiner* refiner, scarp_mesh** out);
void scarp_refiner_free(scarp_refiner* refiner);

/* A field that changes many times a second: an update remakes only the cells that it touches. The field is copied. One
 * thread at a time may change it; a second thread gets an error. Meanwhile, other threads may call
 * scarp_live_changes(), _mesh() and the counts. A failed call changes nothing. The mesh has the same bytes as that of a
 * field made from the final samples at the same col and row; with max_triangles, also at the same level. */
void scarp_live_options_init(scarp_live_options* options, uint32_t struct_size);
scarp_status scarp_live_create(const scarp_field* field, const scarp_live_options* options, scarp_live** out);
/* Replaces a window of cols * rows samples, row by row; NaN and the field's nodata are voids. `tolerance`: cols * rows
 * values, or NULL for no change. */
scarp_status scarp_live_update(scarp_live* live, int32_t col, int32_t row, int32_t cols, int32_t rows,
                               const float* heights, const float* tolerance);
/* Moves the field by `cols` columns east and `rows` rows down; new samples are void until an update. */
scarp_status scarp_live_scroll(scarp_live* live, int32_t cols, int32_t rows);
/* The cells that changed after the version `since`, sorted by slot, including those that became empty; for 0, all cells
 * with a surface. A cell replaces the previous one of its slot. */
scarp_status scarp_live_changes(const scarp_live* live, uint64_t since, scarp_changes** out);
uint64_t scarp_changes_version(const scarp_changes* changes); /* for the next call */
uint64_t scarp_changes_count(const scarp_changes* changes);
/* Fills `out`, whose struct_size the caller sets. */
scarp_status scarp_changes_cell(const scarp_changes* changes, uint64_t index, scarp_live_cell* out);
/* Makes a scarp_changes of one cell, which remains valid when `changes` is freed. */
scarp_status scarp_changes_cut(const scarp_changes* changes, uint64_t index, scarp_changes** out);
void scarp_changes_free(scarp_changes* changes);
/* The whole field as one mesh, in coordinates that do not change when the field moves. */
scarp_status scarp_live_mesh(const scarp_live* live, scarp_mesh** out);
/* Fills `out` with the current cols * rows samples; waits for a running change. */
scarp_status scarp_live_heights(const scarp_live* live, float* out);
void scarp_live_place(const scarp_live* live, int32_t* col, int32_t* row);
/* The geotransform of the field at its current position, in the coordinates of the mesh: for scarp_measure(). */
void scarp_live_geotransform(const scarp_live* live, double out[6]);
double scarp_live_max_error(const scarp_live* live); /* the largest error of any cell */
uint64_t scarp_live_triangle_count(const scarp_live* live);
int64_t scarp_live_level(const scarp_live* live); /* the state of the search for the budget */
uint32_t scarp_live_slot_count(const scarp_live* live);
void scarp_live_free(scarp_live* live);

/* Reads a raster with the options ("band", "nodata", "crs", "z_scale" ...). */
scarp_status scarp_raster_read(const char* path, const scarp_options* options, scarp_raster** out);
/* Fills `field`, which borrows the raster's samples. REQUIRES: scarp_field_init() was called. */
void scarp_raster_field(const scarp_raster* raster, scarp_field* field);
void scarp_raster_free(scarp_raster* raster);

/* Makes all tiles of a raster, by the options of `scarp tile` ("zoom", "vertical", "max_error", "of", "only" ...).
 * `output` is one file if it ends in .pmtiles, .mbtiles or .3tz, else a folder. The set gets its name at the end; a
 * failed call writes nothing. `overwrite`, other than 0: replaces a set made by Scarp. `out`, if not NULL, receives the
 * report of the set, as JSON. Needs GDAL. */
scarp_status scarp_tile(const scarp_field* field, const scarp_options* options, const char* output, int32_t overwrite,
                        scarp_bytes** out);
/* Makes the tiles of files: at each position, the first file with a height is used. */
scarp_status scarp_tile_files(const char* const* paths, uint64_t count, const scarp_options* options,
                              const char* output, int32_t overwrite, scarp_bytes** out);
/* Quantized-mesh tiles on request, by the options of `scarp tile` ("zoom", "vertical", "effort" ...). Needs GDAL. */
scarp_status scarp_tiles_open(const char* path, const scarp_options* options, scarp_tiles** out);
scarp_status scarp_tiles_open_field(const scarp_field* field, const scarp_options* options, scarp_tiles** out);
int32_t scarp_tiles_max_level(const scarp_tiles* tiles);
/* Columns and rows of the tiles of a level, two numbers per tile, sorted; NULL and 0 if there are none. */
uint64_t scarp_tiles_count(const scarp_tiles* tiles, int32_t level);
const uint32_t* scarp_tiles_list(const scarp_tiles* tiles, int32_t level);
/* The tile's bytes as stored (gzip). `bound`, if not NULL: its proven error in metres, NaN if unknown. Several threads
 * may call it at once. */
scarp_status scarp_tiles_read(const scarp_tiles* tiles, int32_t level, uint32_t x, uint32_t y, scarp_bytes** out,
                              double* bound);
scarp_status scarp_tiles_read_file(const scarp_tiles* tiles, const char* name, scarp_bytes** out); /* "layer.json" */
void scarp_tiles_free(scarp_tiles* tiles);

#ifdef __cplusplus
}
#endif
#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#endif
