// A file of any size, read at any offset by several threads.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scarp/result.h"

namespace scarp::io {

class ByteSource {
 public:
  /// Fails with kInput unless `path` is a readable regular file.
  static Result<std::unique_ptr<ByteSource>> open(const std::string& path);
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  ~ByteSource();

  const std::string& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  bool has(std::uint64_t offset, std::uint64_t length) const { return offset <= size_ && length <= size_ - offset; }
  /// Fails with kInput for bytes beyond the end of the file.
  Result<std::vector<std::uint8_t>> read(std::uint64_t offset, std::uint64_t length) const;

 private:
  ByteSource(std::string path, int fd, std::uint64_t size) : path_(std::move(path)), fd_(fd), size_(size) {}

  std::string path_;
  int fd_;
  std::uint64_t size_;
};

}  // namespace scarp::io
