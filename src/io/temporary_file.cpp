#include "io/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <random>
#include <utility>

#include "scarp/io.h"

namespace scarp {
namespace {

constexpr std::size_t kPendingSize = 4096 + 64;  // the longest path that open() accepts, plus suffix
char pending_names[kPendingOutputs][kPendingSize];
std::atomic<bool> pending_taken[kPendingOutputs];
std::atomic<Naming> naming = Naming::kNotYet;
static_assert(std::atomic<Naming>::is_always_lock_free);

}  // namespace

/// The first character is set last and cleared first, so that an interrupting handler sees a whole name or none.
io::PendingName::PendingName(const std::string& name) {
  if (name.empty() || name.size() >= kPendingSize) return;
  int place = 0;
  while (place < kPendingOutputs && pending_taken[place].exchange(true)) ++place;
  if (place == kPendingOutputs) return;
  place_ = place;
  char* held = pending_names[place];
  for (std::size_t i = 1; i <= name.size(); ++i) held[i] = name.c_str()[i];
  std::atomic_signal_fence(std::memory_order_seq_cst);
  held[0] = name[0];
}

io::PendingName::~PendingName() {
  if (place_ < 0) return;
  pending_names[place_][0] = '\0';
  std::atomic_signal_fence(std::memory_order_seq_cst);
  pending_taken[place_] = false;
}

const char* pending_output(int place) { return place >= 0 && place < kPendingOutputs ? pending_names[place] : ""; }

Naming outputs_naming() { return naming; }

io::NamingOutputs::NamingOutputs() { naming = Naming::kNow; }
io::NamingOutputs::~NamingOutputs() { naming = Naming::kDone; }

/// Names are random, because processes in two containers that share a folder may have equal process ids. An existing
/// file belongs to another process and is not touched.
io::TemporaryFile::TemporaryFile(const std::string& folder) {
  constexpr int kMostTries = 100;
  std::random_device random;
  for (int k = 0; k < kMostTries; ++k) {
    name_ = fmt::format("{}.scarp-{:08x}{:08x}.tmp", folder, random(), random());
    pending_.emplace(name_);
    fd_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    is_ours_ = fd_ >= 0;
    if (is_ours_) return;
    error_ = errno;
    pending_.reset();
    if (error_ != EEXIST) return;
  }
}

io::TemporaryFile::~TemporaryFile() {
  close();
  if (is_ours_) ::unlink(name_.c_str());
}

int io::TemporaryFile::close() {
  if (fd_ < 0) return 0;
  return ::close(std::exchange(fd_, -1)) == 0 ? 0 : errno;
}

}  // namespace scarp
