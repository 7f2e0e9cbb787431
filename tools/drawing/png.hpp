#pragma once

#include <string>

#include "planner/base/result.hpp"

namespace swallowtail::drawing {

/// Whether the program that draws pictures, rsvg-convert (Debian: librsvg2-bin), is on the PATH.
bool can_draw_png();

/// Draws an SVG document into a PNG file. Errors (kBadInput): the program is not there, does not understand
/// the document, or cannot write the file.
Status write_png(const std::string& svg, const std::string& path);

}  // namespace swallowtail::drawing
