// Preloaded into a program (LD_PRELOAD), it starts once and runs main() for each request in a copy of the process.
// Loading GDAL's libraries, more than a hundred, costs 38 ms of CPU time, as much as a small mesh.
//
// A request on standard input: the number of following bytes, in 4 bytes; then words, each ended by a zero byte: the
// file for messages, and the arguments of main(). The answer on standard output: the status of wait(), in 4 bytes. It
// ends with the input.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

typedef int (*Main)(int, char **, char **);
typedef int (*Start)(Main, int, char **, void (*)(void), void (*)(void), void (*)(void), void *);

static Main program;

static int read_all(void *to, size_t size) {
  for (size_t got = 0; got < size;) {
    const ssize_t count = read(0, (char *)to + got, size - got);
    if (count <= 0) return 0;
    got += (size_t)count;
  }
  return 1;
}

static int run_copy(char **words, int count, char **env) {
  const pid_t copy = fork();
  if (copy == 0) {
    dup2(open("/dev/null", O_RDWR | O_CLOEXEC), 0);
    dup2(0, 1);
    dup2(open(words[0], O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666), 2);
    exit(program(count - 1, words + 1, env));
  }
  int status = -1;
  waitpid(copy, &status, 0);
  return status;
}

static int serve(int argc, char **argv, char **env) {
  (void)argc, (void)argv;
  unsetenv("LD_PRELOAD");
  for (uint32_t size; read_all(&size, sizeof size);) {
    char *text = malloc(size), **words = malloc((size + 1) * sizeof *words);
    int count = 0;
    if (text == NULL || words == NULL || !read_all(text, size)) return 1;
    for (char *word = text; word < text + size; word += strlen(word) + 1) words[count++] = word;
    words[count] = NULL;
    const int status = run_copy(words, count, env);
    if (write(1, &status, sizeof status) != sizeof status) return 1;
    free(text);
    free(words);
  }
  return 0;
}

int __libc_start_main(Main main, int argc, char **argv, void (*init)(void), void (*fini)(void), void (*rtld_fini)(void),
                      void *stack_end) {
  program = main;
  const Start start = (Start)dlsym(RTLD_NEXT, "__libc_start_main");
  return start(serve, argc, argv, init, fini, rtld_fini, stack_end);
}
