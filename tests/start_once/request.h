// Shared by client.c and server.c: a program is loaded once, and main() runs for each request in a copy of the process.
// Loading GDAL's more than a hundred libraries costs 40 to 100 ms of CPU time, as much as a small mesh.
#pragma once

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

// The path of a program's socket: the variable SCARP_START_ONCE, a dot, and the program's file name. Returns 0 without
// the variable.
static inline int name_socket(const char* program, char* path, size_t size) {
  const char* before = getenv("SCARP_START_ONCE");
  const char* slash = strrchr(program, '/');
  if (before == NULL) return 0;
  const int length = snprintf(path, size, "%s.%s", before, slash != NULL ? slash + 1 : program);
  return length > 0 && (size_t)length < size;
}

enum { kMostFiles = 250, kLimits = 16 };

// A request, with the open files as ancillary data. `size` bytes follow: the program, the arguments and the environment
// as words, each ended by a zero byte. The answer is the status of wait(), in 4 bytes. Until then, each byte from the
// client is a signal for the copy, which is killed if the client ends.
struct Request {
  uint32_t size;
  uint32_t words;
  uint32_t arguments;
  uint32_t files;
  int32_t numbers[kMostFiles];  // numbers of the files; the first is the working directory
  uint32_t umask;
  uint64_t ignored;  // signals
  struct rlimit limits[kLimits];
};
