// Everything that runs on several threads: the loop, the judge, and callers on their own threads. Also built
// separately, as scarp_thread_tests, for ThreadSanitizer.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <future>
#include <limits>
#include <mutex>
#include <new>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "scarp/io.h"
#include "scarp/live.h"
#include "scarp/simplify.h"
#include "source_dir.h"

// After scarp/io.h: Decode::kNone would shadow kNone.
#include "fit/fit.h"
#include "pieces/tiled.h"

namespace scarp {
namespace {

/// Waves with a hole and a cliff, large enough for several blocks of work.
OwnedHeightField make_waves(int cols, int rows) {
  OwnedHeightField field;
  field.cols = cols;
  field.rows = rows;
  field.frame = grid_frame(rows);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const bool hole = std::hypot(col - cols / 3, row - rows / 2) < 20;
      const double height = 30 * std::sin(col * 0.05) * std::cos(row * 0.07) + (col > 2 * cols / 3 ? 25 : 0);
      field.samples.push_back(hole ? std::nanf("") : static_cast<float>(height));
    }
  }
  return field;
}

void expect_same(const Measurement& a, const Measurement& b) {
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.uncovered, b.uncovered);
  EXPECT_EQ(a.max_error, b.max_error);
  EXPECT_EQ(a.max_error_at, b.max_error_at);
  EXPECT_EQ(a.rmse, b.rmse);
  EXPECT_EQ(a.mean_error, b.mean_error);
  EXPECT_EQ(a.p50, b.p50);
  EXPECT_EQ(a.overlaps, b.overlaps);
  EXPECT_EQ(a.t_junctions, b.t_junctions);
  EXPECT_EQ(a.min_angle, b.min_angle);
}

TEST(Threads, ParallelForCallsEachTaskOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
      std::vector<int> calls(count, 0);
      parallel_for(count, threads, [&](std::size_t i) { ++calls[i]; });
      EXPECT_EQ(calls, std::vector<int>(count, 1)) << count << " tasks on " << threads << " threads";
    }
  }
}

TEST(Threads, TheExceptionOfTheLowestIndexComesThrough) {
  for (const int threads : {1, 2, 8}) {
    for (int round = 0; round < 50; ++round) {
      std::string thrown;
      try {
        parallel_for(100, threads, [&](std::size_t i) {
          if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
        });
      } catch (const std::runtime_error& error) {
        thrown = error.what();
      }
      EXPECT_EQ(thrown, "7") << threads << " threads";
    }
  }
}

TEST(Threads, CommitsFollowInOrderOnTheCallingThread) {
  const auto caller = std::this_thread::get_id();
  for (int threads = 1; threads <= 8; ++threads) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{500}}) {
      std::vector<int> calls(count, 0);
      std::vector<std::size_t> committed;
      std::atomic<std::size_t> started{0};
      std::size_t ahead = 0;
      parallel_in_order(
          count, threads,
          [&](std::size_t i, std::size_t worker) {
            EXPECT_LT(worker, static_cast<std::size_t>(threads));
            ++started;
            ++calls[i];
          },
          [&](std::size_t i) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_EQ(calls[i], 1);
            ahead = std::max(ahead, started.load() - committed.size());
            committed.push_back(i);
            return true;
          });
      std::vector<std::size_t> expected(count);
      std::iota(expected.begin(), expected.end(), std::size_t{0});
      EXPECT_EQ(committed, expected) << count << " tasks on " << threads << " threads";
      EXPECT_EQ(calls, std::vector<int>(count, 1));
      EXPECT_LE(ahead, 4 * static_cast<std::size_t>(threads));
    }
  }
}

TEST(Threads, AWorkersMemoryIsItsOwn) {
  for (const int threads : {2, 3, 8}) {
    std::vector<std::size_t> sums(static_cast<std::size_t>(threads), 0);
    parallel_in_order(
        1000, threads, [&](std::size_t i, std::size_t worker) { sums[worker] += i; }, [](std::size_t) { return true; });
    EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), std::size_t{0}), 499500u);
  }
}

TEST(Threads, ACommitStopsEverything) {
  for (int threads = 1; threads <= 8; ++threads) {
    for (int round = 0; round < 20; ++round) {
      std::vector<std::size_t> committed;
      std::atomic<std::size_t> last{0};
      parallel_in_order(
          100000, threads,
          [&](std::size_t i, std::size_t) {
            for (std::size_t seen = last; seen < i && !last.compare_exchange_weak(seen, i);) {
            }
          },
          [&](std::size_t i) {
            committed.push_back(i);
            return i < 37;
          });
      EXPECT_EQ(committed.size(), 38u);
      EXPECT_LE(last.load(), 37 + 4 * static_cast<std::size_t>(threads));
    }
  }
}

TEST(Threads, OrderedTasksThrowWhatTheLowestOfThemThrows) {
  for (int threads = 1; threads <= 8; ++threads) {
    for (int round = 0; round < 30; ++round) {
      std::string thrown;
      std::vector<std::size_t> committed;
      try {
        parallel_in_order(
            200, threads,
            [&](std::size_t i, std::size_t) {
              if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
            },
            [&](std::size_t i) {
              committed.push_back(i);
              return true;
            });
      } catch (const std::runtime_error& error) {
        thrown = error.what();
      }
      EXPECT_EQ(thrown, "7") << threads << " threads";
      EXPECT_LE(committed.size(), 7u);
      for (std::size_t k = 0; k < committed.size(); ++k) EXPECT_EQ(committed[k], k);
    }
  }
}

TEST(Threads, ACommitThatThrowsEndsTheLoop) {
  for (int threads = 1; threads <= 8; ++threads) {
    std::size_t commits = 0;
    EXPECT_THROW(parallel_in_order(
                     5000, threads, [](std::size_t, std::size_t) {},
                     [&](std::size_t i) {
                       ++commits;
                       if (i == 11) throw std::runtime_error("full");
                       return true;
                     }),
                 std::runtime_error);
    EXPECT_EQ(commits, 12u);
  }
}

TEST(Threads, WhatRunsBesideHasEndedWithTheRest) {
  for (const int threads : {1, 2, 8}) {
    const std::thread::id caller = std::this_thread::get_id();
    int beside = 0, rest = 0;
    run_beside(
        threads, [&] { beside = 1; }, [&] { rest = std::this_thread::get_id() == caller ? 1 : 2; });
    EXPECT_EQ(beside, 1) << threads << " threads";
    EXPECT_EQ(rest, 1) << threads << " threads: the caller's own";
  }
}

TEST(Threads, WhatIsThrownBesideComesThroughFirst) {
  for (const int threads : {1, 2}) {
    const auto thrown = [&](bool beside_too) {
      try {
        run_beside(
            threads, [&] { beside_too ? throw std::runtime_error("beside") : void(); },
            [] { throw std::runtime_error("rest"); });
      } catch (const std::runtime_error& error) {
        return std::string(error.what());
      }
      return std::string();
    };
    EXPECT_EQ(thrown(true), "beside") << threads << " threads";
    EXPECT_EQ(thrown(false), "rest") << threads << " threads";
  }
}

TEST(Threads, NeverChangeATiledMesh) {
  const OwnedHeightField field = make_waves(300, 200);
  const auto one = pieces::refine_tiled(field, {.threshold = 0.5, .threads = 1, .tile_side = 32});
  ASSERT_TRUE(one && *one);
  for (const int threads : {2, 3, 8}) {
    const auto many = pieces::refine_tiled(field, {.threshold = 0.5, .threads = threads, .tile_side = 32});
    ASSERT_TRUE(many && *many);
    const tin::Triangulation &a = (*one)->domain.tin, &b = (*many)->domain.tin;
    ASSERT_EQ(a.triangle_count(), b.triangle_count());
    for (tin::HalfEdge h = 0; h < 3 * a.triangle_count(); ++h) {
      ASSERT_EQ(a.origin(h), b.origin(h));
      ASSERT_EQ(a.twin(h), b.twin(h));
    }
    EXPECT_EQ((*one)->seams, (*many)->seams);
  }
}

TEST(Threads, NeverChangeAFittedMesh) {
  const OwnedHeightField field = make_waves(300, 200);
  const auto fitted = [&](int threads) {
    auto tiled = pieces::refine_tiled(field, {.threshold = 0.5, .threads = threads, .tile_side = 32});
    const grid::Raster raster{field.samples.data(), field.cols, field.rows};
    return *fit::fit(raster, std::move((*tiled)->domain.tin), {.threshold = 0.5, .threads = threads, .patch_side = 50});
  };
  const fit::Fitted one = fitted(1);
  EXPECT_GT(one.counts.removed, 0u);
  for (const int threads : {2, 3, 8}) {
    const fit::Fitted many = fitted(threads);
    ASSERT_EQ(one.tin.triangle_count(), many.tin.triangle_count());
    for (tin::HalfEdge h = 0; h < 3 * one.tin.triangle_count(); ++h) {
      ASSERT_EQ(one.tin.origin(h), many.tin.origin(h));
      ASSERT_EQ(one.tin.twin(h), many.tin.twin(h));
    }
    EXPECT_EQ(one.counts.searches, many.counts.searches);
  }
}

TEST(Threads, MemoryThatRunsOutIsAnError) {
  const OwnedHeightField field = make_waves(60, 60);
  Mesh mesh;
  mesh.positions = {0, 0, 0, 59, 0, 0, 0, 59, 0};
  mesh.triangles = {0, 1, 2};
  MeasureOptions options;
  options.on_row = [](int, std::span<const float>) { throw std::bad_alloc(); };
  const auto measured = measure(field, mesh, options);
  ASSERT_FALSE(measured);
  EXPECT_EQ(measured.error().kind, ErrorKind::kInput);
  EXPECT_EQ(measured.error().message, "not enough memory to measure the mesh");
}

TEST(Threads, NeverChangeWhatIsMeasured) {
  const OwnedHeightField field = make_waves(400, 300);
  const Result<Simplified> result = simplify(field, {.goals = {.max_error = 1.0}});
  ASSERT_TRUE(result) << result.error().message;
  Mesh broken = result->mesh;
  broken.triangles.resize(broken.triangles.size() - 9);
  broken.positions[2] += 5;
  for (const Mesh* mesh : {&result->mesh, static_cast<const Mesh*>(&broken)}) {
    const Result<Measurement> one = measure(field, *mesh, {.run = {.threads = 1}});
    ASSERT_TRUE(one) << one.error().message;
    for (const int threads : {2, 5}) {
      const Result<Measurement> many = measure(field, *mesh, {.run = {.threads = threads}});
      ASSERT_TRUE(many) << many.error().message;
      expect_same(*one, *many);
    }
  }
}

TEST(Threads, NeverChangeTheMesh) {
  const OwnedHeightField field = make_waves(300, 200);
  const Result<Simplified> one = simplify(field, {.goals = {.max_error = 0.5}, .run = {.threads = 1}});
  const Result<Simplified> many = simplify(field, {.goals = {.max_error = 0.5}, .run = {.threads = 4}});
  ASSERT_TRUE(one && many);
  EXPECT_EQ(one->mesh.positions, many->mesh.positions);
  EXPECT_EQ(one->mesh.triangles, many->mesh.triangles);
}

/// Enough lines that their changes are scanned in several parts.
LineConstraints make_soft_lines(int cols, int rows) {
  LineConstraints lines;
  for (int k = 0; k < 60; ++k) {
    Line line;
    for (int i = 0; i <= 50; ++i)
      line.points.push_back({10 + i * (cols - 20) / 50.0, 5 + k * (rows - 10) / 60.0 + std::sin(0.7 * i + k),
                             std::numeric_limits<double>::quiet_NaN()});
    lines.lines.push_back(std::move(line));
  }
  return lines;
}

TEST(Threads, NeverChangeAMeshWithLines) {
  const OwnedHeightField field = make_waves(300, 200);
  for (const Effort effort : {Effort::kFast, Effort::kNormal}) {
    SimplifyOptions options;
    options.goals.max_error = 0.5;
    options.quality.effort = effort;
    options.features.breaklines = make_soft_lines(300, 200);
    options.run.threads = 1;
    const Result<Simplified> one = simplify(field, options);
    options.run.threads = 4;
    const Result<Simplified> many = simplify(field, options);
    ASSERT_TRUE(one && many);
    EXPECT_EQ(one->mesh.positions, many->mesh.positions);
    EXPECT_EQ(one->mesh.triangles, many->mesh.triangles);
    EXPECT_EQ(one->lines_inserted, 60u);
    EXPECT_EQ(many->lines_inserted, 60u);
  }
}

TEST(Threads, CallersMayUseTheLibraryFromTheirOwn) {
  const OwnedHeightField field = make_waves(200, 150);
  const auto make = [&] { return simplify(field, {.goals = {.max_error = 0.7}, .run = {.threads = 2}}); };
  auto first = std::async(std::launch::async, make), second = std::async(std::launch::async, make);
  const Result<Simplified> a = first.get(), b = second.get();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->mesh.positions, b->mesh.positions);
  EXPECT_EQ(a->mesh.triangles, b->mesh.triangles);
}

TEST(Threads, BuffersThatOtherRastersLeftChangeNothing) {
  const OwnedHeightField small = make_waves(90, 70), large = make_waves(700, 400);
  const auto mesh_of = [](const OwnedHeightField& field, double error) {
    return [&field, error] { return simplify(field, {.goals = {.max_error = error}, .run = {.threads = 3}})->mesh; };
  };
  const Mesh fine = mesh_of(small, 0.1)(), coarse = mesh_of(large, 2)();
  for (int round = 0; round < 3; ++round) {
    auto a = std::async(std::launch::async, mesh_of(large, 2)), b = std::async(std::launch::async, mesh_of(small, 0.1)),
         c = std::async(std::launch::async, mesh_of(small, 0.1));
    const Mesh first = a.get(), second = b.get(), third = c.get();
    EXPECT_EQ(first.positions, coarse.positions);
    EXPECT_EQ(first.triangles, coarse.triangles);
    for (const Mesh* mesh : {&second, &third}) {
      EXPECT_EQ(mesh->positions, fine.positions);
      EXPECT_EQ(mesh->triangles, fine.triangles);
    }
  }
}

TEST(Threads, FilesWrittenAtOnceAreEachWhole) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("scarp_threads_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::vector<std::future<bool>> writers;
  for (int k = 0; k < 6; ++k) {
    writers.push_back(std::async(std::launch::async, [&folder, k] {
      const std::vector<std::uint8_t> bytes(100000, static_cast<std::uint8_t>(k));
      const std::string path = (folder / ("file" + std::to_string(k % 3))).string();
      for (int round = 0; round < 5; ++round) {
        if (!write_file(path, bytes)) return false;
      }
      return true;
    }));
  }
  for (std::future<bool>& writer : writers) EXPECT_TRUE(writer.get());
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++files;
    const auto bytes = read_file(entry.path().string());
    ASSERT_TRUE(bytes);
    EXPECT_EQ(*bytes, std::vector<std::uint8_t>(100000, bytes->front())) << entry.path();
  }
  EXPECT_EQ(files, 3);
  std::filesystem::remove_all(folder);
}

TEST(Threads, FewSamplesAreWorkedOnByTheCaller) {
  const OwnedHeightField field = make_waves(120, 100);
  std::mutex mutex;
  std::set<std::thread::id> workers;
  SimplifyOptions options{.goals = {.max_error = 1.0}};
  options.run.is_time_up = [&] {
    const std::lock_guard<std::mutex> lock(mutex);
    workers.insert(std::this_thread::get_id());
    return false;
  };
  const Result<Simplified> alone = simplify(field, options);
  EXPECT_EQ(workers, std::set{std::this_thread::get_id()});
  options.run.threads = 3;
  const Result<Simplified> together = simplify(field, options);
  ASSERT_TRUE(alone && together);
  EXPECT_EQ(alone->mesh.positions, together->mesh.positions);
  EXPECT_EQ(alone->mesh.triangles, together->mesh.triangles);
}

TEST(Threads, ReadersMayRunAtOnce) {
  const std::string path = source_dir() + "/data/jacksboro_fault.tif";
  const auto read = [&] { return read_height_field(path, {.crs = "EPSG:32616"}); };
  auto first = std::async(std::launch::async, read), second = std::async(std::launch::async, read);
  const Result<OwnedHeightField> a = first.get(), b = second.get();
  if (!a && a.error().message.find("GDAL") != std::string::npos) GTEST_SKIP() << a.error().message;
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->samples, b->samples);
  const Result<Simplified> mesh = simplify(*a, {.goals = {.max_error = 40.0}, .run = {.threads = 4}});
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_LE(mesh->measurement.max_error, 40.0);
}

TEST(Threads, ReadersOfALiveFieldSeeOneStateOrTheOther) {
  const OwnedHeightField field = make_waves(70, 50);
  OwnedHeightField other = field;
  for (float& z : other.samples) z *= -2;
  auto live = LiveField::create(field.view(), {.max_error = 0.5, .threads = 2});
  ASSERT_TRUE(live) << live.error().message;
  const auto write = [&](const OwnedHeightField& from) {
    const auto written = live->update({0, 0, 70, 50}, from.samples);
    EXPECT_TRUE(written.has_value());
    return live->mesh().positions;
  };
  const std::vector<double> first = live->mesh().positions, second = write(other);
  ASSERT_NE(first, second);
  std::atomic<bool> is_done = false;
  std::atomic<int> faults = 0;
  std::vector<std::thread> readers;
  for (int k = 0; k < 4; ++k) {
    readers.emplace_back([&] {
      std::uint64_t version = 0;
      while (!is_done) {
        const std::vector<double> seen = live->mesh().positions;
        const LiveChanges changes = live->changes(version);
        if ((seen != first && seen != second) || changes.version < version) ++faults;
        version = changes.version;
      }
    });
  }
  for (int k = 0; k < 20; ++k) write(k % 2 == 0 ? field : other);
  is_done = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(faults, 0);
}

TEST(Threads, OneThreadAtATimeChangesALiveField) {
  const OwnedHeightField field = make_waves(200, 200);
  auto live = LiveField::create(field.view(), {.max_error = 0.1});
  ASSERT_TRUE(live) << live.error().message;
  std::atomic<int> refused = 0;
  std::vector<std::thread> writers;
  for (int k = 0; k < 2; ++k) {
    writers.emplace_back([&, k] {
      for (int turn = 0; turn < 50; ++turn) {
        const auto written =
            live->update({0, 0, 150, 150}, std::vector<float>(150 * 150, static_cast<float>(k + turn)));
        if (written) continue;
        EXPECT_NE(written.error().message.find("another thread changes the live field"), std::string::npos);
        ++refused;
      }
    });
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_TRUE(live->set(3, 3, 7).has_value()) << refused << " were refused";
}

}  // namespace
}  // namespace scarp
