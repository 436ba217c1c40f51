// scarp view: a page that shows a mesh and its errors, for a browser.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "session/options/raster_options.h"
#include "session/options/values.h"
#include "session/reports/view_page.h"

namespace scarp::cli {

class ViewCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit ViewCommand(CLI::App& program);
  ViewCommand(const ViewCommand&) = delete;
  ViewCommand& operator=(const ViewCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  Result<void> run() const;

 private:
  /// MESH; of OUT_lod0.glb the other levels, too.
  std::vector<std::string> mesh_paths() const;
  /// The page without a raster: the meshes, of which `first` is read.
  Result<std::vector<PageMesh>> read_meshes(bool is_y_up, Mesh& first) const;
  /// In the coordinates of the mesh.
  Result<OwnedHeightField> read_raster(const Mesh& mesh, std::vector<std::string>& warnings) const;
  /// kPromise where the mesh covers no sample, as measure has it.
  Result<void> check_place(const Mesh& mesh, const OwnedHeightField& field) const;

  CLI::App* command_;
  RasterArguments raster_;
  std::string mesh_;
  Given page_, up_;
  bool open_ = false, overwrite_ = false, quiet_ = false;
};

}  // namespace scarp::cli
