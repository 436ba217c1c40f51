/* A client of Scarp's C library, in C99. */
#include <scarp_c.h>
#include <stdio.h>
#include <stdlib.h>

enum { kCols = 120, kRows = 80 };

/* The same heights in every language: whole numbers. */
static void make_heights(float* heights) {
  for (int row = 0; row < kRows; ++row) {
    for (int col = 0; col < kCols; ++col) heights[row * kCols + col] = (float)((col * col + 3 * row * row) % 97);
  }
}

static int32_t count_calls(const scarp_progress* progress, void* user) {
  (void)progress;
  ++*(int*)user;
  return 0;
}

static int fail(const char* what) {
  fprintf(stderr, "%s: %s\n", what, scarp_last_error());
  return EXIT_FAILURE;
}

int main(int argc, char** argv) {
  static float heights[kCols * kRows];
  make_heights(heights);

  scarp_field field;
  scarp_field_init(&field, sizeof field);
  field.samples = heights;
  field.cols = kCols;
  field.rows = kRows;

  scarp_options options;
  scarp_options_init(&options, sizeof options);
  if (scarp_options_set(&options, "efort", "high") != SCARP_USAGE) return fail("a wrong name was taken");
  printf("%s\n", scarp_last_error());
  options.max_error = 5;
  int calls = 0;
  options.progress = count_calls;
  options.user = &calls;
  if (scarp_options_set(&options, "effort", "normal") != SCARP_OK) return fail("scarp_options_set");

  scarp_mesh* mesh = NULL;
  const scarp_status status = scarp_simplify(&field, &options, &mesh);
  scarp_options_clear(&options);
  if (status != SCARP_OK) return fail("scarp_simplify");
  printf("%llu vertices, %llu triangles\n", (unsigned long long)scarp_mesh_vertex_count(mesh),
         (unsigned long long)scarp_mesh_triangle_count(mesh));

  scarp_report report;
  report.struct_size = sizeof report;
  if (scarp_measure(&field, mesh, NULL, &report) != SCARP_OK) return fail("scarp_measure");
  printf("max error %.3f of %llu samples\n", report.max_error, (unsigned long long)report.samples);

  scarp_bytes* bytes = NULL;
  if (scarp_mesh_encode(mesh, "glb", &bytes) != SCARP_OK) return fail("scarp_mesh_encode");
  printf("%llu bytes of GLB\n", (unsigned long long)scarp_bytes_size(bytes));
  scarp_bytes_free(bytes);
  if (argc > 1 && scarp_mesh_write(mesh, argv[1], 1) != SCARP_OK) return fail("scarp_mesh_write");
  scarp_mesh_free(mesh);

  scarp_refiner* refiner = NULL;
  if (scarp_refiner_create(&field, &refiner) != SCARP_OK) return fail("scarp_refiner_create");
  const long long inserted = scarp_refiner_run(refiner, 20, 0);
  printf("%lld vertices inserted, max error %.3f\n", inserted, scarp_refiner_max_error(refiner));
  scarp_refiner_free(refiner);
  return EXIT_SUCCESS;
}
