/* The C library for its callers: statuses and messages, structs of earlier callers, null pointers, cancellation, and
 * the bytes of the program. Usage: door DEM PROGRAMS_GLB PROGRAMS_OBJ OUT. */
#include <math.h>
#include <scarp_c.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kCols = 90, kRows = 70 };

static int failures = 0;

static void expect(int holds, const char* what, int line) {
  if (holds) return;
  fprintf(stderr, "line %d: %s; the library says: %s\n", line, what, scarp_last_error());
  ++failures;
}
#define EXPECT(holds) expect((holds), #holds, __LINE__)
#define EXPECT_SAYS(words) expect(strstr(scarp_last_error(), words) != NULL, "says: " words, __LINE__)

static float heights[kCols * kRows];

static scarp_field make_field(void) {
  scarp_field field;
  scarp_field_init(&field, sizeof field);
  field.samples = heights;
  field.cols = kCols;
  field.rows = kRows;
  return field;
}

static scarp_options make_options(double max_error) {
  scarp_options options;
  scarp_options_init(&options, sizeof options);
  options.max_error = max_error;
  return options;
}

static int is_same(const scarp_mesh* a, const scarp_mesh* b) {
  const uint64_t vertices = scarp_mesh_vertex_count(a), triangles = scarp_mesh_triangle_count(a);
  return vertices == scarp_mesh_vertex_count(b) && triangles == scarp_mesh_triangle_count(b) &&
         memcmp(scarp_mesh_positions(a), scarp_mesh_positions(b), (size_t)vertices * 24) == 0 &&
         memcmp(scarp_mesh_triangles(a), scarp_mesh_triangles(b), (size_t)triangles * 12) == 0;
}

static void try_field(void) {
  scarp_field field = make_field();
  scarp_options options = make_options(3);
  scarp_mesh* mesh = NULL;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_OK);
  scarp_report report;
  report.struct_size = sizeof report;
  EXPECT(scarp_mesh_report(mesh, &report) == SCARP_OK);
  EXPECT(report.max_error <= 3 && report.samples == kCols * kRows && report.stop == 0);
  scarp_report measured;
  measured.struct_size = sizeof measured;
  EXPECT(scarp_measure(&field, mesh, NULL, &measured) == SCARP_OK);
  EXPECT(measured.max_error == report.max_error && measured.effort == -1);
  EXPECT(fabs(scarp_mesh_positions_f32(mesh)[1] - scarp_mesh_positions(mesh)[1]) < 1e-3);
  EXPECT(scarp_mesh_normals(mesh) == NULL);

  /* By name instead of by the struct, and with arrays on other numbers of threads: the same bytes. */
  scarp_options named = make_options(NAN);
  EXPECT(scarp_options_set(&named, "max_error", "3") == SCARP_OK);
  EXPECT(scarp_options_set(&named, "--num-threads", "1") == SCARP_OK);
  EXPECT(scarp_options_set(&named, "normals", "true") == SCARP_OK);
  EXPECT(scarp_options_set(&named, "uvs", "true") == SCARP_OK);
  EXPECT(scarp_options_set(&named, "uvs", NULL) == SCARP_OK);
  scarp_mesh* again = NULL;
  EXPECT(scarp_simplify(&field, &named, &again) == SCARP_OK);
  EXPECT(is_same(mesh, again));
  EXPECT(scarp_mesh_normals(again) != NULL && scarp_mesh_uvs(again) == NULL);
  scarp_options_clear(&named);
  scarp_mesh_free(again);

  /* An earlier caller with shorter structs: bytes after them are not read. */
  scarp_options old = make_options(3);
  memset((char*)&old + offsetof(scarp_options, mask), 0x5a, sizeof old - offsetof(scarp_options, mask));
  old.struct_size = (uint32_t)offsetof(scarp_options, mask);
  scarp_field old_field = make_field();
  memset((char*)&old_field + offsetof(scarp_field, crs), 0x5a, sizeof old_field - offsetof(scarp_field, crs));
  old_field.struct_size = (uint32_t)offsetof(scarp_field, crs);
  EXPECT(scarp_simplify(&old_field, &old, &again) == SCARP_OK);
  EXPECT(is_same(mesh, again));
  scarp_report short_report;
  memset(&short_report, 0x5a, sizeof short_report);
  short_report.struct_size = (uint32_t)offsetof(scarp_report, max_error);
  EXPECT(scarp_mesh_report(again, &short_report) == SCARP_OK);
  EXPECT(short_report.vertices == report.vertices && memcmp(&short_report.max_error, "ZZZZZZZZ", 8) == 0);
  EXPECT(scarp_options_set(&old, "effort", "high") == SCARP_USAGE);
  scarp_mesh_free(again);

#ifdef IS_NEWEST
  const double given[4] = {0.1, 16777217, NAN, 1e300};
  float rounded[4];
  EXPECT(scarp_round_samples(given, 4, rounded) == 1);
  EXPECT(rounded[0] == 0.1f && rounded[1] == 16777216 && isnan(rounded[2]) && isinf(rounded[3]));
#endif

  /* Arrays in addition to the heights, nodata, a solid. */
  static float mask[kCols * kRows], tolerance[kCols * kRows];
  for (int k = 0; k < kCols * kRows; ++k) {
    mask[k] = k % kCols < kCols / 2 ? 1.0f : 0.25f;
    tolerance[k] = 2;
  }
  options.mask = mask;
  scarp_mesh* other = NULL;
  EXPECT(scarp_simplify(&field, &options, &other) == SCARP_OK);
  EXPECT(scarp_mesh_triangle_count(other) < scarp_mesh_triangle_count(mesh));
  scarp_mesh_free(other);
  options = make_options(NAN);
  options.tolerance = tolerance;
  EXPECT(scarp_simplify(&field, &options, &other) == SCARP_OK);
  EXPECT(scarp_mesh_triangle_count(other) > scarp_mesh_triangle_count(mesh));
  scarp_mesh_free(other);
  options = make_options(3);
  field.nodata = heights[0];
  EXPECT(scarp_simplify(&field, &options, &other) == SCARP_OK);
  EXPECT(!is_same(mesh, other));
  scarp_mesh* solid = NULL;
  EXPECT(scarp_mesh_add_base(mesh, -50, &solid) == SCARP_OK);
  EXPECT(scarp_mesh_triangle_count(solid) > scarp_mesh_triangle_count(mesh));
  scarp_mesh* none = NULL;
  EXPECT(scarp_mesh_add_base(mesh, 50, &none) == SCARP_USAGE && none == NULL);
  scarp_mesh_free(solid);
  scarp_mesh_free(other);

  scarp_mesh* copy = NULL;
  const double* origin = scarp_mesh_origin(mesh);
  const uint64_t count = scarp_mesh_vertex_count(mesh);
  double* positions = malloc((size_t)count * 24);
  for (uint64_t k = 0; k < 3 * count; ++k) positions[k] = origin[k % 3] + scarp_mesh_positions(mesh)[k];
  EXPECT(scarp_mesh_from_arrays(positions, count, scarp_mesh_triangles(mesh), scarp_mesh_triangle_count(mesh), &copy) ==
         SCARP_OK);
  field = make_field();
  EXPECT(scarp_measure(&field, copy, NULL, &measured) == SCARP_OK);
  EXPECT(measured.max_error == report.max_error);
  EXPECT(scarp_mesh_report(copy, &measured) == SCARP_USAGE);
  scarp_mesh_free(copy);
  free(positions);
  scarp_mesh_free(mesh);
}

static int32_t cancel(const scarp_progress* progress, void* user) {
  ++*(int*)user;
  return progress->fraction >= 0;
}

static void try_errors(void) {
  scarp_field field = make_field();
  scarp_options options = make_options(NAN);
  scarp_mesh* mesh = (scarp_mesh*)&field;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE && mesh == NULL);
  EXPECT_SAYS("no goal is given");
  EXPECT(scarp_simplify(&field, NULL, &mesh) == SCARP_USAGE);
  EXPECT(scarp_simplify(&field, &options, NULL) == SCARP_USAGE);
  EXPECT(scarp_simplify(NULL, &options, &mesh) == SCARP_USAGE);
  options.max_error = -1;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("max_error -1 is negative");
  options.max_error = 1;
  EXPECT(scarp_options_set(&options, "max_eror", "1") == SCARP_USAGE);
  EXPECT_SAYS("did you mean max_error?");
  EXPECT(scarp_options_set(&options, "epsilon", "1") == SCARP_USAGE);
  EXPECT_SAYS("did you mean max_error?");
  EXPECT(scarp_options_set(&options, "report", "x.json") == SCARP_USAGE);
  EXPECT_SAYS("the program's alone");
  EXPECT(scarp_options_set(&options, "help", "true") == SCARP_USAGE);
  EXPECT_SAYS("option help is the program's alone");
  EXPECT(scarp_simplify_file("-e.pgm", &options, &mesh) == SCARP_INPUT);
  EXPECT_SAYS("-e.pgm: no such file");
  EXPECT(scarp_options_set(&options, "fill_distance", "3") == SCARP_OK);
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("fill_distance needs nodata_policy fill");
  scarp_options_clear(&options);
  EXPECT(scarp_options_set(&options, "fail_above", "3") == SCARP_OK);
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("fail_above has no meaning here");
  scarp_options_clear(&options);
  field.sample_rounding = NAN;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("sample_rounding");
  field.sample_rounding = 0;
  field.cols = 1;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_INPUT);
  EXPECT_SAYS("at least 2 x 2");
  field.cols = -7;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_INPUT);
  field = make_field();
  field.samples = NULL;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  static float voids[16];
  for (int k = 0; k < 16; ++k) voids[k] = NAN;
  field.samples = voids;
  field.cols = field.rows = 4;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_INPUT);
  EXPECT_SAYS("none of its 4 x 4 samples is a height");
  EXPECT(scarp_simplify_file("/no/such/file.pgm", &options, &mesh) == SCARP_INPUT);
  EXPECT(scarp_mesh_read("/no/such/mesh.glb", &mesh) == SCARP_INPUT);
  const uint32_t far[3] = {0, 1, 9};
  const double corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  EXPECT(scarp_mesh_from_arrays(corners, 3, far, 1, &mesh) == SCARP_INPUT);
  EXPECT_SAYS("names the vertex 9");

  field = make_field();
  options = make_options(0.5);
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_OK);
  scarp_bytes* bytes = NULL;
  EXPECT(scarp_mesh_encode(mesh, "xyz", &bytes) == SCARP_USAGE && bytes == NULL);
  EXPECT(scarp_mesh_write(mesh, "/no/such/folder/mesh.glb", 1) == SCARP_OUTPUT);
  scarp_options limit = make_options(NAN);
  EXPECT(scarp_options_set(&limit, "fail_above", "0.0001") == SCARP_OK);
  scarp_report report;
  report.struct_size = sizeof report;
  report.samples = 0;
  EXPECT(scarp_measure(&field, mesh, &limit, &report) == SCARP_PROMISE && report.samples == kCols * kRows);
  scarp_options_clear(&limit);
  scarp_mesh_free(mesh);
  int calls = 0;
  options.progress = cancel;
  options.user = &calls;
  EXPECT(scarp_options_set(&options, "effort", "max") == SCARP_OK);
  EXPECT(scarp_options_set(&options, "time_limit", "60") == SCARP_OK);
  const scarp_status status = scarp_simplify(&field, &options, &mesh);
  EXPECT(calls == 0 ? status == SCARP_OK : status == SCARP_CANCELLED);
  scarp_mesh_free(mesh);
  scarp_options_clear(&options);
  scarp_mesh_free(NULL);
  scarp_bytes_free(NULL);
  scarp_refiner_free(NULL);
  scarp_raster_free(NULL);
  scarp_tiles_free(NULL);
}

/* Numbers too large for any memory, and structs that were not initialised. */
static void try_unwritten(void) {
  scarp_mesh* mesh = NULL;
  scarp_field field = make_field();
  scarp_field wild_field;
  scarp_points points;
  scarp_options options = make_options(1), wild;
  scarp_report report;
  memset(&wild_field, 0xAA, sizeof wild_field);
  memset(&points, 0xAA, sizeof points);
  memset(&wild, 0xAA, sizeof wild);
  memset(&report, 0xAA, sizeof report);
  EXPECT(scarp_options_set(&wild, "effort", "high") == SCARP_USAGE);
  EXPECT_SAYS("the scarp_options is not initialised: its struct_size is 2863311530");
  scarp_options_clear(&wild);
  EXPECT(scarp_simplify(&field, &wild, &mesh) == SCARP_USAGE && mesh == NULL);
  EXPECT(scarp_simplify(&wild_field, &options, &mesh) == SCARP_USAGE && mesh == NULL);
  EXPECT_SAYS("should be sizeof(scarp_field)");
  EXPECT(scarp_simplify_points(&points, &options, &mesh) == SCARP_USAGE && mesh == NULL);
  EXPECT_SAYS("should be sizeof(scarp_points)");
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_OK);
  EXPECT(scarp_mesh_report(mesh, &report) == SCARP_USAGE);
  EXPECT(scarp_measure(&field, mesh, NULL, &report) == SCARP_USAGE);
  EXPECT_SAYS("should be sizeof(scarp_report)");
  scarp_mesh_free(mesh);
  static char name[1 << 20];
  memset(name, 'a', sizeof name - 1);
  EXPECT(scarp_options_set(&options, name, "1") == SCARP_USAGE);
  EXPECT(scarp_mesh_read("", &mesh) == SCARP_USAGE && mesh == NULL);
  EXPECT_SAYS("the path is empty");
}

static void try_lies(void) {
  const uint32_t corners[3] = {0, 1, 2};
  const double flat[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, odd[9] = {0, 0, 0, 1, 0, NAN, 0, 1, 0};
  scarp_mesh* mesh = NULL;
  const uint64_t counts[4] = {UINT64_C(1) << 62, UINT64_C(1) << 61, UINT64_MAX, UINT64_C(1) << 32};
  for (int k = 0; k < 4; ++k) {
    EXPECT(scarp_mesh_from_arrays(flat, counts[k], corners, 1, &mesh) == SCARP_USAGE && mesh == NULL);
    EXPECT_SAYS("vertices are given: a mesh has at most 4294967294");
    EXPECT(scarp_mesh_from_arrays(flat, 3, corners, counts[k], &mesh) == SCARP_USAGE && mesh == NULL);
    EXPECT_SAYS("triangles are given");
  }
  EXPECT(scarp_mesh_from_arrays(odd, 3, corners, 1, &mesh) == SCARP_INPUT);
  EXPECT_SAYS("the vertex 1 is nan");

  scarp_options options = make_options(1);
  scarp_field field = make_field();
  const int32_t frames[3] = {99, -1, 3};
  for (int k = 0; k < 3; ++k) {
    field.frame = frames[k];
    EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
    EXPECT_SAYS("the field's frame is");
  }
  field = make_field();
  field.cols = field.rows = INT32_MAX;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("2147483647 x 2147483647 samples");
  field = make_field();
  field.cols = -5;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_INPUT);
  EXPECT_SAYS("heights: -5 x ");
  try_unwritten();
  field = make_field();
  field.struct_size = 0;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("should be sizeof(scarp_field)");
  field = make_field();
  options.struct_size = 0;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("should be sizeof(scarp_options)");
  EXPECT(scarp_options_set(&options, "effort", "high") == SCARP_USAGE);
  options = make_options(1);
  const int32_t threads[2] = {-5, 5000};
  for (int k = 0; k < 2; ++k) {
    options.threads = threads[k];
    EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
    EXPECT(strncmp(scarp_last_error(), "threads ", 8) == 0);
  }
  options.threads = 0;
  EXPECT(scarp_options_set(&options, "threads", "-5") == SCARP_OK);
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("threads -5");
  scarp_options_clear(&options);
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_OK);
  scarp_report report;
  report.struct_size = 0;
  EXPECT(scarp_mesh_report(mesh, &report) == SCARP_USAGE);
  EXPECT_SAYS("should be sizeof(scarp_report)");
  scarp_mesh* solid = NULL;
  EXPECT(scarp_mesh_add_base(mesh, NAN, &solid) == SCARP_USAGE && solid == NULL);

  const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 3};
  scarp_points points;
  scarp_points_init(&points, sizeof points);
  points.x = xyz;
  points.y = xyz + 1;
  points.z = xyz + 2;
  points.count = 4;
  points.stride = 0;
  scarp_mesh* of_points = NULL;
  EXPECT(scarp_simplify_points(&points, &options, &of_points) == SCARP_USAGE);
  EXPECT_SAYS("stride is 0");
  const uint64_t strides[3] = {(uint64_t)-1, (uint64_t)-3, UINT64_C(1) << 60};
  for (int k = 0; k < 3; ++k) {
    points.stride = strides[k];
    EXPECT(scarp_simplify_points(&points, &options, &of_points) == SCARP_USAGE);
    EXPECT_SAYS("no array is so large");
    report.struct_size = sizeof report;
    EXPECT(scarp_measure_points(&points, mesh, NULL, &report) == SCARP_USAGE);
  }
  points.stride = 3;
  points.count = UINT64_C(1) << 63;
  EXPECT(scarp_simplify_points(&points, &options, &of_points) == SCARP_USAGE);
  EXPECT_SAYS("count is 9223372036854775808");

  scarp_refiner* refiner = NULL;
  EXPECT(scarp_refiner_create(&field, &refiner) == SCARP_OK);
  EXPECT(scarp_refiner_run(refiner, -1, 0) == -1);
  EXPECT_SAYS("max_error -1 is negative");
  EXPECT(scarp_refiner_run(refiner, NAN, 0) == -1);
  EXPECT_SAYS("max_error nan is no number");
#ifdef IS_NEWEST
  uint64_t inserted = 7;
  options = make_options(-0.5);
  EXPECT(scarp_refiner_go_on(refiner, &options, &inserted) == SCARP_USAGE && inserted == 0);
#endif
  scarp_refiner_free(refiner);
  scarp_mesh_free(mesh);
}

#ifdef IS_NEWEST
/* A mesh as bytes and back, and option names of the caller. */
static void try_newest(void) {
  scarp_field field = make_field();
  field.unit = "ft";
  scarp_options options = make_options(NAN);
  EXPECT(scarp_options_set(&options, "max_error", "3ft") == SCARP_OK);
  EXPECT(scarp_options_set(&options, "normals", "true") == SCARP_OK);
  scarp_mesh *mesh = NULL, *again = NULL;
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_OK);
  scarp_options_clear(&options);
  scarp_report report, other;
  report.struct_size = other.struct_size = sizeof report;
  EXPECT(scarp_mesh_report(mesh, &report) == SCARP_OK && report.max_error > 1 && report.max_error <= 3);
  scarp_bytes* packed = NULL;
  EXPECT(scarp_mesh_pack(mesh, &packed) == SCARP_OK);
  EXPECT(scarp_mesh_unpack(scarp_bytes_data(packed), scarp_bytes_size(packed), &again) == SCARP_OK);
  EXPECT(is_same(mesh, again) && memcmp(scarp_mesh_origin(mesh), scarp_mesh_origin(again), 24) == 0);
  EXPECT(memcmp(scarp_mesh_normals(mesh), scarp_mesh_normals(again), (size_t)scarp_mesh_vertex_count(mesh) * 12) == 0);
  EXPECT(strcmp(scarp_mesh_metadata(mesh, "error"), scarp_mesh_metadata(again, "error")) == 0);
  EXPECT(scarp_mesh_report(again, &other) == SCARP_OK && memcmp(&report, &other, sizeof report) == 0);
  scarp_mesh_free(again);
  for (uint64_t size = 0; size < scarp_bytes_size(packed); size += 1 + size / 7) {
    EXPECT(scarp_mesh_unpack(scarp_bytes_data(packed), size, &again) == SCARP_INPUT && again == NULL);
  }
  scarp_bytes_free(packed);
  scarp_mesh_free(mesh);

  EXPECT(scarp_name_option("max_error", "tolerable") == SCARP_OK && scarp_name_option("epsilon", "x") == SCARP_USAGE);
  options = make_options(-1);
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("tolerable -1 is negative");
  EXPECT(scarp_options_set(&options, "tolerable", "2") == SCARP_OK);
  EXPECT(scarp_simplify(&field, &options, &mesh) == SCARP_OK);
  scarp_options_clear(&options);
  scarp_mesh_free(mesh);
  EXPECT(scarp_name_option("max_error", "max_error") == SCARP_OK);
}

/* Volumes between meshes, and of a mesh above a level. */
static void try_volumes(void) {
  scarp_field field = make_field();
  scarp_options options = make_options(3);
  scarp_mesh *coarse = NULL, *fine = NULL, *solid = NULL, *bare = NULL;
  EXPECT(scarp_simplify(&field, &options, &coarse) == SCARP_OK);
  options = make_options(0.5);
  EXPECT(scarp_simplify(&field, &options, &fine) == SCARP_OK);
  scarp_volumes forth, back;
  forth.struct_size = back.struct_size = sizeof forth;
  EXPECT(scarp_measure_volume(coarse, fine, NULL, &forth) == SCARP_OK);
  EXPECT(scarp_measure_volume(fine, coarse, NULL, &back) == SCARP_OK);
  EXPECT(forth.cut == back.fill && forth.fill == back.cut && forth.net == -back.net && forth.cut > 0);
  const double area = (kCols - 1) * (kRows - 1);
  EXPECT(fabs(forth.common_area - area) < 1e-9 && forth.from_outside == 0 && forth.to_outside == 0);
  EXPECT(forth.uncertainty > 2 * area && forth.uncertainty <= 3.5 * area);
  EXPECT(forth.cut + forth.fill < forth.uncertainty);
  EXPECT(scarp_measure_volume_to_level(fine, -100, NULL, &back) == SCARP_OK);
  EXPECT(back.fill == 0 && back.cut > 50 * area && back.cut < 150 * area && back.net == back.cut);
  EXPECT(scarp_measure_volume_to_level(fine, NAN, NULL, &back) == SCARP_USAGE);
  EXPECT(scarp_measure_volume(fine, NULL, NULL, &back) == SCARP_USAGE);
  EXPECT(scarp_mesh_add_base(fine, -50, &solid) == SCARP_OK);
  EXPECT(scarp_measure_volume(fine, solid, NULL, &back) == SCARP_INPUT);
  EXPECT_SAYS("the second mesh is a closed solid");
  const double square[12] = {0, 0, 7, 9, 0, 7, 9, 9, 7, 0, 9, 7};
  const uint32_t corners[6] = {0, 1, 2, 0, 2, 3};
  EXPECT(scarp_mesh_from_arrays(square, 4, corners, 2, &bare) == SCARP_OK);
  EXPECT(scarp_measure_volume_to_level(bare, 4, NULL, &back) == SCARP_OK);
  EXPECT(fabs(back.cut - 243) < 1e-9 && isnan(back.uncertainty));
  back.struct_size = 16; /* a caller who knows cut alone */
  EXPECT(scarp_measure_volume_to_level(bare, 5, NULL, &back) == SCARP_OK);
  EXPECT(fabs(back.cut - 162) < 1e-9 && isnan(back.uncertainty));
  scarp_mesh_free(bare);
  scarp_mesh_free(solid);
  scarp_mesh_free(fine);
  scarp_mesh_free(coarse);
}

/* A field that changes, judged by scarp_measure() before and after it moved. */
static void try_live(void) {
  scarp_field field = make_field();
  scarp_live_options options;
  scarp_live* live = NULL;
  scarp_changes* changes = NULL;
  EXPECT(scarp_live_create(&field, NULL, &live) == SCARP_USAGE && live == NULL);
  scarp_live_options_init(&options, sizeof options);
  options.max_error = 2;
  options.effort = 3;
  EXPECT(scarp_live_create(&field, &options, &live) == SCARP_USAGE && live == NULL);
  EXPECT_SAYS("is 0 (fast), 1 (normal) or 2 (high), not 3");
  options.effort = 1;
  options.cell = 16;
  EXPECT(scarp_live_create(&field, &options, &live) == SCARP_OK);
  EXPECT(scarp_live_changes(live, 0, &changes) == SCARP_OK);
  const uint64_t version = scarp_changes_version(changes);
  EXPECT(scarp_changes_count(changes) > 1 && scarp_changes_count(changes) <= scarp_live_slot_count(live));
  scarp_changes_free(changes);

  static float all[kCols * kRows];
  const float window[6] = {40, 41, 42, 43, 44, NAN};
  EXPECT(scarp_live_update(live, kCols - 2, 0, 3, 2, window, NULL) == SCARP_USAGE);
  EXPECT_SAYS("is not within the live field");
  EXPECT(scarp_live_update(live, 2, 2, 3, 2, window, NULL) == SCARP_OK);
  EXPECT(scarp_live_changes(live, version, &changes) == SCARP_OK && scarp_changes_count(changes) == 1);
  scarp_live_cell cell;
  cell.struct_size = sizeof cell;
  EXPECT(scarp_changes_cell(changes, 1, &cell) == SCARP_USAGE);
  EXPECT(scarp_changes_cell(changes, 0, &cell) == SCARP_OK);
  EXPECT(cell.version == version + 1 && cell.col == 0 && cell.row == 0 && cell.triangles > 0 && cell.max_error <= 2);
  for (uint32_t k = 0; k < 3 * cell.triangles; ++k) EXPECT(cell.indices[k] < cell.vertices);
  for (uint32_t v = 0; v < cell.vertices; ++v) EXPECT(cell.positions[3 * v] <= 16 && cell.positions[3 * v + 1] >= -16);
  scarp_changes_free(changes);

  for (int turn = 0; turn < 2; ++turn) {
    scarp_mesh* mesh = NULL;
    scarp_report report;
    report.struct_size = sizeof report;
    EXPECT(scarp_live_heights(live, all) == SCARP_OK && isnan(all[turn == 0 ? 3 * kCols + 4 : 6 * kCols + 2]));
    field.samples = all;
    if (turn == 1) field.frame = SCARP_FRAME_SOURCE;
    scarp_live_geotransform(live, field.geotransform);
    EXPECT(scarp_live_mesh(live, &mesh) == SCARP_OK);
    EXPECT(scarp_mesh_triangle_count(mesh) == scarp_live_triangle_count(live));
    EXPECT(scarp_measure(&field, mesh, NULL, &report) == SCARP_OK);
    EXPECT(report.max_error <= 2 && report.uncovered == 0 && report.max_error == scarp_live_max_error(live));
    scarp_mesh_free(mesh);
    EXPECT(scarp_live_scroll(live, 2, -3) == SCARP_OK);
  }
  int32_t col = 0, row = 0;
  scarp_live_place(live, &col, &row);
  EXPECT(col == 4 && row == -6);
  scarp_live_free(live);

  /* A budget: at the same level, the same mesh. */
  scarp_live* other = NULL;
  options.max_triangles = 400;
  EXPECT(scarp_live_create(&field, &options, &live) == SCARP_OK && scarp_live_triangle_count(live) <= 400);
  const int64_t level = scarp_live_level(live);
  options.level = &level;
  EXPECT(scarp_live_create(&field, &options, &other) == SCARP_OK && scarp_live_level(other) == level);
  EXPECT(scarp_live_triangle_count(other) == scarp_live_triangle_count(live));
  scarp_live_free(other);
  scarp_live_free(live);
  const int64_t too_high = INT64_MAX;
  options.level = &too_high;
  EXPECT(scarp_live_create(&field, &options, &live) == SCARP_USAGE);
  EXPECT_SAYS("has no level");
  scarp_live_free(NULL);
  scarp_changes_free(NULL);
}
#endif

static void try_refiner(void) {
  scarp_field field = make_field();
  scarp_refiner* refiner = NULL;
  EXPECT(scarp_refiner_insert_worst(NULL) == -1 && scarp_refiner_run(NULL, 0, 0) == -1);
  EXPECT_SAYS("null pointer");
  EXPECT(scarp_refiner_create(&field, &refiner) == SCARP_OK);
  EXPECT(scarp_refiner_insert_worst(refiner) == 1);
  const int64_t inserted = scarp_refiner_run(refiner, 4, 0);
  EXPECT(inserted > 0 && scarp_refiner_max_error(refiner) <= 4);
  const uint64_t count = scarp_refiner_vertex_count(refiner);
  EXPECT(scarp_refiner_run(refiner, 0, count + 10) == 10 && scarp_refiner_vertex_count(refiner) == count + 10);
#ifdef IS_NEWEST
  int calls = 0;
  scarp_options options = make_options(NAN);
  options.progress = cancel;
  options.user = &calls;
  uint64_t more = 7;
  EXPECT(scarp_refiner_go_on(refiner, &options, &more) == SCARP_CANCELLED && more == 0 && calls == 1);
  options.progress = NULL;
  options.max_points = count + 13;
  EXPECT(scarp_refiner_go_on(refiner, &options, &more) == SCARP_OK && more == 3);
  options.max_triangles = 9;
  EXPECT(scarp_refiner_go_on(refiner, &options, NULL) == SCARP_USAGE);
#endif
  scarp_mesh* mesh = NULL;
  EXPECT(scarp_refiner_mesh(refiner, &mesh) == SCARP_OK);
  EXPECT(scarp_mesh_triangle_count(mesh) == scarp_refiner_triangle_count(refiner));
  scarp_report report;
  report.struct_size = sizeof report;
  EXPECT(scarp_measure(&field, mesh, NULL, &report) == SCARP_OK);
  EXPECT(fabs(report.max_error - scarp_refiner_max_error(refiner)) < 1e-9);
  EXPECT(scarp_refiner_run(refiner, 0, 0) > 0 && scarp_refiner_insert_worst(refiner) == 0);
  scarp_mesh_free(mesh);
  scarp_refiner_free(refiner);
}

static void try_points(void) {
  static double xyz[3 * 500];
  for (int k = 0; k < 500; ++k) {
    xyz[3 * k] = (double)(k * 37 % 101);
    xyz[3 * k + 1] = (double)(k * 53 % 89);
    xyz[3 * k + 2] = (double)(k * k % 31);
  }
  scarp_points points;
  scarp_points_init(&points, sizeof points);
  points.x = xyz;
  points.y = xyz + 1;
  points.z = xyz + 2;
  points.count = 500;
  points.stride = 3;
  scarp_options options = make_options(6);
  scarp_mesh* mesh = NULL;
  EXPECT(scarp_simplify_points(&points, &options, &mesh) == SCARP_OK);
  scarp_report report;
  report.struct_size = sizeof report;
  EXPECT(scarp_measure_points(&points, mesh, NULL, &report) == SCARP_OK);
  EXPECT(report.max_error <= 6 && report.samples == 500);
#ifdef IS_NEWEST
  static float bounds[500];
  for (int k = 0; k < 500; ++k) bounds[k] = k % 3 == 0 ? INFINITY : k % 5 == 0 ? 0 : 2;
  options.tolerance = bounds;
  scarp_mesh* finer = NULL;
  EXPECT(scarp_measure_points(&points, mesh, &options, &report) == SCARP_USAGE); /* max_error is no option of it */
  scarp_options judge = make_options(NAN);
  judge.tolerance = bounds;
  EXPECT(scarp_measure_points(&points, mesh, &judge, &report) == SCARP_PROMISE && report.over > 0);
  EXPECT(scarp_simplify_points(&points, &options, &finer) == SCARP_OK);
  EXPECT(scarp_mesh_triangle_count(finer) > scarp_mesh_triangle_count(mesh));
  EXPECT(scarp_measure_points(&points, finer, &judge, &report) == SCARP_OK && report.over == 0);
  for (int k = 0; k < 500; ++k) { /* a point of bound 0 is a vertex */
    const double* origin = scarp_mesh_origin(finer);
    uint64_t v = 0;
    const uint64_t count = scarp_mesh_vertex_count(finer);
    const double* at = scarp_mesh_positions(finer);
    while (v < count &&
           (fabs(origin[0] + at[3 * v] - xyz[3 * k]) > 1e-4 || fabs(origin[1] + at[3 * v + 1] - xyz[3 * k + 1]) > 1e-4))
      ++v;
    EXPECT(bounds[k] > 0 || v < count);
  }
  scarp_mesh_free(finer);
  bounds[7] = -1;
  EXPECT(scarp_simplify_points(&points, &options, &finer) == SCARP_USAGE);
  EXPECT_SAYS("tolerance[7] is -1: it must be at least 0");
  bounds[7] = NAN;
  EXPECT(scarp_simplify_points(&points, &options, &finer) == SCARP_USAGE);
  EXPECT_SAYS("tolerance[7] is nan");
  options.tolerance = NULL;
#endif
  scarp_mesh_free(mesh);
#ifdef IS_NEWEST
  points.frame = SCARP_FRAME_DEGREES;
  for (int k = 0; k < 500; ++k) xyz[3 * k + 1] -= 44; /* latitudes around the equator */
  EXPECT(scarp_simplify_points(&points, &options, &mesh) == SCARP_OK);
  EXPECT(strstr(scarp_mesh_metadata(mesh, "frame"), "local metres") != NULL);
  scarp_mesh_free(mesh);
  points.frame = 7;
  EXPECT(scarp_simplify_points(&points, &options, &mesh) == SCARP_USAGE);
  EXPECT_SAYS("the points' frame is 7");
  points.frame = 0;
  points.crs = "garbage";
  if (scarp_has_gdal()) {
    EXPECT(scarp_simplify_points(&points, &options, &mesh) == SCARP_USAGE);
    EXPECT_SAYS("the CRS of points, 'garbage', is none that GDAL knows: give a code such as EPSG:32633");
  }
  points.crs = NULL;
#endif
  points.count = 2;
  EXPECT(scarp_simplify_points(&points, &options, &mesh) == SCARP_INPUT);
}

/* 1 if the file has these bytes. */
static int holds(const char* path, const scarp_bytes* bytes) {
  FILE* file = fopen(path, "rb");
  if (file == NULL) return 0;
  const size_t size = (size_t)scarp_bytes_size(bytes);
  char* read = malloc(size + 1);
  const size_t count = fread(read, 1, size + 1, file);
  fclose(file);
  const int same = count == size && memcmp(read, scarp_bytes_data(bytes), size) == 0;
  free(read);
  return same;
}

/* The program made the files by `simplify DEM FILE -e 5`. */
static void try_file(const char* dem, const char* glb, const char* obj, const char* out) {
  const char* files[2];
  files[0] = glb;
  files[1] = obj;
  const char* formats[2] = {"glb", "obj"};
  scarp_mesh* mesh = NULL;
  scarp_bytes* bytes = NULL;
  scarp_report report;
  report.struct_size = sizeof report;
  for (int k = 0; k < 2; ++k) {
    scarp_options options = make_options(5);
    EXPECT(scarp_options_set(&options, "of", formats[k]) == SCARP_OK);
    EXPECT(scarp_simplify_file(dem, &options, &mesh) == SCARP_OK);
    scarp_options_clear(&options);
    if (mesh == NULL) return;
    EXPECT(scarp_mesh_encode(mesh, NULL, &bytes) == SCARP_OK);
    EXPECT(holds(files[k], bytes));
    scarp_bytes_free(bytes);
    EXPECT(scarp_measure_file(dem, mesh, NULL, &report) == SCARP_OK && report.max_error <= 5);
    if (k == 0) {
      EXPECT(scarp_mesh_write(mesh, out, 1) == SCARP_OK);
      EXPECT(scarp_mesh_write(mesh, out, 0) == SCARP_OUTPUT);
      scarp_mesh* read = NULL;
      EXPECT(scarp_mesh_read(out, &read) == SCARP_OK);
      EXPECT(scarp_mesh_triangle_count(mesh) == scarp_mesh_triangle_count(read));
      for (uint64_t v = 0; v < 3 * scarp_mesh_vertex_count(mesh); ++v)
        EXPECT(scarp_mesh_positions(mesh)[v] == scarp_mesh_positions(read)[v]);
      scarp_mesh_free(read);
    }
    scarp_mesh_free(mesh);
  }
  /* The same samples in memory: the same mesh. */
  scarp_options options = make_options(5);
  EXPECT(scarp_simplify_file(dem, &options, &mesh) == SCARP_OK);
  scarp_raster* raster = NULL;
  EXPECT(scarp_raster_read(dem, NULL, &raster) == SCARP_OK);
  scarp_field field;
  scarp_field_init(&field, sizeof field);
  scarp_raster_field(raster, &field);
  scarp_mesh* other = NULL;
  EXPECT(scarp_simplify(&field, &options, &other) == SCARP_OK);
  EXPECT(is_same(mesh, other));
  scarp_mesh_free(other);
  scarp_mesh_free(mesh);
  scarp_raster_free(raster);
}

int main(int argc, char** argv) {
  for (int k = 0; k < kCols * kRows; ++k)
    heights[k] = (float)(30 * sin((k % kCols) / 9.0) * cos((k / kCols) / 7.0) + k % 3);
  EXPECT(scarp_abi_version() == SCARP_ABI_VERSION);
  EXPECT(strstr(scarp_abi_layout(), "scarp_field ") != NULL);
  try_field();
  try_errors();
  try_lies();
#ifdef IS_NEWEST
  try_newest();
  try_volumes();
  try_live();
#endif
  try_refiner();
  try_points();
  if (argc == 5) try_file(argv[1], argv[2], argv[3], argv[4]);
  if (failures == 0) printf("the C library holds\n");
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
