// docs/formats.md contains the table of mesh formats. With SCARP_UPDATE_DOCS=1 this test writes it.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "docs_tables.h"
#include "scarp/io.h"

namespace scarp::formats_docs_test {
namespace {

const std::string kHead =
    "| format | ends in | content | read by | coordinates by default | up | also holds | `measure` |";

std::string list_endings(const MeshFormatTraits& traits) {
  std::istringstream words(traits.endings);
  std::string text;
  for (std::string word; words >> word;) text += (text.empty() ? "`." : ", `.") + word + "`";
  return text;
}

std::string describe_place(const MeshFormatTraits& traits) {
  const std::string precision = traits.is_float32 ? ", float32" : ", double";
  switch (traits.frame) {
    case DefaultFrame::kLocal:
      return "local" + precision;
    case DefaultFrame::kMetric:
      return (traits.has_lengths_only ? "source, never degrees" : "source, local for degrees") + precision;
    case DefaultFrame::kSource:
      break;
  }
  return "source" + precision;
}

std::string list_contents(const MeshFormatTraits& traits) {
  std::string text;
  const auto add = [&](bool is_held, const char* what) {
    if (is_held) text += (text.empty() ? "" : "; ") + std::string(what);
  };
  add(traits.holds_attributes, "normals, colours, texture coordinates");
  add(traits.holds_zones, "materials, node strings");
  add(traits.has_projection_file, "a `.prj` file next to it");
  add(traits.holds_prints, "prints in millimetres");
  return text.empty() ? "–" : text;
}

std::string make_format_table() {
  std::string table = kHead + "\n|---|---|---|---|---|---|---|---|\n";
  for (const MeshFormatTraits* traits : mesh_formats()) {
    const std::string up = std::string(1, traits->up) + (traits->has_choice_of_up ? ", `--up`" : "");
    table += "| " + std::string(traits->title) + " | " + list_endings(*traits) + " | " + traits->contents + " | " +
             traits->read_by + " | " + describe_place(*traits) + " | " + up + " | " + list_contents(*traits) + " | " +
             (traits->is_read ? "yes" : "no") + " |\n";
  }
  return table;
}

TEST(formats_docs, hold_the_table_of_the_library) {
  test::expect_tables("docs/formats.md", {{kHead, make_format_table()}}, "formats_docs.*");
}

}  // namespace
}  // namespace scarp::formats_docs_test
