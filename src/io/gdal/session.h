// Isolation of GDAL's global state.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scarp::gdal {

/// Grows GDAL's block cache, which all files of the process share, to at least 8 MB + `bytes`, unless GDAL_CACHEMAX is
/// set.
void widen_block_cache(std::uint64_t bytes);

/// While it lives, HDF5 prints no errors in this thread.
class Hdf5Errors {
 public:
  using Print = int (*)(std::int64_t, void*);
  Hdf5Errors();
  ~Hdf5Errors();
  Hdf5Errors(const Hdf5Errors&) = delete;
  Hdf5Errors& operator=(const Hdf5Errors&) = delete;

 private:
  Print print_ = nullptr;
  void* client_ = nullptr;
  bool is_silenced_ = false;
};

/// While a Session lives, messages of GDAL, PROJ and HDF5 in this thread are collected instead of printed, and no files
/// are written next to inputs. For remote files, options for cheap range requests with time limits are set for this
/// thread unless the user has set them. The first Session of a process registers GDAL's drivers unless drivers are
/// registered already. It excludes drivers that hostile files can crash or hang. It limits GDAL's block cache to 8 MB
/// unless GDAL_CACHEMAX is set. Sessions may be nested; each must end in the thread that began it.
class Session {
 public:
  explicit Session(bool remote = false);
  /// For parallel work on a local file, in another thread or nested. Does not silence HDF5.
  explicit Session(const Session& first);
  ~Session();
  Session& operator=(const Session&) = delete;

  bool failed() const { return !failures_.empty(); }
  /// GDAL's error messages since clear(), as the end of a sentence; "no reason given" without messages.
  std::string reason() const;
  bool out_of_memory() const { return out_of_memory_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Clears failures, keeps warnings.
  void clear() { failures_.clear(); }

  /// Sets a GDAL option for this thread until the Session ends.
  void set_option(const char* key, const char* value);

  /// Called by GDAL's error handler.
  void note(bool is_failure, bool is_memory, const char* message);

 private:
  void set_default(const char* key, const char* value);

  void begin();

  std::optional<Hdf5Errors> hdf5_errors_;
  std::vector<std::string> failures_, warnings_;
  bool out_of_memory_ = false;
  std::vector<std::pair<std::string, std::pair<bool, std::string>>> saved_options_;  // key, (was set, value)
};

}  // namespace scarp::gdal
