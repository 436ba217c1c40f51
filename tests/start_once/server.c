// Preloaded into a program (LD_PRELOAD), it runs the command of the arguments, and main() for each request of that
// command's clients, until the command ends; it returns the command's exit code.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "request.h"

typedef int (*Main)(int, char**, char**);
typedef int (*Start)(Main, int, char**, void (*)(void), void (*)(void), void (*)(void), void*);

enum { kMostCopies = 200, kAboveFiles = 500 };

static Main program;
static sigset_t signals_before;
static int listener, children;
static struct pollfd sockets[kMostCopies + 2];  // the listener, the ends of children, then one for each copy
static pid_t copies[kMostCopies + 2];
static nfds_t count = 2;

static int receive_all(int from, void* to, size_t size) {
  for (size_t got = 0; got < size;) {
    const ssize_t now = recv(from, (char*)to + got, size - got, 0);
    if (now == 0 || (now < 0 && errno != EINTR)) return 0;
    if (now > 0) got += (size_t)now;
  }
  return 1;
}

// The files get new numbers, which `files` returns. The request's words, or NULL.
static char* receive(int from, struct Request* request, int* files) {
  char control[CMSG_SPACE(kMostFiles * sizeof(int))];
  struct iovec part = {request, sizeof *request};
  struct msghdr message = {.msg_iov = &part, .msg_iovlen = 1, .msg_control = control, .msg_controllen = sizeof control};
  const ssize_t got = recvmsg(from, &message, MSG_CMSG_CLOEXEC);
  if (got <= 0 || !receive_all(from, (char*)request + got, sizeof *request - (size_t)got)) return NULL;
  const struct cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (header == NULL || header->cmsg_len != CMSG_LEN(request->files * sizeof(int))) return NULL;
  memcpy(files, CMSG_DATA(header), request->files * sizeof(int));
  char* text = malloc(request->size);
  if (text != NULL && receive_all(from, text, request->size)) return text;
  free(text);
  return NULL;
}

static void take_files(const struct Request* request, int* files) {
  for (uint32_t k = 0; k < request->files; ++k) files[k] = fcntl(files[k], F_DUPFD_CLOEXEC, kAboveFiles);
  close_range(0, kAboveFiles - 1, 0);
  if (fchdir(files[0]) != 0) _exit(125);
  for (uint32_t k = 1; k < request->files; ++k) {
    if (dup2(files[k], request->numbers[k]) < 0) _exit(125);
  }
  close_range(kAboveFiles, ~0U, 0);
}

static void run_copy(const struct Request* request, char* text, int* files) {
  take_files(request, files);
  umask(request->umask);
  for (int k = 1; k < NSIG; ++k) {
    if (k < 64 && (request->ignored >> k & 1) != 0) signal(k, SIG_IGN);
  }
  sigprocmask(SIG_SETMASK, &signals_before, NULL);
  char** words = calloc(request->words + 2, sizeof *words);
  if (words == NULL) _exit(125);
  char** to = words;
  for (uint32_t k = 0; k < request->words; ++k, text += strlen(text) + 1) {
    if (k == request->arguments) ++to;  // the end of the arguments
    *to++ = text;
  }
  environ = words + request->arguments + 1;
  for (int k = 0; k < kLimits; ++k) setrlimit(k, &request->limits[k]);
  const int code = program((int)request->arguments, words, environ);
  fflush(NULL);
  _exit(code);  // the libraries' destructors would copy more pages than most runs do
}

static void start_copy(void) {
  const int from = accept4(listener, NULL, NULL, SOCK_CLOEXEC);
  if (from < 0) return;
  static struct Request request;
  static int files[kMostFiles];
  char* text = count < kMostCopies + 2 ? receive(from, &request, files) : NULL;
  const pid_t copy = text == NULL ? -1 : fork();
  if (copy == 0) run_copy(&request, text, files);
  for (uint32_t k = 0; text != NULL && k < request.files; ++k) close(files[k]);
  free(text);
  if (copy < 0) {
    close(from);
    return;
  }
  sockets[count] = (struct pollfd){from, POLLIN, 0};
  copies[count++] = copy;
}

static void end_copy(pid_t copy, int status) {
  for (nfds_t k = 2; k < count; ++k) {
    if (copies[k] != copy) continue;
    send(sockets[k].fd, &status, sizeof status, MSG_NOSIGNAL);
    close(sockets[k].fd);
    sockets[k] = sockets[--count];
    copies[k] = copies[count];
    return;
  }
}

// Signals from the client, or its end.
static void forward(nfds_t k) {
  char bytes[16];
  const ssize_t got = recv(sockets[k].fd, bytes, sizeof bytes, MSG_DONTWAIT);
  for (ssize_t byte = 0; byte < got; ++byte) kill(copies[k], bytes[byte]);
  if (got != 0) return;
  kill(copies[k], SIGKILL);
  sockets[k].events = 0;
}

// Ends with the command, with its exit code.
static int answer(pid_t command) {
  for (;;) {
    if (poll(sockets, count, -1) < 0) continue;
    if (sockets[1].revents != 0) {
      struct signalfd_siginfo info;
      if (read(children, &info, sizeof info) < 0) return 125;
      int status;
      for (pid_t ended; (ended = waitpid(-1, &status, WNOHANG)) > 0;) {
        if (ended == command) return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        end_copy(ended, status);
      }
      continue;  // the sockets have new places
    }
    for (nfds_t k = 2; k < count; ++k) {
      if ((sockets[k].revents & (POLLIN | POLLHUP)) != 0 && sockets[k].events != 0) forward(k);
    }
    if (sockets[0].revents != 0) start_copy();
  }
}

static int serve(int argc, char** argv, char** env) {
  (void)argc, (void)env;
  unsetenv("LD_PRELOAD");
  unsetenv("LD_BIND_NOW");
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  if (!name_socket(argv[0], address.sun_path, sizeof address.sun_path)) return 125;
  listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (bind(listener, (struct sockaddr*)&address, sizeof address) != 0 || listen(listener, kMostCopies) != 0) return 125;
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGCHLD);
  sigprocmask(SIG_BLOCK, &ends, &signals_before);
  children = signalfd(-1, &ends, SFD_CLOEXEC);
  const pid_t command = fork();
  if (command == 0) {
    sigprocmask(SIG_SETMASK, &signals_before, NULL);
    execvp(argv[1], argv + 1);
    _exit(127);
  }
  sockets[0] = (struct pollfd){listener, POLLIN, 0};
  sockets[1] = (struct pollfd){children, POLLIN, 0};
  const int code = answer(command);
  for (nfds_t k = 2; k < count; ++k) {
    kill(copies[k], SIGKILL);
    waitpid(copies[k], NULL, 0);
  }
  unlink(address.sun_path);
  return code;
}

int __libc_start_main(Main main, int argc, char** argv, void (*init)(void), void (*fini)(void), void (*rtld_fini)(void),
                      void* stack_end) {
  program = main;
  const Start start = (Start)dlsym(RTLD_NEXT, "__libc_start_main");
  return start(serve, argc, argv, init, fini, rtld_fini, stack_end);
}
