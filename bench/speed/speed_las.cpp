// Times the reading of LAS and LAZ files from memory, without place and unit, and counts what was read.
//
//   speed_las FILE... [--threads N] [--rounds N]
//
// A JSON line for each file. Times are of the round with the least CPU time of N (5). "hash": FNV-1a of all x, y, z as
// the file's integers, by which las.py and the tests compare the points with those of laz-perf; "ground": points of
// class 2.

#include <algorithm>
#include <cstdint>
#include <span>

#include "../harness.h"
#include "las/header.h"
#include "las/read_las.h"

namespace {

std::vector<std::uint8_t> read_all(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Hash {
 public:
  void add(double value) {
    const auto bits = static_cast<std::uint32_t>(static_cast<std::int32_t>(value));
    for (int k = 0; k < 32; k += 8) hash_ = (hash_ ^ (bits >> k & 0xFF)) * 16777619U;
  }
  std::uint32_t value() const { return hash_; }

 private:
  std::uint32_t hash_ = 2166136261U;
};

void time_file(const std::string& path, int threads, int rounds) {
  const std::vector<std::uint8_t> bytes = read_all(path);
  const auto read = [&](std::uint64_t offset, std::span<std::uint8_t> into) {
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), into.size(), into.begin());
    return true;
  };
  const scarp::las::Source source{path, bytes.size(), read};
  scarp::las::Header header = bench::check(scarp::las::read_header(source));
  header.scale = {1, 1, 1};
  header.offset = {0, 0, 0};
  scarp::las::Selection selection;
  selection.has_withheld = true;
  scarp::Run run;
  run.threads = threads;
  scarp::las::Points points;
  bench::Times least;
  for (int round = 0; round < rounds; ++round) {
    const bench::Stopwatch watch;
    points = bench::check(scarp::las::read_points(source, header, selection, run));
    const bench::Times times = watch.read();
    if (round == 0 || times.cpu() < least.cpu()) least = times;
  }
  Hash hash;
  for (std::size_t k = 0; k < points.x.size(); ++k) {
    for (const auto* axis : {&points.x, &points.y, &points.z}) hash.add((*axis)[k]);
  }
  const std::uint64_t ground = points.tally.classes[2];
  std::printf("{\"points\": %zu, \"hash\": %u, \"ground\": %llu, \"bytes\": %zu, %s}\n", points.x.size(), hash.value(),
              static_cast<unsigned long long>(ground), bytes.size(), bench::json_of(least).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "speed_las FILE... [--threads N] [--rounds N]");
  for (const std::string& path : arguments.from(0))
    time_file(path, arguments.number("--threads", 1), arguments.number("--rounds", 5));
}
