// New files under unique names, known to a signal handler.
#pragma once

#include <optional>
#include <string>

namespace scarp::io {

/// While it lives, pending_output() returns the name.
class PendingName {
 public:
  explicit PendingName(const std::string& name);
  PendingName(const PendingName&) = delete;
  PendingName& operator=(const PendingName&) = delete;
  ~PendingName();

 private:
  int place_ = -1;
};

/// While it lives, outputs_naming() returns kNow; afterwards, kDone.
class NamingOutputs {
 public:
  NamingOutputs();
  NamingOutputs(const NamingOutputs&) = delete;
  NamingOutputs& operator=(const NamingOutputs&) = delete;
  ~NamingOutputs();
};

/// A new, empty file in a folder, deleted with this object unless released.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& folder);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();

  const std::string& name() const { return name_; }
  int fd() const { return fd_; }
  /// The errno of a failed creation.
  int error() const { return error_; }
  /// 0 or an errno.
  int close();
  /// Keeps the file, which has been renamed.
  void let_go() { is_ours_ = false; }

 private:
  std::string name_;
  std::optional<PendingName> pending_;
  int fd_ = -1, error_ = 0;
  bool is_ours_ = false;
};

}  // namespace scarp::io
