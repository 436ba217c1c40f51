// Common parts of the experiments with colours.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paper/study.h"
#include "scarp/io.h"
#include "scarp/picture.h"

namespace scarp::paper {

/// Heights with the bands of an image as channels, each with this weight. Borrows both.
HeightField with_colors(HeightField heights, const OwnedChannels& image, double height_scale, double color_scale);

/// A mesh whose colours stand for an image, and how well they do.
struct Painted {
  Simplified run;
  Picture picture;
  double psnr = 0;  ///< against the image
};
Result<Painted> paint(const Study& study, const HeightField& field, const std::string& name, const OwnedChannels& image,
                      PaperOptions options);

/// The same with Objective::kRms and `effort`: at most `vertices`, where the squared error of all bands is small.
Result<Painted> paint_by_squares(const Study& study, const HeightField& field, const std::string& name,
                                 const OwnedChannels& image, std::uint64_t vertices, Effort effort);

/// The image at another size, each new pixel the mean of what it covers, in whole numbers.
OwnedChannels resize(const OwnedChannels& image, int cols, int rows);
/// The middle of a picture, at most that large.
Picture crop(const Picture& picture, int width, int height);
/// Pictures side by side as a PNG. Colours keep five bits, so that the file stays small.
Result<std::vector<std::uint8_t>> encode_beside(std::vector<Picture> pictures);

std::string format_psnr(double psnr);

}  // namespace scarp::paper
