// 3MF, the format of slicers: an archive with one XML document of solids and two small ones that refer to it (Open
// Packaging Conventions). The 3MF consortium's library is used only in tests, to read Scarp's files. Its output is not
// reproducible: it numbers objects at random and rounds coordinates to six decimals.
//
// Coordinates are written as the shortest decimals of float32, and read as float32, as slicers do. The mesh's metadata
// are lines of one metadata element in Scarp's namespace, because their keys may be invalid XML names.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "base/caught.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_file_text.h"
#include "io/mesh/xml_reader.h"
#include "io/zip.h"
#include "scarp/io.h"
#include "scarp/mesh.h"
#include "scarp/version.h"

namespace scarp::io {
namespace {

constexpr std::string_view kModelPart = "3D/3dmodel.model", kTypesPart = "[Content_Types].xml",
                           kLinksPart = "_rels/.rels";
constexpr std::string_view kModelType = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr std::string_view kContentTypes =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
constexpr std::string_view kMetadata = "scarp:metadata", kOriginName = "scarp.origin";
constexpr const char *kName = "name", *kPlacementName = "placement";

std::vector<std::uint8_t> to_bytes(std::string_view text) { return {text.begin(), text.end()}; }

std::string metadata_lines(const Mesh& mesh) {
  std::string lines;
  if (mesh.origin != std::array<double, 3>{})
    lines += ascii_metadata_line(std::string(kOriginName), origin_text(mesh.origin)) + "\n";
  for (const auto& [key, value] : mesh.metadata) {
    if (key != kName) lines += ascii_metadata_line(key, value) + "\n";
  }
  return lines;
}

/// Positions are offsets from `origin`.
void append_object(const Mesh& mesh, std::size_t id, const std::array<double, 3>& origin,
                   std::vector<std::uint8_t>& bytes) {
  auto out = std::back_inserter(bytes);
  const auto name = mesh.metadata.find(kName);
  fmt::format_to(out, "<object id=\"{}\" type=\"model\"", id);
  if (name != mesh.metadata.end()) fmt::format_to(out, " name=\"{}\"", with_entities(ascii_text(name->second)));
  fmt::format_to(out, "><mesh><vertices>\n");
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    float p[3];
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = static_cast<float>((mesh.origin[k] - origin[k]) + mesh.positions[3 * v + k]) + 0.0f;
    fmt::format_to(out, "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n", p[0], p[1], p[2]);
  }
  fmt::format_to(out, "</vertices><triangles>\n");
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const std::uint32_t* c = &mesh.triangles[t];
    fmt::format_to(out, "<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", c[0], c[1], c[2]);
  }
  fmt::format_to(out, "</triangles></mesh></object>\n");
}

std::vector<std::uint8_t> make_model(std::span<const Mesh> objects) {
  const Mesh& first = objects.front();
  std::vector<std::uint8_t> bytes;
  auto out = std::back_inserter(bytes);
  fmt::format_to(
      out,
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<model unit=\"{}\" xml:lang=\"en-US\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" xmlns:scarp=\"urn:scarp:metadata\">\n"
      "<metadata name=\"Application\">Scarp {}</metadata>\n",
      first.metadata.contains(kPlacementName) ? "millimeter" : "meter", version());
  if (const std::string lines = metadata_lines(first); !lines.empty())
    fmt::format_to(out, "<metadata name=\"{}\">{}</metadata>\n", kMetadata, with_entities(lines));
  fmt::format_to(out, "<resources>\n");
  for (std::size_t k = 0; k < objects.size(); ++k) append_object(objects[k], k + 1, first.origin, bytes);
  fmt::format_to(out, "</resources>\n<build>");
  for (std::size_t k = 0; k < objects.size(); ++k) fmt::format_to(out, "<item objectid=\"{}\"/>", k + 1);
  fmt::format_to(out, "</build>\n</model>\n");
  return bytes;
}

tl::unexpected<Error> refuse_to_read(std::string why) { return fail(ErrorKind::kInput, std::move(why)); }

/// Rows are the images of x, y, z and the origin.
using Transform = std::array<double, 12>;
constexpr Transform kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

/// Reads the objects of a model in order, and its build items, transformed to their places.
class ModelReader {
 public:
  explicit ModelReader(std::span<const std::uint8_t> bytes) : xml_(bytes) {}

  Mesh mesh;

  /// Returns a complaint, or an empty string.
  std::string read() {
    for (;;) {
      switch (xml_.next()) {
        case XmlReader::Event::kStart:
          begin_element();
          break;
        case XmlReader::Event::kEnd:
          if (xml_.name() == "metadata") end_metadata();
          if (xml_.name() == "build") in_build_ = false;
          break;
        case XmlReader::Event::kText:
          if (is_own_metadata_) metadata_ += undo_entities(xml_.text());
          break;
        case XmlReader::Event::kComment:
          break;
        case XmlReader::Event::kBroken:
          return fmt::format("line {}: {}", xml_.line(), xml_.complaint());
        case XmlReader::Event::kDone:
          return built_ == 0 ? "its model builds no object" : finish();
      }
      if (!why_.empty()) return fmt::format("line {}: {}", xml_.line(), why_);
    }
  }

 private:
  struct Object {
    std::vector<double> positions;
    std::vector<std::uint32_t> triangles;
    bool is_built = false;
  };

  void begin_element() {
    const std::string_view name = xml_.name();
    if (name == "metadata") {
      is_own_metadata_ = xml_.attribute("name") == kMetadata;
    } else if (name == "object") {
      object_ = &objects_[xml_.attribute("id")];
      if (!object_->positions.empty()) why_ = "two objects have one id";
    } else if (name == "components") {
      why_ = "an object is made of others, which Scarp does not read";
    } else if (name == "vertex" && object_ != nullptr) {
      read_vertex();
    } else if (name == "triangle" && object_ != nullptr) {
      read_triangle();
    } else if (name == "build") {
      in_build_ = true;
    } else if (name == "item" && in_build_) {
      build_item();
    }
  }

  void end_metadata() {
    if (!is_own_metadata_) return;
    is_own_metadata_ = false;
    TextCursor cursor({reinterpret_cast<const std::uint8_t*>(metadata_.data()), metadata_.size()});
    while (!cursor.at_end()) parse_metadata_line(cursor.rest_of_line(), mesh.metadata);
  }

  void read_vertex() {
    for (const char* axis : {"x", "y", "z"}) {
      double value = 0;
      if (!parse_number(xml_.attribute(axis), value) || !std::isfinite(static_cast<float>(value))) {
        why_ = "a vertex needs three finite numbers";
        return;
      }
      object_->positions.push_back(double{static_cast<float>(value)});
    }
  }

  void read_triangle() {
    for (const char* corner : {"v1", "v2", "v3"}) {
      std::int64_t v = 0;
      const bool is_number = parse_integer(xml_.attribute(corner), v);
      if (!is_number || v < 0 || static_cast<std::uint64_t>(v) >= object_->positions.size() / 3) {
        why_ = "a triangle names a vertex that its object does not have";
        return;
      }
      object_->triangles.push_back(static_cast<std::uint32_t>(v));
    }
  }

  void build_item() {
    const auto found = objects_.find(xml_.attribute("objectid"));
    if (found == objects_.end()) {
      why_ = "an object is to be built that is not there";
      return;
    }
    Object& object = found->second;
    if (object.is_built) {
      why_ = "an object is to be built twice, which Scarp does not read";
      return;
    }
    object.is_built = true;
    ++built_;
    Transform m = kIdentity;
    const std::string text = xml_.attribute("transform");
    TextCursor cursor({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    for (std::size_t k = 0; !text.empty() && k < m.size(); ++k) {
      if (!cursor.number(m[k]) || !std::isfinite(m[k])) {
        why_ = "a transform needs twelve finite numbers";
        return;
      }
    }
    const std::size_t first = mesh.vertex_count();
    if (first + object.positions.size() / 3 > std::numeric_limits<std::uint32_t>::max()) {
      why_ = "it has more vertices than 32 bits can number";
      return;
    }
    for (std::size_t i = 0; i < object.positions.size(); i += 3) {
      const double* p = &object.positions[i];
      for (std::size_t k = 0; k < 3; ++k)
        mesh.positions.push_back(m == kIdentity ? p[k] : p[0] * m[k] + p[1] * m[3 + k] + p[2] * m[6 + k] + m[9 + k]);
    }
    for (const std::uint32_t v : object.triangles) mesh.triangles.push_back(static_cast<std::uint32_t>(first) + v);
  }

  std::string finish() {
    const auto origin = mesh.metadata.find(std::string(kOriginName));
    if (origin == mesh.metadata.end()) return {};
    if (const auto parsed = parse_origin(origin->second)) mesh.origin = *parsed;
    mesh.metadata.erase(origin);
    return {};
  }

  XmlReader xml_;
  std::map<std::string, Object> objects_;
  Object* object_ = nullptr;
  bool is_own_metadata_ = false, in_build_ = false;
  int built_ = 0;
  std::string metadata_, why_;
};

/// The name of the package's root part.
std::string find_model_part(const ZipReader& zip) {
  const auto links = zip.extract(zip.find(kLinksPart));
  if (!links) return zip.find(kModelPart);
  XmlReader xml(*links);
  for (auto event = xml.next(); event != XmlReader::Event::kDone && event != XmlReader::Event::kBroken;
       event = xml.next()) {
    if (event != XmlReader::Event::kStart || xml.attribute("Type") != kModelType) continue;
    const std::string target = xml.attribute("Target");
    return zip.find(target.starts_with("/") ? std::string_view(target).substr(1) : target);
  }
  return zip.find(kModelPart);
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_one_3mf(const Mesh& mesh) { return encode_3mf({&mesh, 1}); }

Result<Mesh> decode_3mf(std::span<const std::uint8_t> bytes) {
  SCARP_TRY(const auto& zip, ZipReader::open(bytes));
  const std::string part = find_model_part(zip);
  if (part.empty()) return refuse_to_read("it is an archive without a 3MF model");
  SCARP_TRY(const auto& model, zip.extract(part));
  ModelReader reader(model);
  if (std::string why = reader.read(); !why.empty()) return refuse_to_read(std::move(why));
  return std::move(reader.mesh);
}

}  // namespace scarp::io

namespace scarp {

Result<std::vector<std::uint8_t>> encode_3mf(std::span<const Mesh> objects) try {
  if (objects.empty()) return fail(ErrorKind::kOutput, "a 3MF file needs an object");
  for (const Mesh& mesh : objects) {
    if (std::string why = io::find_unwritable(mesh, true); !why.empty())
      return fail(ErrorKind::kOutput, std::move(why));
    if (const SolidFacts facts = measure_solid(mesh); !facts.is_solid()) {
      return fail(ErrorKind::kOutput,
                  fmt::format("a 3MF file holds closed solids, and this mesh is none ({}): close it "
                              "with a base, or choose another format",
                              facts.list_faults()));
    }
  }
  const std::string links = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/{}\" Id=\"rel0\" Type=\"{}\"/></Relationships>\n",
      io::kModelPart, io::kModelType);
  const io::ZipEntry entries[] = {{std::string(io::kTypesPart), io::to_bytes(io::kContentTypes)},
                                  {std::string(io::kLinksPart), io::to_bytes(links)},
                                  {std::string(io::kModelPart), io::make_model(objects)}};
  return io::encode_zip(entries);
} catch (...) {
  return caught(ErrorKind::kOutput, "encode the solids");
}

}  // namespace scarp
