// client PROGRAM ARGUMENT...: runs the program by the server, with this process's files, folder, environment, limits
// and signals, and ends as it ends. Without a server it becomes the program.
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "request.h"

static int server = -1;

static void forward(int signal) {
  const int before = errno;
  const char byte = (char)signal;
  if (write(server, &byte, 1) < 0) _exit(128 + signal);
  errno = before;
}

static int connect_to(const char* program) {
  struct sockaddr_un address = {.sun_family = AF_UNIX};
  if (!name_socket(program, address.sun_path, sizeof address.sun_path)) return -1;
  const int made = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  return made >= 0 && connect(made, (struct sockaddr*)&address, sizeof address) == 0 ? made : -1;
}

static void list_files(struct Request* request, int* files) {
  files[0] = open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
  request->files = 1;
  DIR* folder = opendir("/proc/self/fd");
  for (struct dirent* entry; folder != NULL && (entry = readdir(folder)) != NULL;) {
    const int number = atoi(entry->d_name);
    if (entry->d_name[0] == '.' || (fcntl(number, F_GETFD) & FD_CLOEXEC) != 0 || request->files == kMostFiles) continue;
    request->numbers[request->files] = number;
    files[request->files++] = number;
  }
  if (folder != NULL) closedir(folder);
}

static char* join_words(struct Request* request, char** arguments) {
  char* text = NULL;
  size_t size = 0;
  FILE* out = open_memstream(&text, &size);
  for (char** word = arguments; *word != NULL; ++word, ++request->words) fwrite(*word, 1, strlen(*word) + 1, out);
  request->arguments = request->words;
  for (char** word = environ; *word != NULL; ++word, ++request->words) fwrite(*word, 1, strlen(*word) + 1, out);
  fclose(out);
  request->size = (uint32_t)size;
  return text;
}

static void send_all(const void* from, size_t size) {
  for (size_t sent = 0; sent < size;) {
    const ssize_t count = send(server, (const char*)from + sent, size - sent, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) exit(125);
    if (count > 0) sent += (size_t)count;
  }
}

static void send_request(struct Request* request, const int* files, const char* text) {
  char control[CMSG_SPACE(kMostFiles * sizeof(int))] = {0};
  struct iovec part = {request, sizeof *request};
  struct msghdr message = {.msg_iov = &part, .msg_iovlen = 1, .msg_control = control};
  message.msg_controllen = CMSG_SPACE(request->files * sizeof(int));
  struct cmsghdr* header = CMSG_FIRSTHDR(&message);
  *header = (struct cmsghdr){.cmsg_level = SOL_SOCKET, .cmsg_type = SCM_RIGHTS};
  header->cmsg_len = CMSG_LEN(request->files * sizeof(int));
  memcpy(CMSG_DATA(header), files, request->files * sizeof(int));
  const ssize_t sent = sendmsg(server, &message, MSG_NOSIGNAL);
  if (sent < 0) exit(125);
  send_all((const char*)request + sent, sizeof *request - (size_t)sent);
  send_all(text, request->size);
}

int main(int argc, char** argv) {
  if (argc < 2) return 125;
  server = connect_to(argv[1]);
  if (server < 0) {
    execv(argv[1], argv + 1);
    return 127;
  }
  static struct Request request;
  static int files[kMostFiles];
  list_files(&request, files);
  umask(request.umask = umask(0));
  for (int k = 0; k < kLimits; ++k) getrlimit(k, &request.limits[k]);
  const int forwarded[] = {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGPIPE};
  for (size_t k = 0; k < sizeof forwarded / sizeof *forwarded; ++k) {
    struct sigaction now = {0};
    sigaction(forwarded[k], NULL, &now);
    if (now.sa_handler == SIG_IGN) {
      request.ignored |= UINT64_C(1) << forwarded[k];
    } else {
      sigaction(forwarded[k], &(struct sigaction){.sa_handler = forward, .sa_flags = SA_RESTART}, NULL);
    }
  }
  send_request(&request, files, join_words(&request, argv + 1));
  int status = 0;
  ssize_t count;
  do count = recv(server, &status, sizeof status, MSG_WAITALL);
  while (count < 0 && errno == EINTR);
  if (count != sizeof status) return 125;
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  signal(WTERMSIG(status), SIG_DFL);
  raise(WTERMSIG(status));
  return 128 + WTERMSIG(status);
}
