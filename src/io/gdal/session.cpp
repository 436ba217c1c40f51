#include "io/gdal/session.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <dlfcn.h>
#include <gdal.h>

#include <algorithm>
#include <array>
#include <mutex>

namespace scarp::gdal {
namespace {

constexpr GIntBig kBlockCacheBytes = 8 << 20;
constexpr std::size_t kMessagesKept = 8;

void CPL_STDCALL collect(CPLErr severity, CPLErrorNum number, const char* message) {
  auto* session = static_cast<Session*>(CPLGetErrorHandlerUserData());
  if (severity == CE_Failure || severity == CE_Fatal) session->note(true, number == CPLE_OutOfMemory, message);
  if (severity == CE_Warning) session->note(false, false, message);
}

/// libhdf4 ends the program on damaged files. The other drivers read XML with Xerces, which expands entities without
/// limit.
constexpr std::array kUnsafeDrivers{"HDF4", "HDF4Image", "NAS", "GMLAS", "Interlis 2"};

/// If the host has registered drivers itself, all of them are kept.
void register_drivers() {
  const bool are_ours = GDALGetDriverCount() == 0;
  GDALAllRegister();
  if (!are_ours) return;
  for (const char* name : kUnsafeDrivers) {
    if (GDALDriverH driver = GDALGetDriverByName(name)) {
      GDALDeregisterDriver(driver);
      GDALDestroyDriver(driver);
    }
  }
}

/// HDF5 prints its own errors. GDAL may run without the library, so its functions are found by name.
struct Hdf5 {
  using Get = int (*)(std::int64_t, Hdf5Errors::Print*, void**);
  using Set = int (*)(std::int64_t, Hdf5Errors::Print, void*);
  Get get_printing = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "H5Eget_auto2"));
  Set set_printing = reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "H5Eset_auto2"));
};

const Hdf5& hdf5() {
  static const Hdf5 found;
  return found;
}
constexpr std::int64_t kThreadsErrors = 0;  // H5E_DEFAULT

void start_gdal_once() {
  static std::once_flag once;
  std::call_once(once, [] {
    register_drivers();
    if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) == nullptr) GDALSetCacheMax64(kBlockCacheBytes);
  });
}

/// One line without a final full stop, and without the place in GDAL's sources ("./ogr/file.cpp, 949: ").
std::string tidy(std::string text) {
  const std::size_t place = text.starts_with("./") ? text.find(".cpp, ") : text.npos;
  if (const std::size_t colon = text.find(": ", place); place != text.npos && colon != text.npos)
    text.erase(0, colon + 2);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

}  // namespace

Hdf5Errors::Hdf5Errors() {
  if (hdf5().get_printing == nullptr || hdf5().set_printing == nullptr) return;
  is_silenced_ = hdf5().get_printing(kThreadsErrors, &print_, &client_) >= 0;
  if (is_silenced_) hdf5().set_printing(kThreadsErrors, nullptr, nullptr);
}

Hdf5Errors::~Hdf5Errors() {
  if (is_silenced_) hdf5().set_printing(kThreadsErrors, print_, client_);
}

void widen_block_cache(std::uint64_t bytes) {
  start_gdal_once();
  if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) != nullptr) return;
  constexpr std::uint64_t kMost = std::uint64_t{1} << 62;
  GDALSetCacheMax64(std::max(GDALGetCacheMax64(), kBlockCacheBytes + static_cast<GIntBig>(std::min(bytes, kMost))));
}

void Session::begin() {
  CPLPushErrorHandlerEx(collect, this);
  start_gdal_once();
  set_option("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");   // else GDAL writes a file next to the input
  set_option("GML_PARSER", "EXPAT");                    // limits the expansion of entities
  set_default("GDAL_ERROR_ON_LIBJPEG_WARNING", "YES");  // otherwise missing parts of a truncated JPEG are grey
}

Session::Session(const Session&) { begin(); }

Session::Session(bool remote) {
  hdf5_errors_.emplace();
  begin();
  if (!remote) return;
  set_default("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");  // no requests for missing side files
  set_default("CPL_VSIL_CURL_USE_HEAD", "NO");
  set_default("GDAL_HTTP_CONNECTTIMEOUT", "20");
  set_default("GDAL_HTTP_LOW_SPEED_TIME", "60");
  set_default("GDAL_HTTP_LOW_SPEED_LIMIT", "1");
  set_default("GDAL_HTTP_MAX_RETRY", "3");
  set_default("GDAL_HTTP_RETRY_DELAY", "1");
  set_default("GDAL_HTTP_MERGE_CONSECUTIVE_RANGES", "YES");
}

Session::~Session() {
  for (auto saved = saved_options_.rbegin(); saved != saved_options_.rend(); ++saved) {
    const auto& [was_set, value] = saved->second;
    CPLSetThreadLocalConfigOption(saved->first.c_str(), was_set ? value.c_str() : nullptr);
  }
  CPLPopErrorHandler();
}

std::string Session::reason() const { return failures_.empty() ? "no reason given" : failures_.front(); }

void Session::note(bool is_failure, bool is_memory, const char* message) {
  out_of_memory_ = out_of_memory_ || is_memory;
  auto& list = is_failure ? failures_ : warnings_;
  std::string text = tidy(message);
  if (list.size() < kMessagesKept && std::find(list.begin(), list.end(), text) == list.end()) {
    list.push_back(std::move(text));
  }
}

void Session::set_option(const char* key, const char* value) {
  const char* before = CPLGetThreadLocalConfigOption(key, nullptr);
  saved_options_.push_back({key, {before != nullptr, before != nullptr ? before : ""}});
  CPLSetThreadLocalConfigOption(key, value);
}

void Session::set_default(const char* key, const char* value) {
  if (CPLGetConfigOption(key, nullptr) == nullptr) set_option(key, value);
}

}  // namespace scarp::gdal
