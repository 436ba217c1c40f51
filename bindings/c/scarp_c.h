/* Scarp for C and all that calls C: height fields to triangle meshes with a proven error bound.
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
 *   - A function that can fail returns a scarp_status; on failure its output is NULL or untouched. scarp_last_error()
 *     then returns one sentence that names the culprit and the remedy. The library throws no exception and prints
 *     nothing.
 *   - Structs begin with their own size, which scarp_..._init() sets. A later library reads the part of a struct that
 *     an earlier caller knows; the rest has its default. Structs only grow at their end. Handles are opaque.
 *   - Memory behind pointers in structs is borrowed for the call; a refiner's samples for its lifetime.
 *   - A pointer obtained from a handle is valid until the handle is freed. Freeing NULL does nothing; functions that
 *     return a number or a pointer do not accept a NULL handle.
 *   - Functions may be called concurrently; several threads may read a handle, but only one may change it. Text is
 *     UTF-8.
 *   - The same input and options give the same bytes, on every machine, for any number of threads. */
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

/* Incremented when old callers would break; the shared library's SOVERSION. */
#define SCARP_ABI_VERSION 1

/* Result of a call: the exit codes of the program. */
typedef int32_t scarp_status;
#define SCARP_OK 0
#define SCARP_USAGE 1     /* options that conflict or are out of range; a null pointer */
#define SCARP_INPUT 2     /* a raster or mesh without usable contents, or an unreadable file */
#define SCARP_PROMISE 3   /* the requested error cannot be kept, or is exceeded */
#define SCARP_OUTPUT 4    /* a file that cannot be written, or a format that cannot hold the mesh */
#define SCARP_CANCELLED 5 /* the progress function requested it */
#define SCARP_INTERNAL 70 /* a bug in Scarp */

typedef struct scarp_mesh scarp_mesh;         /* a mesh, its purpose and its measured error */
typedef struct scarp_refiner scarp_refiner;   /* a mesh that grows by one vertex at a time */
typedef struct scarp_raster scarp_raster;     /* a raster that was read from a file */
typedef struct scarp_tiles scarp_tiles;       /* terrain tiles for globes, made on demand */
typedef struct scarp_bytes scarp_bytes;       /* the bytes of a file */
typedef struct scarp_settings scarp_settings; /* options by name */

/* A snapshot of a running pass. */
typedef struct scarp_progress {
  uint32_t struct_size;
  int32_t reserved;
  const char* pass;    /* "read", "refine", "fit", "search", "measure", "tiles" ...; valid during the call */
  double fraction;     /* 0 to 1 of this pass */
  uint64_t vertices;   /* so far; 0: unknown */
  double max_error;    /* so far, in z units; 0: unknown */
  double seconds_left; /* left of this pass; NaN before an estimate */
  uint64_t tiles;      /* written so far, in the pass "tiles" */
  uint64_t bytes;      /* bytes of these tiles */
} scarp_progress;
/* Called on the calling thread, at the start of a pass and a few times a second. Returns other than 0 to cancel. Must
 * not throw or jump. */
typedef int32_t (*scarp_progress_fn)(const scarp_progress* progress, void* user);

/* The positions of samples. */
#define SCARP_FRAME_GRID 0    /* x = column, y = rows - 1 - row; the geotransform is ignored */
#define SCARP_FRAME_SOURCE 1  /* by the geotransform and the CRS; a CRS in degrees is converted to metres */
#define SCARP_FRAME_DEGREES 2 /* the geotransform is in degrees (of WGS 84 without a CRS): metres around the centre */

/* Samples of heights on a grid, row-major, the first row in the north. NaN and infinities are nodata. */
typedef struct scarp_field {
  uint32_t struct_size;
  int32_t cols, rows; /* at least 2 */
  int32_t frame;      /* DEFAULT: SCARP_FRAME_GRID. The option "crs" overrides it. */
  const float* samples;
  double nodata;          /* another nodata value; samples with it cost one copy of all. DEFAULT: NaN, none. */
  double geotransform[6]; /* GDAL's, of pixel corners: x = g[0] + g[1] col + g[2] row, y = g[3] + g[4] col + g[5] row */
  double sample_rounding; /* largest |value - float32 sample| of rounded values; promises subtract it */
  const char* crs;        /* "EPSG:32611", WKT; DEFAULT: NULL. Without GDAL it is only a name. */
  const char* name;       /* for messages and the mesh's metadata. DEFAULT: NULL, "heights". */
  const char* unit; /* unit of the heights: "m", "ft"; for errors such as "1m" and "3ft". DEFAULT: NULL, unknown. */
} scarp_field;

/* Scattered points: z over x, y. */
typedef struct scarp_points {
  uint32_t struct_size;
  int32_t frame; /* SCARP_FRAME_DEGREES: x and y are degrees, of WGS 84 without a CRS. DEFAULT: 0, by the CRS. */
  const double *x, *y, *z;
  uint64_t count;
  uint64_t stride;  /* doubles from one x to the next, at least 1; 3 for interleaved x, y, z. DEFAULT: 1. */
  const char* crs;  /* like a field's; degrees become metres around the middle of the points. DEFAULT: NULL */
  const char* name; /* DEFAULT: NULL, "points" */
} scarp_points;

/* The most common options; all others by name. */
typedef struct scarp_options {
  uint32_t struct_size;
  int32_t threads;        /* 0: all cores, for few samples one. Never changes the result. */
  double max_error;       /* in z units. DEFAULT: NaN, none. */
  uint64_t max_triangles; /* 0: none */
  uint64_t max_points;    /* vertices; 0: none */
  const float* mask;      /* NULL, or a weight for each sample: weight * |error| is bounded; 0 and NaN: no bound */
  const float* tolerance; /* NULL, or a bound for each sample; NaN: none */
  scarp_progress_fn progress;
  void* user;
  scarp_settings* named; /* set by scarp_options_set() */
} scarp_options;

/* The measured error of a mesh. Errors are vertical, mesh minus sample, in z units. */
typedef struct scarp_report {
  uint32_t struct_size;
  int32_t stop;          /* reason of the end: 0 max_error, 1 max_triangles, 2 max_points, 3 every sample is exact */
  int32_t effort;        /* 0 fast, 1 normal, 2 high, 3 max; -1 for a measured mesh */
  int32_t is_cut_short;  /* a time limit ended the effort */
  int32_t max_error_col; /* the sample with the largest error; -1: none */
  int32_t max_error_row;
  uint64_t vertices, triangles;
  uint64_t samples;   /* judged */
  uint64_t uncovered; /* valid samples without a triangle */
  uint64_t stray;     /* valid samples outside every valid cell */
  uint64_t over;      /* above their tolerance, or above "fail_above" */
  double max_error, rmse, mean_error, mean_abs_error, p50, p95, p99;
  double seconds;
} scarp_report;

/* The library. */
uint32_t scarp_abi_version(void);
const char* scarp_version(void);
int32_t scarp_has_gdal(void); /* 1: reads GDAL's formats and supports CRSs; 0: PGM and STM, and points as text */
/* All structs, one per line: name, size, and members with their offsets, "scarp_field 104 struct_size:0 cols:4 ...".
 * Bindings that redeclare the structs compare them with it. */
const char* scarp_abi_layout(void);
/* The message of this thread's last failed call; valid until its next call. */
const char* scarp_last_error(void);
/* For bindings that use another name for an option ("crs", "frame"): callers and messages then use that name. Applies
 * to the whole process; call it before everything else. SCARP_USAGE if there is no such option. */
scarp_status scarp_name_option(const char* name, const char* shown);

/* Rounds heights to float32 samples for a field. Returns the largest |value - sample|, its sample_rounding. NaN stays
 * NaN; values beyond float32 become infinite. */
double scarp_round_samples(const double* values, uint64_t count, float* samples);

void scarp_field_init(scarp_field* field, uint32_t struct_size);
void scarp_points_init(scarp_points* points, uint32_t struct_size);
void scarp_options_init(scarp_options* options, uint32_t struct_size);
/* Sets an option of the program, except those about its terminal and files. The name is the long one with _ for -, the
 * value as in the program: ("max_error", "0.5%"), ("effort", "high"), ("breaklines", "dikes.gpkg"), ("normals",
 * "true"). For a repeatable option each call adds a value; else the last one applies. A NULL value removes the option.
 * An option set by name overrides the struct's member. `scarp help --json` lists all. "of" is the intended format of
 * the mesh: like the program's OUTPUT it determines the frame and whether positions are float32. SCARP_USAGE for an
 * unknown name, with the one probably meant. */
scarp_status scarp_options_set(scarp_options* options, const char* name, const char* value);
/* Frees the options of scarp_options_set(); the struct may be used again. */
void scarp_options_clear(scarp_options* options);

/* Simplifies a field in memory, like `scarp simplify` with a raster of these samples. Float32 samples are not copied;
 * for an exception see scarp_field::nodata. */
scarp_status scarp_simplify(const scarp_field* field, const scarp_options* options, scarp_mesh** out);
/* Simplifies a file of a raster or points with all of its metadata, exactly like the program. */
scarp_status scarp_simplify_file(const char* path, const scarp_options* options, scarp_mesh** out);
scarp_status scarp_simplify_points(const scarp_points* points, const scarp_options* options, scarp_mesh** out);

/* Judges a mesh by brute force, like `scarp measure`, with that command's options: "fail_above", "mask", "tolerance",
 * "cutline" ... Fills in `out` for SCARP_OK, and for SCARP_PROMISE if the mesh breaks a requested bound. */
scarp_status scarp_measure(const scarp_field* field, const scarp_mesh* mesh, const scarp_options* options,
                           scarp_report* out);
scarp_status scarp_measure_file(const char* path, const scarp_mesh* mesh, const scarp_options* options,
                                scarp_report* out);
scarp_status scarp_measure_points(const scarp_points* points, const scarp_mesh* mesh, const scarp_options* options,
                                  scarp_report* out);

/* Meshes. Vertex v lies at origin + positions[3v .. 3v + 2], x east, y north, z up. At most 2^32 - 2 of each. */
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
const float* scarp_mesh_positions_f32(const scarp_mesh* mesh); /* rounded positions; made at the first call */
/* "crs", "frame", "command", "error" ...; NULL if absent. */
const char* scarp_mesh_metadata(const scarp_mesh* mesh, const char* key);
const char* scarp_mesh_warnings(const scarp_mesh* mesh); /* one per line; "" if none */
/* The report of a mesh that Scarp made. SCARP_USAGE for other meshes: use scarp_measure(). */
scarp_status scarp_mesh_report(const scarp_mesh* mesh, scarp_report* out);
/* Makes another mesh: a solid closed by walls and a flat base at z, below all vertices. */
scarp_status scarp_mesh_add_base(const scarp_mesh* mesh, double z, scarp_mesh** out);
/* `format`: "glb", "obj", "2dm" ... of `scarp help --json`, "svg" or "eps". NULL: the intended format of the mesh. */
scarp_status scarp_mesh_encode(const scarp_mesh* mesh, const char* format, scarp_bytes** out);
/* Writes a file in the format of its ending: first under a temporary name, then renamed. */
scarp_status scarp_mesh_write(const scarp_mesh* mesh, const char* path, int32_t overwrite);
/* Converts a mesh to bytes and back, for another process with the same version of the library. */
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
/* Inserts until the max error is at most max_error, or there are max_vertices (0: any number). Returns how many were
 * inserted; -1: failed. */
int64_t scarp_refiner_run(scarp_refiner* refiner, double max_error, uint64_t max_vertices);
/* Inserts by options: max_error (DEFAULT: 0), max_points and progress. Always fills in `inserted`, unless NULL: a
 * cancelled refiner keeps its vertices. */
scarp_status scarp_refiner_go_on(scarp_refiner* refiner, const scarp_options* options, uint64_t* inserted);
double scarp_refiner_max_error(const scarp_refiner* refiner);
uint64_t scarp_refiner_vertex_count(const scarp_refiner* refiner);
uint64_t scarp_refiner_triangle_count(const scarp_refiner* refiner);
scarp_status scarp_refiner_mesh(const scarp_refiner* refiner, scarp_mesh** out);
void scarp_refiner_free(scarp_refiner* refiner);

/* Reads a raster by options ("band", "nodata", "crs", "z_scale" ...). */
scarp_status scarp_raster_read(const char* path, const scarp_options* options, scarp_raster** out);
/* The field of the raster, which it borrows. REQUIRES: init was called. */
void scarp_raster_field(const scarp_raster* raster, scarp_field* field);
void scarp_raster_free(scarp_raster* raster);

/* Makes all tiles of a raster, by the options of `scarp tile` ("zoom", "vertical", "max_error", "of", "only" ...): into
 * a folder, or into one file if `output` ends in .pmtiles, .mbtiles or .3tz. The set gets its name at the end; a failed
 * call writes nothing. `overwrite`, other than 0: replaces a set made by Scarp. `out`: the report of the set as JSON,
 * unless NULL. Needs GDAL. */
scarp_status scarp_tile(const scarp_field* field, const scarp_options* options, const char* output, int32_t overwrite,
                        scarp_bytes** out);
/* Makes all tiles of files: at each place the first file with a height there is used. */
scarp_status scarp_tile_files(const char* const* paths, uint64_t count, const scarp_options* options,
                              const char* output, int32_t overwrite, scarp_bytes** out);
/* Opens tiles of quantized-mesh, made on demand, by the options of `scarp tile` ("zoom", "vertical", "effort" ...).
 * Needs GDAL. */
scarp_status scarp_tiles_open(const char* path, const scarp_options* options, scarp_tiles** out);
scarp_status scarp_tiles_open_field(const scarp_field* field, const scarp_options* options, scarp_tiles** out);
int32_t scarp_tiles_max_level(const scarp_tiles* tiles);
/* Columns and rows of the tiles of a level, two numbers a tile, sorted; NULL and 0 for none. */
uint64_t scarp_tiles_count(const scarp_tiles* tiles, int32_t level);
const uint32_t* scarp_tiles_list(const scarp_tiles* tiles, int32_t level);
/* The tile's bytes (gzip) and, unless NULL, `bound`: its proven error in metres, NaN if unknown. May be called
 * concurrently. */
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
